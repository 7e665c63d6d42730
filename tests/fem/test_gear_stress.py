"""Line contact beside an edge, stress in fillets, load over the face width."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from tests.fem.gear_cases import LINE_LOAD, WIDTH, sun_planet
from trochoid.fem.edge_law import EdgeLine, centroid
from trochoid.fem.gear_pair import GearPair
from trochoid.fem.gear_path import Mating, Path, base_pitch, mating_assembly, solve_path
from trochoid.fem.gear_root import Loaded, largest, pair_loads, root_stress, root_table, tooth_stress
from trochoid.fem.gear_slices import Lead, solve_face
from trochoid.fem.laws import HertzLine
from trochoid.fem.stress import Press, basis, sample, solve_state
from trochoid.fem.stress_field import NODES
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array

KERNEL, RADIUS, ROUNDING = 1.5e-10, 5e-3, 1e-9  # m/N, m: a sharp edge


def _edge(inside: float, rounding: float = ROUNDING) -> EdgeLine:
    return EdgeLine(np.array([KERNEL]), np.array([RADIUS]), np.array([inside]), np.array([rounding]))


@pytest.mark.exact
def test_far_inside_the_edge_it_is_hertz() -> None:
    """Exact: approach, slope, width and peak of Hertz's line contact, and no jump where the edge begins to cut."""
    force = np.array([4000.0])
    hertz = HertzLine(np.array([KERNEL]), np.array([RADIUS]))
    a = float(hertz.half_width(force)[0])
    for inside in (3 * a, a * (1 + 1e-9), a * (1 - 1e-9)):
        law = _edge(inside, 4e-5)
        np.testing.assert_allclose(law.approach(force), hertz.approach(force), rtol=1e-7)
        np.testing.assert_allclose(law.half_width(force), a, rtol=1e-7)
        np.testing.assert_allclose(law.peak(force), hertz.peak(force), rtol=1e-7)
        np.testing.assert_allclose(centroid(a, np.array([inside])), inside, rtol=1e-7)


@pytest.mark.exact
@pytest.mark.parametrize("share", [0.7, 0.0, -0.5, -4.0])
def test_cut_parabola_presses_and_opens_as_it_should(share: float) -> None:
    """Exact: the pressure's force, and its logarithmic potential at two places, by quadrature; dh/dF by differences."""
    force = 4000.0
    a = np.sqrt(2 * KERNEL * RADIUS * force)
    x, law = share * a, _edge(share * a)
    b = 2 * float(law.half_width(np.array([force]))[0])
    factor = 1 / (np.pi * KERNEL * RADIUS)  # p = E*/(2R) sqrt((b − s)/s)(s + b/2 − x), E* = 2/(πA)

    def pressure(u: float) -> float:
        s = b * np.sin(u) ** 2
        return float(factor * 2 * b * np.cos(u) ** 2 * (s + b / 2 - x))

    whole = quad(pressure, 0, np.pi / 2)[0]
    assert whole == pytest.approx(force, rel=1e-9)

    def deflection(at: float) -> float:
        knot = np.arcsin(np.sqrt(at / b))
        integral = quad(
            lambda u: pressure(u) * np.log(abs(b * np.sin(u) ** 2 - at) + 1e-300),
            0,
            np.pi / 2,
            points=[knot] if 0 < at < b else None,
            limit=400,
        )[0]
        return float(-KERNEL * integral)

    h = float(law.approach(np.array([force]))[0][0])
    vertex = max(x, 0.0)
    for at in (0.0, 0.3 * b, 0.8 * b):
        gap = ((at - x) ** 2 - (vertex - x) ** 2) / (2 * RADIUS)
        assert deflection(at) == pytest.approx(h - gap, rel=2e-6)
    middle = quad(lambda u: pressure(u) * b * np.sin(u) ** 2, 0, np.pi / 2)[0] / force
    assert float(centroid(float(a), np.array([x]))[0]) == pytest.approx(middle, rel=1e-9)


@pytest.mark.exact
@pytest.mark.parametrize("inside", [2e-4, 3e-5, 0.0, -1e-5, -3e-4])
def test_slope_is_the_derivative(inside: float) -> None:
    """Exact: with a rounded edge too, from little to heavy load, and positive."""
    law = _edge(inside, 4e-5)
    for force in (1.0, 100.0, 4000.0, 1e5):
        f, d = np.array([force]), np.array([1e-4 * force])
        slope = (law.approach(f + d)[0] - law.approach(f - d)[0]) / (2 * d)
        np.testing.assert_allclose(law.approach(f)[1], slope, rtol=1e-6)
        assert slope > 0
        assert law.peak(f) > 0
        assert law.reach(f) >= law.half_width(f) * (1 - 1e-12)


def _solved(level: int) -> tuple[Mating, Path]:
    mating = sun_planet(level)
    return mating, solve_path(mating, base_pitch(mating, 40))


def _on_flanks(path: Path) -> Array:
    edge = path.contact.touches["mesh0"].state.edge
    assert edge is not None
    return np.asarray((np.where(path.force > 0, edge[..., 0], 1.0) > 0).all(axis=1))


def _largest_stress(mating: Mating, path: Path, gear: int) -> Array:
    pair = mating_assembly(mating, path.angle).families[0].pair
    assert isinstance(pair, GearPair)
    loaded = pair_loads(pair, path.contact.touches["mesh0"].state, path.force, bool(gear))
    return tooth_stress(root_table(mating.wheels[gear].body), loaded, WIDTH)


