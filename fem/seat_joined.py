"""A bearing ring pressed into its housing: two plane bodies of their own materials and widths, joined as one.

The fit is perfect: on it both move alike, and it carries tension too, as an interference does until it is used up. The
stress of the interference itself, and what it takes of the bearing's clearance, are not in it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from scipy.spatial import cKDTree

from trochoid.fem.body import Body, body_of
from trochoid.fem.elasticity import Elements, elements
from trochoid.fem.material import Plane
from trochoid.geometry.mesh import Mesh
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.types import Array, IntArray

SAME = 1e-9  # of the fit's extent: how far its nodes may lie apart
_SIDES = ((0, 1), (1, 2), (0, 2))  # rows 3, 4, 5 of a triangle are the mid nodes of these


@dataclass(frozen=True, slots=True)
class Layer:
    """One of the two bodies: its mesh, moduli and width in m."""

    mesh: Mesh
    plane: Plane
    width: float


def pressed_body(ring: Layer, housing: Layer, fit: str, supports: tuple[str, ...]) -> Body:
    """Return ring and housing as one held body, per unit width of the ring; it is pressed in the ring only.

    Both meshes have a loop `fit` on the same circle with the same facets, and no other name in common. A housing of
    another width counts with its stiffness in proportion, which is exact in plane stress alone. Raises TrochoidError
    and Infeasible.
    """
    if not supports:
        raise TrochoidError("seat: name the edges that hold the housing (supports)")
    for layer in (ring, housing):
        if not (np.isfinite(layer.width) and layer.width > 0.0):
            raise Infeasible(f"seat: widths must be positive and finite, given {layer.width} m")
    mesh, inner, outer = _joined_mesh(ring.mesh, housing.mesh, fit)
    parts = _joined(
        mesh,
        elements(ring.mesh, ring.plane),
        elements(housing.mesh, housing.plane),
        housing.width / ring.width,
    )
    body = body_of(mesh, ring.plane, parts, supports)
    other = np.zeros(len(mesh.points), dtype=bool)
    other[outer] = True
    other[inner] = False  # the fit belongs to the ring: patches may reach it, but not beyond
    return replace(body, held=body.held | other)


def _joined_mesh(ring: Mesh, housing: Mesh, fit: str) -> tuple[Mesh, IntArray, IntArray]:
    """Return one mesh, and the numbers in it of the nodes of both."""
    matches = _matches(ring, housing, fit)
    own = np.full(len(housing.points), -1, dtype=np.intp)
    own[matches[1]] = matches[0]
    free = own < 0
    own[free] = len(ring.points) + np.arange(int(free.sum()))
    points = np.concatenate([ring.points, housing.points[free]])
    triangles = np.concatenate([ring.triangles, own[housing.triangles]], axis=1)
    number = _numbering(len(points), triangles)
    inner, outer = number[: len(ring.points)], number[own]
    placed = np.empty_like(points)
    placed[number] = points
    edges = {name: inner[e] for name, e in ring.edges.items()}
    edges |= {name: outer[e] for name, e in housing.edges.items() if name != fit}
    parameters = dict(ring.parameters) | {n: p for n, p in housing.parameters.items() if n != fit}
    whole = number[triangles]
    for array in (placed, whole, *edges.values()):
        array.setflags(write=False)
    return Mesh(placed, whole, MappingProxyType(edges), MappingProxyType(parameters)), inner, outer


def _matches(ring: Mesh, housing: Mesh, fit: str) -> tuple[IntArray, IntArray]:
    """Return the nodes of the ring and of the housing on the fit, in the same order."""
    for name, mesh in (("ring", ring), ("housing", housing)):
        if fit not in mesh.edges:
            raise TrochoidError(f'seat: the {name} has no edge "{fit}"; it has {", ".join(mesh.edges)}')
    common = sorted((ring.edges.keys() & housing.edges.keys()) - {fit})
    if common:
        raise TrochoidError(f"seat: ring and housing both have an edge {', '.join(common)}; rename one")
    inner, outer = np.unique(ring.edges[fit]), np.unique(housing.edges[fit])
    places = ring.points[inner]
    distance, nearest = cKDTree(places).query(housing.points[outer])
    extent = float(np.ptp(places, axis=0).max())
    if inner.size != outer.size or distance.max() > SAME * extent or np.unique(nearest).size != inner.size:
        raise Infeasible(
            f'seat: ring and housing do not meet on "{fit}": {inner.size // 2} and {outer.size // 2} facets, nodes '
            f"up to {1e3 * float(distance.max()):.3g} mm apart; give both the same circle with the same facets"
        )
    return inner[nearest], outer


def _numbering(count: int, triangles: IntArray) -> IntArray:
    """Return the new number of each node: vertices first, then mid nodes in the order of their sides."""
    vertices = np.unique(triangles[:3])
    number = np.full(count, -1, dtype=np.intp)
    number[vertices] = np.arange(vertices.size)
    ends = np.stack([np.sort(number[triangles[list(side)]], axis=0) for side in _SIDES])  # (3, 2, m)
    _, place = np.unique(ends[:, 0] * vertices.size + ends[:, 1], return_inverse=True)
    number[triangles[3:].ravel()] = vertices.size + place.ravel()
    return number


def _joined(mesh: Mesh, ring: Elements, housing: Elements, wider: float) -> Elements:
    """Return the elements of both, those of the housing `wider` times as stiff."""
    triangles = mesh.triangles.T
    areas: Array = np.concatenate([ring.areas, housing.areas])
    weight = np.zeros(len(mesh.points))
    np.add.at(weight, triangles, areas)
    centroids = np.concatenate([ring.centroids, housing.centroids])
    dofs = np.stack([2 * triangles, 2 * triangles + 1], axis=-1).reshape(-1, 12)
    stiffness = np.concatenate([ring.stiffness, wider * housing.stiffness])
    return Elements(stiffness, dofs, areas, weight, centroids, cKDTree(centroids))
