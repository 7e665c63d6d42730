"""Craig–Bampton reduction: exact for loads that stand still, rigid motions free, frequencies above the full model's."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh
from scipy.sparse import csc_matrix

from tests.geometry.solid_cases import CASING, bar
from trochoid.dynamics.modes import natural_modes
from trochoid.fem.linear_solver import Solve, factorise
from trochoid.fem.material import Material
from trochoid.fem.reduction import (
    Reduced,
    interface_stiffness,
    joined,
    reading,
    reduce,
    rigid_coordinates,
    spread,
)
from trochoid.fem.reduction_error import reduction_error
from trochoid.fem.solid import mass_properties, rigid_motions, solid_body
from trochoid.fem.solid_interface import Interface, interfaces_of
from trochoid.geometry.casing_box import centers
from trochoid.geometry.casing_mesh import mesh_casing
from trochoid.geometry.solid_mesh import solid_mesh
from trochoid.kinematics.errors import Infeasible, TrochoidError

STEEL = Material(200e9, 0.3, 8000.0)
seeds = st.integers(0, 2**31 - 1)


@cache
def casing() -> Reduced:
    body = solid_body(mesh_casing(CASING, 0.05), STEEL)
    return reduce(body, interfaces_of(body, centers(CASING)))


def _ends(size: tuple[float, float, float]) -> dict[str, tuple[float, float, float]]:
    return {"left": (0.0, 0.5 * size[1], 0.5 * size[2]), "right": (size[0], 0.5 * size[1], 0.5 * size[2])}


@cache
def beam(upper: float) -> Reduced:
    """Return a slender bar, its ends rigid."""
    size = (1.0, 0.02, 0.01)
    body = solid_body(bar(size, (24, 1, 1)), Material(200e9, 0.0, 8000.0))
    return reduce(body, interfaces_of(body, _ends(size)), upper)


@pytest.mark.property
def test_rigid_motions_are_free_and_nothing_else() -> None:
    """Six frequencies of exactly zero; mass and stiffness symmetric; rigid coordinates cost nothing."""
    found = casing()
    hertz = natural_modes(found.mass, found.stiffness).hertz
    assert (hertz[:6] == 0.0).all()
    assert hertz[6] > 100.0
    for matrix in (found.mass, found.stiffness):
        assert np.array_equal(matrix, matrix.T)
        assert np.linalg.eigvalsh(matrix).min() > -1e-9 * np.abs(matrix).max()
    work = found.stiffness @ rigid_coordinates(found, (0.1, 0.2, 0.3))
    assert np.abs(work).max() < 1e-12 * np.abs(found.stiffness).max()


@pytest.mark.exact
def test_mass_and_inertia_are_kept() -> None:
    """The reduced mass on rigid motions about the centre is that of the whole mesh."""
    found = casing()
    whole = mass_properties(found.body)
    rigid = rigid_coordinates(found, tuple(whole.center))
    mass = rigid.T @ found.mass @ rigid
    assert mass[:3, :3] == pytest.approx(whole.mass * np.eye(3), abs=1e-8 * whole.mass)
    assert mass[3:, 3:] == pytest.approx(whole.inertia, abs=1e-8 * whole.inertia.max())
    assert mass[:3, 3:] == pytest.approx(np.zeros((3, 3)), abs=1e-8 * whole.mass)
    points = rigid_motions(found.body.mesh.points, whole.center)
    assert found.basis @ rigid == pytest.approx(points, abs=1e-8)


@pytest.mark.independent
@settings(max_examples=5, deadline=None)
@given(seeds)
def test_static_loads_are_exact(seed: int) -> None:
    """Feet held, wrenches on the bores: motions are those of all degrees of freedom, by another solver, to 1e-8."""
    found = casing()
    load = np.random.default_rng(seed).normal(size=12) * np.tile([1e3] * 3 + [50.0] * 3, 2)
    moved = np.linalg.solve(interface_stiffness(found)[:12, :12], load)
    full, size = _held_at_feet()
    right = np.zeros((size, 1))
    right[:12, 0] = load
    expected = full(right)[:12, 0]
    assert moved == pytest.approx(expected, rel=1e-8, abs=1e-8 * np.abs(expected).max())


@cache
def _held_at_feet() -> tuple[Solve, int]:
    found = casing()
    join = joined(found.body, found.interfaces)
    free = np.setdiff1d(np.arange(join.shape[1]), np.arange(12, 36))
    matrix = csc_matrix((join.T @ found.body.stiffness @ join)[free][:, free])
    return factorise(matrix, "superlu"), len(free)


@pytest.mark.exact
def test_beam_between_its_ends() -> None:
    """ν = 0, one end held: L/(EA); by an end moment L/(EI) and L²/(2EI), exact; by a force L³/(3EI) + 1.2 L/(GA)."""
    found = beam(100.0)
    tip = np.linalg.inv(found.stiffness[6:12, 6:12])
    length, width, height, modulus = 1.0, 0.02, 0.01, 200e9
    area, shear = width * height, modulus / 2.0
    assert tip[0, 0] == pytest.approx(length / (modulus * area), rel=1e-8)
    for axis, about, sign, deep, wide in ((1, 5, 1.0, width, height), (2, 4, -1.0, height, width)):
        bending = modulus * wide * deep**3 / 12.0
        assert tip[about, about] == pytest.approx(length / bending, rel=1e-7)
        assert tip[axis, about] == pytest.approx(sign * length**2 / (2.0 * bending), rel=1e-7)
        lateral = length**3 / (3.0 * bending) + 1.2 * length / (shear * area)
        assert tip[axis, axis] == pytest.approx(lateral, rel=1e-3)  # cubic, which the elements are not


@pytest.mark.exact
def test_free_beam() -> None:
    """Euler's free beam: f = (βL)² √(EI/(ρA))/(2πL²), βL = 4.7300, 7.8532; here 1/50 and 1/100 deep, in both planes."""
    hertz = natural_modes(beam(3000.0).mass, beam(3000.0).stiffness).hertz[6:]
    unit = np.sqrt(200e9 / 12.0 / 8000.0) / (2.0 * np.pi)
    expected = sorted(unit * deep * b**2 for deep in (0.01, 0.02) for b in (4.730041, 7.853205))
    assert hertz[:3] == pytest.approx(expected[:3], rel=5e-3)


