"""Second-order triangles on the unit sphere: what a body of rays through O is extruded from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from trochoid.geometry.mesh import edge_keys, with_middles, without_ears
from trochoid.geometry.quality import Quality
from trochoid.geometry.sphere_outline import SphereOutline
from trochoid.geometry.triangulate import triangulate
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, IntArray

THIN = 3.0  # lengths of a facet over the distance to the hub: with 6 elements fold
# reference coordinates at which the Jacobian is looked at: nodes and the middle
_PLACES = np.array([[0, 0], [1, 0], [0, 1], [0.5, 0], [0.5, 0.5], [0, 0.5], [1 / 3, 1 / 3]])


@dataclass(frozen=True, eq=False)
class SphereMesh:
    """P2 triangles on the unit sphere; arrays are read-only.

    points (n, 3): unit vectors, vertices first.  triangles (6, m): vertices, counter-clockwise seen from outside,
    then the mid-side nodes of 01, 12, 02.  edges[name] (3, k): start, end and mid node of each facet of a side;
    parameters[name] (3, k) theirs, growing (see `Side`).
    """

    points: Array
    triangles: IntArray
    edges: Mapping[str, IntArray]
    parameters: Mapping[str, Array]

    def nodes(self, name: str) -> IntArray:
        """Return the nodes (2k+1,) of an open side in order: end, middle, end, ..."""
        edge = self.edges[name]
        return np.append(np.stack([edge[0], edge[2]], axis=1).ravel(), edge[1, -1])


def mesh_sphere(outline: SphereOutline, growth: float = 1.3) -> SphereMesh:
    """Mesh an outline; elements grow away from the sides by about `growth` from one to the next.

    Raises TrochoidError when gmsh fails or an element folds.
    """
    corners = [np.concatenate([side.ends[:-1] for side in loop]) for loop in outline.loops]
    chart, triangles = triangulate([outline.to_chart(c) for c in corners], growth - 1.0)
    edges: dict[str, IntArray] = {}
    first = 0
    for loop, corner in zip(outline.loops, corners, strict=True):
        start = first
        for side in loop:
            count = len(side.middles)
            index = first + np.arange(count + 1) - start
            edges[side.name] = np.stack([index[:-1], index[1:]]) % len(corner) + start
            first += count
    triangles = without_ears(chart, triangles, np.concatenate(list(edges.values()), axis=1))
    size = len(chart)
    chart, triangles, pairs = with_middles(chart, triangles)
    points = outline.from_chart(chart)
    parameters: dict[str, Array] = {}
    for loop in outline.loops:
        for side in loop:
            ends = edges[side.name]
            middle = size + np.searchsorted(pairs, edge_keys(ends[0], ends[1], size))
            points[middle], points[ends[0]] = side.middles, side.ends[:-1]
            edges[side.name], parameters[side.name] = _forward(ends, middle, side.parameters)
    mesh = SphereMesh(points, triangles, MappingProxyType(edges), MappingProxyType(parameters))
    _fail_if_folded(mesh)
    for array in (points, triangles, *edges.values(), *parameters.values()):
        array.setflags(write=False)
    return mesh


def sphere_quality(mesh: SphereMesh) -> Quality:
    """Worst angles and scaled Jacobian."""
    corner = mesh.points[mesh.triangles[:3]]
    to_next, to_last = np.roll(corner, -1, axis=0) - corner, np.roll(corner, 1, axis=0) - corner
    angles = np.arctan2(
        np.linalg.norm(np.cross(to_next, to_last), axis=-1), np.sum(to_next * to_last, axis=-1)
    )
    volume = jacobians(mesh)
    worst = float((volume.min(axis=0) / volume.max(axis=0)).min())
    return Quality(len(mesh.points), mesh.triangles.shape[1], float(angles.min()), float(angles.max()), worst)


def jacobians(mesh: SphereMesh) -> Array:
    """Return f·(∂f/∂ξ × ∂f/∂η) (7, m) at nodes and middles of the elements: solid angle per unit of ξ and η."""
    node = mesh.points[mesh.triangles]
    values = []
    for x, y in _PLACES:
        z = 1.0 - x - y
        by_x = np.array([1.0 - 4.0 * z, 4.0 * x - 1.0, 0.0, 4.0 * (z - x), 4.0 * y, -4.0 * y])
        by_y = np.array([1.0 - 4.0 * z, 0.0, 4.0 * y - 1.0, -4.0 * x, 4.0 * x, 4.0 * (z - y)])
        shape = np.array([z * (2 * z - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * z * x, 4 * x * y, 4 * y * z])
        f, fx, fy = (np.tensordot(s, node, 1) for s in (shape, by_x, by_y))
        values.append(np.sum(f * np.cross(fx, fy), axis=-1))
    return np.array(values)


def _forward(ends: IntArray, middle: IntArray, parameters: Array) -> tuple[IntArray, Array]:
    """Return facets (3, k) and their parameters in the direction in which these grow."""
    edge = np.stack([*ends, middle])
    if parameters[0, 0] > parameters[1, 0]:
        edge, parameters = edge[[1, 0, 2], ::-1], parameters[[1, 0, 2], ::-1]
    return np.ascontiguousarray(edge), np.ascontiguousarray(parameters)


def _fail_if_folded(mesh: SphereMesh) -> None:
    folded = np.flatnonzero(jacobians(mesh).min(axis=0) <= 0.0)
    if folded.size:
        raise TrochoidError(
            f"{folded.size} curved elements fold, first at {mesh.points[mesh.triangles[0, folded[0]]]} on the unit "
            f"sphere; {_remedy(mesh)}"
        )


def _remedy(mesh: SphereMesh) -> str:
    """Say what takes folds away: facets no longer than THIN times the distance to the hub, or shorter ones."""
    if not {"flank", "hub"} <= set(mesh.edges):
        return "give the flank more facets"
    flank, hub = (mesh.points[mesh.edges[name]] for name in ("flank", "hub"))
    away = np.linalg.norm(flank.reshape(-1, 1, 3) - hub.reshape(-1, 3), axis=-1).min()
    longest = np.linalg.norm(flank[1] - flank[0], axis=-1).max()
    if longest < THIN * away:
        return "give the flank more facets"
    return (
        f"the body is only {np.degrees(away):.3g}° thin between the flank and the hub that holds it, and the flank's "
        f"facets are {np.degrees(longest):.3g}° long: hold it at least {np.degrees(longest / THIN):.3g}° away from the "
        f"flank, or give the flank {int(np.ceil(flank.shape[1] * longest / (THIN * away)))} facets"
    )
