"""Displacement and stress of a body under its contacts: Hertz in closed form near them, finite elements for
the rest.

The same split as in the compliance: in a patch round each contact the finite elements carry only what is left
of the half-plane's field, so that a mesh that is twenty times coarser than the contact still shows its
stress.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.fem import flamant
from trochoid.fem.body import Body
from trochoid.fem.compliance import solve_patches
from trochoid.fem.elasticity import nodal_stress
from trochoid.fem.material import Plane
from trochoid.fem.patch import Patch, PointForce, patch_load
from trochoid.kinematics.types import Array, frozen

DEPTHS = np.linspace(0.0, 2.0, 81)  # half-widths below a contact, where its largest stress is sought


@dataclass(frozen=True, slots=True)
class Press:
    """A contact that presses a body: edge name, curve parameter, unit normal out of the body (2,), line load
    N/m, half width m.
    """

    edge: str
    parameter: float
    normal: Array
    load: float
    half_width: float


@dataclass(frozen=True, slots=True)
class StressField:
    """`displacement` (n, 2) m; `stress` (n, 4) xx, yy, zz, xy Pa; `von_mises` (n,) Pa; its `largest`, also
    below contacts, and where (2,).
    """

    displacement: Array
    stress: Array
    von_mises: Array
    largest: float
    place: Array


def hertz_stress(plane_position: Array, half_width: float, load: float) -> Array:
    """Return the stress (n, 3) σx, σz, τxz in Pa under a Hertz line contact at (n, 2) positions x along the
    surface, z into the body.

    McEwen; Johnson, Contact Mechanics (4.49).

    """
    x, z = plane_position[:, 0], plane_position[:, 1]
    a = half_width
    inner = a**2 - x**2 + z**2
    root = np.sqrt(inner**2 + 4 * x**2 * z**2)
    m2, n2 = np.maximum(0.5 * (root + inner), 1e-300), np.maximum(0.5 * (root - inner), 0.0)
    m, n = np.sqrt(m2), np.sign(x) * np.sqrt(n2)
    peak = 2 * load / (np.pi * a)
    share = (z**2 + n2) / (m2 + n2)
    return (
        -peak / a * np.stack([m * (1 + share) - 2 * z, m * (1 - share), n * (m2 - z**2) / (m2 + n2)], axis=-1)
    )


def von_mises(stress: Array, plane: Plane) -> Array:
    """Return the equivalent stress (…,) of xx, yy, xy (…, 3)."""
    x, y, shear = np.moveaxis(stress, -1, 0)
    out = plane.out_of_plane * plane.poissons_ratio * (x + y)
    return np.asarray(np.sqrt(0.5 * ((x - y) ** 2 + (y - out) ** 2 + (out - x) ** 2) + 3 * shear**2))


def stress_field(body: Body, presses: Sequence[Press]) -> StressField:
    """Return the state of a body under contacts; what they leave unbalanced is carried by inertia (a free body)."""
    active = [p for p in presses if p.load > 0]
    loads = [_point_force(body, p) for p in active]
    patches = [patch_load(body, load) for load in loads]
    mesh = body.mesh
    answer = solve_patches(body, loads, patches).sum(axis=1).reshape(-1, 2)
    moves = answer[mesh.triangles.T].copy()
    displacement = answer.copy()
    for press, load, patch in zip(active, loads, patches, strict=True):
        moves[patch.elements] -= patch.border
        displacement[patch.nodes] += _flamant_blunted(
            body.plane, mesh.points[patch.nodes], load, press.half_width
        )
    stress = nodal_stress(mesh, body.plane, moves)
    smooth = stress.copy()
    for press, load, patch in zip(active, loads, patches, strict=True):
        places = mesh.points[mesh.triangles.T[patch.elements]]
        stress[patch.elements] += _closed_form(places.reshape(-1, 2), press, load).reshape(
            *places.shape[:2], 3
        )
    nodal = _averaged(body, stress)
    equivalent = von_mises(nodal, body.plane)
    largest, place = float(equivalent.max()), mesh.points[int(np.argmax(equivalent))]
    for number in range(len(active)):
        peak, where = _below(body, number, active, loads, patches, smooth)
        if peak > largest:
            largest, place = peak, where
    out = body.plane.out_of_plane * body.plane.poissons_ratio * (nodal[:, 0] + nodal[:, 1])
    full = np.column_stack([nodal[:, 0], nodal[:, 1], out, nodal[:, 2]])
    return StressField(frozen(displacement), frozen(full), frozen(equivalent), largest, frozen(place))


def _point_force(body: Body, press: Press) -> PointForce:
    """Put the load on the facet that holds the parameter, at the place of the quadratic edge."""
    edge, t = body.mesh.edges[press.edge], body.mesh.parameters[press.edge]
    period = t[1, -1] - t[0, 0]
    at = t[0, 0] + np.mod(press.parameter - t[0, 0], period)
    facet = int(np.clip(np.searchsorted(t[0], at, side="right") - 1, 0, t.shape[1] - 1))
    xi = _along(t[:, facet], at)
    nodes = body.mesh.points[edge[:, facet]]
    shape = np.array([(1 - xi) * (1 - 2 * xi), xi * (2 * xi - 1), 4 * xi * (1 - xi)])
    element = int(np.flatnonzero((body.mesh.triangles[3:] == edge[2, facet]).any(axis=0))[0])
    length = float(np.linalg.norm(nodes[1] - nodes[0]))
    return PointForce(shape @ nodes, -press.normal, -press.normal * press.load, element, length)


def _along(t: Array, at: float) -> float:
    """Return ξ in 0…1 with the quadratic t(ξ) = `at`, by Newton."""
    start, end, mid = t
    xi = (at - start) / (end - start)
    for _ in range(6):
        value = (1 - xi) * (1 - 2 * xi) * start + xi * (2 * xi - 1) * end + 4 * xi * (1 - xi) * mid
        slope = (4 * xi - 3) * start + (4 * xi - 1) * end + (4 - 8 * xi) * mid
        xi -= (value - at) / slope
    return float(np.clip(xi, 0.0, 1.0))


def _flamant_blunted(plane: Plane, points: Array, load: PointForce, half_width: float) -> Array:
    """Return Flamant's displacement, with the distance kept at the mean logarithmic radius a/2 of the
    contact or more.
    """
    position = points - load.point
    distance = np.hypot(position[:, 0], position[:, 1])
    least = 0.5 * half_width
    direction = np.where((distance > 0)[:, None], position, load.inward)
    direction = direction / np.linalg.norm(direction, axis=1)[:, None]
    return flamant.displacement(
        plane, direction * np.maximum(distance, least)[:, None], load.inward, load.force
    )


def _closed_form(points: Array, press: Press, load: PointForce) -> Array:
    """Return Hertz's stress (n, 3) as xx, yy, xy in the body's axes."""
    inward = load.inward
    along = np.array([inward[1], -inward[0]])
    position = points - load.point
    local = np.stack([position @ along, np.maximum(position @ inward, 0.0)], axis=-1)
    sx, sz, shear = hertz_stress(local, press.half_width, press.load).T
    tensor = (
        sx[:, None, None] * np.outer(along, along)
        + sz[:, None, None] * np.outer(inward, inward)
        + shear[:, None, None] * (np.outer(along, inward) + np.outer(inward, along))
    )
    return np.stack([tensor[:, 0, 0], tensor[:, 1, 1], tensor[:, 0, 1]], axis=-1)


def _averaged(body: Body, stress: Array) -> Array:
    """Average the elements' stresses at each node."""
    nodes = body.mesh.triangles.T
    total = np.zeros((len(body.mesh.points), 3))
    np.add.at(total, nodes, stress)
    return total / np.bincount(nodes.ravel(), minlength=len(total))[:, None]


def _below(
    body: Body,
    number: int,
    presses: Sequence[Press],
    loads: Sequence[PointForce],
    patches: Sequence[Patch],
    smooth: Array,
) -> tuple[float, Array]:
    """Return the largest equivalent stress on the normal under one contact, and its place."""
    load, press = loads[number], presses[number]
    nodes = body.mesh.triangles[:, load.element]
    nearest = int(np.argmin(np.linalg.norm(body.mesh.points[nodes] - load.point, axis=1)))
    background = smooth[load.element, nearest].copy()
    for other, (p, q) in enumerate(zip(presses, loads, strict=True)):
        if other != number and load.element in patches[other].elements:
            background += _closed_form(load.point[None], p, q)[0]
    places = load.point + DEPTHS[:, None] * press.half_width * load.inward
    values = von_mises(background + _closed_form(places, press, load), body.plane)
    deepest = int(np.argmax(values))
    return float(values[deepest]), places[deepest]
