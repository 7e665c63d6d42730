"""Trace the region of a plane where every one of several margins is positive, exactly, with names on its boundary.

Marching squares find the topology on a grid; `blocking_refine` then puts points and corners onto the boundary.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from trochoid.geometry.blocking_refine import Margins, bisected, refined
from trochoid.kinematics.types import Array, BoolArray, IntArray

_REACH = 10.0  # grid cells by which a traced boundary may lie outside those that it was found in
END = "end of the shifts searched"


@dataclass(frozen=True, eq=False, slots=True)
class Boundary:
    """A closed polygon, region on its left: points (n, 2), and the condition that binds after each of them (n,)."""

    points: Array
    conditions: IntArray
    area: float


@dataclass(frozen=True, eq=False, slots=True)
class Contour:
    """Boundaries of a region and the names of its conditions; holes have negative areas."""

    names: tuple[str, ...]
    boundaries: tuple[Boundary, ...]

    @property
    def area(self) -> float:
        """Area of the region; its error falls with the fourth power of the grid's step."""
        return float(sum(b.area for b in self.boundaries))

    @property
    def binding(self) -> tuple[str, ...]:
        """Names of the conditions that form the boundary."""
        used = {int(k) for b in self.boundaries for k in b.conditions}
        return tuple(name for k, name in enumerate(self.names) if k in used)

    def slices(self, y: Array) -> Array:
        """Lengths of the region along x at the ordinates y (n,), which grow."""
        total = np.zeros(y.shape)
        for b in self.boundaries:
            start, end = b.points, np.roll(b.points, -1, axis=0)
            low, high = np.minimum(start[:, 1], end[:, 1]), np.maximum(start[:, 1], end[:, 1])
            first, last = np.searchsorted(y, low), np.searchsorted(y, high)
            for k in np.flatnonzero(last > first):
                here = slice(first[k], last[k])
                rise = end[k, 1] - start[k, 1]
                at = start[k, 0] + (y[here] - start[k, 1]) / rise * (end[k, 0] - start[k, 0])
                total[here] += np.sign(rise) * at
        return total


def trace(
    margins: Margins,
    names: tuple[str, ...],
    low: tuple[float, float],
    high: tuple[float, float],
    steps: int = 160,
) -> Contour:
    """Region within the box where all margins are ≥ 0; where the box ends it, its boundary is named `END`."""
    margins, names = _boxed(margins, low, high), (*names, END)
    x, y = (np.linspace(a, b, steps + 1) for a, b in zip(low, high, strict=True))
    inside = _inside(margins, x, y)
    if not inside.any():
        return Contour(names, ())
    # once more, on the part of the box that holds the region
    x, y = _around(x, np.any(inside, axis=1)), _around(y, np.any(inside, axis=0))
    inside = _inside(margins, x, y)
    loops = _link(inside)
    boundaries = []
    for loop in loops:
        good, bad = (np.stack((x[loop[:, k, 0]], y[loop[:, k, 1]]), axis=-1) for k in (0, 1))
        found = refined(margins, good, bad)
        # the corners of a spike cut off by the grid may be those of the main region: keep to its own cells then
        room = _REACH * np.array([x[1] - x[0], y[1] - y[0]])
        low, high = np.minimum(good, bad).min(axis=0) - room, np.maximum(good, bad).max(axis=0) + room
        within = np.all((found[0] >= low) & (found[0] <= high))
        boundaries.append(Boundary(*(found if within else bisected(margins, good, bad))))
    return Contour(names, tuple(boundaries))


def _boxed(margins: Margins, low: tuple[float, float], high: tuple[float, float]) -> Margins:
    """The margins, and as the last of them how far a point is inside the box, a little smaller than given."""
    center, half = 0.5 * (np.array(low) + high), 0.4999 * (np.array(high) - low)

    def boxed(x: Array, y: Array) -> Array:
        inside = np.minimum(half[0] - np.abs(x - center[0]), half[1] - np.abs(y - center[1]))
        return np.concatenate((margins(x, y), inside[None]))

    return boxed


def _inside(margins: Margins, x: Array, y: Array) -> BoolArray:
    at, up = np.meshgrid(x, y, indexing="ij")
    inside: BoolArray = (margins(at.ravel(), up.ravel()).min(axis=0) >= 0.0).reshape(at.shape)
    inside[[0, -1]] = False
    inside[:, [0, -1]] = False
    return inside


def _around(axis: Array, used: Any) -> Array:
    first, last = np.flatnonzero(used)[[0, -1]]
    return np.linspace(axis[max(0, first - 2)], axis[min(axis.size - 1, last + 2)], axis.size)


def _link(inside: BoolArray) -> list[Array]:
    """Loops of grid edges that the boundary crosses, region on the left; each (n, 2, 2): inner and outer node."""
    mixed = inside[:-1, :-1].astype(int) + inside[1:, :-1] + inside[1:, 1:] + inside[:-1, 1:]
    follow: dict[Any, Any] = {}
    for i, j in np.argwhere((mixed > 0) & (mixed < 4)).tolist():
        nodes = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
        leave, enter = [], []
        for a, b in zip(nodes, nodes[1:] + nodes[:1], strict=True):
            if inside[a] and not inside[b]:
                leave.append((a, b))
            elif inside[b] and not inside[a]:
                enter.append((b, a))
        if (
            len(leave) == 2 and inside[nodes[0]]
        ):  # a saddle is cut apart: each inner node keeps its own corner
            enter = enter[::-1]
        follow.update(zip(leave, enter, strict=True))
    loops = []
    while follow:
        start, edge = follow.popitem()
        loop = [start]
        while edge != start:
            loop.append(edge)
            edge = follow.pop(edge)
        loops.append(np.array(loop))
    return [loop for loop in loops if len(loop) > 3]
