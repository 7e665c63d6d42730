"""Outlines: the closed boundary of a plane body, cut into facets, with names for its parts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from trochoid.kinematics.curve import ArcLength, Curve, corners
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array

_NO_SIDES: Mapping[str, tuple[float, float]] = MappingProxyType({})


@dataclass(frozen=True, eq=False)
class Loop:
    """A named closed curve and the facets on it.

    Either `facets` of equal arc length, the first from the parameter `start` (a curve with corners starts
    at one and shares the facets among its sides); or explicit `breaks` (n+1,), increasing, the last one a
    period after the first, all corners among them.  `sides` names stretches t0 … t1 of the curve.
    """

    name: str
    curve: Curve
    facets: int = 0
    start: float = 0.0
    breaks: Array | None = None
    sides: Mapping[str, tuple[float, float]] = field(default_factory=lambda: _NO_SIDES)

    def parameters(self) -> Array:
        """Curve parameters of the facet ends, shape (facets+1,); raises Infeasible."""
        if self.breaks is not None:
            return _checked(self)
        if self.facets < 3:
            raise Infeasible(f"loop '{self.name}' has {self.facets} facets; at least 3 are needed")
        sharp = corners(self.curve)
        arc = ArcLength(self.curve)
        if sharp.size == 0:
            first = arc.length(self.start)
            t = arc.parameter(first + arc.total * np.arange(self.facets) / self.facets)
            return np.append(t, t[0] + self.curve.period)
        ends = np.append(sharp, sharp[0] + self.curve.period)
        s = arc.length(ends)
        counts = np.maximum(1, np.rint(self.facets * np.diff(s) / arc.total).astype(int))
        inner = [
            arc.parameter(np.linspace(a, b, n + 1)[1:-1]) for a, b, n in zip(s, s[1:], counts, strict=False)
        ]
        return np.sort(np.concatenate((ends, *inner)))


@dataclass(frozen=True, slots=True)
class Outline:
    """Boundary of a plane body: one outer loop and the loops of its holes."""

    outer: Loop
    holes: tuple[Loop, ...] = ()

    @property
    def loops(self) -> tuple[Loop, ...]:
        """The outer loop, then the holes."""
        return (self.outer, *self.holes)


def _checked(loop: Loop) -> Array:
    t = np.asarray(loop.breaks, dtype=np.float64)
    period = loop.curve.period
    if t.size < 4 or not np.all(np.diff(t) > 0.0) or abs(t[-1] - t[0] - period) > 1e-12 * period:
        raise Infeasible(
            f"breaks of loop '{loop.name}' must grow over exactly one period ({period:.12g}) with at least 3 "
            f"facets; given are {t.size - 1} from {t[0]:.12g} to {t[-1]:.12g}"
        )
    for corner in corners(loop.curve):
        distance = np.abs(np.mod(t - corner + 0.5 * period, period) - 0.5 * period)
        if distance.min() > 1e-9:
            raise Infeasible(
                f"breaks of loop '{loop.name}' leave out the corner at parameter {corner:g}; add it"
            )
    return t


def graded_breaks(
    curve: Curve, foci: Array, finest: float, coarsest: float, slope: float = 0.3, width: float = 0.0
) -> Array:
    """Breaks for a Loop: facets of length `finest` within `width` (m) of the parameters `foci`.

    Beyond, the length grows by `slope` times the arc distance, up to `coarsest`; corners and foci are
    facet ends.
    """
    arc = ArcLength(curve)
    fixed = np.unique(np.mod(arc.length(np.concatenate((np.ravel(foci), corners(curve)))), arc.total))
    centers = np.mod(arc.length(np.ravel(foci)), arc.total)
    breaks = []
    for low, high in zip(fixed, np.append(fixed[1:], fixed[0] + arc.total), strict=True):
        s = _samples(low, high, finest)
        away = np.abs(np.mod(s[:, None] - centers + 0.5 * arc.total, arc.total) - 0.5 * arc.total).min(axis=1)
        length = np.minimum(coarsest, finest + slope * np.maximum(0.0, away - width))
        count = np.concatenate(([0.0], np.cumsum(np.diff(s) * 0.5 * (1.0 / length[1:] + 1.0 / length[:-1]))))
        facets = max(1, round(count[-1]))
        breaks.append(np.interp(count[-1] * np.arange(facets) / facets, count, s))
    t = arc.parameter(np.concatenate(breaks))
    return np.append(t, t[0] + curve.period)


def _samples(low: float, high: float, finest: float) -> Array:
    """Positions from `low` to `high` that are dense at both ends and in proportion beyond."""
    half = 0.5 * (high - low)
    steps = np.minimum(np.geomspace(0.1 * min(finest, half), half, 1000), half)
    inner = np.linspace(low, high, 2001)
    return np.unique(np.concatenate(([low, high], low + steps, high - steps, inner)))


def bending_breaks(curve: Curve, facets: int, repeats: int = 1, share: float = 0.2) -> Array:
    """Breaks for a Loop: `facets` on each of `repeats` alike parts, closer where the curvature changes.

    The facet density is (1 − share) of arc length and `share` of the variation of curvature; with a fifth,
    the compliance of a cycloid disc is splined five times better than on equal facets (12 per lobe).
    """
    t = np.linspace(0.0, curve.period / repeats, 4001)
    middle = 0.5 * (t[1:] + t[:-1])
    length = curve.speed(middle) * np.diff(t)
    change = np.abs(np.diff(curve.curvature(t)))
    even = length / length.sum()
    density = even if change.sum() == 0.0 else (1.0 - share) * even + share * change / change.sum()
    part = np.interp(np.arange(facets) / facets, np.append(0.0, np.cumsum(density)), t)
    starts = curve.period / repeats * np.arange(repeats)
    return np.append((starts[:, None] + part[None]).ravel(), curve.period)