@pytest.mark.property
def test_error_against_the_full_model() -> None:
    """Reduced frequencies lie above the full ones (Rayleigh), closer the more modes are kept."""
    errors = [reduction_error(beam(upper), 4).relative for upper in (100.0, 1000.0, 5000.0)]
    assert all((error > -1e-7).all() for error in errors)
    assert errors[0].max() > 10.0 * errors[1].max() > 100.0 * errors[2].max()
    assert errors[2].max() < 1e-3
    found = reduction_error(casing())
    assert (found.full <= 1000.0).all() or len(found.full) == 1
    assert np.abs(found.relative).max() < 0.02


@pytest.mark.property
@settings(max_examples=5, deadline=None)
@given(seeds)
def test_turning_the_body(seed: int) -> None:
    """Frequencies do not depend on the axes, nor where an interface's coordinates are."""
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    turn *= np.linalg.det(turn)
    mesh = bar((0.3, 0.05, 0.02), (6, 1, 1))
    hertz = []
    for points, at in ((mesh.points, (0.0, 0.0, 0.0)), (mesh.points @ turn.T + 0.7, (1.0, -2.0, 0.5))):
        body = solid_body(solid_mesh(points, mesh.elements, mesh.sets), STEEL)
        found = reduce(body, interfaces_of(body, {"left": at, "right": (0.1, 0.1, 0.1)}), 5000.0)
        hertz.append(natural_modes(found.mass, found.stiffness).hertz)
    assert hertz[1] == pytest.approx(hertz[0], rel=1e-7)
    assert (hertz[1][:6] == 0.0).all()


