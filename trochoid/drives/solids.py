"""Simple bodies for films, as closed surfaces of triangles: rods, bars, bodies of revolution, cones."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.spherical import turn
from trochoid.kinematics.types import Array, IntArray

ROUND = 48  # points of a circle


@dataclass(frozen=True, eq=False, slots=True)
class Solid:
    """A surface: `points` (n, 3) m and `cells` (3, m), counter-clockwise seen from outside."""

    points: Array
    cells: IntArray

    def turned(self, matrix: Array) -> Solid:
        """Return it turned about O by a rotation (3, 3)."""
        return Solid(turn(matrix, self.points), self.cells)


def joined(solids: Sequence[Solid]) -> Solid:
    """Return several surfaces as one."""
    first = np.cumsum([0, *(len(solid.points) for solid in solids)])
    cells = [solid.cells + start for solid, start in zip(solids, first, strict=False)]
    return Solid(np.concatenate([solid.points for solid in solids]), np.concatenate(cells, axis=1))


def revolved(profile: Sequence[tuple[float, float]], axis: Array, round_: int = ROUND) -> Solid:
    """Return a body of revolution: closed `profile` of (radius, height) along `axis` (3,), counter-clockwise."""
    radius, height = np.array(profile).T
    one, other = _across(axis)
    angle = 2.0 * math.pi * np.arange(round_) / round_
    circle = np.cos(angle)[:, None] * one + np.sin(angle)[:, None] * other
    points = radius[:, None, None] * circle + height[:, None, None] * axis
    count = len(radius)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(count), np.arange(round_), indexing="ij"))
    cells = _quads(i, (i + 1) % count, j, (j + 1) % round_, round_)
    on_axis = (radius[cells // round_] == 0.0) & (cells % round_ > 0)
    cells = np.where(on_axis, cells // round_ * round_, cells)  # one point of the axis stands for all
    a, b, c = cells
    used, cells = np.unique(cells[:, (a != b) & (b != c) & (c != a)], return_inverse=True)
    return Solid(points.reshape(-1, 3)[used], cells.reshape(3, -1))


def rod(start: Array, end: Array, radius: float) -> Solid:
    """Return a round rod between two points (3,)."""
    way = end - start
    length = float(np.linalg.norm(way))
    made = revolved(((0.0, 0.0), (radius, 0.0), (radius, length), (0.0, length)), way / length)
    return Solid(made.points + start, made.cells)


def frustum(axis: Array, angle: float, inner: float, outer: float, round_: int = 32) -> Solid:
    """Return the cone of half angle `angle` (rad) about a ray through O between the distances `inner` and `outer`."""
    c, s = math.cos(angle), math.sin(angle)
    profile = ((0.0, inner * c), (inner * s, inner * c), (outer * s, outer * c), (0.0, outer * c))
    return revolved(profile, axis, round_)


def tube(points: Array, radius: float, round_: int = 24) -> Solid:
    """Return a round bar along a plane curve of points (n, 3)."""
    tangent = np.gradient(points, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    normal = np.cross(tangent[0], tangent[-1])
    size = float(np.linalg.norm(normal))
    upright = _across(tangent[0])[0] if size < 1e-9 else normal / size
    angle = 2.0 * math.pi * np.arange(round_) / round_
    other = np.cross(tangent, upright)
    circle = np.cos(angle)[:, None] * upright + np.sin(angle)[:, None] * other[:, None, :]
    n = len(points)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n - 1), np.arange(round_), indexing="ij"))
    around = np.arange(round_)
    on = (around + 1) % round_
    last = (n - 1) * round_
    caps = [
        np.stack([np.full(round_, n * round_), on, around]),
        np.stack([np.full(round_, n * round_ + 1), last + around, last + on]),
    ]
    body = points[:, None, :] + radius * circle
    cells = np.concatenate([_quads(i, i + 1, j, (j + 1) % round_, round_), *caps], axis=1)
    return Solid(np.concatenate([body.reshape(-1, 3), points[[0, -1]]]), cells)


def _quads(i: IntArray, up: IntArray, j: IntArray, on: IntArray, width: int) -> IntArray:
    """Return two triangles for each quadrilateral of a grid."""
    a, b, c, d = i * width + j, i * width + on, up * width + on, up * width + j
    return np.concatenate([np.stack([a, b, c]), np.stack([a, c, d])], axis=1)


def _across(axis: Array) -> tuple[Array, Array]:
    """Return unit vectors that make a right-handed frame with a unit `axis`."""
    side = np.cross([0.0, 1.0, 0.0] if abs(axis[1]) < 0.9 else [1.0, 0.0, 0.0], axis)
    one = side / np.linalg.norm(side)
    return one, np.cross(axis, one)
