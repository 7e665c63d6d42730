"""State of a body under its contacts: a half-plane in closed form near them, finite elements for the rest.

The same split as in the compliance: in a patch round each contact the finite elements carry only what is left
of the half-plane's field, so that a mesh twenty times coarser than the contact still has its stress. The
half-plane is pressed by the strips of a resolved contact, by Hertz's pressure where there are none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from trochoid.fem import flamant
from trochoid.fem.assembly import Touch
from trochoid.fem.body import Body
from trochoid.fem.compliance import solve_patches
from trochoid.fem.elasticity import nodal_stress
from trochoid.fem.hertz import hertz_stress, in_plane, local_position
from trochoid.fem.material import Plane
from trochoid.fem.pair import rotation
from trochoid.fem.patch import Patch, PointForce, patch_load
from trochoid.fem.strip_stress import strip_stress
from trochoid.kinematics.types import Array, IntArray


@dataclass(frozen=True, slots=True)
class Press:
    """A contact that presses a body, and may rub on it.

    Edge name, curve parameter, unit normal n out of the body (2,), line load along −n in N/m, half width in m;
    `tangential` line load along t = (−n_y, n_x) in N/m. A resolved contact has strips at `offset` (m,), arc length
    in m from the parameter and growing with it, with line loads `strips` (m,) and, when it rubs, `sheared` (m,)
    along t; they sum to the loads above. Without `sheared` the tangential load is spread like the pressure.
    """

    edge: str
    parameter: float
    normal: Array
    load: float
    half_width: float
    tangential: float = 0.0
    offset: Array = field(default_factory=lambda: np.zeros(0))
    strips: Array = field(default_factory=lambda: np.zeros(0))
    sheared: Array = field(default_factory=lambda: np.zeros(0))


@dataclass(frozen=True, slots=True)
class State:
    """A body under contacts; the offsets of their strips run along t.

    `moves` (m, 6, 2) and `smooth` (m, 6, 3): what the finite elements carry of displacement and stress. What
    is not in them, the field of each contact in its patch, is added where the state is sampled.
    """

    body: Body
    presses: tuple[Press, ...]
    loads: tuple[PointForce, ...]
    patches: tuple[Patch, ...]
    moves: Array
    smooth: Array


def pressed(touch: Touch, edges: Sequence[str], turn: Array | float, width: float) -> list[Press]:
    """Return what a body feels of one family of contacts, in its own frame.

    `edges` (c,) names of the edges pressed, `turn` angle of the body's frame in rad, `width` of its face in m.
    """
    normals = touch.state.normal @ rotation(turn)
    return [
        Press(
            edges[i],
            float(touch.state.parameter[i]),
            normals[i],
            float(touch.force[i]) / width,
            float(touch.half_width[i]),
            offset=touch.offset[i],
            strips=touch.strips[i] / width,
        )
        for i in np.flatnonzero(touch.force > 0).tolist()
    ]


def solve_state(body: Body, presses: Sequence[Press]) -> State:
    """Solve a body under contacts; what they leave unbalanced is carried by inertia (a free body)."""
    active = tuple(_along_tangent(body, p) for p in presses if p.load > 0)
    loads = tuple(_point_force(body, p) for p in active)
    patches = tuple(patch_load(body, load) for load in loads)
    answer = np.zeros((body.size, 1))
    if active:
        answer = solve_patches(body, patches).sum(axis=1)
    moves = answer.reshape(-1, 2)[body.mesh.triangles.T].copy()
    for patch in patches:
        moves[patch.elements] -= patch.border
    return State(body, active, loads, patches, moves, nodal_stress(body.mesh, body.plane, moves))


def sample(state: State, elements: IntArray, shape: Array) -> tuple[Array, Array, Array]:
    """Return points (k, q, 2), displacement (k, q, 2) and stress (k, q, 3) as xx, yy, xy.

    `elements` (k,) and the values `shape` (k, q, 6) of their basis functions at q places in each.
    """
    mesh = state.body.mesh
    points = shape @ mesh.points[mesh.triangles.T[elements]]
    displacement = shape @ state.moves[elements]
    stress = shape @ state.smooth[elements]
    for press, load, patch in zip(state.presses, state.loads, state.patches, strict=True):
        inside = np.isin(elements, patch.elements)
        places = points[inside].reshape(-1, 2)
        near = points[inside].shape[:2]
        blunt = _flamant_blunted(state.body.plane, places, load, press.half_width)
        displacement[inside] += blunt.reshape(*near, 2)
        stress[inside] += contact_stress(press, load, places).reshape(*near, 3)
    return points, displacement, stress


def contact_stress(press: Press, load: PointForce, points: Array) -> Array:
    """Return the half-plane's stress (n, 3) as xx, yy, xy in Pa at `points` (n, 2) under one contact."""
    place = local_position(points, load.point, load.inward)
    if len(press.strips) == 0:
        local = hertz_stress(place, press.half_width, press.load, press.tangential)
    else:
        sheared = press.sheared if len(press.sheared) else press.tangential / press.load * press.strips
        local = strip_stress(place, press.offset, press.strips, sheared)
    return in_plane(local, load.inward)


