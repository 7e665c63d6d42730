"""Loops refined where contacts press them: equal short facets there, growing to the loop's ordinary ones between."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from trochoid.geometry.outline import Loop
from trochoid.kinematics.curve import ArcLength, corners
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, IntArray

SLOPE = 0.3  # growth of the facet length with the arc distance from a window


@dataclass(frozen=True, slots=True)
class Window:
    """Equal facets on a loop: `facets` of `length` (m) along the arc, their middle at the curve `parameter`."""

    parameter: float
    length: float
    facets: int


def refine(loop: Loop, windows: Sequence[Window], slope: float = SLOPE) -> tuple[Loop, tuple[IntArray, ...]]:
    """Return the loop with these windows, and for each window the numbers of its facets, in the order of the curve.

    Between windows facets grow by `slope` times the distance up to what the loop had there.  Raises Infeasible
    when windows overlap or reach over a corner.
    """
    if not windows:
        return loop, ()
    arc = ArcLength(loop.curve)
    half = np.array([0.5 * w.facets * w.length for w in windows])
    middle = np.mod(arc.length(np.array([w.parameter for w in windows])), arc.total)
    order = np.argsort(middle - half)
    sizes = _Sizes(
        arc.total, middle, half, np.array([w.length for w in windows]), slope, _ordinary(loop, arc)
    )
    sharp = arc.length(corners(loop.curve))
    breaks, numbers, first = [], {}, float((middle - half)[order[0]])
    for i, after in zip(order, np.append(order[1:], order[0]), strict=True):
        low, high = middle[i] - half[i], middle[i] + half[i]
        until = middle[after] - half[after] + (arc.total if after == order[0] else 0.0)
        if until < high - 1e-9 * half[i]:
            raise Infeasible(_overlap(loop, windows[i], windows[after]))
        breaks.append(np.linspace(low, high, windows[i].facets + 1)[:-1])
        numbers[int(i)] = sum(map(len, breaks[:-1])) + np.arange(windows[i].facets)
        _fail_if_over_corner(loop, _inside(sharp, low, high, arc.total), windows[i])
        stops = np.concatenate(([high], _inside(sharp, high, until, arc.total), [until]))
        for a, b in pairwise(stops):
            breaks.append(_graded(a, b, sizes))
    t = arc.parameter(np.concatenate(breaks))
    parameters = np.append(t, arc.parameter(np.array([first]))[0] + loop.curve.period)
    return replace(loop, breaks=parameters), tuple(numbers[i] for i in range(len(windows)))


@dataclass(frozen=True, slots=True)
class _Sizes:
    """Wanted facet length along a loop of length `total`, m."""

    total: float
    middle: Array
    half: Array
    length: Array
    slope: float
    ordinary: Callable[[Array], Array]

    def at(self, s: Array) -> Array:
        away = np.abs(np.mod(s[:, None] - self.middle + 0.5 * self.total, self.total) - 0.5 * self.total)
        near = self.length + self.slope * np.maximum(0.0, away - self.half)
        return np.asarray(np.minimum(near.min(axis=1), self.ordinary(s)))


def _ordinary(loop: Loop, arc: ArcLength) -> Callable[[Array], Array]:
    """Return the length of the loop's own facets as a function of arc length."""
    ends = arc.length(loop.parameters())
    middle, length = 0.5 * (ends[1:] + ends[:-1]), np.diff(ends)
    return lambda s: np.asarray(np.interp(s, middle, length, period=arc.total))


def _graded(low: float, high: float, sizes: _Sizes) -> Array:
    """Return facet ends from `low` on, without `high`, so that facets are as long as wanted."""
    if high - low <= 1e-9 * sizes.length.min():
        return np.zeros(0)
    half = 0.5 * (high - low)
    steps = np.geomspace(min(0.1 * sizes.length.min(), half), half, 1000)
    s = np.unique(np.concatenate((low + steps, high - steps, np.linspace(low, high, 2001))))
    s = s[(s >= low) & (s <= high)]
    density = 1.0 / sizes.at(s)
    count = np.append(0.0, np.cumsum(0.5 * np.diff(s) * (density[1:] + density[:-1])))
    facets = max(1, round(count[-1]))
    return np.asarray(np.interp(count[-1] * np.arange(facets) / facets, count, s))


def _inside(places: Array, low: float, high: float, total: float) -> Array:
    """Return the places strictly between `low` and `high` on a loop, unwrapped and sorted."""
    unwrapped = low + np.mod(places - low, total)
    return np.sort(unwrapped[(unwrapped > low) & (unwrapped < high)])


def _fail_if_over_corner(loop: Loop, inside: Array, window: Window) -> None:
    if inside.size:
        raise Infeasible(
            f"the window of {window.facets} facets of {window.length:.3g} m at parameter {window.parameter:.6g} of "
            f"loop '{loop.name}' reaches over a corner; contacts at an edge cannot be refined"
        )


def _overlap(loop: Loop, one: Window, other: Window) -> str:
    return (
        f"windows at parameters {one.parameter:.6g} and {other.parameter:.6g} of loop '{loop.name}' overlap: "
        f"{one.facets} facets of {one.length:.3g} m and {other.facets} of {other.length:.3g} m; "
        "make them narrower, or the load smaller"
    )
