"""Places on the surface of a solid mesh that are found by their shape: a bore, a foot, a patch round a point."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from trochoid.geometry.solid_mesh import SolidMesh, with_sets
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, BoolArray, IntArray

Triple = tuple[float, float, float]
OFF_BODY = 0.05  # of the body: how far a point may be off its surface
NEAR = 2e-3  # of the radius or the body: how far a corner of a facet may lie from the shape


@dataclass(frozen=True, slots=True)
class Cylinder:
    """Facets on a cylinder: `point` and `direction` of its axis, `radius` and, from `point` along it, `span`, m."""

    point: Triple
    direction: Triple
    radius: float
    span: tuple[float, float] = (-math.inf, math.inf)


@dataclass(frozen=True, slots=True)
class Disc:
    """Facets in a plane across `normal`, within `radius` (m) of `point`."""

    point: Triple
    normal: Triple
    radius: float = math.inf


Place = Cylinder | Disc


def find(mesh: SolidMesh, places: Mapping[str, Place]) -> SolidMesh:
    """Return the mesh with the nodes of each place as a named set.

    A facet belongs to a place when all its corners do.  Raises TrochoidError naming every place where there is none.
    """
    found: dict[str, IntArray] = {}
    missed = []
    for name, place in places.items():
        try:
            found[name] = place_nodes(mesh, place, name)
        except TrochoidError as fault:
            missed.append(str(fault))
    if missed:
        raise TrochoidError("\n".join(missed))
    return with_sets(mesh, found)


def place_nodes(mesh: SolidMesh, place: Place, name: str = "the place") -> IntArray:
    """Return the nodes of the surface's facets that lie on a cylinder or in a disc, rising."""
    facets = mesh.facets
    away, inside, near = _distance(mesh, place)
    on = (np.abs(away) <= near) & inside
    chosen = on[facets[: len(facets) // 2]].all(axis=0)
    if not chosen.any():
        outer = np.unique(facets)
        closest = outer[np.argmin(np.where(inside[outer], np.abs(away[outer]), np.inf))]
        raise TrochoidError(
            f"{name}: no whole facet of the mesh lies on {_words(place)}; "
            f"{_why_none(mesh, closest, abs(away[closest]), bool(inside[outer].any()), near)}"
        )
    return np.unique(facets[:, chosen]).astype(np.intp)


def _why_none(mesh: SolidMesh, closest: int, off: float, within: bool, near: float) -> str:
    if not within:
        low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
        return (
            f"no node of its surface is within those ends: the body is between {_mm(low)} and {_mm(high)} mm; check "
            "the place and the unit of the mesh"
        )
    if off <= near:
        return (
            f"single nodes do, as that at {_mm(mesh.points[closest])} mm: the place ends within the facets; mesh the "
            "body so that edges follow its rim, or give a larger one"
        )
    return (
        f"the nearest node, at {_mm(mesh.points[closest])} mm, is {1e3 * off:.3g} mm off; check the place and the unit "
        "of the mesh"
    )


def patch(mesh: SolidMesh, point: Triple, radius: float | None = None, name: str = "") -> IntArray:
    """Return the nodes of the surface within `radius` (m) of its node next to a point; None: those of the next facet.

    Raises TrochoidError when the point is off the body, by 5 % of its extent and a facet, or they are fewer than three.
    """
    outer = np.unique(mesh.facets)
    distance = np.linalg.norm(mesh.points[outer] - point, axis=1)
    nearest = outer[np.argmin(distance)]
    if distance.min() > OFF_BODY * mesh.extent + _edge(mesh, nearest):
        raise TrochoidError(
            f"the point {f'{name} at ' if name else ''}{_mm(point)} mm is {1e3 * distance.min():.3g} mm from the body; "
            f"the nearest node of its surface is at {_mm(mesh.points[nearest])} mm"
        )
    if radius is None:
        middles = mesh.points[mesh.facets[: len(mesh.facets) // 2]].mean(axis=0)
        facet = int(np.argmin(np.linalg.norm(middles - point, axis=1)))
        return np.sort(mesh.facets[:, facet])
    chosen = outer[np.linalg.norm(mesh.points[outer] - mesh.points[nearest], axis=1) <= radius]
    if len(chosen) < 3:
        raise TrochoidError(
            f"only {len(chosen)} node(s) lie within {1e3 * radius:.4g} mm of {_mm(point)} mm: a patch needs at least "
            "three; give a larger radius"
        )
    return np.asarray(chosen, dtype=np.intp)


def middle(mesh: SolidMesh, name: str) -> Triple:
    """Return the middle of the box round a named set, m: on the axis of a whole bore, half-way along it.

    Raises TrochoidError for a set that is not there.
    """
    if name not in mesh.sets:
        raise TrochoidError(f"the mesh has no set {name!r}; there are {', '.join(mesh.sets) or 'none'}")
    points = mesh.points[mesh.sets[name]]
    x, y, z = (0.5 * (points.min(axis=0) + points.max(axis=0))).tolist()
    return x, y, z


def _edge(mesh: SolidMesh, node: int) -> float:
    """Return the longest edge of the facets round a node of the surface, m."""
    corners = mesh.points[mesh.facets[: len(mesh.facets) // 2, (mesh.facets == node).any(axis=0)]]
    return float(np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=-1).max())


def _distance(mesh: SolidMesh, place: Place) -> tuple[Array, BoolArray, float]:
    """Return how far points (n,) are off the shape, whether (n,) they are within its ends, and what counts as on it."""
    from_point = mesh.points - place.point
    if isinstance(place, Cylinder):
        axis = _unit(place.direction)
        along = from_point @ axis
        across = np.linalg.norm(from_point - along[:, None] * axis, axis=1)
        near = NEAR * place.radius
        inside = (along >= place.span[0] - near) & (along <= place.span[1] + near)
        return across - place.radius, inside, near
    normal = _unit(place.normal)
    near = NEAR * min(mesh.extent, place.radius)
    off = from_point @ normal
    across = np.linalg.norm(from_point - off[:, None] * normal, axis=1)
    return off, across <= place.radius + near, near


def _words(place: Place) -> str:
    """Return what a place is, in mm."""
    if isinstance(place, Disc):
        size = "" if math.isinf(place.radius) else f" of radius {_mm([place.radius])} mm"
        across = ", ".join(f"{x:.4g}" for x in place.normal)
        return f"the disc{size} about {_mm(place.point)} mm, across the direction {across}"
    ends = [end for end in place.span if not math.isinf(end)]
    span = f", from {_mm([ends[0]])} to {_mm([ends[1]])} mm along it" if len(ends) == len(place.span) else ""
    along = ", ".join(f"{x:.4g}" for x in place.direction)
    return (
        f"the cylinder of radius {_mm([place.radius])} mm about the axis through {_mm(place.point)} mm in the "
        f"direction {along}{span}"
    )


def _mm(values: Iterable[float]) -> str:
    return ", ".join(f"{1e3 * float(value) + 0.0:.5g}" for value in values)


def _unit(direction: Triple) -> Array:
    length = float(np.linalg.norm(direction))
    if not length > 0.0:
        raise TrochoidError(f"a direction must have a length, given {direction}")
    return np.asarray(direction, dtype=np.float64) / length