@pytest.mark.exact
def test_reading_of_rigid_motions() -> None:
    """A point reads u + θ × r, also when it is not a node, and θ itself."""
    found, at = casing(), (0.03, 0.125, 0.011)
    rows = reading(found, at) @ rigid_coordinates(found)
    assert rows[:3] == pytest.approx(rigid_motions(np.array([at]), np.zeros(3)), abs=1e-8)
    assert rows[3:, 3:] == pytest.approx(np.eye(3), abs=1e-6)


@pytest.mark.independent
def test_reading_of_bending() -> None:
    """On a facet of a beam held at one end, tip force: F x² (3L − x)/(6EI) and its slope (Euler)."""
    found = beam(100.0)
    force = np.zeros(found.size)
    force[8] = 1.0
    free = np.arange(6, found.size)
    motion = np.zeros(found.size)
    motion[free] = np.linalg.solve(found.stiffness[np.ix_(free, free)], force[free])
    moved = reading(found, (12.5 / 24.0, 0.01, 0.01)) @ motion
    at, bending = 12.5 / 24.0, 200e9 * 0.02 * 0.01**3 / 12.0
    assert moved[2] == pytest.approx(at**2 * (3.0 - at) / 6.0 / bending, rel=2e-3)
    assert moved[4] == pytest.approx(-(at - 0.5 * at**2) / bending, rel=2e-3)


@pytest.mark.property
def test_stiffer_material_scales_all_frequencies() -> None:
    """√10⁶ times the frequencies when E is 10⁶ times as large and as many modes are kept."""
    soft = beam(1000.0)
    body = solid_body(soft.body.mesh, Material(200e15, 0.0, 8000.0))
    hard = reduce(body, soft.interfaces, 1e6)
    assert hard.held_frequencies == pytest.approx(1e3 * soft.held_frequencies, rel=1e-9)
    squares = [eigh(r.stiffness, r.mass, eigvals_only=True)[6:] for r in (soft, hard)]
    assert squares[1] == pytest.approx(1e6 * squares[0], rel=1e-7)


@pytest.mark.exact
def test_interfaces_that_cannot_be() -> None:
    """None, unknown, overlapping, on a line, of all nodes: each says so."""
    body = solid_body(bar((0.3, 0.05, 0.02), (2, 1, 1)), STEEL)
    left, right = interfaces_of(body, _ends((0.3, 0.05, 0.02)))
    with pytest.raises(Infeasible, match="at least one interface"):
        reduce(body, ())
    with pytest.raises(TrochoidError, match="no set 'lft'; there are left, right"):
        interfaces_of(body, {"lft": (0.0, 0.0, 0.0)})
    with pytest.raises(Infeasible, match="left and all share 8 nodes"):
        reduce(body, (left, Interface("all", left.position, np.arange(len(body.mesh.points)))))
    with pytest.raises(Infeasible, match="line has 2 nodes on a line"):
        reduce(body, (left, Interface("line", right.position, right.nodes[:2])))
    rest = np.setdiff1d(np.arange(len(body.mesh.points)), left.nodes)
    with pytest.raises(Infeasible, match="hold every node"):
        reduce(body, (left, Interface("rest", right.position, rest)))
    with pytest.raises(TrochoidError, match="no interface 'up'"):
        casing().columns("up")


@pytest.mark.exact
def test_spread_mass() -> None:
    """The mass matrix is the same along each axis, and `weighed` multiplies by it."""
    body = beam(100.0).body
    motion = np.random.default_rng(0).normal(size=(body.size, 2))
    assert body.weighed(motion) == pytest.approx(spread(body.mass) @ motion, rel=1e-12, abs=1e-14)
