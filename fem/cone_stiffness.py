"""Stiffness of a body of rays x = ρ f(ξ, η): exactly a sum of Kronecker products of plane and radial matrices.

With φ = L(ρ) N(ξ, η) and the dual basis A, a^ξ, a^η of f, ∂f/∂ξ, ∂f/∂η the gradient is L' N A + (L/ρ) B,
B = N_ξ a^ξ + N_η a^η, and dV = ρ² dρ f·(f_ξ × f_η) dξ dη.  So, with the elasticity of the two vectors
k(u, v) = λ u vᵀ + μ v uᵀ + μ u·v,

    K = ∫LL ⊗ k(B, B) + ∫ρ L'L ⊗ k(A N, B) + its transpose + ∫ρ² L'L' ⊗ k(A N, A N).

A degree of freedom is (3 node + direction)·count + layer node.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix

from trochoid.fem.cone_layers import Layers, matrices
from trochoid.fem.material import Material
from trochoid.geometry.sphere_mesh import SphereMesh
from trochoid.kinematics.types import Array

# six points of degree four (Dunavant): constant strain and rigid motions pass through them exactly
_A, _B = 0.445948490915965, 0.091576213509771
_POINTS = np.array(
    [[_A, _A], [1 - 2 * _A, _A], [_A, 1 - 2 * _A], [_B, _B], [1 - 2 * _B, _B], [_B, 1 - 2 * _B]]
)
_WEIGHTS = 0.5 * np.repeat([0.223381589678011, 0.109951743655322], 3)


@dataclass(frozen=True, eq=False, slots=True)
class PlaneMatrices:
    """k(B, B), k(AN, B) and k(AN, AN), each (3n, 3n), sparse."""

    across: csr_matrix
    mixed: csr_matrix
    along: csr_matrix


def cone_stiffness(mesh: SphereMesh, radial: Layers, material: Material) -> csc_matrix:
    """Return the stiffness of a body; `radial` in m, result in N/m."""
    plane, depth = plane_matrices(mesh, material), matrices(radial)
    parts = (plane.across, plane.along, plane.mixed, plane.mixed.T)
    return _summed(parts, (depth.plain, depth.steep, depth.mixed, depth.mixed.T))


def _summed(planes: Sequence[csr_matrix], radials: Sequence[csr_matrix]) -> csc_matrix:
    """Return the sum of Kronecker products of plane matrices, all of one pattern, and radial ones.

    Written in place, one column of the radial matrices at a time: the sum of four sparse products takes six times as
    long.
    """
    wide = [x.tocsc() for x in planes]
    for x in wide:
        x.sort_indices()
    narrow = np.stack([x.toarray() for x in radials])
    band, count = (narrow != 0.0).any(axis=0), narrow.shape[1]
    entries = np.diff(wide[0].indptr)
    starts = np.concatenate([[0], np.cumsum(np.outer(entries, band.sum(axis=0)))])
    column = np.repeat(np.arange(len(entries)), entries)
    before = np.arange(len(column)) - wide[0].indptr[column]  # entries of the same column
    data, index = np.empty(starts[-1]), np.empty(starts[-1], dtype=np.int32)
    for c in range(count):
        rows = np.flatnonzero(band[:, c])
        place = (starts[column * count + c] + before * len(rows))[:, None] + np.arange(len(rows))
        terms = [x.data[:, None] * r[rows, c] for x, r in zip(wide, narrow, strict=True)]
        data[place] = terms[0] + terms[1] + terms[2] + terms[3]
        index[place] = wide[0].indices[:, None] * count + rows
    total = csc_matrix((data, index, starts), shape=(count * len(entries),) * 2)
    total.eliminate_zeros()
    return total


def plane_matrices(mesh: SphereMesh, material: Material) -> PlaneMatrices:
    """Integrate over all elements at once."""
    shear = material.youngs_modulus / (2 * (1 + material.poissons_ratio))
    lame = 2 * shear * material.poissons_ratio / (1 - 2 * material.poissons_ratio)
    value, by_x, by_y = shapes(_POINTS)
    node = mesh.points[mesh.triangles]  # (6, m, 3)
    f, fx, fy = (np.einsum("aq,amc->mqc", s, node) for s in (value, by_x, by_y))
    volume = np.sum(f * np.cross(fx, fy), axis=-1)
    dual = [np.cross(u, v) / volume[..., None] for u, v in ((fx, fy), (fy, f), (f, fx))]
    across = np.einsum("aq,mqc->mqac", by_x, dual[1]) + np.einsum("aq,mqc->mqac", by_y, dual[2])
    along = np.einsum("aq,mqc->mqac", value, dual[0])
    weight = volume * _WEIGHTS
    index = (3 * mesh.triangles.T[:, :, None] + np.arange(3)).reshape(-1, 18)
    rows, columns = np.repeat(index, 18, axis=1).ravel(), np.tile(index, (1, 18)).ravel()

    def assembled(left: Array, right: Array) -> csr_matrix:
        size = (len(left), len(_WEIGHTS), 18)
        flat = (left * weight[..., None, None]).reshape(size).transpose(0, 2, 1)
        product = (flat @ right.reshape(size)).reshape(-1, 6, 3, 6, 3)  # (m, a, i, b, j) = ∫ left_ai right_bj
        element = lame * product + shear * product.transpose(0, 1, 4, 3, 2)
        dot = np.einsum("maibi->mab", product)
        for i in range(3):
            element[:, :, i, :, i] += shear * dot
        return csr_matrix((element.ravel(), (rows, columns)), shape=(3 * len(mesh.points),) * 2)

    return PlaneMatrices(assembled(across, across), assembled(along, across), assembled(along, along))


def shapes(places: Array) -> tuple[Array, Array, Array]:
    """Return the six shape functions and their slopes over ξ and η, (6, q) each, at places (q, 2)."""
    x, y = places.T
    z, o = 1.0 - x - y, np.zeros_like(x)
    value = np.stack([z * (2 * z - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * z * x, 4 * x * y, 4 * y * z])
    by_x = np.stack([1 - 4 * z, 4 * x - 1, o, 4 * (z - x), 4 * y, -4 * y])
    by_y = np.stack([1 - 4 * z, o, 4 * y - 1, -4 * x, 4 * x, 4 * (z - y)])
    return value, by_x, by_y
