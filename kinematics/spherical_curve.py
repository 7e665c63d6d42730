"""Curves on the unit sphere with exact point, normal and geodesic curvature; nearest point on any of them.

They answer to the same names as plane curves, with angles (rad) in place of lengths, so `curve.ArcLength`
serves both.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.spherical import angle_between, unit
from trochoid.kinematics.types import Array


class SphericalCurve(Protocol):
    """A closed curve c(t) on the unit sphere, counter-clockwise about the pole it encloses, seen from outside.

    `t` may have any shape and any number of periods.  The normal lies in the tangent plane of the sphere and
    points out of the material, which is to the left of an outer boundary and to the right of a hole.
    """

    @property
    def period(self) -> float:
        """Parameter length of one round."""
        ...

    def point(self, t: npt.ArrayLike) -> Array:
        """Unit vector to the point, shape (..., 3)."""
        ...

    def tangent(self, t: npt.ArrayLike) -> Array:
        """Unit tangent in the direction of growing t, shape (..., 3)."""
        ...

    def normal(self, t: npt.ArrayLike) -> Array:
        """Unit normal out of the material, across point and tangent, shape (..., 3)."""
        ...

    def speed(self, t: npt.ArrayLike) -> Array:
        """|dc/dt|, rad."""
        ...

    def curvature(self, t: npt.ArrayLike) -> Array:
        """Geodesic curvature, 1/rad, positive where the material is convex; 0 on a great circle."""
        ...


@dataclass(frozen=True, slots=True)
class SmallCircle:
    """A circle of the angular `radius` (rad) about the unit vector `pole`; with `hole=True` material is outside.

    The cut of the sphere with a cone: the outline of a tapered pin.  t = 0 is towards the z axis (towards the
    x axis where the pole is the z axis).
    """

    pole: tuple[float, float, float]
    radius: float
    hole: bool = False

    @property
    def period(self) -> float:
        """2π: the parameter is the azimuth about the pole."""
        return 2.0 * math.pi

    def _frame(self) -> tuple[Array, Array, Array]:
        pole = unit(np.asarray(self.pole, dtype=np.float64))
        start = np.array([0.0, 0.0, 1.0]) if abs(pole[2]) < 1.0 - 1e-12 else np.array([1.0, 0.0, 0.0])
        first = unit(start - (start @ pole) * pole)
        return pole, first, np.cross(pole, first)

    def _away(self, t: npt.ArrayLike) -> Array:
        t = np.asarray(t, dtype=np.float64)[..., None]
        _, first, second = self._frame()
        away: Array = np.cos(t) * first + np.sin(t) * second
        return away

    @property
    def _side(self) -> float:
        return -1.0 if self.hole else 1.0

    def point(self, t: npt.ArrayLike) -> Array:
        """Unit vector to the point."""
        point: Array = math.cos(self.radius) * self._frame()[0] + math.sin(self.radius) * self._away(t)
        return point

    def tangent(self, t: npt.ArrayLike) -> Array:
        """Unit tangent."""
        return self._away(np.asarray(t, dtype=np.float64) + 0.5 * math.pi)

    def normal(self, t: npt.ArrayLike) -> Array:
        """Unit normal out of the material."""
        out = math.cos(self.radius) * self._away(t) - math.sin(self.radius) * self._frame()[0]
        return np.asarray(self._side * out)

    def speed(self, t: npt.ArrayLike) -> Array:
        """Sine of the radius, rad."""
        return np.full(np.shape(t), math.sin(self.radius))

    def curvature(self, t: npt.ArrayLike) -> Array:
        """Cotangent of the radius, negative for a hole."""
        return np.full(np.shape(t), self._side / math.tan(self.radius))


def foot_point(
    curve: SphericalCurve, points: npt.ArrayLike, t0: npt.ArrayLike, iterations: int = 60
) -> tuple[Array, Array]:
    """Nearest point of `curve` to each of the unit vectors `points` (n, 3), from the start parameters `t0` (n,).

    Returns parameters (n,) and signed angles (n,), rad, positive outside the material.  Newton on p·τ = 0,
    whose derivative is −|c'|(p·c + κ p·n); a step never increases the distance.  Raises NotConverged.
    """
    points = np.asarray(points, dtype=np.float64)
    t = np.array(np.broadcast_to(np.asarray(t0, dtype=np.float64), points.shape[:-1]))
    noise = 16.0 * float(np.finfo(np.float64).eps) * (1.0 + float(np.abs(t).max(initial=0.0)))
    for _ in range(iterations):
        c = curve.point(t)
        slope = np.sum((points - c) * curve.tangent(t), axis=-1)
        bend = np.sum(points * (c + curve.curvature(t)[..., None] * curve.normal(t)), axis=-1)
        small = np.abs(slope) <= noise * np.maximum(1.0, np.abs(bend))
        arc = slope / np.where(bend > 1e-12, bend, np.maximum(-bend, 0.05))
        limit = curve.period / 8.0
        t = _descend(curve, points, t, np.clip(arc / curve.speed(t), -limit, limit), noise)
        if small.all():
            c = curve.point(t)
            outside = np.sum((points - c) * curve.normal(t), axis=-1)
            return t, np.copysign(angle_between(points, c), outside)
    left = f"{int((~small).sum())} of {small.size} points, first at {points[~small][0]}"
    raise NotConverged(
        f"no nearest point on the spherical curve in {iterations} steps for {left}; start nearer to the foot point"
    )


def _descend(curve: SphericalCurve, points: Array, t: Array, step: Array, noise: float) -> Array:
    before = np.linalg.norm(points - curve.point(t), axis=-1)
    for _ in range(40):
        worse = np.linalg.norm(points - curve.point(t + step), axis=-1) > before + noise
        if not worse.any():
            break
        step = np.where(worse, 0.5 * step, step)
    return np.asarray(t + step)
