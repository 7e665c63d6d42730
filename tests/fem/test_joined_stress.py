"""Half-plane and finite elements joined: below contacts that the mesh does not resolve, with strips and friction."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

from tests.fem.cases import RADIUS, STEEL, on_circle, round_disc, small_mesh
from tests.fem.test_strip_stress import hertz_strips
from trochoid.fem import flamant
from trochoid.fem.body import Body, build_body
from trochoid.fem.elasticity import nodal_stress
from trochoid.fem.hertz import hertz_stress_in_plane, max_shear, von_mises
from trochoid.fem.locate import located
from trochoid.fem.stress import Press, State, basis, contact_stress, sample, solve_state
from trochoid.fem.stress_field import StressField, stress_field
from trochoid.fem.stress_peak import depth
from trochoid.fem.strips import REACH, strip_centres
from trochoid.kinematics.types import Array

LOAD, ANGLE, FACETS = 1e6, 0.4, 48
FACET = 2 * np.pi * RADIUS / FACETS


def squeezed(half_width: float, strips: bool, friction: float = 0.0, angle: float = ANGLE) -> list[Press]:
    """Return two opposite contacts that rub alike, so that the disc would turn: its inertia holds it."""
    shares = hertz_strips() / hertz_strips().sum() if strips else np.zeros(0)
    offset = REACH * half_width * strip_centres() if strips else np.zeros(0)
    places = np.array([angle, angle + np.pi])
    return [
        Press("rim", float(t), n, LOAD, half_width, friction * LOAD, offset, LOAD * shares)
        for t, n in zip(places, on_circle(1.0, places), strict=True)
    ]


def exact(points: Array, half_width: float, angle: float = ANGLE) -> Array:
    """Return the stress (n, 3) of the squeezed disc: Hertz here, Flamant from the far side, P/(πR)."""
    near, far = on_circle(RADIUS, np.array([angle, angle + np.pi]))
    here = hertz_stress_in_plane(points, near, -near / RADIUS, half_width, LOAD)
    there = flamant.stress(points - far, -LOAD * far / RADIUS)
    return np.asarray(here + there + LOAD / (np.pi * RADIUS) * np.array([1.0, 1.0, 0.0]))


def at(state: State, points: Array) -> Array:
    """Return the stress (n, 3) of a state at points (n, 2) close together."""
    mesh = state.body.mesh
    corners = mesh.points[mesh.triangles[:3].T]
    size = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=-1).max(axis=1)
    middle, reach = points.mean(axis=0), np.linalg.norm(points - points.mean(axis=0), axis=1).max()
    near = np.flatnonzero(np.linalg.norm(corners.mean(axis=1) - middle, axis=1) < reach + size)
    elements, reference = located(mesh, near, points)
    found, _, stress = sample(state, elements, basis(reference)[:, None])
    np.testing.assert_allclose(found[:, 0], points, atol=1e-9)
    return stress[:, 0]


def under(depths: Array, angle: float = ANGLE) -> Array:
    """Return points (n, 2) at these depths in m under the contact."""
    return (RADIUS - depths)[:, None] * on_circle(1.0, np.array([angle]))


@pytest.mark.published
@pytest.mark.parametrize("strips", [False, True])
@pytest.mark.parametrize("coarseness", [5.0, 20.0, 100.0])
def test_peaks_below_a_contact_that_the_mesh_does_not_see(coarseness: float, strips: bool) -> None:
    """Facets many times the contact: 0.300 p0 at 0.786 a, von Mises 0.558 p0 at 0.70 a, shifted by the disc."""
    half = FACET / coarseness
    field = stress_field(round_disc(FACETS)[0], squeezed(half, strips))
    line = np.linspace(0.2, 1.5, 5201) * half
    stress = exact(under(line), half)
    for measure, peak, least, low in (
        (max_shear, field.max_shear_peak, 0.300283, 0.786),
        (von_mises, field.von_mises_peak, 0.5577, 0.70),
    ):
        values = measure(stress, STEEL)
        assert peak.value == pytest.approx(values.max(), rel=5e-3)
        assert peak.depth == pytest.approx(line[values.argmax()], rel=0.02)
        if coarseness >= 20:  # where the disc is large beside the contact: the half-plane's numbers, to 1 %
            assert peak.value == pytest.approx(least * 2 * LOAD / (np.pi * half), rel=0.01)
            assert peak.depth == pytest.approx(low * half, rel=0.02)


@pytest.mark.exact
@pytest.mark.parametrize("angle", [0.0, 0.4, 0.4 + np.pi / FACETS])
def test_field_under_the_contact(angle: float) -> None:
    """Every component down to six facets below the contact within 0.5 % of p0, and of its size there from 1 a on."""
    half = FACET / 20
    state = solve_state(round_disc(FACETS)[0], squeezed(half, strips=True, angle=angle))
    for low, high in ((0.02, 1.0), (1.0, 8.0), (8.0, 120.0)):
        points = under(np.linspace(low, high, 40) * half, angle)
        truth = exact(points, half, angle)
        assert np.abs(at(state, points) - truth).max() < 5e-3 * np.abs(truth).max() + 1e-3 * LOAD / RADIUS


@pytest.mark.exact
def test_peak_is_a_node_and_no_place_is_higher() -> None:
    """The file's largest value is the peak, and no point of a fine grid below the contacts is 0.1 % above it."""
    half = FACET / 20
    presses = squeezed(half, strips=True)
    body = round_disc(FACETS)[0]
    field, state = stress_field(body, presses), solve_state(body, presses)
    x, z = (a.ravel() for a in np.meshgrid(np.linspace(-1, 1, 81) * half, np.linspace(0.05, 2.0, 118) * half))
    outward = on_circle(1.0, np.array([ANGLE]))[0]
    points = (RADIUS - z)[:, None] * outward + x[:, None] * np.array([-outward[1], outward[0]])
    grid = at(state, points)
    for measure, values, peak in (
        (von_mises, field.von_mises, field.von_mises_peak),
        (max_shear, field.max_shear, field.max_shear_peak),
    ):
        assert values[peak.node] == peak.value
        assert values[np.unique(field.triangles)].max() == peak.value
        np.testing.assert_array_equal(field.points[peak.node], peak.place)
        assert measure(grid, STEEL).max() <= peak.value * (1 + 1e-3)
        assert peak.depth == pytest.approx(RADIUS - np.linalg.norm(peak.place), rel=1e-3)


