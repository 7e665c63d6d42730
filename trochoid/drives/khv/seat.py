"""Stiffness of the eccentric bearing under its load: rollers by ISO/TS 16281 on a rigid ring, and on the
disc's elastic bore.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.bodies import Level
from trochoid.drives.khv.contact import assembly
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.series import Series
from trochoid.fem.bearing import RollerBearing, seated_stiffness
from trochoid.fem.position import seat_coupling
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class SeatStiffness:
    """Stiffness (4, 4) on x, y (N/m) and tilt about x, y (N·m/rad) of one eccentric bearing at the first position.

    `elastic` is None when the disc is rigid.

    """

    rigid: Array
    elastic: Array | None


def seat_stiffness(design: Design, series: Series, level: Level | None, disc: int = 0) -> SeatStiffness:
    """Return the bearing's stiffness at the roller loads of the first position."""
    assert series.bearing is not None
    table = design.drive.eccentric_bearing
    bearing = RollerBearing(
        table.rollers, table.roller_radius, design.pitch_radius, table.roller_length, 2 * design.bearing_play
    )
    crank = float(series.crank[0])
    loads = series.bearing.force[0, disc]
    start = design.cage_angle(crank)
    rigid = seated_stiffness(bearing, loads, np.zeros((table.rollers,) * 2), start)
    if level is None:
        return SeatStiffness(rigid, None)
    problem = assembly(design, series.rung, level.elastic, crank)
    family = next(f for f in problem.families if f.name == f"bearing{disc}")
    seat = seat_coupling(problem, family, series.motion[0])
    return SeatStiffness(rigid, seated_stiffness(bearing, loads, seat, start))
