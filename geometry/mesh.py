"""Second-order triangle mesh of an outline, its boundary mid-side nodes on the true curves."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from trochoid.geometry.outline import Loop, Outline
from trochoid.geometry.quality import jacobian_bounds
from trochoid.geometry.triangulate import triangulate
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, IntArray

_EDGES = ((0, 1), (1, 2), (0, 2))  # rows 3, 4, 5 of a P2 triangle are the mid-side nodes of these


@dataclass(frozen=True, eq=False)
class Mesh:
    """Plain arrays of a P2 triangle mesh; nodes are numbered as scikit-fem's MeshTri2 numbers them.

    points (n, 2), m: first all vertices, then all mid-side nodes.  triangles (6, m): vertices 0, 1, 2,
    counter-clockwise, then the mid-side nodes of edges 01, 12, 02.  edges[name] (3, k): start, end and mid
    node of each facet of a loop, or of one of its sides, in order, counter-clockwise.  parameters[name]
    (3, k): their curve parameters, unwrapped, so that end > mid > start.
    """

    points: Array
    triangles: IntArray
    edges: Mapping[str, IntArray]
    parameters: Mapping[str, Array]

    @property
    def vertices(self) -> int:
        """Number of vertices: nodes from this number on are mid-side nodes."""
        return int(self.triangles[:3].max()) + 1


def mesh_outline(outline: Outline, growth: float | Callable[[Array], Array] = 1.3) -> Mesh:
    """Mesh an outline; elements grow away from the boundary by about `growth` from one to the next.

    It may be a function that gives it at points (n, 2) of the boundary.

    Raises TrochoidError when gmsh fails, or where curved elements would fold (naming the loop to refine).
    """
    ends = {loop.name: loop.parameters() for loop in outline.loops}
    if len(ends) < len(outline.loops):
        raise TrochoidError(
            f"loops of an outline need different names; given {[loop.name for loop in outline.loops]}"
        )
    corners = [loop.curve.point(ends[loop.name][:-1]) for loop in outline.loops]
    rate = growth(np.concatenate(corners)) if callable(growth) else growth
    points, triangles = triangulate(corners, rate - 1.0)
    nodes = _boundary_nodes(outline.loops, ends)
    triangles = without_ears(points, triangles, np.concatenate([n[:2] for n in nodes.values()], axis=1))
    size = len(points)
    points, triangles, pairs = with_middles(points, triangles)
    edges: dict[str, IntArray] = {}
    parameters: dict[str, Array] = {}
    for loop in outline.loops:
        edge, t = _curved(loop, ends[loop.name], nodes[loop.name], pairs, size)
        points[edge[2]] = loop.curve.point(t[2])
        edges[loop.name], parameters[loop.name] = edge, t
        for side, (low, high) in loop.sides.items():
            inside = np.mod(t[2] - low, loop.curve.period) < high - low
            edges[side], parameters[side] = edge[:, inside], t[:, inside]
    _fail_if_folded(points, triangles, outline.loops, edges)
    for array in (points, triangles, *edges.values(), *parameters.values()):
        array.setflags(write=False)
    return Mesh(points, triangles, MappingProxyType(edges), MappingProxyType(parameters))


def _boundary_nodes(loops: tuple[Loop, ...], ends: Mapping[str, Array]) -> dict[str, IntArray]:
    """Start and end node of each facet, shape (2, k), by loop."""
    nodes, first = {}, 0
    for loop in loops:
        start = first + np.arange(ends[loop.name].size - 1)
        nodes[loop.name] = np.stack((start, np.roll(start, -1)))
        first += start.size
    return nodes


def without_ears(points: Array, triangles: IntArray, facets: IntArray) -> IntArray:
    """Swap the inner edge of each triangle with two facets: on a smooth boundary its corner would be flat."""
    size = len(points)
    triangles = triangles.copy()
    on_boundary = np.sort(edge_keys(facets[0], facets[1], size))
    keys = np.stack([edge_keys(triangles[a], triangles[b], size) for a, b in _EDGES])
    count = np.isin(keys, on_boundary).sum(axis=0)
    for ear in np.flatnonzero(count == 2).tolist():
        inner = int(np.flatnonzero(~np.isin(keys[:, ear], on_boundary))[0])
        neighbours = np.flatnonzero((keys == keys[inner, ear]).any(axis=0))
        other = int(neighbours[neighbours != ear][0])
        _swap(triangles, ear, other)
        keys = np.stack([edge_keys(triangles[a], triangles[b], size) for a, b in _EDGES])
    return triangles


def _swap(triangles: IntArray, ear: int, other: int) -> None:
    """Join the tips of two neighbours instead of the ends of their common edge; orientation is kept."""
    shared = np.intersect1d(triangles[:, ear], triangles[:, other])
    turn = int(np.flatnonzero(~np.isin(triangles[:, ear], shared))[0])
    tip, a, b = np.roll(triangles[:, ear], -turn)
    far = int(np.setdiff1d(triangles[:, other], shared)[0])
    triangles[:, ear], triangles[:, other] = (tip, a, far), (tip, far, b)


def edge_keys(a: IntArray, b: IntArray, size: int) -> IntArray:
    """Return one number for each edge between nodes a and b (…) of `size`, whichever comes first."""
    keys: IntArray = np.minimum(a, b) * size + np.maximum(a, b)
    return keys


def with_middles(points: Array, triangles: IntArray) -> tuple[Array, IntArray, IntArray]:
    """Add straight mid-side nodes; the third value holds the sorted edge keys in the order of these nodes."""
    size = len(points)
    keys = np.stack([edge_keys(triangles[a], triangles[b], size) for a, b in _EDGES])
    pairs, index = np.unique(keys, return_inverse=True)
    middle = 0.5 * (points[pairs // size] + points[pairs % size])
    raised = np.concatenate((triangles, size + index.reshape(keys.shape)))
    return np.concatenate((points, middle)), raised.astype(np.intp), pairs


def _curved(loop: Loop, ends: Array, nodes: IntArray, pairs: IntArray, size: int) -> tuple[IntArray, Array]:
    """Facets (3, k) with their mid nodes, and parameters (3, k) with the mid one at half the arc length."""
    arc = ArcLength(loop.curve)
    s = arc.length(ends)
    middle = arc.parameter(0.5 * (s[1:] + s[:-1]))
    edge = np.stack((*nodes, size + np.searchsorted(pairs, edge_keys(nodes[0], nodes[1], size))))
    return edge, np.stack((ends[:-1], ends[1:], middle))


def _fail_if_folded(
    points: Array, triangles: IntArray, loops: tuple[Loop, ...], edges: Mapping[str, IntArray]
) -> None:
    low, _ = jacobian_bounds(points, triangles)
    folded = triangles[:, low <= 0.0]
    if folded.size == 0:
        return
    touched = [loop.name for loop in loops if np.isin(edges[loop.name], folded).any()]
    raise TrochoidError(
        f"{folded.shape[1]} curved elements fold, first at {points[folded[0, 0]]} m; "
        f"give more facets to {', '.join(touched) or 'the loops beside them'}"
    )