@pytest.mark.independent
def test_largest_shear_from_principal_stresses() -> None:
    """Half the largest difference of the three eigenvalues of the stress tensor."""
    field = stress_field(round_disc(FACETS)[0], squeezed(FACET / 20, True, 0.2))
    tensor = np.zeros((len(field.stress), 3, 3))
    tensor[:, 0, 0], tensor[:, 1, 1], tensor[:, 2, 2] = field.stress[:, :3].T
    tensor[:, 0, 1] = tensor[:, 1, 0] = field.stress[:, 3]
    principal = np.linalg.eigvalsh(tensor)
    np.testing.assert_allclose(field.max_shear, 0.5 * (principal[:, 2] - principal[:, 0]), rtol=1e-9)


@lru_cache(maxsize=1)
def resolved_body() -> Body:
    """Return a disc whose facets are a sixth of the contact's half width."""
    return round_disc(720)[0]


@pytest.mark.independent
@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_against_a_resolved_mesh(friction: float) -> None:
    """Hertz's tractions, with friction, laid on the nodes of a mesh that resolves them; no closed form is used there.

    Both measures' largest value below the surface to 0.5 %, every component to 1 % of p0 in the mean: element stresses
    of the resolved mesh scatter by 2 %, and a half-plane leaves out the curvature, a/R = 5 % here, at the edges.
    """
    half = 6 * 2 * np.pi * RADIUS / 720
    fine = resolved_body()
    loads = np.zeros((fine.size, 1))
    nodes, weights = np.polynomial.legendre.leggauss(12)
    x = 0.5 * (nodes + 1)
    shape = np.stack([(1 - x) * (1 - 2 * x), x * (2 * x - 1), 4 * x * (1 - x)], axis=-1)
    slope = np.stack([4 * x - 3, 4 * x - 1, 4 - 8 * x], axis=-1)
    edge = fine.mesh.edges["rim"]
    place = shape @ fine.mesh.points[edge.T]  # (k, q, 2)
    arc = np.linalg.norm(slope @ fine.mesh.points[edge.T], axis=-1) * 0.5 * weights
    for side in (1.0, -1.0):
        outward = side * on_circle(1.0, np.array([ANGLE]))[0]
        tangent = np.array([-outward[1], outward[0]])
        along = place @ tangent
        inside = np.maximum(1 - (along / half) ** 2, 0.0) * (place @ outward > 0)
        density = arc * np.sqrt(inside)
        density *= LOAD / density.sum()
        force = density[..., None] * (friction * tangent - outward)
        nodal = np.einsum("kqi,qa->kai", force, shape)
        np.add.at(loads[:, 0].reshape(-1, 2), edge.T, nodal)
    relief = fine.relief
    assert relief is not None
    loads -= relief.weighted @ np.linalg.solve(relief.gram, relief.modes.T @ loads)
    moved = fine.solve(loads).reshape(-1, 2)[fine.mesh.triangles.T]
    true = nodal_stress(fine.mesh, STEEL, moved)

    coarse = round_disc(60)[0]  # facets twice the contact's half width
    x, z = (a.ravel() for a in np.meshgrid(np.linspace(-1.5, 1.5, 25), np.linspace(0.25, 4.0, 31)))
    outward = on_circle(1.0, np.array([ANGLE]))[0]
    points = (RADIUS - half * z)[:, None] * outward + half * x[:, None] * np.array([-outward[1], outward[0]])
    near = np.flatnonzero(np.linalg.norm(fine.parts.centroids - points.mean(axis=0), axis=1) < 6 * half)
    elements, reference = located(fine.mesh, near, points)
    expected = np.einsum("na,nai->ni", basis(reference), true[elements])
    for strips in (False, True):
        found = at(solve_state(coarse, squeezed(half, strips, friction)), points)
        difference = np.sqrt(np.mean((found - expected) ** 2, axis=0))
        assert difference.max() < 0.01 * 2 * LOAD / (np.pi * half)
        for measure in (von_mises, max_shear):
            assert measure(found, STEEL).max() == pytest.approx(measure(expected, STEEL).max(), rel=5e-3)


