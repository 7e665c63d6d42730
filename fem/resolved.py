"""The oracle: compliance of a body by pressing its finite elements directly, on a mesh that resolves the contacts.

Nothing of the engine's splitting is used: no logarithm taken out, no table, no Hertz law. A facet of the mesh
carries a constant pressure along the normal of the true curve, and what it measures is the mean of the same
displacement over the facet, so that C = GᵀK⁻¹G is symmetric. One constant per quadratic facet is stable.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csc_matrix, hstack

from trochoid.fem.body import Body, build_body
from trochoid.fem.material import Plane
from trochoid.geometry.mesh import Mesh, mesh_outline
from trochoid.geometry.outline import Loop, Outline
from trochoid.geometry.refined import Window, refine
from trochoid.kinematics.curve import ArcLength, Circle
from trochoid.kinematics.types import Array, IntArray

COLUMNS = 32  # solved at once: a mesh that resolves contacts is large, and its columns need memory
_GAUSS = np.polynomial.legendre.leggauss(4)
_X = 0.5 * (_GAUSS[0] + 1)
_SHAPE = np.stack([(1 - _X) * (1 - 2 * _X), _X * (2 * _X - 1), 4 * _X * (1 - _X)])  # start, end, mid; (3, 4)
_SLOPE = np.stack([4 * _X - 3, 4 * _X - 1, 4 - 8 * _X])


@dataclass(frozen=True, slots=True)
class Facets:
    """Facets of one window as pressure unknowns.

    `parameters` (m, q) on the curve and `weights` (m, q) of the points by which a mean over a facet is taken,
    `offset` (m,) arc length of the facets' middles from the window's, `length` (m,), both in m, `loads` (2n, m):
    a unit force, spread evenly over each facet along the inward normal.
    """

    parameters: Array
    weights: Array
    offset: Array
    length: Array
    loads: csc_matrix

    @property
    def middle(self) -> Array:
        """Curve parameters (m,) of the facets' middles."""
        return np.asarray((self.parameters * self.weights).sum(axis=1))


@dataclass(frozen=True, slots=True)
class RefinedBody:
    """A body on a refined mesh, and the facets of its windows by loop."""

    body: Body
    facets: Mapping[str, tuple[Facets, ...]]


def refined_body(
    outline: Outline,
    windows: Mapping[str, Sequence[Window]],
    plane: Plane,
    supports: tuple[str, ...] = (),
) -> RefinedBody:
    """Mesh an outline with these windows on its loops and factor it; no supports leave the body free.

    Raises TrochoidError, Infeasible where windows overlap.
    """
    refined = {loop.name: refine(loop, windows.get(loop.name, ())) for loop in outline.loops}
    loops = [refined[loop.name][0] for loop in outline.loops]
    body = build_body(mesh_outline(Outline(loops[0], tuple(loops[1:]))), plane, supports)
    facets = {
        loop.name: tuple(_facets(body.mesh, loop, numbers) for numbers in refined[loop.name][1])
        for loop in loops
    }
    return RefinedBody(body, facets)


def _facets(mesh: Mesh, loop: Loop, numbers: IntArray) -> Facets:
    edge, ends = mesh.edges[loop.name][:, numbers], mesh.parameters[loop.name][:, numbers]
    t = np.einsum("aq,ak->kq", _SHAPE, ends)
    along = np.linalg.norm(np.einsum("aq,akc->kqc", _SLOPE, mesh.points[edge]), axis=-1) * 0.5 * _GAUSS[1]
    length = along.sum(axis=1)
    weights = along / length[:, None]
    push = -np.einsum("aq,kq,kqc->akc", _SHAPE, weights, loop.curve.normal(t))  # (3, k, 2)
    dofs = np.stack([2 * edge, 2 * edge + 1], axis=-1)
    columns = np.broadcast_to(np.arange(len(numbers))[None, :, None], dofs.shape)
    shape = (2 * len(mesh.points), len(numbers))
    loads = csc_matrix((push.ravel(), (dofs.ravel(), columns.ravel())), shape=shape)
    s = ArcLength(loop.curve).length(ends)
    offset = 0.5 * (s[0] + s[1]) - 0.5 * (s[0, 0] + s[1, -1])
    return Facets(t, weights, offset, s[1] - s[0], loads)


def direct_compliance(body: Body, loads: csc_matrix) -> Array:
    """Return C (k, k) in 1/Pa of a body under loads (2n, k): displacement along one per unit line load on another.

    A free body is balanced by inertia relief, and displacements count from its mean motion.
    """
    result = np.empty((loads.shape[1],) * 2)
    for start in range(0, loads.shape[1], COLUMNS):
        chosen = slice(start, start + COLUMNS)
        result[:, chosen] = loads.T @ _displaced(body, loads[:, chosen].toarray())
    return 0.5 * (result + result.T)


def _displaced(body: Body, right: Array) -> Array:
    if body.relief is None:
        return body.solve(right)
    r = body.relief
    answer = body.solve(right - r.weighted @ np.linalg.solve(r.gram, r.modes.T @ right))
    return np.asarray(answer - r.modes @ np.linalg.solve(r.gram, r.weighted.T @ answer))


def round_partner(plane: Plane, radius: float, length: float, facets: int, around: int = 64) -> Array:
    """Return C (m, m) in 1/Pa of a cylinder that is held on its far side by the mirror image of its contact.

    m = `facets` of `length` m round the place that is pressed, in the cylinder's anticlockwise order. The
    plane between both contacts stays plane: half a cylinder (Johnson, Contact Mechanics, 5.57). The whole one
    is meshed, with `around` ordinary facets, and pressed on both sides.
    """
    loop = Loop("rim", Circle((0.0, 0.0), radius), around)
    windows = [Window(0.0, length, facets), Window(np.pi, length, facets)]
    made = refined_body(Outline(loop), {"rim": windows}, plane)
    near, far = made.facets["rim"]
    return 0.5 * direct_compliance(made.body, near.loads + far.loads[:, ::-1])


def mirrored(partner: Array) -> Array:
    """Return a partner's compliance in the order of the facets it faces, when both bodies are convex.

    Seen from a hole the order is the same, and nothing is to be done.
    """
    return partner[::-1, ::-1]


def spread(facets: Facets, shares: Array) -> Facets:
    """Return all facets of a window as one unknown that loads them by `shares` (m,) of its force."""
    weights = (shares[:, None] * facets.weights).reshape(1, -1)
    loads = csc_matrix(facets.loads @ csc_matrix(shares[:, None]))
    return replace(
        facets,
        parameters=facets.parameters.reshape(1, -1),
        weights=weights,
        offset=np.zeros(1),
        length=np.array([facets.length.sum()]),
        loads=loads,
    )


def all_loads(facets: Sequence[Facets]) -> csc_matrix:
    """Return the loads of several windows side by side."""
    return hstack([f.loads for f in facets], format="csc")
