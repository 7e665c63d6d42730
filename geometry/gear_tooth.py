"""The tooth of an involute gear with a rounded tip edge, in closed form; external teeth and those of a ring.

Half a tooth is, from the middle of a space: root circle, fillet, involute, rounding, tip circle. The rounding touches
involute and tip circle. Where the land is too narrow for two of them (a pointed tooth), it touches both flanks and
ends the tooth below the tip circle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute import Gear, inverse_involute
from trochoid.kinematics.involute_curve import GearCurve
from trochoid.kinematics.involute_cut import Cut


@dataclass(frozen=True, slots=True)
class Tooth:
    """What a tool leaves (`cut`), the tip circle and the radius of the tip edge's rounding, m."""

    cut: Cut
    tip_radius: float
    rounding: float

    def __post_init__(self) -> None:
        """Refuse a tip circle that does not cross the involute, and a rounding that is none or eats it up."""
        if not self.rounding > 0.0:
            raise Infeasible(
                f"tip rounding {1e3 * self.rounding:g} mm: a sharp edge has no contact law; a few hundredths of the "
                f"module, {20.0 * self.gear.module:.3g} mm, are usual"
            )
        if self.tip_radius < self.gear.base_radius or not self.full:
            GearCurve(self.cut, self.tip_radius)
        if not self.gear.side * (self.end - self.cut.start) > 0.0:
            raise Infeasible(
                f"tip rounding {1e3 * self.rounding:g} mm leaves no involute: it would end before the involute begins, "
                f"at a radius of curvature of {1e3 * self.cut.start:.6g} mm; take a smaller rounding"
            )

    @property
    def gear(self) -> Gear:
        """The gear."""
        return self.cut.gear

    @property
    def pitch(self) -> float:
        """Angle between teeth, rad."""
        return 2.0 * math.pi / self.gear.teeth

    @property
    def full(self) -> bool:
        """Whether one rounding makes the whole tip, because the teeth are pointed or nearly so."""
        return not self._turn(self._circle_reach()) < 0.5 * self.pitch

    def _circle_reach(self) -> float:
        """Distance (m) of the rounding's centre from the base circle along its tangent; nan within that circle."""
        inner, base = self.tip_radius - self.gear.side * self.rounding, self.gear.base_radius
        return math.sqrt(inner**2 - base**2) if inner > base else math.nan

    def _turn(self, reach: float) -> float:
        """Polar angle (rad) of the rounding's centre, from the middle of the space."""
        side, base = self.gear.side, self.gear.base_radius
        end = reach + side * self.rounding
        return float(self.gear.base_angle + side * (end / base - math.atan2(reach, base)))

    @property
    def reach(self) -> float:
        """Distance (m) of the rounding's centre from the base circle along its tangent."""
        if not self.full:
            return self._circle_reach()
        gear = self.gear
        room = 0.5 * self.pitch - float(gear.base_angle) - self.rounding / gear.base_radius
        angle = float(inverse_involute(gear.side * room))
        return gear.base_radius * math.tan(angle)

    @property
    def end(self) -> float:
        """Radius of curvature ρ_e (m) where the involute ends and the rounding begins."""
        return self.reach + self.gear.side * self.rounding

    @property
    def end_radius(self) -> float:
        """Radius (m) of the circle on which the involute ends."""
        return math.hypot(self.gear.base_radius, self.end)

    @property
    def center(self) -> complex:
        """Centre of the rounding, m, on the flank at positive polar angles."""
        radius = math.hypot(self.gear.base_radius, self.reach)
        turn = 0.5 * self.pitch if self.full else self._turn(self.reach)
        return complex(radius * math.cos(turn), radius * math.sin(turn))

    @property
    def top_radius(self) -> float:
        """Radius (m) of the highest point: the tip circle's, less where the tooth is pointed."""
        if not self.full:
            return self.tip_radius
        return abs(self.center) + self.gear.side * self.rounding


def sharpest(gear: Gear, share: float = 0.02) -> float:
    """Return the tip rounding (m) that is taken where none is given: a share of the module."""
    return share * gear.module
