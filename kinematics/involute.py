"""Involute gears with profile shift: the involute function, one gear and its tooth.

Lengths in m, angles in rad.  A shift may be an array; every result then has its shape, which is how blocking
contours are computed.  Signs: `side` is +1 for a gear with external teeth and −1 for a ring, and a positive
shift moves the rack away from the centre in both, so that it thickens a tooth and thins that of a ring.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array

Real = float | Array


def involute(angle: Real) -> Any:
    """Involute function inv α = tan α − α."""
    return np.tan(angle) - angle


def inverse_involute(value: Real) -> Any:
    """Pressure angle (rad) whose involute function is `value`; nan where that is negative.

    Newton on t − atan t for t = tan α, which is convex, so that it converges from any start.
    """
    v = np.where(np.asarray(value) >= 0.0, value, np.nan)
    cube = np.cbrt(3.0 * v)
    t = np.minimum(cube * (1.0 + 0.2 * cube**2), v + 0.5 * math.pi)
    for _ in range(12):
        with np.errstate(divide="ignore", invalid="ignore"):
            step = (t - np.arctan(t) - v) * (1.0 + t**2) / t**2
        step = np.where(t > 0.0, step, 0.0)
        t = t - step
        if not np.any(np.abs(step) > 1e-13 * t):
            break
    return np.arctan(t)[()]


def polar_involute(base_radius: Real, radius: Real) -> Any:
    """Pressure angle (rad) of an involute where it has the given radius (m); nan inside the base circle."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.arccos(base_radius / np.asarray(radius))[()]


@dataclass(frozen=True, slots=True)
class Gear:
    """One gear of the basic rack (α, h_a*, c*), shifted by x modules; `internal` for a ring."""

    teeth: int
    module: float
    pressure_angle: float = math.radians(20.0)
    shift: Real = 0.0
    addendum: float = 1.0
    clearance: float = 0.25
    internal: bool = False

    def __post_init__(self) -> None:
        """Refuse what no rack can cut."""
        if self.teeth < 3:
            raise Infeasible(f"{self.teeth} teeth: a gear needs at least 3")
        if not (self.module > 0.0 and math.isfinite(self.module)):
            raise Infeasible(f"module {self.module} m: it must be positive")
        if not 0.0 < self.pressure_angle < 0.5 * math.pi:
            given = f"pressure angle {math.degrees(self.pressure_angle):g}°"
            raise Infeasible(f"{given}: it must lie between 0 and 90°; 20° is usual")

    @property
    def side(self) -> float:
        """+1 for external teeth, −1 for a ring."""
        return -1.0 if self.internal else 1.0

    @property
    def pitch_radius(self) -> float:
        """Reference radius m z/2, m."""
        return 0.5 * self.module * self.teeth

    @property
    def base_radius(self) -> float:
        """Base radius, m."""
        return self.pitch_radius * math.cos(self.pressure_angle)

    @property
    def thickness(self) -> Any:
        """Tooth thickness at the reference circle, m(π/2 ± 2x tan α), in m."""
        return self.module * (0.5 * math.pi + self.side * 2.0 * self.shift * math.tan(self.pressure_angle))

    @property
    def base_angle(self) -> Any:
        """Polar angle (rad) from the middle of a space to the foot of its involute on the base circle.

        A ring's space is the tooth of an external gear with the same shift.
        """
        half_tooth = self.thickness / (2.0 * self.pitch_radius)
        inv = involute(self.pressure_angle)
        if self.internal:
            return math.pi / self.teeth - half_tooth + inv
        return math.pi / self.teeth - half_tooth - inv

    def flank_angle(self, radius: Real) -> Any:
        """Polar angle (rad) from the middle of a space to its flank at `radius` (m)."""
        return self.base_angle + self.side * involute(polar_involute(self.base_radius, radius))

    def thickness_at(self, radius: Real) -> Any:
        """Thickness of a tooth (m) along the circle of `radius`; negative beyond its point."""
        return 2.0 * radius * (math.pi / self.teeth - self.flank_angle(radius))

    @property
    def point_radius(self) -> Any:
        """Radius (m) at which the flanks of a tooth meet in a point; nan for a ring whose base circle is before."""
        return self.base_radius / np.cos(
            inverse_involute(self.side * (math.pi / self.teeth - self.base_angle))
        )

    def curvature_radius(self, radius: Real) -> Any:
        """Radius of curvature (m) of the involute at `radius` (m); 0 inside the base circle."""
        return np.sqrt(np.maximum(np.asarray(radius) ** 2 - self.base_radius**2, 0.0))[()]

    @property
    def least_shift(self) -> float:
        """x_min = h_a* − z sin²α/2, below which a rack undercuts the flank (external teeth)."""
        return self.addendum - 0.5 * self.teeth * math.sin(self.pressure_angle) ** 2

    @property
    def rack_boundary(self) -> Any:
        """Radius of curvature ρ_l (m) where a rack's straight flank ends; negative when undercut."""
        sine = math.sin(self.pressure_angle)
        return self.pitch_radius * sine - (self.addendum - self.shift) * self.module / sine

    @property
    def rack_root_radius(self) -> Any:
        """Root radius (m) that a rack with h_a* + c* cuts into external teeth."""
        return self.pitch_radius - (self.addendum + self.clearance - self.shift) * self.module
