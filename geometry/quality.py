"""How good a P2 triangle mesh is: guaranteed Jacobian bounds, smallest angles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from trochoid.kinematics.types import Array, IntArray

if TYPE_CHECKING:
    from trochoid.geometry.mesh import Mesh

# reference coordinates of the six nodes of a P2 triangle
_NODES = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]])


@dataclass(frozen=True, slots=True)
class Quality:
    """Worst values over a mesh: angles (rad) of the straight triangles, least Jacobian over the largest."""

    nodes: int
    triangles: int
    min_angle: float
    max_angle: float
    min_scaled_jacobian: float


def quality(mesh: Mesh) -> Quality:
    """Worst angles and scaled Jacobian of a mesh."""
    angles = corner_angles(mesh.points, mesh.triangles)
    low, high = jacobian_bounds(mesh.points, mesh.triangles)
    count = mesh.triangles.shape[1]
    return Quality(
        len(mesh.points), count, float(angles.min()), float(angles.max()), float((low / high).min())
    )


def corner_angles(points: Array, triangles: IntArray) -> Array:
    """Angles (3, m), rad, of the straight-sided triangles."""
    corner = points[triangles[:3]]
    to_next, to_last = np.roll(corner, -1, axis=0) - corner, np.roll(corner, 1, axis=0) - corner
    angles: Array = np.arctan2(_cross(to_next, to_last), np.sum(to_next * to_last, axis=-1))
    return angles


def jacobian_bounds(points: Array, triangles: IntArray) -> tuple[Array, Array]:
    """Lower and upper bound (m,) of det ∂x/∂ξ over each P2 triangle, from its Bézier coefficients, m²."""
    node = points[triangles]
    value = np.stack([_determinant(node, x, y) for x, y in _NODES])
    middle = 2.0 * value[3:] - 0.5 * (value[[0, 1, 0]] + value[[1, 2, 2]])
    coefficients = np.concatenate((value[:3], middle))
    return coefficients.min(axis=0), coefficients.max(axis=0)


def _determinant(node: Array, x: float, y: float) -> Array:
    z = 1.0 - x - y
    by_x = np.array([1.0 - 4.0 * z, 4.0 * x - 1.0, 0.0, 4.0 * (z - x), 4.0 * y, -4.0 * y])
    by_y = np.array([1.0 - 4.0 * z, 0.0, 4.0 * y - 1.0, -4.0 * x, 4.0 * x, 4.0 * (z - y)])
    return _cross(np.tensordot(by_x, node, 1), np.tensordot(by_y, node, 1))


def _cross(a: Array, b: Array) -> Array:
    cross: Array = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return cross
