"""The sides of a body of rays as second-order triangles on the nodes of its elements."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from trochoid.fem.cone_body import ConeBody
from trochoid.kinematics.types import Array, IntArray

SIDES = ("flank", "hub")  # of a tooth: the cuts beside it are inside the rim


@dataclass(frozen=True, eq=False, slots=True)
class ToothSurface:
    """Nodes (k,) of the sides by their number in the plane mesh, `plane`, and on the ray, `layer`; `cells` (6, m).

    Cells: vertices, counter-clockwise seen from outside, then the middles of 01, 12, 20.
    """

    plane: IntArray
    layer: IntArray
    cells: IntArray

    def points(self, body: ConeBody) -> Array:
        """Return the nodes' places (k, 3), m."""
        return np.asarray(body.mesh.points[self.plane] * body.radial.nodes[self.layer][:, None])


def tooth_surface(body: ConeBody, sides: Iterable[str] = SIDES) -> ToothSurface:
    """Return both ends of a body and the sides named."""
    mesh, count = body.mesh, body.radial.count
    inner = mesh.triangles[[0, 2, 1, 5, 4, 3]] * count
    cells = [inner, mesh.triangles * count + count - 1]
    corners = mesh.triangles[:3]
    inward = {  # edges with their triangle on the left, seen from outside
        (int(a), int(b)) for i in range(3) for a, b in zip(corners[i], corners[(i + 1) % 3], strict=True)
    }
    for side in sides:
        for low, high, middle in mesh.edges[side].T.tolist():
            start, end = (low, high) if (low, high) in inward else (high, low)
            cells.append(_quads(start, end, middle, count))
    flat = np.concatenate(cells, axis=1)
    used, index = np.unique(flat, return_inverse=True)
    return ToothSurface(used // count, used % count, index.reshape(flat.shape))


def _quads(start: int, end: int, middle: int, count: int) -> IntArray:
    """Return the triangles (6, 2 layers) over a facet: the node in the middle of each nine lies on their diagonal."""
    low = np.arange(0, count - 1, 2)
    a, b, m = (node * count + low for node in (start, end, middle))
    one = np.stack([a, b, b + 2, m, b + 1, m + 1])
    other = np.stack([a, b + 2, a + 2, m + 1, m + 2, a + 1])
    return np.concatenate([one, other], axis=1)
