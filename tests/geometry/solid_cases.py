"""Bodies of bricks on a grid, and a small casing, for tests."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from trochoid.geometry.casing_box import Bore, BoxCasing, MountPlace
from trochoid.geometry.solid_mesh import SolidMesh, solid_mesh
from trochoid.kinematics.types import Array, IntArray

CASING = BoxCasing(
    (0.30, 0.25, 0.20),
    0.01,
    (Bore("input", "low", 0.04, 0.055, 0.025), Bore("output", "high", 0.03, 0.045, 0.02, x=0.02)),
    tuple(
        MountPlace(name, x, z, 0.015)
        for name, x, z in (
            ("foot 1", -0.17, -0.08),
            ("foot 2", 0.17, -0.08),
            ("foot 3", 0.17, 0.08),
            ("foot 4", -0.17, 0.08),
        )
    ),
    base=0.015,
    flange=(0.04, 0.0),
)


def grid(counts: tuple[int, int, int]) -> tuple[Array, IntArray]:
    """Return points (n, 3) in the unit cube and bricks (8, m) of a grid."""
    axes = [np.linspace(0.0, 1.0, count + 1) for count in counts]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    number = np.arange(len(points)).reshape([count + 1 for count in counts])
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    nodes = [number[i : counts[0] + i, j : counts[1] + j, k : counts[2] + k].ravel() for i, j, k in corners]
    return points, np.stack(nodes)


def bricks(counts: tuple[int, int, int], place: Callable[[Array], Array] = lambda x: x) -> SolidMesh:
    """Return quadratic bricks of a grid in the unit cube, all their nodes moved by `place`."""
    unit = solid_mesh(*grid(counts))
    return solid_mesh(place(unit.points), unit.elements)


def bar(size: tuple[float, float, float], counts: tuple[int, int, int]) -> SolidMesh:
    """Return a bar along x from the origin, its ends the sets "left" and "right"."""
    mesh = bricks(counts, lambda points: points * size)
    at = mesh.points[:, 0]
    sets = {"left": np.flatnonzero(at < 1e-9), "right": np.flatnonzero(at > size[0] * (1.0 - 1e-9))}
    return solid_mesh(mesh.points, mesh.elements, sets)
