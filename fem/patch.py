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
    u_s + U − border.
    """

    dofs: IntArray
    values: Array
    nodes: IntArray
    elements: IntArray
    border: Array


def patch_load(body: Body, load: PointForce, radius: float = RADIUS) -> Patch:
    """Return what the finite elements have to carry of `load`."""
    inside = _grow(body, load, radius * load.facet)
    member = np.zeros(len(body.neighbours), dtype=bool)
    member[inside] = True
    across = body.neighbours[inside]
    border = np.where(across >= 0, ~member[across], True)
    which, side = np.nonzero(border)
    sides = body.mesh.triangles[_SIDES[side].T, inside[which]]  # (3, k)
    dofs, values = _boundary_traction(body, load, sides)
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
    )


def _grow(body: Body, load: PointForce, radius: float) -> IntArray:
    """Grow D from the loaded element: near, off the supports, and off the outward normal where the logarithm is cut."""
    turn = complex(load.inward[0], -load.inward[1])
    near = np.flatnonzero(np.hypot(*(body.parts.centroids - load.point).T) < radius)
    corners = body.mesh.triangles[:, near]
    relative = body.mesh.points[corners] - load.point
    angle = np.abs(np.angle((relative[..., 0] + 1j * relative[..., 1]) * turn))
    allowed = np.zeros(len(body.neighbours), dtype=bool)
    allowed[near[np.all(angle < 0.85 * np.pi, axis=0) & ~body.held[corners].any(axis=0)]] = True
    allowed[load.element] = True
    inside = np.zeros_like(allowed)
    front = np.array([load.element])
    while len(front):
        inside[front] = True
        reached = body.neighbours[front]
        reached = np.unique(reached[reached >= 0])
        front = reached[allowed[reached] & ~inside[reached]]
    return np.flatnonzero(inside)


def _boundary_traction(body: Body, load: PointForce, sides: IntArray) -> tuple[IntArray, Array]:
    """Integrate −t_s·v over sides (3, k) that run anticlockwise round D."""
    nodes = body.mesh.points[sides]  # (3, k, 2)
    place = np.einsum("aq,akc->kqc", _SHAPE, nodes)
    along = np.einsum("aq,akc->kqc", _SLOPE, nodes)
    outward = np.stack([along[..., 1], -along[..., 0]], axis=-1)  # times the arc element
    pull = flamant.traction((place - load.point).reshape(-1, 2), outward.reshape(-1, 2), load.force)
    weighted = pull.reshape(*place.shape) * (0.5 * _GAUSS[1])[:, None]
    values = -np.einsum("aq,kqc->akc", _SHAPE, weighted)
    dofs = np.stack([2 * sides, 2 * sides + 1], axis=-1)
    return dofs.ravel(), values.ravel()
