"""An elastic body of rays between two spheres: its stiffness, what holds it, and its factor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, kron

from trochoid.fem.cone_layers import Layers
from trochoid.fem.cone_stiffness import cone_stiffness
from trochoid.fem.linear_solver import Solve, factorise, installed
from trochoid.fem.material import Material
from trochoid.geometry.sphere_mesh import SphereMesh
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, BoolArray, IntArray

AT_ONCE = 256  # columns solved together: what bounds the memory


@dataclass(frozen=True, eq=False, slots=True)
class ConeBody:
    """A body before it is factored: `stiffness` in N/m, and what is `held` (3n·layer nodes,)."""

    mesh: SphereMesh
    radial: Layers
    material: Material
    stiffness: csc_matrix
    held: BoolArray

    @property
    def size(self) -> int:
        """Number of degrees of freedom, held ones too."""
        return int(self.stiffness.shape[0])

    def dofs(self, nodes: IntArray) -> IntArray:
        """Return the degrees of freedom (k, 3, layer nodes) of nodes (k,) of the plane mesh."""
        count = self.radial.count
        return np.asarray((3 * nodes[:, None, None] + np.arange(3)[:, None]) * count + np.arange(count))


def cone_body(
    mesh: SphereMesh,
    radial: Layers,
    material: Material,
    held: tuple[str, ...] = ("hub",),
    web: tuple[float, float] | None = None,
) -> ConeBody:
    """Assemble a body that is held along the sides named, where `web` says at what distances (m) from the centre.

    Raises TrochoidError when there is no such side, or nothing in reach of the web.
    """
    fixed = np.zeros((len(mesh.points), 3, radial.count), dtype=bool)
    rho = radial.nodes
    low, high = (rho[0], rho[-1]) if web is None else web
    inside = (rho >= low - 1e-9 * rho[-1]) & (rho <= high + 1e-9 * rho[-1])
    if not held or inside.sum() < 2:
        raise TrochoidError(
            f"a body of rays must be held on a side between two distances; given are {list(held)} and "
            f"{low:g} to {high:g} m of {rho[0]:g} to {rho[-1]:g} m"
        )
    for name in held:
        if name not in mesh.edges:
            raise TrochoidError(f'no side "{name}" to hold; the mesh has {", ".join(mesh.edges)}')
        fixed[np.ix_(np.unique(mesh.edges[name]), np.arange(3), inside)] = True
    return ConeBody(mesh, radial, material, cone_stiffness(mesh, radial, material), fixed.ravel())


def factored(body: ConeBody, free: BoolArray, solver: str | None = None) -> Solve:
    """Factor the stiffness of the degrees of freedom `free`; the function solves for columns (free, k).

    PARDISO, where installed, takes a fifth of CHOLMOD's time for these bodies.
    """
    if solver is None and "pardiso" in installed():
        solver = "pardiso"
    index = np.flatnonzero(free)
    return factorise(csc_matrix(body.stiffness[index][:, index]), solver)


def product(plane: csc_matrix, radial: Array) -> csc_matrix:
    """Return loads (3n·layer nodes, k·s): plane ones (3n, k) times radial ones (layer nodes, s), the latter inner."""
    return kron(plane, csc_matrix(radial), format="csc")


def read(solve: Solve, loads: csc_matrix, watched: csc_matrix) -> tuple[Array, Array]:
    """Return loadsᵀ K⁻¹ loads (k, k) and watchedᵀ K⁻¹ loads (w, k), in blocks of columns."""
    own = np.empty((loads.shape[1],) * 2)
    seen = np.empty((watched.shape[1], loads.shape[1]))
    rows, others = loads.T.tocsr(), watched.T.tocsr()
    for start in range(0, loads.shape[1], AT_ONCE):
        chosen = slice(start, start + AT_ONCE)
        moved = solve(loads[:, chosen].toarray(order="F"))
        own[:, chosen], seen[:, chosen] = rows @ moved, others @ moved
    return 0.5 * (own + own.T), seen
