"""Compliance of a body's surfaces: C(x, y) = −2/(πE')·ln|x−y| + S(x, y), with S smooth and tabulated at
stations.

Every facet's mid node is a station: the true profile passes through it and the quadratic boundary is smooth
there. S is splined in arc length, in both arguments, so that a contact may sit anywhere on the profile. On a
curved surface S has a kink at x = y: the point force drags the surface towards itself, by a jump of
(κ−1)/(4G), and the normal turns with the curvature k, which leaves k(κ−1)/(8G)·|x−y|. A spline across the
kink would be ten times worse than the mesh. So S(x, x) has a spline of its own, and on surfaces of constant
curvature the kink is taken out of the table as well.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from trochoid.fem import flamant
from trochoid.fem.body import Body
from trochoid.fem.linear_solver import BLOCK
from trochoid.fem.patch import Patch, PointForce, patch_load
from trochoid.geometry.outline import Loop
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.types import Array, IntArray, frozen


@dataclass(frozen=True, slots=True)
class Stations:
    """Where a body may be pressed: mid nodes of facets.

    `nodes` (k,), outward unit normals (k, 2) of the true profile, the facet's `elements` (k,) and `facets`
    lengths (k,).
    """

    nodes: IntArray
    normals: Array
    elements: IntArray
    facets: Array


@dataclass(frozen=True, slots=True)
class Surface:
    """One closed surface of a body: arc-length positions of its stations, its length in m, the first
    station, and the kink's slope in 1/(Pa·m).
    """

    name: str
    positions: Array
    length: float
    first: int
    kink: float


@dataclass(frozen=True, slots=True)
class Weights:
    """Non-zero cubic B-splines at n places: columns (n, 4) of the table, their values (n, 4); the surface's
    first station and its kink's slope (n,).
    """

    columns: IntArray
    values: Array
    surface: IntArray
    kink: Array

    @staticmethod
    def joined(parts: Sequence[Weights]) -> Weights:
        """Return the places of all parts, in order."""
        return Weights(
            np.concatenate([p.columns for p in parts]),
            np.concatenate([p.values for p in parts]),
            np.concatenate([p.surface for p in parts]),
            np.concatenate([p.kink for p in parts]),
        )


@dataclass(frozen=True, slots=True)
class Compliance:
    """Tabulated smooth compliance of a body of unit thickness.

    `table` (k, k) and `diagonal` (k,) hold the spline coefficients of S and of S(x, x) in 1/Pa, `stations`
    (k, k) S itself, `kernel` is 2/(πE'), `asymmetry` the largest difference of S from its transpose over the
    range of S: a measure of the mesh.
    """

    surfaces: Mapping[str, Surface]
    table: Array
    diagonal: Array
    stations: Array
    kernel: float
    asymmetry: float

    def smooth(self, place: Weights, points: Array) -> Array:
        """Return S (n, n) between points (n, 2) at these places."""
        return self._smooth(place, _distances(points))

    def between(self, place: Weights, points: Array) -> Array:
        """Return the compliance (n, n) between points (n, 2) at these places; on the diagonal S alone,
        without the logarithm.
        """
        distance = _distances(points)
        result = self._smooth(place, distance)
        np.fill_diagonal(distance, 1.0)
        result -= self.kernel * np.log(distance)
        return result

    def _smooth(self, place: Weights, distance: Array) -> Array:
        gathered = self.table[place.columns[:, None, :, None], place.columns[None, :, None, :]]
        half = np.matmul(gathered, place.values[None, :, :, None])[..., 0]
        result: Array = np.einsum("ija,ia->ij", half, place.values)
        same = np.equal.outer(place.surface, place.surface)
        result += np.where(same, place.kink, 0.0) * distance
        np.fill_diagonal(result, np.einsum("ia,ia->i", self.diagonal[place.columns], place.values))
        return result


def _distances(points: Array) -> Array:
    offset = points[:, None] - points[None]
    distances: Array = np.hypot(offset[..., 0], offset[..., 1])
    return distances


def surface_weights(surface: Surface, position: Array) -> Weights:
    """Return the spline weights at arc-length positions (n,)."""
    count = len(surface.positions)
    turn = np.append(surface.positions, surface.positions[0] + surface.length)
    knots = np.concatenate([turn[-4:-1] - surface.length, turn, turn[1:4] + surface.length])
    position = turn[0] + np.mod(position - turn[0], surface.length)
    interval = np.clip(np.searchsorted(knots, position, side="right") - 1, 3, count + 2)
    columns = interval[:, None] - 3 + np.arange(4)[None, :]
    own, kink = np.full(len(position), surface.first), np.full(len(position), surface.kink)
    return Weights(surface.first + columns % count, _basis(knots, interval, position), own, kink)


def _basis(knots: Array, interval: IntArray, position: Array) -> Array:
    """Return the four cubic B-splines that are not zero at each position (de Boor's recursion, vectorised)."""
    values = np.ones((len(position), 1))
    for degree in range(1, 4):
        new = np.zeros((len(position), degree + 1))
        for j in range(degree):
            right = knots[interval + j + 1]
            left = knots[interval + j + 1 - degree]
            part = values[:, j] / (right - left)
            new[:, j] += (right - position) * part
            new[:, j + 1] += (position - left) * part
        values = new
    return values


def tabulate(body: Body, stations: Stations, surfaces: tuple[Surface, ...]) -> Compliance:
    """Press the body at every station along its normal and tabulate S between all of them."""
    raw = np.empty((len(stations.nodes),) * 2)
    for start in range(0, len(stations.nodes), BLOCK):
        chosen = np.arange(start, min(start + BLOCK, len(stations.nodes)))
        raw[:, chosen] = _columns(body, stations, chosen)
    s = 0.5 * (raw + raw.T)
    table, diagonal = s.copy(), np.diag(s).copy()
    for surface in surfaces:
        rows = slice(surface.first, surface.first + len(surface.positions))
        points = body.mesh.points[stations.nodes[rows]]
        table[rows, rows] -= surface.kink * np.linalg.norm(points[:, None] - points[None], axis=-1)
    for surface in surfaces:
        rows = slice(surface.first, surface.first + len(surface.positions))
        inverse = np.linalg.inv(_collocation(surface))
        table[rows] = inverse @ table[rows]
        table[:, rows] = table[:, rows] @ inverse.T
        diagonal[rows] = inverse @ diagonal[rows]
    asymmetry = float(np.abs(raw - raw.T).max() / np.ptp(s))
    named = MappingProxyType({x.name: x for x in surfaces})
    return Compliance(named, frozen(table), frozen(diagonal), frozen(s), body.plane.kernel, asymmetry)


def _collocation(surface: Surface) -> Array:
    count = len(surface.positions)
    weights = surface_weights(surface, surface.positions)
    matrix = np.zeros((count, count))
    np.add.at(matrix, (np.arange(count)[:, None], weights.columns - surface.first), weights.values)
    return matrix


def _columns(body: Body, stations: Stations, chosen: IntArray) -> Array:
    """Return S at all stations for unit presses at the chosen ones."""
    loads = [
        PointForce(
            body.mesh.points[stations.nodes[i]],
            -stations.normals[i],
            -stations.normals[i],
            int(stations.elements[i]),
            float(stations.facets[i]),
        )
        for i in chosen
    ]
    patches = [patch_load(body, load) for load in loads]
    answer = solve_patches(body, patches)
    inward = -stations.normals
    columns = np.empty((len(stations.nodes), len(chosen)))
    for j, (load, patch) in enumerate(zip(loads, patches, strict=True)):
        u = answer[:, j].reshape(-1, 2)[stations.nodes]
        columns[:, j] = np.einsum("ki,ki->k", inward, u)
        _add_singular(body, load, patch, stations, columns[:, j])
    return columns


def _add_singular(body: Body, load: PointForce, patch: Patch, stations: Stations, column: Array) -> None:
    """Add u_s where the station lies in D, and take the logarithm out everywhere."""
    offset = body.mesh.points[stations.nodes] - load.point
    distance = np.hypot(offset[:, 0], offset[:, 1])
    elsewhere = distance > 0
    column[elsewhere] += body.plane.kernel * np.log(distance[elsewhere])
    near = np.isin(stations.nodes, patch.nodes) & elsewhere
    singular = flamant.displacement(body.plane, offset[near], load.inward, load.force)
    column[near] -= np.einsum("ki,ki->k", stations.normals[near], singular)


def solve_patches(body: Body, patches: Sequence[Patch]) -> Array:
    """Solve for the finite-element part (2n, k) of point forces; a free body is balanced by inertia relief
    and its mean motion removed.
    """
    rhs = np.zeros((body.size, len(patches)), order="F")
    for j, patch in enumerate(patches):
        np.add.at(rhs[:, j], patch.dofs, patch.values)
    if body.relief is None:
        return body.solve(rhs)
    r = body.relief
    total = np.linalg.solve(r.gram, r.modes.T @ rhs)
    answer = body.solve(rhs - r.weighted @ total)
    mean = r.weighted.T @ answer + np.stack([patch.mean for patch in patches], axis=-1)
    return np.asarray(answer - r.modes @ np.linalg.solve(r.gram, mean))


def press(body: Body, loops: Sequence[Loop]) -> Compliance:
    """Make every facet of the loops a station and tabulate S between all of them."""
    stations, surfaces = place_stations(body, loops)
    return tabulate(body, stations, surfaces)


def place_stations(body: Body, loops: Sequence[Loop]) -> tuple[Stations, tuple[Surface, ...]]:
    """Return a station at every facet's mid node of the loops, with the normal of the true curve."""
    surfaces, nodes, normals, facets = [], [], [], []
    first = 0
    mesh = body.mesh
    jump = (body.plane.kolosov - 1) / (8 * body.plane.shear)
    for loop in loops:
        t = mesh.parameters[loop.name]
        arc = ArcLength(loop.curve)
        nodes.append(mesh.edges[loop.name][2])
        normals.append(loop.curve.normal(t[2]))
        facets.append(arc.length(t[1]) - arc.length(t[0]))
        bend = loop.curve.curvature(t[2])
        constant = np.ptp(bend) <= 1e-9 * np.abs(bend).max()
        surfaces.append(
            Surface(loop.name, arc.length(t[2]), arc.total, first, float(jump * bend[0] * constant))
        )
        first += t.shape[1]
    all_nodes = np.concatenate(nodes)
    rows, columns = np.nonzero(np.isin(mesh.triangles[3:], all_nodes))
    element = np.empty(len(mesh.points), dtype=np.intp)
    element[mesh.triangles[3:][rows, columns]] = columns
    return (
        Stations(all_nodes, np.concatenate(normals), element[all_nodes], np.concatenate(facets)),
        tuple(surfaces),
    )
