"""Rollers that lean or are too thick for the flanks: they press both sides of the teeth without any load."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.precessional.contact import paired, satellite_moves, solve_series, to_flank
from trochoid.drives.precessional.rim import toothed
from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    from trochoid.drives.precessional.contact import Series
    from trochoid.drives.precessional.contact_stages import Solved
    from trochoid.drives.precessional.design import Design
    from trochoid.drives.precessional.teeth import Level

LEAST = 1e-9  # m: what is less is no more than the rounding of flanks and their sizes
HALVINGS = 60
UP = 1.05  # of the clearance that is just enough: the flanks' slopes are those before anything turns


@dataclass(frozen=True, slots=True)
class Wedged:
    """`missing` clearance in m at the position of the crank angle `crank`, and the largest `force` (N) without load."""

    missing: float
    crank: float
    force: float


def wedged(design: Design, solved: Solved, tilt_stiffness: float | None) -> Wedged | None:
    """Say how far the rollers are too thick to turn freely, and what they press with; None where they are not."""
    series = solved.fine
    missing = missing_clearance(design, solved.level, series.crank)
    worst = int(missing.argmax())
    if missing[worst] < LEAST:
        return None
    idle: Series = series
    if series.torque != 0.0:
        idle = solve_series(design, solved.level, 0.0, series.crank[worst : worst + 1], tilt_stiffness)
    return Wedged(float(missing[worst]), float(series.crank[worst]), float(idle.total.max()))


def missing_clearance(design: Design, level: Level, crank: Array) -> Array:
    """Return by how much (n,), m, rollers must be thinner for the satellite to turn on its axis without force.

    Below 0: how much thicker they may be. Its axis itself is held by A, so that it does not give way without a force.
    """
    (tooth, _), pair = toothed(design), paired(design, level, crank)
    axis = satellite_moves(tooth, to_flank(tooth, crank))[:, :, 2]
    state = pair.at(np.zeros((len(crank), 3)))
    closing = np.einsum("ncsk,nk->ncs", state.arms, axis)
    share = pair.slices.middle / design.tooth_radius
    return np.array(
        [
            _missing(g.ravel(), a.ravel(), np.broadcast_to(share, g.shape).ravel())
            for g, a in zip(state.gap, closing, strict=True)
        ]
    )


def _missing(gap: Array, closing: Array, share: Array) -> float:
    """Return the least y for which an angle m leaves no gap + y·share − closing·m below 0."""
    ahead, back = closing > 0.0, closing < 0.0
    if not ahead.any() or not back.any():
        return -math.inf

    def room(y: float) -> float:
        limit = (gap + y * share) / np.where(closing == 0.0, 1.0, closing)
        return float(limit[ahead].min() - limit[back].max())

    low, high = float((-gap / share).min()), float((-gap / share).max())
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if room(middle) >= 0.0 else (middle, high)
    return high


def said(design: Design, found: Wedged) -> str:
    """Return the warning."""
    given = design.scene.drive.rollers
    leaning = given.tilt != 0.0 or given.skew != 0.0
    enough = 1e3 * (given.clearance + UP * found.missing)
    digit = 10.0 ** (math.floor(math.log10(enough)) - 1)
    enough = math.ceil(enough / digit) * digit
    cause = "they lean (tilt, skew)" if leaning else "they are too thick for the flanks"
    return (
        f"rollers wedge: {found.force:.3g} N without load at input angle {math.degrees(found.crank):.4g}°, for "
        f"{cause}; give a clearance of at least {1e3 * enough:.3g} µm (drive.rollers.clearance = {enough:.3g})"
        + (", or less tilt and skew" if leaning else "")
    )