@pytest.mark.regression
@pytest.mark.parametrize("gear", [0, 1])
def test_root_stress_converges_to_one_percent(gear: int) -> None:
    """Regression: the largest tension over a base pitch, 6, 12 and 20 facets per flank; about twice F/(b m)."""
    found = [float(_largest_stress(*_solved(level), gear).max()) for level in (6, 12, 20)]
    assert found[1] == pytest.approx(found[2], rel=1e-2)
    assert found[0] == pytest.approx(found[2], rel=3e-2)
    assert 1.8 < found[2] / (LINE_LOAD / 2e-3) < 3.2


@pytest.mark.independent
def test_root_stress_is_that_of_the_whole_field() -> None:
    """Independent: the stress that a whole solution with the contact's patch leaves in the fillets' elements."""
    mating, _ = _solved(12)
    gear = mating.wheels[0].body
    table, mesh = root_table(gear), gear.body.mesh
    s = float(gear.flank.positions[len(gear.flank.positions) // 2])
    rho = np.sqrt(2 * gear.blank.tooth.gear.base_radius * s)
    t = float(gear.blank.boundary.parameter(rho))
    press = Press("teeth", t, gear.blank.boundary.normal(t), 1e5, 1e-5)
    state = solve_state(gear.body, [press])
    ends = mesh.parameters["teeth"]
    for k in np.flatnonzero(np.abs(table.parameters - 0.16) < 0.045):
        facet = int(np.flatnonzero(ends[2] == table.parameters[k])[0])
        middle = mesh.edges["teeth"][2, facet]
        element = int(np.flatnonzero((mesh.triangles[3:] == middle).any(axis=0))[0])
        place = int(np.flatnonzero(mesh.triangles[:, element] == middle)[0])
        stress = sample(state, np.array([element]), basis(NODES)[None, place][:, None])[2][0, 0]
        along = gear.blank.boundary.tangent(table.parameters[k])
        pulled = along @ np.array([[stress[0], stress[2]], [stress[2], stress[1]]]) @ along
        one = Loaded(np.zeros((1, 1), dtype=np.intp), 1, np.array([[s]]), np.array([[1e5]]))
        found = root_stress(table, [one], np.zeros(1, dtype=np.intp), 1.0)[0, k]
        assert found == pytest.approx(pulled, rel=0.03)


@pytest.mark.exact
def test_largest_of_a_parabola() -> None:
    """Exact: the top of a parabola through three places, wherever it lies between them."""
    k = np.arange(9.0)
    for top in (3.2, 4.0, 4.49):
        assert largest(5.0 - (k - top) ** 2)[None][0] == pytest.approx(5.0, abs=1e-12)
    assert largest(k) == pytest.approx(8.0)


@pytest.mark.property
def test_slices_alike_are_the_plane_pair() -> None:
    """Property: without misalignment every slice carries the same and the error is the plane model's."""
    mating = sun_planet()
    angle = base_pitch(mating, 7)
    plane, face = solve_path(mating, angle), solve_face(mating, angle, Lead(slices=5))
    np.testing.assert_allclose(face.error, plane.error, rtol=1e-7)
    np.testing.assert_allclose(face.stiffness, plane.stiffness, rtol=1e-6)
    np.testing.assert_allclose(face.factor, 1.0, rtol=1e-9)
    np.testing.assert_allclose(face.line_load.mean(axis=2), plane.force / WIDTH, atol=1e-6 * LINE_LOAD)


@pytest.mark.exact
def test_little_misalignment_tilts_the_load_in_proportion() -> None:
    """Exact: with uncoupled slices of stiffness k the load is F/b ± k f/2 (to first order in the misalignment f)."""
    mating = sun_planet()
    angle = base_pitch(mating, 7)
    plane = solve_path(mating, angle)
    lead = Lead(misalignment=1e-7, slices=9)
    face = solve_face(mating, angle, lead)
    load = face.line_load.sum(axis=1)
    slope = (load[:, -1] - load[:, 0]) / (lead.place[-1] - lead.place[0])
    clear = _on_flanks(plane)  # a tip edge about to touch does so at one end first
    assert clear.sum() >= 4
    np.testing.assert_allclose(-slope[clear], plane.stiffness[clear] / WIDTH * 1e-7, rtol=1e-3)
    # the middle slice is as open as in the plane pair
    np.testing.assert_allclose(face.error - 0.5e-7 * 8 / 9, plane.error, rtol=1e-4)


@pytest.mark.property
def test_crown_and_misalignment_over_the_face() -> None:
    """Property: a crown loads the middle, misalignment one end, together they share; loads always sum to the whole."""
    mating = sun_planet()
    angle = base_pitch(mating, 5)
    crowned = solve_face(mating, angle, Lead(0.0, 10e-6, 9))
    np.testing.assert_allclose(crowned.line_load, crowned.line_load[..., ::-1], rtol=1e-7, atol=1e-3)
    assert (crowned.line_load.sum(axis=1).argmax(axis=1) == 4).all()
    tilted = solve_face(mating, angle, Lead(30e-6, 0.0, 9))
    assert (np.diff(tilted.line_load.sum(axis=1), axis=1) <= 0).all()
    assert (tilted.factor > 1.5).all()
    both = solve_face(mating, angle, Lead(30e-6, 10e-6, 9))
    assert (both.factor < tilted.factor).all()
    for face in (crowned, tilted, both):  # on tip edges forces are inclined a little
        np.testing.assert_allclose(face.line_load.sum(axis=1).mean(axis=1), LINE_LOAD, rtol=5e-3)
    with pytest.raises(Infeasible, match="0 slices"):
        Lead(slices=0)
