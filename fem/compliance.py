"""Compliance of a body's surfaces: C(x, y) = −2/(πE')·ln|x−y| + S(x, y), with S smooth and tabulated at
stations.

Every facet's mid node is a station: the true profile passes through it and the quadratic boundary is smooth
there. S is splined in arc length, in both arguments, so that a contact may sit anywhere on the profile. On a
curved surface S has a kink at x = y: the point force drags the surface towards itself, by a jump of
(κ−1)/(4G), and the normal turns with the curvature k, which leaves k(κ−1)/(8G)·|x−y|. A spline across the
kink would be ten times worse than the mesh. So S(x, x) has a spline of its own, and on surfaces of constant
curvature the kink is taken out of the table as well.

A body that is pressed tangentially as well has two more tables (see `tangential`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from scipy.sparse import csc_matrix, hstack

from trochoid.fem import flamant
from trochoid.fem.body import Body
from trochoid.fem.condensed import displaced
from trochoid.fem.linear_solver import BLOCK
from trochoid.fem.patch import Patch, PointForce, patch_load
from trochoid.fem.surface import (
    Stations,
    Surface,
    Weights,
    kinks,
    read_diagonal,
    read_table,
    set_diagonal,
    splined,
    surface_weights,
    without_kinks,
)
from trochoid.fem.tangential import Tangential, blocks, drag, tangential_tables, tangents
from trochoid.geometry.outline import Loop
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, frozen

__all__ = [
    "Compliance",
    "Stations",
    "Surface",
    "Weights",
    "place_stations",
    "press",
    "solve_patches",
    "surface_weights",
    "tabulate",
]


@dataclass(frozen=True, slots=True)
class Compliance:
    """Tabulated smooth compliance of a body of unit thickness.

    `table` (k, k) and `diagonal` (k,) hold the spline coefficients of S and of S(x, x) in 1/Pa, `stations`
    (k, k) S itself, `kernel` is 2/(πE'), `asymmetry` the largest difference of S from its transpose over the
    range of S: a measure of the mesh. `tangential` is None unless the body was pressed tangentially too.

    Places and points may have leading axes (a batch of positions).
    """

    surfaces: Mapping[str, Surface]
    table: Array
    diagonal: Array
    stations: Array
    kernel: float
    asymmetry: float
    tangential: Tangential | None = None

    def smooth(self, place: Weights, points: Array) -> Array:
        """Return S (n, n) between points (n, 2) at these places."""
        return self._smooth(place, _distances(points))

    def between(self, place: Weights, points: Array) -> Array:
        """Return the compliance (n, n) between points (n, 2) at these places; on the diagonal S alone,
        without the logarithm.
        """
        distance = _distances(points)
        result = self._smooth(place, distance)
        set_diagonal(distance, 1.0)
        result -= self.kernel * np.log(distance)
        return result

    def coupled(self, place: Weights, points: Array) -> Array:
        """Return the compliance (2n, 2n) between normal forces (first n, along −n) and tangential forces (last
        n, along t, the outward normal n turned by +90°) at points (n, 2); on the diagonals of both parts S alone.

        Raises TrochoidError when the body was not pressed tangentially.
        """
        if self.tangential is None:
            raise TrochoidError(
                "the body was pressed along its normals only; tabulate it with tangential=True"
            )
        distance = _distances(points)
        normal = self.between(place, points)
        mixed, along = blocks(self.tangential, place, distance)
        set_diagonal(distance, 1.0)
        along -= self.kernel * np.log(distance)
        turned = np.swapaxes(mixed, -1, -2)
        upper, lower = np.concatenate([normal, mixed], -1), np.concatenate([turned, along], -1)
        return np.concatenate([upper, lower], axis=-2)

    def _smooth(self, place: Weights, distance: Array) -> Array:
        result = read_table(self.table, place)
        result += kinks(place) * distance
        set_diagonal(result, read_diagonal(self.diagonal, place))
        return result


def _distances(points: Array) -> Array:
    offset = points[..., :, None, :] - points[..., None, :, :]
    distances: Array = np.hypot(offset[..., 0], offset[..., 1])
    return distances


def tabulate(
    body: Body, stations: Stations, surfaces: tuple[Surface, ...], tangential: bool = False
) -> Compliance:
    """Press the body at every station along its normal and tabulate S between all of them; with `tangential`
    press it along its tangent as well.
    """
    inward, along = -stations.normals, tangents(stations.normals)
    points, further = body.mesh.points[stations.nodes], None
    raw, *rest = _pressed(body, stations, inward, (inward, along) if tangential else (inward,))
    if tangential:
        mixed, own = _pressed(body, stations, along, (inward, along))
        further = tangential_tables(body.plane, surfaces, points, mixed, rest[0], own)
    s = 0.5 * (raw + raw.T)
    table, diagonal = splined(without_kinks(s, surfaces, points), s, surfaces)
    named = MappingProxyType({x.name: x for x in surfaces})
    lopsided = float(np.abs(raw - raw.T).max() / np.ptp(s))
    return Compliance(named, frozen(table), frozen(diagonal), frozen(s), body.plane.kernel, lopsided, further)


def _pressed(body: Body, stations: Stations, force: Array, measured: Sequence[Array]) -> tuple[Array, ...]:
    """Return for each direction `measured` (k, 2) the displacement (k, k) along it at all stations under unit
    forces (k, 2), without the logarithm where both directions are the same.
    """
    count = len(stations.nodes)
    raw = tuple(np.zeros((count, count), order="F") for _ in measured)
    loads, means = [], []
    for start in range(0, count, BLOCK):
        patches = []
        for i in range(start, min(start + BLOCK, count)):
            load = _point_force(body, stations, i, force[i])
            patches.append(patch_load(body, load))
            for whole, direction in zip(raw, measured, strict=True):
                _add_singular(body, load, patches[-1], stations, whole[:, i], direction, direction is force)
        loads.append(_loads(body, patches))
        means.append(_means(patches))
    answers = _read(body, stations, measured, hstack(loads, format="csc"), np.hstack(means))
    for whole, answer in zip(raw, answers, strict=True):
        whole += answer
    return raw


def _point_force(body: Body, stations: Stations, i: int, force: Array) -> PointForce:
    point, normal = body.mesh.points[stations.nodes[i]], stations.normals[i]
    return PointForce(point, -normal, force, int(stations.elements[i]), float(stations.facets[i]))


def _read(
    body: Body, stations: Stations, measured: Sequence[Array], loads: csc_matrix, means: Array
) -> list[Array]:
    """Return the finite elements' displacement (k, k) at all stations along each direction."""
    dofs = np.stack([2 * stations.nodes, 2 * stations.nodes + 1])
    columns = np.broadcast_to(np.arange(dofs.shape[1]), dofs.shape)
    seen = [
        csc_matrix((d.T.ravel(), (dofs.ravel(), columns.ravel())), shape=(body.size, dofs.shape[1]))
        for d in measured
    ]
    return displaced(body, seen, loads, means)


def _add_singular(
    body: Body,
    load: PointForce,
    patch: Patch,
    stations: Stations,
    column: Array,
    direction: Array,
    same: bool,
) -> None:
    """Add u_s where the station lies in D, and take the logarithm out everywhere when the directions are the same.

    At the loaded station itself u_s then has nothing left: across it the other direction jumps by equal amounts.
    """
    offset = body.mesh.points[stations.nodes] - load.point
    distance = np.hypot(offset[:, 0], offset[:, 1])
    elsewhere = distance > 0
    if same:
        column[elsewhere] += body.plane.kernel * np.log(distance[elsewhere])
    near = np.isin(stations.nodes, patch.nodes) & elsewhere
    singular = flamant.displacement(body.plane, offset[near], load.inward, load.force)
    column[near] += np.einsum("ki,ki->k", direction[near], singular)


def solve_patches(body: Body, patches: Sequence[Patch]) -> Array:
    """Solve for the finite-element part (2n, k) of point forces; a free body is balanced by inertia relief
    and its mean motion removed.
    """
    rhs = _loads(body, patches).toarray(order="F")
    if body.relief is None:
        return body.solve(rhs)
    r = body.relief
    total = np.linalg.solve(r.gram, r.modes.T @ rhs)
    answer = body.solve(rhs - r.weighted @ total)
    mean = r.weighted.T @ answer + _means(patches)
    return np.asarray(answer - r.modes @ np.linalg.solve(r.gram, mean))


def _loads(body: Body, patches: Sequence[Patch]) -> csc_matrix:
    """Return the finite elements' loads (2n, k)."""
    columns = np.repeat(np.arange(len(patches)), [len(patch.dofs) for patch in patches])
    rows, values = np.concatenate([p.dofs for p in patches]), np.concatenate([p.values for p in patches])
    return csc_matrix((values, (rows, columns)), shape=(body.size, len(patches)))


def _means(patches: Sequence[Patch]) -> Array:
    return np.stack([patch.mean for patch in patches], axis=-1)


def press(body: Body, loops: Sequence[Loop], tangential: bool = False) -> Compliance:
    """Make every facet of the loops a station and tabulate S between all of them; see `tabulate`."""
    stations, surfaces = place_stations(body, loops)
    return tabulate(body, stations, surfaces, tangential)


def place_stations(body: Body, loops: Sequence[Loop]) -> tuple[Stations, tuple[Surface, ...]]:
    """Return a station at every facet's mid node of the loops, with the normal of the true curve."""
    surfaces, nodes, normals, facets = [], [], [], []
    first = 0
    mesh = body.mesh
    jump = drag(body.plane)
    for loop in loops:
        t = mesh.parameters[loop.name]
        arc = ArcLength(loop.curve)
        nodes.append(mesh.edges[loop.name][2])
        normals.append(loop.curve.normal(t[2]))
        facets.append(arc.length(t[1]) - arc.length(t[0]))
        bend = loop.curve.curvature(t[2])
        constant = np.ptp(bend) <= 1e-9 * np.abs(bend).max()
        sense = float(np.sign(np.sum(tangents(normals[-1][:1]) * loop.curve.tangent(t[2][:1]))))
        round_bend = float(bend[0] * constant)
        kink = float(jump * bend[0] * constant)
        surfaces.append(Surface(loop.name, arc.length(t[2]), arc.total, first, kink, sense, round_bend))
        first += t.shape[1]
    all_nodes = np.concatenate(nodes)
    rows, columns = np.nonzero(np.isin(mesh.triangles[3:], all_nodes))
    element = np.empty(len(mesh.points), dtype=np.intp)
    element[mesh.triangles[3:][rows, columns]] = columns
    return (
        Stations(all_nodes, np.concatenate(normals), element[all_nodes], np.concatenate(facets)),
        tuple(surfaces),
    )
