"""An elastic body: mesh, moduli and the factor of its stiffness. Built once; every position of a drive
reuses it.

A body that is held has `supports`. A free body (a disc between its contacts) is held at three degrees of
freedom only to make the matrix regular; every load is first balanced by a rigid-body acceleration field
(inertia relief), so that these three carry nothing, and displacements are measured from the body's mean
motion. The compliance is then symmetric and does not know where the body was held.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.elasticity import Elements, assemble, elements
from trochoid.fem.linear_solver import Solve, factorise
from trochoid.fem.material import Plane
from trochoid.geometry.mesh import Mesh
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, BoolArray, IntArray

EDGES = ((0, 1, 3), (1, 2, 4), (2, 0, 5))  # corner, corner, mid node of each side of a triangle


@dataclass(frozen=True, slots=True)
class Body:
    """A factored plane body of unit thickness.

    `neighbours` (m, 3) element across each side, −1 on the boundary; `held` (n,) nodes of the supports, which D
    must stay off; `solve` takes and gives (2n, k); `relief` is None for a held body. `fixed` (2n,) are the degrees
    of freedom that `solve` leaves at zero, `solver` what factored it (None: the fastest).
    """

    mesh: Mesh
    plane: Plane
    parts: Elements
    neighbours: IntArray
    held: BoolArray
    solve: Solve
    relief: Relief | None
    fixed: BoolArray
    solver: str | None = None

    @property
    def size(self) -> int:
        """Number of degrees of freedom."""
        return 2 * len(self.mesh.points)


@dataclass(frozen=True, slots=True)
class Relief:
    """What balances a load on a free body.

    `modes` (2n, 3) rigid motions x, y, rotation about the origin; `weighted` = W·modes, the accelerations'
    nodal loads, and what a motion's mean is measured with; `gram` = modesᵀ W modes.
    """

    modes: Array
    weighted: Array
    gram: Array


def rigid_modes(points: Array) -> Array:
    """Return the rigid motions x, y and rotation about the origin as columns (2n, 3)."""
    modes = np.zeros((2 * len(points), 3))
    modes[0::2, 0] = 1
    modes[1::2, 1] = 1
    modes[0::2, 2] = -points[:, 1]
    modes[1::2, 2] = points[:, 0]
    return modes


def build_body(mesh: Mesh, plane: Plane, supports: tuple[str, ...] = (), solver: str | None = None) -> Body:
    """Assemble and factor a body; `supports` names the edges that are held, none leaves it free.

    Raises TrochoidError when a named edge does not exist.
    """
    return body_of(mesh, plane, elements(mesh, plane), supports, solver)


def body_of(
    mesh: Mesh, plane: Plane, parts: Elements, supports: tuple[str, ...] = (), solver: str | None = None
) -> Body:
    """Return the body of given elements; `plane` are the moduli where it is pressed. See `build_body`."""
    n = len(mesh.points)
    held = np.zeros(n, dtype=bool)
    for name in supports:
        if name not in mesh.edges:
            raise TrochoidError(f'no edge "{name}" to hold; the mesh has {", ".join(mesh.edges)}')
        held[mesh.edges[name].ravel()] = True
    fixed = np.repeat(held, 2) if supports else _three_points(mesh)
    solve = _reduced(parts, fixed, solver)
    relief = None if supports else _relief(mesh, parts)
    return Body(mesh, plane, parts, _neighbours(mesh), held, solve, relief, fixed, solver)


def _three_points(mesh: Mesh) -> BoolArray:
    """Mark three degrees of freedom at two inner nodes as held; they carry no force."""
    boundary = np.unique(np.concatenate([edge.ravel() for edge in mesh.edges.values()]))
    corners = np.setdiff1d(np.unique(mesh.triangles[:3]), boundary)
    if len(corners) < 2:
        raise TrochoidError("the mesh has fewer than two inner nodes: use more facets")
    clearance = np.min(
        np.linalg.norm(
            mesh.points[corners][:, None] - mesh.points[boundary[:: max(1, len(boundary) // 500)]][None],
            axis=-1,
        ),
        axis=1,
    )
    first = corners[np.argmax(clearance)]
    apart = np.linalg.norm(mesh.points[corners] - mesh.points[first], axis=1)
    second = corners[np.argmax(np.minimum(clearance / clearance.max(), apart / apart.max()))]
    across = np.abs(mesh.points[second] - mesh.points[first])
    fixed = np.zeros(2 * len(mesh.points), dtype=bool)
    fixed[[2 * first, 2 * first + 1, 2 * second + int(across[0] > across[1])]] = True
    return fixed


def _reduced(parts: Elements, fixed: BoolArray, solver: str | None) -> Solve:
    free = np.flatnonzero(~fixed)
    inner = factorise(assemble(parts, len(fixed))[free][:, free], solver)

    def solve(columns: Array) -> Array:
        result = np.zeros_like(columns)
        result[free] = inner(columns[free])
        return result

    return solve


def _relief(mesh: Mesh, parts: Elements) -> Relief:
    modes = rigid_modes(mesh.points)
    weighted = modes * np.repeat(parts.weight, 2)[:, None]
    return Relief(modes, weighted, modes.T @ weighted)


def _neighbours(mesh: Mesh) -> IntArray:
    mids = mesh.triangles[3:].T.ravel()
    order = np.argsort(mids, kind="stable")
    same = np.flatnonzero(mids[order][1:] == mids[order][:-1])
    left, right = order[same], order[same + 1]
    neighbours = np.full(len(mids), -1, dtype=np.intp)
    neighbours[left], neighbours[right] = right // 3, left // 3
    return neighbours.reshape(-1, 3)
