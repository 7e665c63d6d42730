"""Which element holds a point, and where in it."""

from __future__ import annotations

import numpy as np

from trochoid.fem.stress import basis
from trochoid.geometry.mesh import Mesh
from trochoid.kinematics.types import Array, IntArray

NEWTON = 5  # steps; quadratic elements are nearly straight


def round_element(mesh: Mesh, element: int) -> IntArray:
    """Return the elements that share a corner with an element, itself among them."""
    return np.flatnonzero(np.isin(mesh.triangles[:3], mesh.triangles[:3, element]).any(axis=0))


def located(mesh: Mesh, near: IntArray, points: Array) -> tuple[IntArray, Array]:
    """Return elements (n,) of those `near` (e,), and reference coordinates (n, 2) in them, of points (n, 2) in m.

    Points outside all of them go to their edge.
    """
    nodes = mesh.points[mesh.triangles.T[near]]  # (e, 6, 2)
    found = np.full((len(points), len(near), 2), 1 / 3)
    for _ in range(NEWTON):
        miss = points[:, None] - np.einsum("nea,eai->nei", basis(found), nodes)
        slope = np.einsum("neak,eai->neik", _basis_slope(found), nodes)
        found = np.clip(found + np.linalg.solve(slope, miss[..., None])[..., 0], -1.0, 2.0)
    inside = np.maximum(found, 0.0)
    inside = inside / np.maximum(inside.sum(axis=-1, keepdims=True), 1.0)
    place = np.einsum("nea,eai->nei", basis(inside), nodes)
    choice = np.linalg.norm(place - points[:, None], axis=-1).argmin(axis=1)
    return near[choice], inside[np.arange(len(points)), choice]


def _basis_slope(reference: Array) -> Array:
    """Return the derivatives (..., 6, 2) of the basis functions by the reference coordinates (..., 2)."""
    x, y = reference[..., 0], reference[..., 1]
    z, none = 1 - x - y, np.zeros_like(x)
    by_x = [1 - 4 * z, 4 * x - 1, none, 4 * (z - x), 4 * y, -4 * y]
    by_y = [1 - 4 * z, none, 4 * y - 1, -4 * x, 4 * x, 4 * (z - y)]
    return np.stack([np.stack(by_x, axis=-1), np.stack(by_y, axis=-1)], axis=-1)
