"""Element matrices and stress recovery on curved quadratic triangles."""

from __future__ import annotations

import numpy as np
import pytest
from skfem import Basis, ElementTriP2, ElementVector
from skfem.models.elasticity import linear_elasticity

from tests.fem.cases import STEEL, round_loop, small_mesh
from trochoid.fem.body import rigid_modes
from trochoid.fem.elasticity import assemble, elements, nodal_stress, quadratic_mesh
from trochoid.fem.material import Material, Plane
from trochoid.geometry.mass import section
from trochoid.geometry.mesh import Mesh, mesh_outline
from trochoid.geometry.outline import Loop, Outline
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.types import Array

PLANES = [
    Material(210e9, 0.3).plane("strain"),
    Material(210e9, 0.3).plane("stress"),
    Material(1.0, 0.0).plane("strain"),
]
SLOPE = np.array([[1e-4, 3e-4], [-2e-4, 5e-5]])  # ∂u_b/∂x_a


@pytest.fixture(scope="module")
def disc() -> Mesh:
    return small_mesh()[0]


def _stiffness(mesh: Mesh) -> Array:
    return np.asarray(assemble(elements(mesh, STEEL), 2 * len(mesh.points)).toarray())


@pytest.mark.exact
@pytest.mark.parametrize("plane", PLANES)
def test_constant_strain_is_exact_on_a_curved_mesh(disc: Mesh, plane: Plane) -> None:
    """Patch test: a linear displacement leaves no force at inner nodes and Hooke's constant stress everywhere."""
    parts = elements(disc, plane)
    u = disc.points @ SLOPE + np.array([1e-5, -2e-5])
    force = (assemble(parts, u.size) @ u.ravel()).reshape(-1, 2)
    inner = np.setdiff1d(np.arange(len(u)), np.concatenate([e.ravel() for e in disc.edges.values()]))
    assert np.abs(force[inner]).max() < 1e-12 * np.abs(force).max()
    strain = 0.5 * (SLOPE + SLOPE.T)
    hooke = plane.lame * np.trace(strain) * np.eye(2) + 2 * plane.shear * strain
    stress = nodal_stress(disc, plane, u[disc.triangles.T])
    expected = np.broadcast_to([hooke[0, 0], hooke[1, 1], hooke[0, 1]], stress.shape)
    assert stress == pytest.approx(expected, rel=1e-10, abs=1e-10 * np.abs(hooke).max())


@pytest.mark.exact
def test_energy_of_constant_strain_is_that_of_the_true_area() -> None:
    """½∫σ:ε = ½ σ:ε A; the quadratic boundary takes A to the fourth power of the facet length."""
    strain = 0.5 * (SLOPE + SLOPE.T)
    density = 0.5 * (STEEL.lame * np.trace(strain) ** 2 + 2 * STEEL.shear * np.sum(strain**2))
    errors = []
    for facets in (12, 24):
        outline = Outline(round_loop(facets))
        mesh = mesh_outline(outline)
        u = (mesh.points @ SLOPE).ravel()
        energy = 0.5 * u @ assemble(elements(mesh, STEEL), u.size) @ u
        errors.append(abs(energy / (density * section(outline).area) - 1))
    assert errors[0] < 2e-4
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4, abs=0.2)


@pytest.mark.property
def test_rigid_motions_cost_nothing(disc: Mesh) -> None:
    """K times a translation or rotation is zero."""
    stiffness = assemble(elements(disc, STEEL), 2 * len(disc.points))
    modes = rigid_modes(disc.points)
    size = abs(stiffness) @ np.abs(modes)
    assert np.abs(stiffness @ modes).max() < 1e-13 * size.max()


@pytest.mark.property
def test_stiffness_is_symmetric_with_three_free_motions() -> None:
    """K = Kᵀ, and all eigenvalues but three are positive."""
    mesh = mesh_outline(Outline(round_loop(12), (Loop("bore", Circle((0.0, 0.0), 0.02, hole=True), 8),)))
    stiffness = _stiffness(mesh)
    assert np.abs(stiffness - stiffness.T).max() < 1e-14 * np.abs(stiffness).max()
    values = np.linalg.eigvalsh(stiffness)
    assert np.abs(values[:3]).max() < 1e-11 * values[-1]
    assert values[3] > 1e-5 * values[-1]


@pytest.mark.independent
def test_matrix_is_that_of_scikit_fem(disc: Mesh) -> None:
    """scikit-fem's own form of linear elasticity, assembled term by term, gives the same matrix."""
    basis = Basis(quadratic_mesh(disc), ElementVector(ElementTriP2()), intorder=4)
    theirs = linear_elasticity(Lambda=STEEL.lame, Mu=STEEL.shear).assemble(basis)
    mine = assemble(elements(disc, STEEL), 2 * len(disc.points))
    assert abs(mine - theirs).max() < 1e-12 * abs(theirs).max()


@pytest.mark.exact
def test_nodal_areas_sum_to_the_section(disc: Mesh) -> None:
    """Areas of the nodes: their sum is the area of the outline, their first moment its centroid."""
    mesh, outline = small_mesh(6)
    parts, truth = elements(mesh, STEEL), section(outline)
    assert parts.weight.sum() == pytest.approx(truth.area, rel=1e-4)
    assert parts.weight == pytest.approx(
        np.bincount(mesh.triangles.T.ravel(), parts.areas.ravel()), rel=1e-13
    )
    assert parts.weight @ mesh.points == pytest.approx(np.zeros(2), abs=1e-4 * 0.08 * truth.area)


@pytest.mark.exact
def test_recovered_stress_of_a_quadratic_displacement() -> None:
    """Straight triangles: a quadratic displacement is in the space, so its linear stress is exact at the nodes."""
    from trochoid.kinematics.path import polygon

    block = polygon([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)])
    mesh = mesh_outline(Outline(Loop("block", block, 24)))
    x, y = mesh.points.T
    u = np.stack([x * x - 3 * x * y, 2 * y * y + x * y], axis=-1)
    stress = nodal_stress(mesh, STEEL, u[mesh.triangles.T]) / STEEL.shear
    dxx, dyy, dxy = 2 * x - 3 * y, 4 * y + x, -3 * x + y
    ratio = STEEL.lame / STEEL.shear
    expected = np.stack([ratio * (dxx + dyy) + 2 * dxx, ratio * (dxx + dyy) + 2 * dyy, dxy], axis=-1)
    assert stress == pytest.approx(expected[mesh.triangles.T], abs=1e-10)
