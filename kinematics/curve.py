"""Plane curves with exact point, normal and curvature; nearest point and arc length on any of them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array

MOST_PANELS = 4096  # more are halved for rounding's sake: flat spherical curves have speeds of few digits
_GAUSS_X, _GAUSS_W = np.polynomial.legendre.leggauss(16)
_COARSE_X, _COARSE_W = np.polynomial.legendre.leggauss(11)


class Curve(Protocol):
    """A closed, counter-clockwise plane curve r(t); `t` may have any shape and any number of periods.

    Points are in m, shape (..., 2).  The normal points out of the material, so the material lies to the left
    of an outer boundary and to the right of a hole.
    """

    @property
    def period(self) -> float:
        """Parameter length of one round."""
        ...

    def point(self, t: npt.ArrayLike) -> Array:
        """Position, m, shape (..., 2)."""
        ...

    def tangent(self, t: npt.ArrayLike) -> Array:
        """Unit tangent in the direction of growing t, shape (..., 2)."""
        ...

    def normal(self, t: npt.ArrayLike) -> Array:
        """Unit normal out of the material, shape (..., 2)."""
        ...

    def speed(self, t: npt.ArrayLike) -> Array:
        """|dr/dt|, m."""
        ...

    def curvature(self, t: npt.ArrayLike) -> Array:
        """Signed curvature, 1/m, positive where the material is convex."""
        ...


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle about `center` (m); with `hole=True` the material is outside."""

    center: tuple[float, float]
    radius: float
    hole: bool = False

    @property
    def period(self) -> float:
        """2π: the parameter is the polar angle about the centre."""
        return 2.0 * math.pi

    @property
    def _side(self) -> float:
        return -1.0 if self.hole else 1.0

    def point(self, t: npt.ArrayLike) -> Array:
        """Position, m."""
        return np.asarray(self.center) + self.radius * _polar(t)

    def tangent(self, t: npt.ArrayLike) -> Array:
        """Unit tangent."""
        t = np.asarray(t, dtype=np.float64)
        return np.stack((-np.sin(t), np.cos(t)), axis=-1)

    def normal(self, t: npt.ArrayLike) -> Array:
        """Unit normal out of the material."""
        return self._side * _polar(t)

    def speed(self, t: npt.ArrayLike) -> Array:
        """|dr/dt| = radius, m."""
        return np.full(np.shape(t), self.radius)

    def curvature(self, t: npt.ArrayLike) -> Array:
        """1/radius, negative for a hole, 1/m."""
        return np.full(np.shape(t), self._side / self.radius)


def _polar(t: npt.ArrayLike) -> Array:
    t = np.asarray(t, dtype=np.float64)
    return np.stack((np.cos(t), np.sin(t)), axis=-1)


def foot_point(
    curve: Curve, points: npt.ArrayLike, t0: npt.ArrayLike, iterations: int = 60
) -> tuple[Array, Array]:
    """Nearest point of `curve` to each of `points` (n, 2), from the start parameters `t0` (n,).

    Returns parameters (n,) and signed distances (n,), m, positive outside the material.  Newton on
    (p − r)·τ = 0, whose derivative −|r'|(1 + κ d) needs no derivative of the curvature; a step never
    increases the distance.  Raises NotConverged.
    """
    points = np.asarray(points, dtype=np.float64)
    t = np.array(np.broadcast_to(np.asarray(t0, dtype=np.float64), points.shape[:-1]))
    offset = points - curve.point(t)
    noise = _rounding(points, offset, t * curve.speed(t))
    for _ in range(iterations):
        slope = np.sum(offset * curve.tangent(t), axis=-1)
        bend = 1.0 + curve.curvature(t) * np.sum(offset * curve.normal(t), axis=-1)
        step = _newton_step(curve, t, slope, bend)
        small = np.abs(slope) <= noise * np.maximum(1.0, np.abs(bend))
        t, offset = _descend(curve, points, t, offset, step, noise)
        if small.all():
            return t, np.sum(offset * curve.normal(t), axis=-1)
    left = f"{int((~small).sum())} of {small.size} points, first at {points[~small][0]} m"
    raise NotConverged(
        f"no nearest point on the curve in {iterations} steps for {left}; start nearer to the foot point"
    )


def _rounding(*lengths: Array) -> float:
    """Length (m) below which nothing can be told from zero beside `lengths`."""
    return 8.0 * float(np.finfo(np.float64).eps) * sum(float(np.abs(x).max(initial=0.0)) for x in lengths)


