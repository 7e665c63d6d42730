"""Elasticity of solid bodies on quadratic tetrahedra and bricks: stiffness, mass, rigid-body properties.

scikit-fem supplies shape functions and quadrature; element matrices are formed for many elements in one batched
product, as in the plane (`elasticity`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix
from skfem import ElementHexS2, ElementTetP2
from skfem.quadrature import get_quadrature

from trochoid.fem.material import Material
from trochoid.geometry.solid_mesh import EDGES, SolidMesh
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.types import Array, IntArray, frozen

_CORNERS = {
    10: np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float64),
    20: np.array(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
        dtype=np.float64,
    ),
}
_KINDS = {10: (ElementTetP2, 5), 20: (ElementHexS2, 5)}  # quadrature: exact for the mass of straight elements
_BATCH = 2048  # elements at once: what they need stays in tens of MB


@dataclass(frozen=True, eq=False, slots=True)
class SolidBody:
    """A mesh of n points with its `stiffness` (3n, 3n), N/m, and `mass` (n, n), kg, the same along each axis.

    The degrees of freedom of a point are 3·point, +1, +2.
    """

    mesh: SolidMesh
    material: Material
    stiffness: csc_matrix
    mass: csc_matrix

    @property
    def size(self) -> int:
        """Number of degrees of freedom."""
        return 3 * len(self.mesh.points)

    def weighed(self, motion: Array) -> Array:
        """Return M u (3n, k) of motions (3n, k)."""
        flat = motion.reshape(len(self.mesh.points), -1)
        return np.asarray((self.mass @ flat).reshape(motion.shape))


@dataclass(frozen=True, slots=True)
class MassProperties:
    """`mass` kg, `center` (3,) m and `inertia` (3, 3) kg·m² about it, −∫xy dm off its diagonal."""

    mass: float
    center: Array
    inertia: Array


def solid_body(mesh: SolidMesh, material: Material) -> SolidBody:
    """Integrate stiffness and mass; raises Infeasible for a material, TrochoidError for folded elements."""
    if not (material.youngs_modulus > 0.0 and material.density > 0.0):
        raise Infeasible(
            f"a body that vibrates needs E and density above 0, given E = {material.youngs_modulus:g} Pa and "
            f"{material.density:g} kg/m³"
        )
    if not -1.0 < material.poissons_ratio < 0.5:
        raise Infeasible(f"Poisson's ratio must be between −1 and 0.5, given {material.poissons_ratio:g}")
    size, nodes = len(mesh.points), mesh.elements.T
    parts = [_matrices(mesh, material, chosen) for chosen in _batches(nodes.shape[0])]
    stiffness, mass = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    dofs: IntArray = (3 * nodes[:, :, None] + np.arange(3)).reshape(len(nodes), -1)
    return SolidBody(mesh, material, _assembled(stiffness, dofs, 3 * size), _assembled(mass, nodes, size))


def mass_properties(body: SolidBody) -> MassProperties:
    """Return mass, centre and inertia of the meshed body: the integrals that its mass matrix contains."""
    ones = np.ones((len(body.mesh.points), 1))
    mass = float((ones.T @ (body.mass @ ones))[0, 0])
    center = (ones.T @ (body.mass @ body.mesh.points))[0] / mass
    arms = body.mesh.points - center
    second = arms.T @ (body.mass @ arms)
    return MassProperties(
        mass, frozen(center), frozen(np.trace(second) * np.eye(3) - 0.5 * (second + second.T))
    )


def rigid_motions(points: Array, about: Array) -> Array:
    """Return the displacements (3n, 6) of points (n, 3) under unit translations and unit rotations about a point."""
    x, y, z = (points - about).T
    motion = np.zeros((len(points), 3, 6))
    motion[:, range(3), range(3)] = 1.0
    motion[:, 1, 3], motion[:, 2, 3] = -z, y
    motion[:, 0, 4], motion[:, 2, 4] = z, -x
    motion[:, 0, 5], motion[:, 1, 5] = -y, x
    return motion.reshape(-1, 6)


def _batches(count: int) -> Iterator[slice]:
    return (slice(start, start + _BATCH) for start in range(0, count, _BATCH))


def _shapes(nodes: int) -> tuple[Array, Array, Array]:
    """Return values (k, q), slopes (k, 3, q) and weights (q,) of the shape functions in VTK's order."""
    kind, order = _KINDS[nodes]
    places, weights = get_quadrature(kind.refdom, order)
    corners = _CORNERS[nodes]
    wanted = np.concatenate([corners, [0.5 * (corners[a] + corners[b]) for a, b in EDGES[nodes]]])
    theirs = np.asarray(kind.doflocs, dtype=np.float64)
    number = np.argmin(np.linalg.norm(wanted[:, None] - theirs, axis=2), axis=1)
    pairs = [kind().lbasis(places, int(i)) for i in number]
    values, slopes = (np.stack([pair[j] for pair in pairs]) for j in (0, 1))
    return values, slopes, weights


def _matrices(mesh: SolidMesh, material: Material, chosen: slice) -> tuple[Array, Array]:
    """Return stiffness (m, 3k, 3k) and mass (m, k, k) of elements."""
    values, slopes, weights = _shapes(len(mesh.elements))
    nodes = mesh.elements[:, chosen].T
    count, size = nodes.shape
    jacobian = np.einsum("eka,kbq->eqab", mesh.points[nodes], slopes, optimize=True)  # ∂x_a/∂ξ_b
    volume = np.linalg.det(jacobian)
    if (volume <= 0.0).any():
        bad = np.flatnonzero((volume <= 0.0).any(axis=1))
        raise TrochoidError(
            f"{len(bad)} curved elements fold, one at {mesh.points[nodes[bad[0], 0]]} m; mesh that place more finely"
        )
    volume = volume * weights
    inverse = np.linalg.inv(jacobian)
    gradients = np.einsum("kbq,eqba->eqka", slopes, inverse, optimize=True).reshape(count, -1, 3 * size)
    products = (gradients * volume[:, :, None]).transpose(0, 2, 1) @ gradients
    products = products.reshape(count, size, 3, size, 3)  # (m, i, a, j, b) = ∫ ∂a φi ∂b φj
    modulus, ratio = material.youngs_modulus, material.poissons_ratio
    shear, lame = modulus / (2 * (1 + ratio)), modulus * ratio / ((1 + ratio) * (1 - 2 * ratio))
    laplace = np.einsum("eiaja->eij", products)
    stiffness = lame * products + shear * products.transpose(0, 1, 4, 3, 2)
    for a in range(3):
        stiffness[:, :, a, :, a] += shear * laplace
    mass = material.density * np.einsum("iq,jq,eq->eij", values, values, volume, optimize=True)
    return stiffness.reshape(count, 3 * size, 3 * size), mass


def _assembled(matrices: Array, dofs: IntArray, size: int) -> csc_matrix:
    width, index = dofs.shape[1], dofs.astype(np.int32)
    rows, columns = np.repeat(index, width, axis=1).ravel(), np.tile(index, (1, width)).ravel()
    matrix = coo_matrix((matrices.ravel(), (rows, columns)), shape=(size, size)).tocsc()
    return csc_matrix(0.5 * (matrix + matrix.T))
