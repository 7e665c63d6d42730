"""Stiffness of a turning-arm bearing under its load: by ISO/TS 16281 on a rigid ring, and in the disc's hole."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.rv.bodies import Level
from trochoid.drives.rv.contact import assembly, cage_angle
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.series import Series
from trochoid.fem.bearing import RollerBearing, seated_stiffness
from trochoid.fem.position import seat_coupling
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class ArmStiffness:
    """Stiffness (4, 4) on x, y (N/m) and tilts (N·m/rad) of one turning-arm bearing, and its `load` (2,) in N."""

    rigid: Array
    elastic: Array
    load: Array

    @property
    def too_stiff(self) -> float:
        """How much more the rigid ring's stiffness along the load is, in %; 0 where nothing carries."""
        hard, soft = (float(self.load @ k[:2, :2] @ self.load) for k in (self.rigid, self.elastic))
        return 100.0 * (hard / soft - 1.0) if soft > 0.0 else 0.0


def arm_stiffness(
    design: Design, series: Series, level: Level, disc: int = 0, crank: int = 0
) -> ArmStiffness:
    """Return the bearing's stiffness at the roller loads of the first position."""
    table = design.drive.arm_bearing
    bearing = RollerBearing(
        table.rollers, table.roller_radius, design.pitch_radius, table.roller_length, 2.0 * design.arm_play
    )
    loads, start = series.arm.force[0, disc, crank], float(cage_angle(design, series.crank[:1])[0])
    problem = assembly(design, series.motions, level.elastic, series.crank[:1])
    family = next(f for f in problem.families if f.name == f"arm{disc}_{crank}")
    seat = seat_coupling(problem, family, series.motion[0])
    rigid = seated_stiffness(bearing, loads, np.zeros((table.rollers,) * 2), start)
    return ArmStiffness(
        rigid, seated_stiffness(bearing, loads, seat, start), series.arm.resultant[0, disc, crank]
    )
