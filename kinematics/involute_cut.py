"""What a generating tool leaves in a gear: root circle, trochoid fillet, involute; rack and shaper alike.

Complex numbers stand for plane vectors in the gear's frame, whose x axis is the middle of a space.  A point
fixed in the tool rolls with it on the gear's generating pitch circle r.  After the roll φ, with E = exp(iφ), its
offset from the pitch point is q E, where for a tool of pitch curvature b (0 for a rack, 1/r0 for a shaper outside,
−1/r0 for one inside a ring) and θ = b r φ

    q(φ) = w exp(iθ) − (exp(iθ) − 1)/b,   p = E(r + q),   p' = i k q E,   k = 1 + b r.

The pitch point is the centre of the motion, so the normal of every path goes through it: a tool tip rounded
with ρ about the point leaves E(r + q + σ ρ q/|q|), with the path's curvature K = (k|q|² − r Re q)/(k|q|³).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.involute import Gear
from trochoid.kinematics.types import Array, ComplexArray


@dataclass(frozen=True, slots=True)
class Fillet:
    """Trochoid fillet in the half of a space at positive polar angles; lengths in m, rolls in rad.

    `corner` is w, the offset of the centre of the tip rounding from the pitch point at φ = 0.  The fillet runs
    from the root circle at the roll `root` to the involute at the roll `end`.
    """

    pitch_radius: float
    pitch_curvature: float
    corner: complex
    rounding: float
    sign: float
    internal: bool
    root: float
    end: float

    @property
    def _k(self) -> float:
        return 1.0 + self.pitch_curvature * self.pitch_radius

    def offset(self, roll: npt.ArrayLike) -> ComplexArray:
        """q(φ), m, of the centre of the rounding."""
        phi = np.asarray(roll, dtype=np.float64)
        theta = self.pitch_curvature * self.pitch_radius * phi
        half = np.exp(0.5j * theta)
        q: ComplexArray = half * (self.corner * half - 1j * self.pitch_radius * phi * _sinc(0.5 * theta))
        return q

    def _bend(self, q: ComplexArray) -> Array:
        size = np.abs(q)
        bend: Array = (self._k * size**2 - self.pitch_radius * q.real) / (self._k * size**3)
        return bend

    def point(self, roll: npt.ArrayLike) -> ComplexArray:
        """Point of the fillet, m."""
        q = self.offset(roll)
        reach = q * (1.0 + self.sign * self.rounding / np.abs(q))
        point: ComplexArray = np.exp(1j * np.asarray(roll)) * (self.pitch_radius + reach)
        return point

    def normal(self, roll: npt.ArrayLike) -> ComplexArray:
        """Unit normal out of the gear's material."""
        q = self.offset(roll)
        normal: ComplexArray = -self.sign * np.exp(1j * np.asarray(roll)) * q / np.abs(q)
        return normal

    def growth(self, roll: npt.ArrayLike) -> Array:
        """1 + σρK, which is positive where the rounding leaves a regular curve."""
        return 1.0 + self.sign * self.rounding * self._bend(self.offset(roll))

    def speed(self, roll: npt.ArrayLike) -> Array:
        """|dr/dφ|, m."""
        speed: Array = np.abs(self._k * self.offset(roll)) * np.abs(self.growth(roll))
        return speed

    def curvature(self, roll: npt.ArrayLike) -> Array:
        """Signed curvature, 1/m, positive where the material is convex."""
        bend = self.sign * self._bend(self.offset(roll))
        curvature: Array = -bend / (1.0 + self.rounding * bend)
        return curvature


@dataclass(frozen=True, slots=True)
class Cut:
    """Half a space of a gear as a tool leaves it: root circle, fillet, involute to the tip circle; m, rad.

    `boundary` is the radius of curvature ρ_l of the involute where the tool's flank ends; `start` the one where
    the involute of the gear starts.  The two differ on an undercut flank, where `boundary` < `start` at the
    crossing with the fillet.
    """

    gear: Gear
    fillet: Fillet
    root_radius: float
    boundary: float
    start: float

    @property
    def undercut(self) -> bool:
        """Whether the tool's tip cuts off part of the involute."""
        return self.boundary < 0.0


def trimmed(cut: Cut) -> Cut:
    """The same cut with the fillet ended where it meets the involute, if the flank is undercut."""
    if not cut.undercut:
        return cut
    fillet, base = cut.fillet, cut.gear.base_radius
    rise = np.linspace(fillet.root, fillet.end, 65)
    above = np.abs(fillet.point(rise)) >= base
    k = int(np.argmax(above))
    low = _bisect(lambda t: float(np.abs(fillet.point(t))) - base, rise[k - 1], rise[k])

    def into_tooth(roll: float) -> float:
        z = fillet.point(roll)
        angle = cut.gear.flank_angle(max(base, float(np.abs(z))))
        return float(angle - np.angle(z))

    # 1e-12: at the base circle itself the fillet still lies in the tooth
    end = _bisect(into_tooth, low + 1e-12 * (fillet.end - low), fillet.end)
    meets = float(cut.gear.curvature_radius(float(np.abs(fillet.point(end)))))
    return replace(cut, fillet=replace(fillet, end=end), start=meets)


def _bisect(function: Any, low: float, high: float) -> float:
    """Zero of a function that grows from `low` to `high`, to rounding."""
    for _ in range(70):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)


def _sinc(x: Array) -> Array:
    sinc: Array = np.sinc(x / math.pi)
    return sinc
