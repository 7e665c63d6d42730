"""Surface of the volumetric blocking contour, face by face, from the two plane contours that make it.

The body of (x1, x2, x3) is what both contours allow, so that its section at any x2 is a set of rectangles: stretches of
the contour (x1, x2) times stretches of the contour (x2, x3).  Its sides are ruled; each belongs to one condition.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from trochoid.geometry.blocking_contour import Contour
from trochoid.kinematics.types import Array, IntArray, frozen

_FLAT = 1e-9  # height (in shifts) below which a side stands still in x2


@dataclass(frozen=True, eq=False, slots=True)
class Face:
    """What one condition leaves of the surface: vertices (n, 3) in (x1, x2, x3), triangles (m, 3), outward normals."""

    name: str
    vertices: Array
    triangles: IntArray


@dataclass(frozen=True, eq=False, slots=True)
class _Side:
    """A part of a contour along which x2 only grows: `along` (n,) over `level` (n,)."""

    name: str
    level: Array
    along: Array

    def at(self, level: float) -> float:
        return float(np.interp(level, self.level, self.along))


@dataclass(frozen=True, slots=True)
class _Strip:
    """Sides that bound one of the contours between two neighbouring levels, in pairs left and right."""

    pairs: tuple[tuple[_Side, _Side], ...]

    def stretches(self, level: float) -> list[tuple[float, float]]:
        return [(left.at(level), right.at(level)) for left, right in self.pairs]


def surface(outer: Contour, inner: Contour, levels: int = 120) -> tuple[Face, ...]:
    """Faces of the body over the contours (x1, x2) and (x2, x3), cut at `levels` of x2 and at every corner."""
    one, one_flat = _sides(outer, 0)
    two, two_flat = _sides(inner, 1)
    if not one or not two:
        return ()
    at = _levels(one, two, levels)
    quads: dict[str, list[Array]] = {}
    strips = [(_strip(one, a, b), _strip(two, a, b)) for a, b in pairwise(at)]
    for (x1, x3), low, high in zip(strips, at, at[1:], strict=False):
        for name, quad in _walls(x1, x3, low, high):
            quads.setdefault(name, []).append(quad)
    ends = [(side.name, float(side.level[k])) for side in (*one, *two) for k in (0, -1)]
    nothing = _Strip(()), _Strip(())
    for level, below, above in zip(at, [nothing, *strips], [*strips, nothing], strict=True):
        for quad in _caps(level, below, above):
            name = min((*one_flat, *two_flat, *ends), key=lambda side: abs(side[1] - level))[0]
            quads.setdefault(name, []).append(quad)
    return tuple(_face(name, np.array(found)) for name, found in quads.items())


def _sides(contour: Contour, axis: int) -> tuple[list[_Side], list[tuple[str, float]]]:
    """Sides of a contour, `axis` being that of the shift beside x2; those that stand still in x2 apart, by level."""
    sides, flat = [], []
    for boundary in contour.boundaries:
        points, names = boundary.points, boundary.conditions
        n = len(points)
        change = np.flatnonzero(names != np.roll(names, 1))
        first = int(change[0]) if change.size else 0
        order = (first + np.arange(n + 1)) % n
        x, y, label = points[order, axis], points[order, 1 - axis], names[order]
        starts = np.flatnonzero(np.r_[True, label[1:-1] != label[:-2]])
        for begin, end in zip(starts, [*starts[1:], n], strict=True):
            name, part = contour.names[label[begin]], slice(int(begin), int(end) + 1)
            if np.ptp(y[part]) < _FLAT:
                flat.append((name, float(y[begin])))
                continue
            for side in _monotone(name, x[part], y[part]):
                if np.ptp(side.level) < _FLAT:
                    flat.append((name, float(side.level[0])))
                else:
                    sides.append(side)
    return sides, flat


def _monotone(name: str, x: Array, y: Array) -> Iterator[_Side]:
    """Cut a polyline where x2 turns round."""
    rise = np.sign(np.where(np.abs(np.diff(y)) < 1e-13, 0.0, np.diff(y)))
    for k in range(1, rise.size):  # a level piece goes on as the one before
        rise[k] = rise[k] or rise[k - 1]
    turns = np.flatnonzero(rise[1:] * rise[:-1] < 0.0) + 1
    for begin, end in zip([0, *turns], [*turns, x.size - 1], strict=True):
        part = slice(int(begin), int(end) + 1)
        along, level = x[part], y[part]
        step = 1 if level[-1] > level[0] else -1
        yield _Side(name, np.maximum.accumulate(level[::step]), along[::step])


def _levels(one: list[_Side], two: list[_Side], count: int) -> Array:
    """Ends of all sides within what both contours reach, and a regular division."""
    low = max(min(float(s.level[0]) for s in sides) for sides in (one, two))
    high = min(max(float(s.level[-1]) for s in sides) for sides in (one, two))
    if high - low < _FLAT:
        return np.zeros(0)
    ends = np.array([float(end) for s in (*one, *two) for end in s.level[[0, -1]]])
    at = np.unique(np.concatenate((np.linspace(low, high, count + 1), ends[(ends > low) & (ends < high)])))
    kept: Array = at[np.r_[True, np.diff(at) > _FLAT]]
    return kept


def _strip(sides: list[_Side], low: float, high: float) -> _Strip:
    middle = 0.5 * (low + high)
    here = sorted((s for s in sides if s.level[0] < middle < s.level[-1]), key=lambda s: s.at(middle))
    return _Strip(tuple(zip(here[::2], here[1::2], strict=False)))


def _walls(x1: _Strip, x3: _Strip, low: float, high: float) -> Iterator[tuple[str, Array]]:
    """Quadrangles (4, 3) of the sides of one strip, anticlockwise from outside."""
    for a, b in x1.pairs:
        for c, d in x3.pairs:
            for side, turned in ((a, False), (b, True)):
                quad = np.array(
                    [
                        (side.at(low), low, c.at(low)),
                        (side.at(low), low, d.at(low)),
                        (side.at(high), high, d.at(high)),
                        (side.at(high), high, c.at(high)),
                    ]
                )
                yield side.name, quad[::-1] if turned else quad
            for side, turned in ((c, True), (d, False)):
                quad = np.array(
                    [
                        (a.at(low), low, side.at(low)),
                        (b.at(low), low, side.at(low)),
                        (b.at(high), high, side.at(high)),
                        (a.at(high), high, side.at(high)),
                    ]
                )
                yield side.name, quad[::-1] if turned else quad


def _caps(level: float, below: tuple[_Strip, _Strip], above: tuple[_Strip, _Strip]) -> Iterator[Array]:
    """Rectangles (4, 3) at one level that only the strip below or only the one above has."""
    spans = [[strip.stretches(level) for strip in strips] for strips in (below, above)]
    edges = [np.unique([x for side in spans for span in side[axis] for x in span]) for axis in (0, 1)]
    edges = [e[np.r_[True, np.diff(e) > _FLAT]] if e.size else e for e in edges]
    for p, q in zip(edges[0], edges[0][1:], strict=False):
        for r, s in zip(edges[1], edges[1][1:], strict=False):
            has = [_holds(span[0], 0.5 * (p + q)) and _holds(span[1], 0.5 * (r + s)) for span in spans]
            if has[0] != has[1]:
                quad = np.array([(p, level, r), (q, level, r), (q, level, s), (p, level, s)])
                yield quad[::-1] if has[0] else quad


def _holds(spans: list[tuple[float, float]], at: float) -> bool:
    return any(low < at < high for low, high in spans)


def _face(name: str, quads: Array) -> Face:
    first = 4 * np.arange(len(quads))[:, None]
    triangles: IntArray = np.concatenate([first + np.array(corners) for corners in ((0, 1, 2), (0, 2, 3))])
    triangles.setflags(write=False)
    return Face(name, frozen(quads.reshape(-1, 3)), triangles)
