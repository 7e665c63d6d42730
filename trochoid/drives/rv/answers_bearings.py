"""Answers about turning-arm bearings in the discs' holes and crank bearings: stiffness, safety and life."""

from __future__ import annotations

import numpy as np

from trochoid.drives.entries import STIFFNESS_ENTRIES
from trochoid.drives.mesh_error import Pair, scalar_error
from trochoid.drives.rolling import Held, rollers_under
from trochoid.drives.rolling_answers import MODEL, life_parts, noted, stiffness_parts, with_errors
from trochoid.drives.rv.bearings import ring_speeds
from trochoid.drives.rv.seat import ArmStiffness
from trochoid.drives.rv.series import Series
from trochoid.drives.rv.stages import Stages
from trochoid.results.outcome import Parts, Quantity
from trochoid.scene.rolling import RollingTable


def bearing_stiffness(s: Stages) -> Quantity:
    """Stiffness of a turning-arm bearing on a rigid ring and in the disc's hole, and of the crank bearings."""
    parts: dict[str, Quantity | Parts] = {
        "arm_rigid_ring": _entries(s, s.arm.map(lambda x: x.rigid)),
        "arm_elastic_seat": _entries(s, s.arm.map(lambda x: x.elastic)),
        "arm_rigid_ring_over_flexible": _number(s, s.arm.map(_too_stiff), "%"),
    }
    given = s.scene.drive.crankshaft.bearing_stiffness
    if given is not None:
        parts["crank"] = Quantity(1e-6 * given, "N/um", None, "given")
    note = "turning arm: first disc and crankshaft at the first position, rollers by ISO/TS 16281"
    for place, now, used in zip("AB", s.rolling, s.crank_stiffness, strict=True) if s.rolling else ():
        off = None if used is None else float(np.abs(now.mean[:2, :2] - used).max() / np.abs(used).max())
        found = stiffness_parts(now, off)
        (outward, coupling), (_, across) = now.mean[:2, :2]
        found["outward"] = Quantity(1e-6 * float(outward), "N/um", None, MODEL)
        found["across"] = Quantity(1e-6 * float(across), "N/um", None, MODEL)
        found["coupling"] = Quantity(1e-6 * float(coupling), "N/um", None, MODEL)
        parts[f"crank_{place}"] = noted(found, now)
        note = (
            "turning arm: first disc and crankshaft at the first position; crank bearings: x from the carrier's axis "
            "outward, mean over the turn and all crankshafts, ± what the loads on the finer mesh would change"
        )
    return Quantity(parts=parts, note=note)


def _too_stiff(found: ArmStiffness) -> float:
    return found.too_stiff


def _number(s: Stages, pair: Pair[float], unit: str) -> Quantity:
    error = None if pair.coarse is None else scalar_error(pair.fine, pair.coarse, s.difference)
    return Quantity(pair.fine, unit, error, s.rung)


def _entries(s: Stages, matrix: Pair[np.ndarray]) -> Parts:
    return {
        name: _number(s, matrix.map(lambda k, ij=ij, scale=scale: scale * float(k[ij])), unit)  # type: ignore[misc]
        for name, ij, scale, unit in STIFFNESS_ENTRIES
    }


def bearing_life(s: Stages) -> Quantity:
    """Safety and life of the turning-arm bearings by their rollers' loads in elastic holes, and of crank bearings."""
    inner, outer = ring_speeds(s.design)
    both = s.contact.pair
    parts: dict[str, Quantity | Parts] = {}
    for i in range(len(s.design.discs)):
        levels = both.map(lambda x, i=i: life_parts(_arm(s, x, i), inner - outer, inner_turns=True))  # type: ignore[misc]
        parts[f"arm_disc_{i + 1}"] = with_errors(levels, s.difference)
    for place, found in zip("AB", s.rolling, strict=False):
        parts[f"crank_{place}"] = life_parts(found, inner - outer, inner_turns=True)
    note = (
        "over a turn of the crankshafts and all of them, speeds past the carrier; the arm's rollers as they share the "
        "load in the disc's hole, crank bearings on rigid rings; L10r by ISO/TS 16281"
    )
    return Quantity(parts=parts, note=note)


def _arm(s: Stages, series: Series, disc: int) -> Held:
    """Return the turning-arm bearing of a disc under the roller loads of a turn on all crankshafts."""
    from trochoid.fem.rolling_roller import RollerRow

    table = s.design.drive.arm_bearing
    row = RollerRow(
        table.rollers,
        2.0 * table.roller_radius,
        2.0 * s.design.pitch_radius,
        table.roller_length,
        clearance=2.0 * s.design.arm_play,
    )
    forces = series.arm.force[:-1, disc].reshape(-1, table.rollers)
    return Held(
        RollingTable(), rollers_under(row, forces, series.arm.resultant[:-1, disc].reshape(-1, 2)), None
    )
