"""Singularity subtraction: the finite-element load that is left of a point force once Flamant's field is
taken out.

In a patch D of elements round the loaded point the unknown is u − u_s (inside and on the free boundary),
elsewhere it is u. The right-hand side is −∫ t_s·v over the free boundary of D and over its inner border Γ,
plus K_D applied to u_s on Γ. On a smooth boundary t_s is bounded, so what the mesh has to carry is smooth.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem import flamant
from trochoid.fem.body import EDGES, Body
from trochoid.kinematics.types import Array, IntArray

# Radius of D in local facet lengths. The error that does not vanish with the mesh is 4e-4 of a unit of the
# logarithm (5: 8e-4, 12: 2e-4).
RADIUS = 8.0
_GAUSS = np.polynomial.legendre.leggauss(8)
_X = 0.5 * (_GAUSS[0] + 1)
_SHAPE = np.stack([(1 - _X) * (1 - 2 * _X), _X * (2 * _X - 1), 4 * _X * (1 - _X)])  # start, end, mid; (3, 8)
_SLOPE = np.stack([4 * _X - 3, 4 * _X - 1, 4 - 8 * _X])
_SIDES = np.array(EDGES)


@dataclass(frozen=True, slots=True)
class PointForce:
    """A force per unit thickness on the boundary: point (2,), inward unit normal (2,), force (2,), the
    element and facet length there.
    """

    point: Array
    inward: Array
    force: Array
    element: int
    facet: float


@dataclass(frozen=True, slots=True)
class Patch:
    """Load of one point force: `dofs` and `values` of the right-hand side, and the nodes where u = U + u_s.

    `elements` (e,) of D, and `border` (e, 6, 2): u_s at their nodes on Γ, zero at the others; inside D, u =
    u_s + U − border. `mean` (3,) is the area integral of the rigid motions x, y, rotation times u − U.
    """

    dofs: IntArray
    values: Array
    nodes: IntArray
    elements: IntArray
    border: Array
    mean: Array


def patch_load(body: Body, load: PointForce, radius: float = RADIUS) -> Patch:
    """Return what the finite elements have to carry of `load`."""
    inside = _grow(body, load, radius * load.facet)
    member = np.zeros(len(body.neighbours), dtype=bool)
    member[inside] = True
    across = body.neighbours[inside]
    border = np.where(across >= 0, ~member[across], True)
    which, side = np.nonzero(border)
    sides = body.mesh.triangles[_SIDES[side].T, inside[which]]  # (3, k)
    edges = _edges(body, load, sides)
    dofs, values = _boundary_traction(load, sides, edges)
    gamma = np.unique(sides[:, across[which, side] >= 0])
    nodes = body.mesh.triangles[:, inside]
    on_gamma = np.isin(nodes, gamma)
    singular = np.zeros((*nodes.shape, 2))
    position = body.mesh.points[gamma] - load.point
    if len(gamma):
        at_gamma = flamant.displacement(body.plane, position, load.inward, load.force)
        singular[on_gamma] = at_gamma[np.searchsorted(gamma, nodes[on_gamma])]
    border_values = singular.transpose(1, 0, 2)
    local = np.einsum("eij,ej->ei", body.parts.stiffness[inside], border_values.reshape(-1, 12))
    return Patch(
        np.concatenate([dofs, body.parts.dofs[inside].ravel()]),
        np.concatenate([values, local.ravel()]),
        np.setdiff1d(nodes, gamma),
        inside,
        border_values,
        _area_integral(body, load, edges) - _border_integral(body, inside, border_values),
    )


def _grow(body: Body, load: PointForce, radius: float) -> IntArray:
    """Grow D from the loaded element: near, off the supports, and off the outward normal where the logarithm is cut."""
    turn = complex(load.inward[0], -load.inward[1])
    near = np.array(body.parts.near.query_ball_point(load.point, radius), dtype=np.intp)
    corners = body.mesh.triangles[:, near]
    relative = body.mesh.points[corners] - load.point
    z = (relative[..., 0] + 1j * relative[..., 1]) * turn
    pressed = np.abs(z) < 1e-6 * load.facet  # a corner that is pressed has no angle, and must not lie on Γ
    angle = np.abs(np.angle(np.where(pressed, 1.0, z)))
    allowed = np.zeros(len(body.neighbours), dtype=bool)
    seen = np.all(angle < 0.85 * np.pi, axis=0) | pressed.any(axis=0)
    allowed[near[seen & ~body.held[corners].any(axis=0)]] = True
    allowed[load.element] = True
    inside = np.zeros_like(allowed)
    front = np.array([load.element])
    while len(front):
        inside[front] = True
        reached = body.neighbours[front]
        reached = np.unique(reached[reached >= 0])
        front = reached[allowed[reached] & ~inside[reached]]
    return np.flatnonzero(inside)


@dataclass(frozen=True, slots=True)
class _Edges:
    """Gauss points on the sides of D: `place` (k, q, 2) from the loaded point, `outward` (k, q, 2) normal times arc."""

    place: Array
    outward: Array


def _edges(body: Body, load: PointForce, sides: IntArray) -> _Edges:
    """Return the quadrature on sides (3, k) that run anticlockwise round D."""
    nodes = body.mesh.points[sides] - load.point  # (3, k, 2)
    place = np.einsum("aq,akc->kqc", _SHAPE, nodes)
    along = np.einsum("aq,akc->kqc", _SLOPE, nodes) * (0.5 * _GAUSS[1])[:, None]
    return _Edges(place, np.stack([along[..., 1], -along[..., 0]], axis=-1))


def _boundary_traction(load: PointForce, sides: IntArray, edges: _Edges) -> tuple[IntArray, Array]:
    """Integrate −t_s·v over the sides (3, k)."""
    pull = flamant.traction(edges.place.reshape(-1, 2), edges.outward.reshape(-1, 2), load.force)
    values = -np.einsum("aq,kqc->akc", _SHAPE, pull.reshape(*edges.place.shape))
    dofs = np.stack([2 * sides, 2 * sides + 1], axis=-1)
    return dofs.ravel(), values.ravel()


def _area_integral(body: Body, load: PointForce, edges: _Edges) -> Array:
    """Return ∫_D of the rigid motions times u_s (3,), as integrals over the sides.

    With u_s = L ln r + B(θ), ∫ u_s r dr = r²(u_s − L/2)/2 and ∫ r u_s r dr = r³(u_s − L/3)/3.
    """
    place, outward = edges.place.reshape(-1, 2), edges.outward.reshape(-1, 2)
    flux = np.einsum("ni,ni->n", place, outward)
    u, growth = (
        flamant.displacement(body.plane, place, load.inward, load.force),
        -body.plane.kernel * load.force,
    )
    shift = 0.5 * flux @ (u - growth / 2)
    turn = _cross(place, u - growth / 3) @ flux / 3 + _cross(load.point, shift)
    return np.append(shift, turn)


def _border_integral(body: Body, inside: IntArray, border: Array) -> Array:
    """Return the rigid motions times `border` over D (3,), by the weights that measure every mean."""
    weighted = border * body.parts.areas[inside][:, :, None]
    places = body.mesh.points[body.mesh.triangles[:, inside].T]
    return np.append(weighted.sum(axis=(0, 1)), _cross(places, weighted).sum())


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
