"""Plane elasticity on quadratic triangles: element matrices, mass, stress recovery.

scikit-fem supplies the curved mapping, the basis and its quadrature; the element matrices are formed for all
elements in one batched product, because a form per pair of the twelve basis functions costs ten times more.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix
from scipy.spatial import cKDTree
from skfem import Basis, ElementTriP2, MeshTri2

from trochoid.fem.material import Plane
from trochoid.geometry.mesh import Mesh
from trochoid.kinematics.types import Array, IntArray


@dataclass(frozen=True, slots=True)
class Elements:
    """Element data of a mesh: `stiffness` (m, 12, 12) for unit thickness, `dofs` (m, 12), `areas` (m, 6) of the
    elements' nodes in m² and their sums `weight` (n,) over the elements round a node; `near` finds `centroids` (m, 2)
    by place.
    """

    stiffness: Array
    dofs: IntArray
    areas: Array
    weight: Array
    centroids: Array
    near: cKDTree


def quadratic_mesh(mesh: Mesh) -> MeshTri2:
    """Return the mesh as scikit-fem's; our meshes are numbered the way it numbers them."""
    return MeshTri2(np.ascontiguousarray(mesh.points.T), np.ascontiguousarray(mesh.triangles))


def elements(mesh: Mesh, plane: Plane) -> Elements:
    """Integrate the element matrices; a point's degrees of freedom are 2·node and 2·node+1."""
    basis = Basis(quadratic_mesh(mesh), ElementTriP2(), intorder=4)
    gradients = np.stack([basis.basis[i][0].grad for i in range(6)])  # (6, 2, m, q)
    values = np.stack([np.broadcast_to(np.asarray(basis.basis[i][0]), basis.dx.shape) for i in range(6)])
    g = gradients.transpose(2, 3, 0, 1).reshape(*basis.dx.shape, 12)
    products = (g * basis.dx[:, :, None]).transpose(0, 2, 1) @ g
    products = products.reshape(-1, 6, 2, 6, 2)  # (m, i, a, j, b) = ∫ ∂a φi ∂b φj
    lame, shear = plane.lame, plane.shear
    laplace = np.einsum("eiaja->eij", products)
    stiffness = lame * products + shear * products.transpose(0, 1, 4, 3, 2)
    for a in range(2):
        stiffness[:, :, a, :, a] += shear * laplace
    triangles = mesh.triangles.T
    areas = np.einsum("ieq,eq->ei", values, basis.dx)
    weight = np.zeros(len(mesh.points))
    np.add.at(weight, triangles, areas)
    dofs = np.stack([2 * triangles, 2 * triangles + 1], axis=-1).reshape(-1, 12)
    centroids = mesh.points[triangles[:, :3]].mean(axis=1)
    return Elements(stiffness.reshape(-1, 12, 12), dofs, areas, weight, centroids, cKDTree(centroids))


def assemble(parts: Elements, size: int) -> csc_matrix:
    """Sum the element matrices into a sparse matrix of `size` degrees of freedom."""
    rows = np.repeat(parts.dofs, 12, axis=1).ravel()
    columns = np.tile(parts.dofs, (1, 12)).ravel()
    return csc_matrix((parts.stiffness.ravel(), (rows, columns)), shape=(size, size))


def nodal_stress(mesh: Mesh, plane: Plane, displacement: Array) -> Array:
    """Return the stress per element node (m, 6, 3) as xx, yy, xy in Pa of displacements (m, 6, 2) at the
    elements' nodes.
    """
    basis = Basis(
        quadratic_mesh(mesh), ElementTriP2(), quadrature=(ElementTriP2.doflocs.T.copy(), np.full(6, 1 / 12))
    )
    gradients = np.stack([basis.basis[i][0].grad for i in range(6)])
    strain = np.einsum("iaeq,eib->eqab", gradients, displacement)
    trace = np.einsum("eqaa->eq", strain) * plane.lame
    return np.stack(
        [
            trace + 2 * plane.shear * strain[..., 0, 0],
            trace + 2 * plane.shear * strain[..., 1, 1],
            plane.shear * (strain[..., 0, 1] + strain[..., 1, 0]),
        ],
        axis=-1,
    )