def _newton_step(curve: Curve, t: Array, slope: Array, bend: Array) -> Array:
    # where 1 + κ d < 0 the stationary point is a maximum: there go down the slope about as far
    arc = slope / np.where(bend > 1e-12, bend, np.maximum(-bend, 0.05))
    limit = curve.period / 8.0
    step: Array = np.clip(arc / curve.speed(t), -limit, limit)
    return step


def _descend(
    curve: Curve, points: Array, t: Array, offset: Array, step: Array, noise: float
) -> tuple[Array, Array]:
    before = np.linalg.norm(offset, axis=-1)
    for _ in range(40):
        moved = points - curve.point(t + step)
        worse = np.linalg.norm(moved, axis=-1) > before + noise
        if not worse.any():
            break
        step = np.where(worse, 0.5 * step, step)
    return t + step, moved


@dataclass(frozen=True)
class ArcLength:
    """Map between the parameter of a curve and its arc length (m, zero at t = 0), to rounding both ways.

    Composite Gauss quadrature on panels that are halved until two orders agree to 1e-13 of the total.
    """

    curve: Curve
    knots: Array = field(init=False, repr=False)
    sums: Array = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Build the panels over one period."""
        knots = _panels(self.curve)
        sums = np.concatenate(([0.0], np.cumsum(_piece(self.curve, knots[:-1], knots[1:]))))
        for name, value in (("knots", knots), ("sums", sums)):
            value.setflags(write=False)
            object.__setattr__(self, name, value)

    @property
    def total(self) -> float:
        """Length of one round, m."""
        return float(self.sums[-1])

    def length(self, t: npt.ArrayLike) -> Array:
        """Arc length from t = 0 to t, m; negative t and whole rounds included."""
        t = np.asarray(t, dtype=np.float64)
        rounds = np.floor(t / self.curve.period)
        inner = t - rounds * self.curve.period
        panel = np.clip(np.searchsorted(self.knots, inner, "right") - 1, 0, self.knots.size - 2)
        start = self.knots[panel]
        return rounds * self.total + self.sums[panel] + _piece(self.curve, start, inner)

    def parameter(self, s: npt.ArrayLike) -> Array:
        """Parameter at arc length s (m): inverse of `length`, by Newton steps kept within a shrinking bracket."""
        s = np.asarray(s, dtype=np.float64)
        rounds = np.floor(s / self.total)
        inner = s - rounds * self.total
        panel = np.clip(np.searchsorted(self.sums, inner, "right") - 1, 0, self.knots.size - 2)
        start, low, high = self.knots[panel], self.knots[panel], self.knots[panel + 1]
        target = inner - self.sums[panel]
        t = low + (high - low) * target / (self.sums[panel + 1] - self.sums[panel])
        for _ in range(60):
            miss = target - _piece(self.curve, start, t)
            low, high = np.where(miss > 0.0, t, low), np.where(miss < 0.0, t, high)
            step = miss / self.curve.speed(t)
            new = np.where((t + step < low) | (t + step > high), 0.5 * (low + high), t + step)
            done = np.all(np.abs(new - t) <= 4e-16 * self.curve.period)
            t = new
            if done:
                break
        return rounds * self.curve.period + t


def _piece(curve: Curve, low: Array, high: Array, x: Array = _GAUSS_X, w: Array = _GAUSS_W) -> Array:
    """Arc length between the parameters `low` and `high` (any shape) by one Gauss rule, m."""
    half = 0.5 * (high - low)
    nodes = low[..., None] + half[..., None] * (1.0 + x)
    return half * (curve.speed(nodes) @ w)


def _panels(curve: Curve) -> Array:
    """Knots of panels on which the 11 and the 16 point rules agree; corners are always knots."""
    knots = np.union1d(np.linspace(0.0, curve.period, 33), corners(curve))
    for _ in range(30):
        low, high = knots[:-1], knots[1:]
        fine = _piece(curve, low, high)
        error = np.abs(fine - _piece(curve, low, high, _COARSE_X, _COARSE_W))
        bad = error > np.maximum(1e-13 * fine, 1e-15 * fine.sum())
        if not bad.any() or knots.size + bad.sum() > MOST_PANELS:
            break
        knots = np.sort(np.concatenate((knots, 0.5 * (low + high)[bad])))
    return knots


def corners(curve: Curve) -> Array:
    """Parameters in [0, period) at which the tangent jumps; empty for a smooth curve."""
    return np.asarray(getattr(curve, "corners", ()), dtype=np.float64)
