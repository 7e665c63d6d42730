"""Solid elasticity: uniform strain, rigid motions, mass, and natural frequencies that sources print."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csc_matrix, hstack

from tests.geometry.solid_cases import CASING, bar, bricks
from trochoid.fem.linear_solver import factorise
from trochoid.fem.material import Material
from trochoid.fem.reduction import spread
from trochoid.fem.solid import SolidBody, mass_properties, rigid_motions, solid_body
from trochoid.fem.solid_modes import lowest_modes, modes_below
from trochoid.geometry.casing_mesh import mesh_casing
from trochoid.geometry.solid_mesh import SolidMesh, solid_mesh
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.types import Array

STEEL = Material(200e9, 0.3, 8000.0)
seeds = st.integers(0, 2**31 - 1)


def _distorted(seed: int) -> SolidMesh:
    """Return bricks whose corners are moved at random, with straight edges."""
    rng = np.random.default_rng(seed)
    mesh = bricks((2, 2, 2))
    corners = mesh.elements[:8]
    moved = mesh.points[: corners.max() + 1] + rng.uniform(-0.08, 0.08, (corners.max() + 1, 3))
    return solid_mesh(moved, corners)


@pytest.mark.property
@settings(max_examples=10, deadline=None)
@given(seeds)
def test_uniform_strain(seed: int) -> None:
    """Patch test: no force inside under a uniform strain of distorted bricks, energy ½ V (λ tr² + 2μ ε:ε)."""
    body = solid_body(_distorted(seed), STEEL)
    gradient = np.random.default_rng(seed + 1).normal(size=(3, 3)) * 1e-4
    moved = (body.mesh.points @ gradient.T).ravel()
    force = (body.stiffness @ moved).reshape(-1, 3)
    inside = np.setdiff1d(np.arange(len(force)), body.mesh.facets)
    assert np.abs(force[inside]).max() < 1e-10 * np.abs(force).max()
    strain, volume = 0.5 * (gradient + gradient.T), mass_properties(body).mass / STEEL.density
    shear, lame = 200e9 / 2.6, 200e9 * 0.3 / (1.3 * 0.4)
    energy = 0.5 * volume * (lame * np.trace(strain) ** 2 + 2 * shear * (strain**2).sum())
    assert 0.5 * moved @ force.ravel() == pytest.approx(energy, rel=1e-10)


@pytest.mark.property
@pytest.mark.parametrize("kind", ["bricks", "tetrahedra"])
def test_matrices(kind: str) -> None:
    """Symmetric; rigid motions cost nothing; the mass matrix is positive and its sum the mass."""
    body = solid_body(_distorted(5) if kind == "bricks" else mesh_casing(CASING, 0.08), STEEL)
    largest = np.abs(body.stiffness.data).max()
    assert abs(body.stiffness - body.stiffness.T).max() == 0.0
    rigid = rigid_motions(body.mesh.points, np.zeros(3))
    assert np.abs(body.stiffness @ rigid).max() < 1e-11 * largest
    factorise(csc_matrix(body.mass))  # refuses what is not positive definite
    assert body.mass.sum() == pytest.approx(mass_properties(body).mass, rel=1e-12)


@pytest.mark.exact
def test_mass_of_a_bar() -> None:
    """m = ρ a b c about the middle, with (b² + c²)/12."""
    found = mass_properties(solid_body(bar((0.3, 0.2, 0.1), (2, 1, 1)), STEEL))
    assert found.mass == pytest.approx(48.0, rel=1e-12)
    assert found.center == pytest.approx([0.15, 0.1, 0.05], rel=1e-12)
    assert found.inertia == pytest.approx(4.0 * np.diag([0.05, 0.10, 0.13]), abs=1e-12)


# NAFEMS, Selected benchmarks for natural frequency analysis, test FV41: free cylinder, axisymmetric vibration


CYLINDER = (243.53, 377.41, 394.11, 397.72, 405.28)
SECTOR = np.deg2rad(10.0)


def _sector(points: Array) -> Array:
    radius, angle = 1.8 + 0.4 * points[:, 0], SECTOR * points[:, 1]
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), 10.0 * points[:, 2]], axis=1)


def _with_symmetry_faces(body: SolidBody, angle: Array) -> csc_matrix:
    """Return the map from free motions to all: no motion across the faces at 0 and SECTOR, along their true normals."""
    count = len(body.mesh.points)
    held = (angle < 1e-9) | (angle > SECTOR - 1e-9)
    cosine, sine = np.cos(angle), np.sin(angle)
    node = np.arange(count)
    radial = csc_matrix(
        (np.concatenate([cosine, sine]), (np.concatenate([3 * node, 3 * node + 1]), np.tile(node, 2))),
        shape=(3 * count, count),
    )
    free = node[~held]
    around = csc_matrix(
        (np.concatenate([-sine[free], cosine[free]]),
         (np.concatenate([3 * free, 3 * free + 1]), np.tile(np.arange(len(free)), 2))),
        shape=(3 * count, len(free)),
    )  # fmt: skip
    axial = csc_matrix((np.ones(count), (3 * node + 2, node)), shape=(3 * count, count))
    return csc_matrix(hstack([radial, around, axial]))


@pytest.mark.published
def test_nafems_free_cylinder() -> None:
    """NAFEMS FV41: a sector of 10° with symmetry faces, 3 × 1 × 32 bricks: five frequencies within 0.5 %."""
    body = solid_body(bricks((3, 1, 32), _sector), STEEL)
    angle = np.arctan2(body.mesh.points[:, 1], body.mesh.points[:, 0])
    free = _with_symmetry_faces(body, angle)
    stiffness = csc_matrix(free.T @ body.stiffness @ free)
    mass = csc_matrix(free.T @ spread(body.mass) @ free)
    shift = -((2.0 * np.pi * 100.0) ** 2)
    hertz, _ = lowest_modes(mass, factorise(csc_matrix(stiffness - shift * mass)), 6, shift)
    assert hertz[0] == pytest.approx(0.0, abs=1e-2)  # along the axis it is free
    assert hertz[1:] == pytest.approx(CYLINDER, rel=5e-3)


def _free_hertz(body: SolidBody, count: int, shift: float) -> Array:
    mass = spread(body.mass)
    hertz, _ = lowest_modes(mass, factorise(csc_matrix(body.stiffness - shift * mass)), 6 + count, shift)
    assert np.abs(hertz[:6]).max() < 1e-3 * hertz[6]
    return hertz[6:]


@pytest.mark.published
def test_free_square_plate() -> None:
    """Leissa 1973 (J. Sound Vib. 31, 257): ω a² √(ρh/D) = 13.489, 19.789, 24.432, 35.024 twice, upper bounds."""
    side, thick = 1.0, 0.01
    body = solid_body(bar((side, side, thick), (8, 8, 1)), STEEL)
    bending = 200e9 * thick**3 / 12.0 / (1.0 - 0.09)
    unit = np.sqrt(bending / (8000.0 * thick)) / side**2 / (2.0 * np.pi)
    found = _free_hertz(body, 5, -((2.0 * np.pi * 30.0) ** 2)) / unit
    assert found == pytest.approx([13.489, 19.789, 24.432, 35.024, 35.024], rel=1e-2)
    assert found[3] == pytest.approx(found[4], rel=1e-6)  # a pair: two of the same, neither missed


@pytest.mark.exact
def test_bar_of_a_material_without_lateral_strain() -> None:
    """ν = 0: a bar moving along itself alone vibrates at n/(2L) √(E/ρ) with free ends; quadratic: fourth order."""
    errors = []
    for count in (4, 8):
        body = solid_body(bar((1.0, 0.1, 0.1), (count, 1, 1)), Material(200e9, 0.0, 8000.0))
        points = body.mesh.points
        places, row = np.unique(points[:, 0].round(9), return_inverse=True)
        plane = csc_matrix(
            (np.ones(len(row)), (3 * np.arange(len(row)), row)), shape=(body.size, len(places))
        )
        stiffness = csc_matrix(plane.T @ body.stiffness @ plane)
        mass = csc_matrix(plane.T @ spread(body.mass) @ plane)
        shift = -1e7
        hertz, _ = lowest_modes(mass, factorise(csc_matrix(stiffness - shift * mass)), 3, shift)
        assert hertz[0] == pytest.approx(0.0, abs=1e-3)
        errors.append(hertz[1:] / [2500.0, 5000.0] - 1.0)
    assert np.abs(errors[1]).max() < 3e-4
    assert errors[0] / errors[1] == pytest.approx([16.0, 16.0], rel=0.1)


@pytest.mark.property
def test_all_modes_below_are_all() -> None:
    """Modes of a held bar up to a frequency: as many, and the same, as all its modes computed densely."""
    from scipy.linalg import eigh

    body = solid_body(bar((0.2, 0.05, 0.05), (4, 1, 1)), STEEL)  # square: bending modes in pairs
    free = np.setdiff1d(np.arange(body.size), (3 * body.mesh.sets["left"][:, None] + np.arange(3)).ravel())
    stiffness, mass = (csc_matrix(m[free][:, free]) for m in (body.stiffness, spread(body.mass)))
    squares, _ = eigh(stiffness.toarray(), mass.toarray())
    expected = np.sqrt(squares) / (2.0 * np.pi)
    for upper in (100.0, 20e3, 60e3):
        hertz, modes, _ = modes_below(mass, factorise(stiffness), upper)
        assert hertz == pytest.approx(expected[expected <= upper], rel=1e-9)
        assert modes.T @ (mass @ modes) == pytest.approx(np.eye(len(hertz)), abs=1e-9)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("material", "said"),
    [
        (Material(0.0, 0.3, 8000.0), "E and density above 0"),
        (Material(2e11, 0.3), "E and density above 0"),
        (Material(2e11, 0.5, 8000.0), "between −1 and 0.5"),
    ],
)
def test_materials_that_cannot_be(material: Material, said: str) -> None:
    """No stiffness, no mass, incompressible: a message."""
    with pytest.raises(Infeasible, match=said):
        solid_body(bricks((1, 1, 1)), material)


@pytest.mark.exact
def test_folded_elements_are_refused() -> None:
    """A middle node pulled past its corner folds a curved element."""
    mesh = bricks((1, 1, 1))
    points = mesh.points.copy()
    middle = mesh.elements[8, 0]
    points[middle] = points[mesh.elements[1, 0]] + [0.9, 0.0, 0.0]
    with pytest.raises(TrochoidError, match="1 curved elements fold"):
        solid_body(solid_mesh(points, mesh.elements), STEEL)


@pytest.mark.property
def test_many_modes_may_be_enough() -> None:
    """With a lower limit that must be reached, all modes up to the limit that is told are there."""
    rng = np.random.default_rng(5)
    squares = np.sort(rng.uniform(1.0, 1e4, 120)) * (2.0 * np.pi) ** 2
    mass, stiffness = (csc_matrix(np.diag(each)) for each in (np.ones(120), squares))
    every = np.sqrt(squares) / (2.0 * np.pi)
    for least, many in ((20.0, 5), (60.0, 5), (20.0, 40)):
        hertz, modes, limit = modes_below(mass, factorise(stiffness), 95.0, least, many)
        assert least <= limit <= 95.0
        assert len(hertz) >= many
        assert hertz == pytest.approx(every[every <= limit], rel=1e-9)
        assert modes.shape == (120, len(hertz))
    hertz, _, limit = modes_below(mass, factorise(stiffness), 95.0)
    assert limit == 95.0
    assert hertz == pytest.approx(every[every <= 95.0], rel=1e-9)