def basis(reference: Array) -> Array:
    """Return the six quadratic basis functions (…, 6) at reference coordinates (…, 2), in the mesh's order of nodes."""
    x, y = reference[..., 0], reference[..., 1]
    z = 1 - x - y
    return np.stack(
        [z * (2 * z - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * x * z, 4 * x * y, 4 * y * z], axis=-1
    )


def _point_force(body: Body, press: Press) -> PointForce:
    """Put the load on the facet that holds the parameter, at the place of the quadratic edge."""
    edge, t = body.mesh.edges[press.edge], body.mesh.parameters[press.edge]
    facet, at = _facet(t, press.parameter)
    xi = _along(t[:, facet], at)
    nodes = body.mesh.points[edge[:, facet]]
    shape = np.array([(1 - xi) * (1 - 2 * xi), xi * (2 * xi - 1), 4 * xi * (1 - xi)])
    element = int(np.flatnonzero((body.mesh.triangles[3:] == edge[2, facet]).any(axis=0))[0])
    length = float(np.linalg.norm(nodes[1] - nodes[0]))
    force = press.tangential * _tangent(press) - press.load * press.normal
    return PointForce(shape @ nodes, -press.normal, force, element, length)


def _along_tangent(body: Body, press: Press) -> Press:
    """Return a contact whose strips are counted along t: on the edges of holes the parameter grows against it."""
    edge, t = body.mesh.edges[press.edge], body.mesh.parameters[press.edge]
    start, end = body.mesh.points[edge[:2, _facet(t, press.parameter)[0]]]
    if (end - start) @ _tangent(press) > 0:
        return press
    return replace(press, offset=-press.offset[::-1], strips=press.strips[::-1], sheared=press.sheared[::-1])


def _tangent(press: Press) -> Array:
    return np.array([-press.normal[1], press.normal[0]])


def _facet(t: Array, parameter: float) -> tuple[int, float]:
    """Return the facet, of those with parameters t (3, k), that holds a parameter, and where within the period."""
    at = t[0, 0] + float(np.mod(parameter - t[0, 0], t[1, -1] - t[0, 0]))
    return int(np.clip(np.searchsorted(t[0], at, side="right") - 1, 0, t.shape[1] - 1)), at


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
    """Return Flamant's displacement (n, 2), the distance kept at the contact's mean logarithmic radius a/2 or more."""
    position = points - load.point
    distance = np.hypot(position[:, 0], position[:, 1])
    direction = np.where((distance > 0)[:, None], position, load.inward)
    direction = direction / np.linalg.norm(direction, axis=1)[:, None]
    place = direction * np.maximum(distance, 0.5 * half_width)[:, None]
    return flamant.displacement(plane, place, load.inward, load.force)
