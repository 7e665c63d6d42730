"""Two involute gears in mesh, external or internal: operating angle, contact, sliding.

The first gear has external teeth; the second has external teeth or is a ring (`internal`).  With s = +1 or −1
for these, z_Σ = z2 + s z1 and x_Σ = x2 + s x1 serve both: inv α_w = inv α + 2 x_Σ tan α/z_Σ.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute import Gear, Real, inverse_involute, involute, polar_involute


@dataclass(frozen=True, slots=True)
class Pair:
    """Gears in mesh at an operating pressure angle α_w (rad); lengths in m."""

    first: Gear
    second: Gear
    operating_angle: Any

    def __post_init__(self) -> None:
        """Refuse gears that no common rack makes."""
        one, two = self.first, self.second
        if one.internal:
            raise Infeasible("the first gear of a pair is a ring; give the ring as the second")
        if one.module != two.module or one.pressure_angle != two.pressure_angle:
            raise Infeasible(
                "gears of different module or pressure angle do not mesh; give both the same rack"
            )
        if self.teeth <= 0:
            given = f"{one.teeth} teeth in a ring of {two.teeth}"
            raise Infeasible(
                f"{given}: the ring needs more; take at least {one.teeth + 1}, or a smaller planet"
            )

    @property
    def side(self) -> float:
        """+1 for an external, −1 for an internal mesh."""
        return self.second.side

    @property
    def teeth(self) -> int:
        """z_Σ = z2 ± z1."""
        return self.second.teeth + int(self.side) * self.first.teeth

    @property
    def shift(self) -> Any:
        """x_Σ = x2 ± x1."""
        return self.second.shift + self.side * self.first.shift

    @property
    def reference_distance(self) -> float:
        """Centre distance (m) without shift, m z_Σ/2."""
        return 0.5 * self.first.module * self.teeth

    @property
    def center_distance(self) -> Any:
        """Operating centre distance a_w, m."""
        return self.reference_distance * math.cos(self.first.pressure_angle) / np.cos(self.operating_angle)

    @property
    def spread(self) -> Any:
        """y = (a_w − a)/m."""
        return (self.center_distance - self.reference_distance) / self.first.module

    @property
    def tip_shortening(self) -> Any:
        """Δy = x_Σ − y, by which tips are shortened to keep the clearance."""
        return self.shift - self.spread

    @property
    def ratio(self) -> float:
        """u = z2/z1."""
        return self.second.teeth / self.first.teeth

    @property
    def pitch_radii(self) -> tuple[Any, Any]:
        """Operating pitch radii, m."""
        cosine = np.cos(self.operating_angle)
        return self.first.base_radius / cosine, self.second.base_radius / cosine

    @property
    def action(self) -> Any:
        """Length a_w sin α_w (m) between the points where the line of action touches the base circles."""
        return self.center_distance * np.sin(self.operating_angle)

    @property
    def backlash(self) -> Any:
        """Play (m) along the line of action; negative where the given a_w is too small for the shifts."""
        one = self.first
        inv = involute(self.operating_angle) - involute(one.pressure_angle)
        short = inv * self.teeth - 2.0 * self.shift * math.tan(one.pressure_angle)
        return self.side * one.module * math.cos(one.pressure_angle) * short

    def of_first(self, curvature_radius: Real) -> Any:
        """Radius of curvature (m) of the first gear's flank where it touches the second's of `curvature_radius`."""
        return self.side * (self.action - curvature_radius)

    def of_second(self, curvature_radius: Real) -> Any:
        """Radius of curvature (m) of the second gear's flank where it touches the first's of `curvature_radius`."""
        return self.action - self.side * curvature_radius

    def lowest(self, first_tip: Real, second_tip: Real) -> tuple[Any, Any]:
        """Radii of curvature ρ_p (m) where the active flanks end, for the tip radii (m) of both.

        An external flank is active from there outward, a ring's from there inward.
        """
        one = self.of_first(self.second.curvature_radius(second_tip))
        return one, self.of_second(self.first.curvature_radius(first_tip))

    def contact_ratio(self, first_tip: Real, second_tip: Real) -> Any:
        """ε_α for the tip radii (m) of both gears."""
        one, two = self.first.curvature_radius(first_tip), self.second.curvature_radius(second_tip)
        pitch = math.pi * self.first.module * math.cos(self.first.pressure_angle)
        return (one + self.side * (two - self.action)) / pitch

    def sliding(self, first_tip: Real, second_tip: Real) -> tuple[Any, Any]:
        """Specific sliding ϑ of both flanks where they end; −∞ at the base circle."""
        low1, low2 = self.lowest(first_tip, second_tip)
        with np.errstate(divide="ignore"):
            one = 1.0 - np.divide(self.of_second(low1), low1) / self.ratio
            return one, 1.0 - np.divide(self.of_first(low2), low2) * self.ratio


def mesh(first: Gear, second: Gear) -> Pair:
    """Pair without play: α_w from the shifts; nan where arrays of shifts have none, raises Infeasible for numbers."""
    side, alpha = second.side, first.pressure_angle
    teeth = second.teeth + side * first.teeth
    if teeth <= 0:
        return Pair(first, second, alpha)  # raises, with advice
    slope = 2.0 * math.tan(alpha) / teeth
    shift = second.shift + side * first.shift
    inv = involute(alpha) + slope * shift
    if np.ndim(inv) == 0 and inv < 0.0:
        name = "x2 − x1" if side < 0.0 else "x1 + x2"
        raise Infeasible(
            f"{name} = {shift:g} for {first.teeth} and {second.teeth} teeth: no operating pressure angle; "
            f"it must be at least {-involute(alpha) / slope:.6g}"
        )
    return Pair(first, second, inverse_involute(inv))


def mesh_at(first: Gear, second: Gear, center_distance: float) -> Pair:
    """Pair at a given centre distance (m), with whatever play the shifts leave; raises Infeasible."""
    teeth = second.teeth + second.side * first.teeth
    least = 0.5 * first.module * teeth * math.cos(first.pressure_angle)
    if 0.0 < center_distance < least:
        given = f"centre distance {1e3 * center_distance:.6g} mm"
        raise Infeasible(
            f"{given} for {first.teeth} and {second.teeth} teeth: the base circles need more than "
            f"a·cos α = {1e3 * least:.6g} mm"
        )
    if not (center_distance > 0.0 and math.isfinite(center_distance)):
        raise Infeasible(f"centre distance {center_distance} m: it must be above {1e3 * least:.6g} mm")
    return Pair(first, second, math.acos(min(1.0, least / center_distance)) if teeth > 0 else 0.0)


def needed_shift(pair: Pair) -> Any:
    """x_Σ that meshes without play at the pair's operating pressure angle."""
    alpha = pair.first.pressure_angle
    return pair.teeth * (involute(pair.operating_angle) - involute(alpha)) / (2.0 * math.tan(alpha))


