"""One position solved by finite elements alone, the contacts' widths resolved: an oracle, slow, for tests.

Each contact has facets far narrower than itself, each with a constant pressure on each slice, along the true normal;
the rollers are rigid.  Gaps are those of the exact curves at the nominal pose, and the rim's motion closes them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, hstack

from trochoid.fem import complementarity as lcp
from trochoid.fem.cone_body import ConeBody, factored, product, read
from trochoid.fem.cone_flank import Flank
from trochoid.fem.cone_layers import integrals
from trochoid.fem.cone_sector import covered
from trochoid.kinematics.spherical import angle_between
from trochoid.kinematics.types import Array, IntArray

_GAUSS = np.polynomial.legendre.leggauss(4)


@dataclass(frozen=True, eq=False, slots=True)
class Resolved:
    """Forces (C, f, s) in N on facets and slices, `pressure` (C, f, s) in Pa, `motion` (k,), `dofs` of the mesh."""

    force: Array
    pressure: Array
    motion: Array
    dofs: int

    @property
    def line(self) -> Array:
        """Force (C, s) of each contact's slices, N."""
        return np.asarray(self.force.sum(axis=1))


@dataclass(frozen=True, eq=False, slots=True)
class Window:
    """A contact that is resolved: numbers of its `facets` on the side, the roller's `axis` (3,) and half `angle`."""

    facets: IntArray
    axis: Array
    angle: float


def resolve(
    body: ConeBody,
    side: Flank,
    windows: tuple[Window, ...],
    moves: Array,
    load: Array,
    reach: tuple[float, float] | None = None,
    relief: Array | float = 0.0,
    solver: str | None = None,
) -> Resolved:
    """Solve the contact of all windows under `load` (k,) on the motions; `relief` (C, s) in m widens the gaps."""
    slices = covered(body, reach)
    breaks = body.radial.breaks
    middle, length = 0.5 * (breaks[slices] + breaks[slices + 1]), np.diff(breaks)[slices]
    parts = [_facets(side, w) for w in windows]
    plane = hstack([p[0] for p in parts], format="csc")
    depth = integrals(body.radial)[:, slices]
    force = product(plane, depth / depth.sum(axis=0))
    inner = np.flatnonzero(~body.held)
    own, _ = read(factored(body, ~body.held, solver), force[inner], csc_matrix((len(inner), 0)))
    point, normal = (np.concatenate([p[i] for p in parts]) for i in (1, 2))
    lever = middle[:, None] * np.cross(point, normal)[:, None, :]
    arms = np.concatenate([lever, np.broadcast_to(normal[:, None, :], lever.shape)], axis=-1) @ moves
    axis = np.concatenate([np.broadcast_to(w.axis, (len(w.facets), 3)) for w in windows])
    angle = np.concatenate([np.full(len(w.facets), w.angle) for w in windows])
    given = np.broadcast_to(np.asarray(relief, dtype=np.float64), (len(windows), len(slices)))
    gap = (angle_between(point, axis) - angle)[:, None] * middle
    gap = gap + np.concatenate(
        [np.broadcast_to(g, (len(w.facets), len(slices))) for g, w in zip(given, windows, strict=True)]
    )
    count = gap.size
    group = lcp.Group(own[None], gap.reshape(1, -1), arms.reshape(1, count, -1))
    k = len(load)
    found = lcp.solve(lcp.Problem((group,), np.zeros((1, 1)), np.zeros((k, k)), np.asarray(load)))
    forces = found.forces[0].reshape(len(windows), -1, len(slices))
    width = np.concatenate([p[3] for p in parts]).reshape(len(windows), -1, 1)
    return Resolved(forces, forces / (width * middle * length), found.motion, int((~body.held).sum()))


def _facets(side: Flank, window: Window) -> tuple[csc_matrix, Array, Array, Array]:
    """Return unit loads (3n, f) of facets, and their mean points, normals (f, 3) and widths (f,), rad."""
    columns, points, normals = [], [], []
    x, weight = 0.5 * (_GAUSS[0] + 1.0), 0.5 * _GAUSS[1]
    shape = np.stack([(1 - x) * (1 - 2 * x), x * (2 * x - 1), 4 * x * (1 - x)])
    for facet in window.facets:
        t = side.parameters[:, facet] @ shape
        normal = side.curve.normal(t)
        values = -np.einsum("aq,q,qc->ac", shape, weight, normal)
        rows = (3 * side.edge[:, facet][:, None] + np.arange(3)).ravel()
        columns.append(
            csc_matrix((values.ravel(), (rows, np.zeros(9, dtype=int))), shape=(3 * side.nodes, 1))
        )
        points.append(side.curve.point(side.parameters[2, facet]))
        normals.append(side.curve.normal(side.parameters[2, facet]))
    widths = np.diff(side.ends)[window.facets]
    return hstack(columns, format="csc"), np.array(points), np.array(normals), widths
