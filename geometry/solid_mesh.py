"""Quadratic meshes of solid bodies: plain arrays, the facets of their surface, named sets of nodes.

Nodes of an element are in the order of VTK: corners, then the middles of the edges in `EDGES`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, IntArray, frozen

EDGES = {
    10: ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)),
    20: ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
}
FACES = {
    10: ((0, 2, 1, 6, 5, 4), (0, 1, 3, 4, 8, 7), (1, 2, 3, 5, 9, 8), (0, 3, 2, 7, 9, 6)),
    20: (
        (0, 3, 2, 1, 11, 10, 9, 8),
        (4, 5, 6, 7, 12, 13, 14, 15),
        (0, 1, 5, 4, 8, 17, 12, 16),
        (1, 2, 6, 5, 9, 18, 13, 17),
        (2, 3, 7, 6, 10, 19, 14, 18),
        (3, 0, 4, 7, 11, 16, 15, 19),
    ),
}
CORNERS = {4: 4, 8: 8, 10: 4, 20: 8}  # of an element, by its number of nodes
RAISED = {4: 10, 8: 20}


@dataclass(frozen=True, eq=False)
class SolidMesh:
    """A body of quadratic tetrahedra or bricks; arrays are read-only.

    points (n, 3), m.  elements (10 or 20, m).  sets[name] (k,): the nodes of a place on it, rising.
    """

    points: Array
    elements: IntArray
    sets: Mapping[str, IntArray]

    @property
    def corners(self) -> int:
        """Number of corners of an element, which are its first nodes: 4 or 8."""
        return CORNERS[len(self.elements)]

    @cached_property
    def facets(self) -> IntArray:
        """Facets (6 or 8, k) of the surface: corners counter-clockwise seen from outside, then middles."""
        faces = np.concatenate([self.elements[list(face)] for face in FACES[len(self.elements)]], axis=1)
        ends = np.sort(faces[: len(faces) // 2], axis=0)
        _, first, count = np.unique(ends, axis=1, return_index=True, return_counts=True)
        return _locked(faces[:, np.sort(first[count == 1])])

    @property
    def extent(self) -> float:
        """The largest side of the box round the body, m."""
        return float(np.ptp(self.points, axis=0).max())


def solid_mesh(points: Array, elements: IntArray, sets: Mapping[str, IntArray] | None = None) -> SolidMesh:
    """Return the mesh of elements (4, 8, 10 or 20, m) without points that none of them uses.

    Straight elements of 4 or 8 nodes get nodes in the middle of their edges: bending locks without.  Nodes of the
    `sets` are given, and kept, by number; middles between nodes of a set belong to it.  Raises TrochoidError for
    elements of other kinds, turned inside out, or not joined into one body.
    """
    if elements.ndim != 2 or len(elements) not in CORNERS or elements.shape[1] == 0:
        raise TrochoidError(
            f"a solid mesh needs elements of 4, 8, 10 or 20 nodes, given an array of shape {elements.shape}"
        )
    used, elements = np.unique(elements, return_inverse=True)
    elements, points = elements.reshape(-1, elements.shape[-1]).astype(np.intp), np.asarray(points)[used]
    if points.shape[1:] != (3,) or not np.isfinite(points).all():
        raise TrochoidError(f"a solid mesh needs finite points (n, 3), given shape {points.shape}")
    kept = {name: np.flatnonzero(np.isin(used, nodes)) for name, nodes in (sets or {}).items()}
    if len(elements) in RAISED:
        points, elements, kept = _raised(points, elements, kept)
    _fail_if_inverted(points, elements)
    _fail_if_apart(elements, len(points))
    return SolidMesh(
        frozen(points), _locked(elements), MappingProxyType({name: _locked(s) for name, s in kept.items()})
    )


def with_sets(mesh: SolidMesh, sets: Mapping[str, IntArray]) -> SolidMesh:
    """Return the mesh with more named sets of nodes; one of the same name is replaced."""
    more = {name: _locked(np.unique(nodes)) for name, nodes in sets.items()}
    return SolidMesh(mesh.points, mesh.elements, MappingProxyType({**mesh.sets, **more}))


def _raised(
    points: Array, elements: IntArray, sets: Mapping[str, IntArray]
) -> tuple[Array, IntArray, dict[str, IntArray]]:
    edges, size = EDGES[RAISED[len(elements)]], len(points)
    ends = np.sort([[elements[a], elements[b]] for a, b in edges], axis=1)
    keys, index = np.unique(ends[:, 0] * size + ends[:, 1], return_inverse=True)
    first, last = keys // size, keys % size
    grown = {}
    for name, nodes in sets.items():
        inside = np.isin(first, nodes) & np.isin(last, nodes)
        grown[name] = np.concatenate([nodes, size + np.flatnonzero(inside)])
    middles = size + index.reshape(len(edges), -1)
    return (
        np.concatenate([points, 0.5 * (points[first] + points[last])]),
        np.concatenate([elements, middles]),
        grown,
    )


def _fail_if_inverted(points: Array, elements: IntArray) -> None:
    """Look at the corners only; curved elements are looked at where they are integrated."""
    tetrahedron = (0, 1, 2, 3) if len(elements) == 10 else (0, 1, 3, 4)
    a, b, c, d = points[elements[list(tetrahedron)]]
    volume = np.einsum("ei,ei->e", np.cross(b - a, c - a), d - a)
    if (volume <= 0.0).any():
        bad = int(np.argmin(volume))
        raise TrochoidError(
            f"{int((volume <= 0.0).sum())} of {elements.shape[1]} elements are flat or turned inside out, the worst at "
            f"{a[bad]} m; write the mesh again with outward numbering, or mesh that place more finely"
        )


def _fail_if_apart(elements: IntArray, size: int) -> None:
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    rows, columns = np.repeat(elements[:1], len(elements), axis=0).ravel(), elements.ravel()
    count, label = connected_components(
        coo_matrix((np.ones(len(rows), dtype=np.int8), (rows, columns)), shape=(size,) * 2), directed=False
    )
    if count > 1:
        raise TrochoidError(
            f"the mesh is {count} bodies that share no nodes (of {', '.join(map(str, np.bincount(label)[:9]))} nodes); "
            "join them where the mesh is made, so that they share their facets"
        )


def _locked(values: IntArray) -> IntArray:
    array = np.ascontiguousarray(values, dtype=np.intp)
    array.setflags(write=False)
    return array
