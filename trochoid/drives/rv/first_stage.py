"""The involute stage of an RV drive: sun and planets with the shifts that the scene gives or leaves to choose."""

from __future__ import annotations

import math
from dataclasses import dataclass

from trochoid.kinematics.involute import Gear
from trochoid.kinematics.involute_cut import Cut
from trochoid.kinematics.involute_pair import Pair, mesh, mesh_at, needed_shift
from trochoid.kinematics.rack import Rack, rack_cut
from trochoid.scene.drive_rv import FirstStage

ROUNDING = 0.38  # of the rack's tip, in modules, where its flanks leave room for it


@dataclass(frozen=True, slots=True)
class Stage:
    """Sun (first) and planet (second) in mesh, their tip radii in m, and what is given of their play (m, on the
    pitch circle).
    """

    pair: Pair
    tips: tuple[float, float]
    backlash: float

    @property
    def arm(self) -> float:
        """Centre distance (m), the radius of the circle of the crankshafts."""
        return float(self.pair.center_distance)

    @property
    def cuts(self) -> tuple[Cut, Cut]:
        """What a standard rack leaves of sun and planet; raises Infeasible."""
        return _cut(self.pair.first), _cut(self.pair.second)


def first_stage(table: FirstStage) -> Stage:
    """Make the stage; raises Infeasible where the gears cannot reach each other.

    Without `x_sun` the sun has the least shift (to 0.01) that a rack does not undercut, and without `x_planet` the
    planet has what keeps the centre distance: the given one, else that of unshifted gears.
    """
    x_sun = _x_sun(table)
    sun = _gear(table, table.z_sun, x_sun)
    planet = _gear(table, table.z_planet, -x_sun if table.x_planet is None else table.x_planet)
    if table.center_distance is None:
        pair = mesh(sun, planet)
    else:
        pair = mesh_at(sun, planet, table.center_distance)
        if table.x_planet is None:
            planet = _gear(table, table.z_planet, float(needed_shift(pair)) - x_sun)
            pair = mesh_at(sun, planet, table.center_distance)
    short = float(pair.tip_shortening)  # tips keep the rack's clearance to the other's root
    tips = tuple(g.pitch_radius + g.module * (g.addendum + float(g.shift) - short) for g in (sun, planet))
    return Stage(pair, (tips[0], tips[1]), table.backlash)


def _x_sun(table: FirstStage) -> float:
    if table.x_sun is not None:
        return table.x_sun
    least = _gear(table, table.z_sun, 0.0).least_shift
    return max(0.0, math.ceil(100.0 * least - 1e-9) / 100.0)


def _gear(table: FirstStage, teeth: int, shift: float) -> Gear:
    return Gear(teeth, table.module, table.pressure_angle, shift)


def _cut(gear: Gear) -> Cut:
    alpha, height = gear.pressure_angle, gear.addendum + gear.clearance
    room = (0.25 * math.pi - height * math.tan(alpha)) * math.cos(alpha) / (1.0 - math.sin(alpha))
    return rack_cut(gear, Rack(gear.module, alpha, height, min(ROUNDING, room)))