def tip_clash(pair: Pair, first_tip: Real, second_tip: Real) -> Any:
    """Arc (in teeth angle, rad) by which the tips of an internal mesh pass each other; negative where they clash.

    z1(θ1 + inv α_a1) − z2(θ2 + inv α_a2) + (z2 − z1) inv α_w, over z1; θ is the angle of the point where the tip
    circles cross from the line of centres.  +∞ where they do not cross.
    """
    a, one, two = pair.center_distance, pair.first, pair.second
    with np.errstate(invalid="ignore"):
        reach = second_tip**2 - first_tip**2
        cosine1 = (reach - a**2) / (2.0 * a * first_tip)
        cosine2 = (reach + a**2) / (2.0 * a * second_tip)
        turn1 = np.arccos(cosine1) + involute(polar_involute(one.base_radius, first_tip))
        turn2 = np.arccos(cosine2) + involute(polar_involute(two.base_radius, second_tip))
        free = turn1 - turn2 * pair.ratio + involute(pair.operating_angle) * (pair.ratio - 1.0)
    return np.where(np.abs(cosine1) < 1.0, free, np.inf)[()]


def radial_clash(pair: Pair, first_tip: Real, second_tip: Real) -> Any:
    """Angle (rad) that lets a planet be pushed into its ring radially; negative where the tips clash.

    θ1 + inv α_a1 − inv α_w − u(θ2 + inv α_a2 − inv α_w), with sin²θ1 = (1 − q²)/(1 − 1/u²),
    sin²θ2 = (1/q² − 1)/(u² − 1), q = cos α_a1/cos α_a2 (KHK, internal gears, trimming).  Axial assembly needs none.
    """
    one, two, u = pair.first, pair.second, pair.ratio
    alpha1 = polar_involute(one.base_radius, first_tip)
    alpha2 = polar_involute(two.base_radius, second_tip)
    q = np.cos(alpha1) / np.cos(alpha2)
    theta1 = np.arcsin(np.sqrt(np.clip((1.0 - q**2) / (1.0 - 1.0 / u**2), 0.0, 1.0)))
    theta2 = np.arcsin(np.sqrt(np.clip((1.0 / q**2 - 1.0) / (u**2 - 1.0), 0.0, 1.0)))
    inv = involute(pair.operating_angle)
    return theta1 + involute(alpha1) - inv - u * (theta2 + involute(alpha2) - inv)