@pytest.mark.property
def test_a_turned_disc_has_the_turned_field() -> None:
    """By whole facets, strips and friction with it: the same peaks at the same depth."""
    body, step = round_disc(FACETS)[0], 2 * np.pi / FACETS

    def solved(angle: float) -> StressField:
        return stress_field(body, squeezed(FACET / 20, True, 0.25, angle))

    one, other = solved(0.3), solved(0.3 + 8 * step)
    for a, b in ((one.von_mises_peak, other.von_mises_peak), (one.max_shear_peak, other.max_shear_peak)):
        assert a.value == pytest.approx(b.value, rel=2e-3)
        assert a.depth == pytest.approx(b.depth, rel=0.01)  # the peak is flat


@pytest.mark.property
def test_millimetres() -> None:
    """The same disc in millimetres (N/mm, MPa): a millionth of the numbers, the same depth in its own unit."""
    loads = squeezed(FACET / 20, True, 0.2)
    milli = replace(STEEL, modulus=STEEL.modulus * 1e-6, shear=STEEL.shear * 1e-6)
    other = [
        replace(
            p,
            load=p.load * 1e-3,
            tangential=p.tangential * 1e-3,
            half_width=p.half_width * 1e3,
            offset=p.offset * 1e3,
            strips=p.strips * 1e-3,
        )
        for p in loads
    ]
    one = stress_field(round_disc(FACETS)[0], loads).max_shear_peak
    two = stress_field(round_disc(FACETS, RADIUS * 1e3, milli)[0], other).max_shear_peak
    assert 1e6 * two.value == pytest.approx(one.value, rel=1e-6)
    assert 1e-3 * two.depth == pytest.approx(one.depth, rel=1e-4)


@pytest.mark.exact
def test_strips_in_a_hole_run_against_the_tangent() -> None:
    """On a hole the parameter grows against t = (−n_y, n_x): pressure on the side of larger parameters stays there."""
    body = drilled_body()
    centre, radius, t = np.array([0.052, 0.0]), 0.009, 0.7
    outward = -on_circle(1.0, np.array([t]))[0]  # out of the body: to the hole's middle
    half = 1e-4
    offset = REACH * half * strip_centres()
    for side in (1.0, -1.0):
        strips = np.where(side * offset > 0, LOAD / 13, 0.0)
        state = solve_state(body, [Press("hole0", t, outward, LOAD, half, 0.0, offset, strips)])
        angles = t + np.array([1, -1]) * 0.6 * half / radius
        points = centre + on_circle(radius + 0.1 * half, angles)
        there, other = contact_stress(state.presses[0], state.loads[0], points)
        loaded, free = (there, other) if side > 0 else (other, there)
        assert np.abs(loaded).max() > 2 * np.abs(free).max()


@lru_cache(maxsize=1)
def drilled_body() -> Body:
    """Return the coarse disc with bore and holes."""

    return build_body(small_mesh()[0], STEEL)


@pytest.mark.exact
def test_depth_is_the_distance_from_the_nearest_edge() -> None:
    """In a disc: what is left of its radius; the quadratic edge of 48 facets is 1e-7 of it off the circle."""
    mesh = round_disc(FACETS)[0].mesh
    for r in (0.0, 0.03, 0.049, 0.05 - 1e-5):
        place = on_circle(r, np.array([1.1]))[0]
        assert depth(mesh, place) == pytest.approx(RADIUS - r, abs=3e-6 * RADIUS)
