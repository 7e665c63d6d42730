"""The bearings of the crankshafts in the carrier: stiffness as given, or of rolling bearings under what they carry.

Loads and stiffnesses follow from each other: contacts are solved with elastic discs on the coarser mesh at a few places
of the turn, stiffnesses follow from their loads, and so on until both agree. In the carrier's frame a crankshaft's load
hardly turns, so that its bearings are stiffer along it than across.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.rolling import SETTLED, STEPS, Held, held
from trochoid.drives.rolling_seat import seat_levels
from trochoid.drives.rv.series import solve_series, turn_angles
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, frozen

if TYPE_CHECKING:
    from trochoid.drives.rolling_seat import SeatLevels
    from trochoid.drives.rv.bodies import Level
    from trochoid.drives.rv.design import Design
    from trochoid.drives.rv.series import Series

NAME = "drive.crankshaft.bearing"
POSITIONS = 6  # over a turn of the crankshafts
FIRST = 3e8  # N/m: where loads and stiffnesses start from
ABOUT = 1000.0 * SETTLED  # relative change at which they agree


@dataclass(frozen=True, eq=False, slots=True)
class CrankBearings:
    """Rolling bearings A and B of the crankshafts under the loads of all, and their stiffness (2, 2, 2) in N/m.

    It is along the line from the carrier's axis to the crankshaft's, and across that line.
    """

    rolling: tuple[Held, Held]
    stiffness: Array


def crank_bearings(design: Design, level: Level) -> CrankBearings:
    """Return the bearings with loads and stiffnesses that agree; raises Infeasible for one that resists nothing."""
    angle = np.linspace(0.0, turn_angles(design, 1)[-1], POSITIONS, endpoint=False)
    table = design.drive.crankshaft.bearing
    assert table is not None
    seat = seat_levels(table, design.scene.materials)
    stiffness = FIRST * np.tile(np.eye(2), (2, 1, 1))
    change = np.inf
    for _ in range(STEPS):
        series = solve_series(design, "level0", replace(level, cranks=stiffness), angle)
        rolling = _pair(design, series, seat)
        new = np.stack([each.mean[:2, :2] for each in rolling])
        change = float(np.abs(new - stiffness).max() / np.abs(new).max())
        stiffness = frozen(new)
        if change <= ABOUT:
            return CrankBearings(rolling, stiffness)
    raise NotConverged(
        f"bearings of the crankshafts: stiffness and load still change each other by {change:.1e} after {STEPS} steps; "
        f"give their radial_load, or a smaller clearance"
    )


def under(design: Design, series: Series, found: CrankBearings | None) -> tuple[Held, Held]:
    """Return the bearings A and B under the loads of solved contacts over a turn, in the seats that were `found`."""
    table = design.drive.crankshaft.bearing
    assert table is not None
    if found is None:
        return _pair(design, series, seat_levels(table, design.scene.materials))
    one, two = _pair(design, series, None)
    return replace(one, seat=found.rolling[0].seat), replace(two, seat=found.rolling[1].seat)


def _pair(design: Design, series: Series, seat: SeatLevels | None) -> tuple[Held, Held]:
    table = design.drive.crankshaft.bearing
    assert table is not None
    force = np.einsum("njbx,jyx->njby", series.bearing_force, local(design))
    one, two = (
        held(f"{NAME}, {place}", table, force[:, :, b].reshape(-1, 2), seat, ring_speeds(design))
        for b, place in enumerate("AB")
    )
    return one, two


def local(design: Design) -> Array:
    """Return the unit vectors (j, 2, 2) outward and across at each crankshaft, in rows."""
    out = design.crank_places / design.first.arm
    return np.stack([out, np.stack([-out[:, 1], out[:, 0]], axis=-1)], axis=1)


def ring_speeds(design: Design) -> tuple[float, float]:
    """Return the speeds (rad/s) of crankshaft and carrier, about the crankshaft's axis and past the carrier."""
    return float(design.turning) * design.scene.operation.input_speed, 0.0
