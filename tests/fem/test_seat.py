"""Rollers in a seat that yields: rigid limit, hole in a plate, ring theory, energy, invariants, and what is refused."""

from __future__ import annotations

import itertools
from functools import lru_cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.fem.cases import hole_in_plate_green, on_circle, small_mesh
from tests.fem.rolling_cases import DEEP
from trochoid.fem import bearing_equilibrium
from trochoid.fem.bearing import EXPONENT, RollerBearing, iso16281_constant
from trochoid.fem.body import build_body
from trochoid.fem.laws import PowerLaw
from trochoid.fem.material import Material, Plane, PlaneState
from trochoid.fem.pair import HolePair, Member, Seat
from trochoid.fem.position import Assembly, Family, seat_coupling, solve_position
from trochoid.fem.rolling_roller import RollerRow, logarithmic, row_of
from trochoid.fem.seat import (
    STEEL,
    FlexibleSeat,
    bore_motion,
    plain_rollers,
    roller_angles,
    roller_seat,
    seat_compliance,
    seat_of,
)
from trochoid.fem.seat_equilibrium import SeatedState, ring_stiffness, solve_seated
from trochoid.fem.seat_error import SeatReport, rigid_ring_error
from trochoid.fem.seat_ring import ring_outline, usual_facets
from trochoid.geometry.mesh import mesh_outline
from trochoid.geometry.outline import Loop, Outline
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.types import Array

BORE, WIDTH = 25e-3, 12e-3  # m
PLAIN = RollerBearing(rollers=16, roller_radius=3e-3, pitch_radius=22e-3, length=10e-3)
LOOSE = RollerBearing(rollers=16, roller_radius=3e-3, pitch_radius=22e-3, length=10e-3, clearance=30e-6)
TIGHT = RollerBearing(rollers=13, roller_radius=3e-3, pitch_radius=22e-3, length=10e-3, clearance=-6e-6)
FEET = ((np.radians(215), np.radians(235)), (np.radians(305), np.radians(325)))
DOWN = np.array([0.0, -5000.0])
ROUND: tuple[tuple[float, float], ...] = ()

bearings = st.sampled_from([PLAIN, LOOSE, TIGHT])
# no roller stands square to the load: without clearance it would touch without force, where laws have no derivative
directions = st.integers(0, 359).map(lambda v: float(np.radians(v + 0.4)))
angles = st.integers(0, 359).map(lambda v: float(np.radians(v)))
sizes = st.sampled_from([1.0, 300.0, 5e3, 1e5])


@lru_cache(maxsize=32)
def _seat(
    wall: float,
    facets: int,
    feet: tuple[tuple[float, float], ...] = FEET,
    state: PlaneState = "stress",
    scale: float = 1.0,
    free: bool = False,
) -> FlexibleSeat:
    """Return a ring about the bore, its wall in bore radii: on feet, held all round (ROUND), or free."""
    outline = ring_outline(scale * BORE, wall * scale * BORE, facets, feet)
    held = tuple(f"held{i}" for i in range(len(feet))) if feet else ("outer",)
    body = build_body(mesh_outline(outline), STEEL.plane(state), () if free else held)
    return seat_of(body, outline.holes[0], scale * WIDTH)


@lru_cache(maxsize=1)
def _cycloid_disc() -> FlexibleSeat:
    mesh, outline = small_mesh()
    bore = next(loop for loop in outline.loops if loop.name == "bore")
    return seat_of(build_body(mesh, STEEL.plane("strain")), bore, WIDTH)


def _seated(bearing: RollerBearing, seat: FlexibleSeat, load: Array, angle0: float = 0.0) -> SeatedState:
    matrix = seat_compliance(bearing, seat, float(np.linalg.norm(load)), angle0)
    return solve_seated(bearing, matrix, load, angle0)


def _radii(bearing: RollerBearing) -> Array:
    return on_circle(1.0, roller_angles(bearing))


def _without_motion(matrix: Array, bearing: RollerBearing) -> Array:
    """Take the motion of the bore as a whole out of a compliance (rollers, rollers)."""
    arms = _radii(bearing)
    rest = np.eye(bearing.rollers) - 2.0 / bearing.rollers * arms @ arms.T
    return np.asarray(rest @ matrix @ rest)


def _hole(plane: Plane, radius: float, angle: Array) -> Array:
    """Return the compliance (n, n) of a hole in an infinite plate, in closed form, on the diagonal S alone."""
    apart = angle[:, None] - angle
    matrix = hole_in_plate_green(plane, apart + np.eye(len(angle)))
    own = plane.kernel * (np.log(radius) - 0.75) + (0.75 * (plane.kolosov - 1) + 1) / (
        4 * np.pi * plane.shear
    )
    np.fill_diagonal(matrix, own)
    return matrix


def _ring_theory(plane: Plane, inner: float, wall: float, angle: float, terms: int = 60) -> float:
    """Return the radial displacement of a free ring at an angle from a unit radial force: Timoshenko's curved beam.

    Fourier series of w, v and the turning of sections, from stretching, shear (5/6) and bending about the mean radius,
    per unit width; without n = 1.
    """
    r, stretch = inner + 0.5 * wall, plane.modulus * wall
    shear, bend = 5.0 / 6.0 * plane.shear * wall, plane.modulus * wall**3 / 12.0
    total = r / stretch / (2.0 * np.pi)
    for n in range(2, terms):
        strain = np.array([1.0, n, 0.0]) / r
        slide, turn = np.array([-n / r, -1.0 / r, 1.0]), np.array([0.0, 0.0, n / r])
        pairs = zip((strain, slide, turn), (stretch, shear, bend), strict=True)
        stiffness = sum((k * np.outer(e, e) for e, k in pairs), start=np.zeros((3, 3)))
        total += np.linalg.solve(r * stiffness, [1.0 / np.pi, 0.0, 0.0])[0] * np.cos(n * angle)
    return float(total)


# --- limits -----------------------------------------------------------------------------------------------------------


@pytest.mark.exact
@settings(max_examples=30, deadline=None)
@given(bearings, sizes, directions, angles)
def test_seat_of_the_standard_is_the_rigid_ring(
    bearing: RollerBearing, size: float, direction: float, angle0: float
) -> None:
    """Nothing beyond the standard's seat: loads, displacement and 4×4 stiffness are those of `bearing_equilibrium`."""
    load = size * on_circle(1.0, np.array([direction]))[0]
    found = solve_seated(bearing, np.zeros((bearing.rollers,) * 2), load, angle0)
    rigid = bearing_equilibrium.solve(bearing, np.append(load, [0.0, 0.0]), angle0)
    assert found.loads == pytest.approx(rigid.roller_loads, rel=1e-6, abs=1e-7 * rigid.roller_loads.max())
    assert found.load == pytest.approx(load, abs=1e-9 * max(size, rigid.roller_loads.max()))
    assert found.stiffness == pytest.approx(rigid.stiffness, rel=1e-5, abs=1e-5 * rigid.stiffness[0, 0])


@pytest.mark.exact
def test_rigid_ring_is_reached_in_proportion_to_the_compliance() -> None:
    """A seat times λ: displacement and stiffness differ from the rigid ring's by O(λ), halved with λ."""
    seat = seat_compliance(PLAIN, _seat(0.25, 52), 5000.0)
    rigid = bearing_equilibrium.solve(PLAIN, np.append(DOWN, [0.0, 0.0]))
    states = [solve_seated(PLAIN, share * seat, DOWN) for share in (2e-4, 1e-4)]
    moved = [s.displacement[1] / rigid.displacement[1] - 1.0 for s in states]
    softer = [1.0 - s.stiffness[1, 1] / rigid.stiffness[1, 1] for s in states]
    for one, two in (moved, softer):
        assert one / two == pytest.approx(2.0, rel=2e-3)
        assert 1e-6 < two < 1e-3


@pytest.mark.exact
def test_thick_seat_becomes_a_hole_in_a_plate() -> None:
    """Muskhelishvili's hole in an infinite plate: what is left of the wall falls with (bore/edge)², to nothing."""
    plane, found = STEEL.plane("strain"), []
    closed = _without_motion(_hole(plane, BORE, roller_angles(PLAIN)), PLAIN)
    for far in (8.0, 16.0):
        seat = _seat(far - 1.0, 96, ROUND, "strain")
        weights, points = seat.places(roller_angles(PLAIN))
        found.append(_without_motion(seat.body.compliance.between(weights, points), PLAIN))
    one, two = (np.abs(f - closed).max() / np.ptp(closed) for f in found)
    limit = (4.0 * found[1] - found[0]) / 3.0
    assert 1.8 < np.log2(one / two) < 2.05
    assert limit == pytest.approx(closed, abs=1e-3 * np.ptp(closed))


@pytest.mark.exact
def test_thick_seat_shapes_the_bearing_as_the_plate_does() -> None:
    """The stiffness against the bore's mean motion tends to that of rollers on the plate's closed form, as fast."""
    plane, along, found = STEEL.plane("strain"), np.array([0.0, 1.0]), []
    for far in (8.0, 16.0):
        seat = _seat(far - 1.0, 96, ROUND, "strain")
        matrix = seat_compliance(PLAIN, seat, 5000.0)
        state = solve_seated(PLAIN, matrix, DOWN)
        found.append(ring_stiffness(PLAIN, state, matrix, bore_motion(PLAIN, seat), along))
    law, whole = roller_seat(PLAIN, seat), PowerLaw(iso16281_constant(PLAIN.length), EXPONENT)
    exchange = law.widening + law.seat_for_seat(whole, law.typical_load(5000.0))
    plate = _hole(plane, BORE, roller_angles(PLAIN)) / WIDTH + exchange * np.eye(16)
    first = _first_harmonic(plane) / WIDTH * _radii(PLAIN).T
    limit = ring_stiffness(PLAIN, solve_seated(PLAIN, plate, DOWN), plate, first, along)
    assert 1.7 < np.log2((found[0] - limit) / (found[1] - limit)) < 2.1
    assert (4.0 * found[1] - found[0]) / 3.0 == pytest.approx(limit, rel=1e-3)


def _first_harmonic(plane: Plane) -> float:
    """Return the mean motion of the bore, n = 1, that `hole_in_plate_green` holds per unit force, 1/Pa."""
    angle = 2 * np.pi * (np.arange(4096) + 0.5) / 4096
    return float(2.0 * np.mean(hole_in_plate_green(plane, angle) * np.cos(angle)))


@pytest.mark.exact
@pytest.mark.parametrize("state", ["strain", "stress"])
def test_mean_radial_motion_is_lames(state: PlaneState) -> None:
    """Lamé's thick cylinder, its outer edge held: ∫C(x, y) dx is the radial motion under unit pressure (1e-5)."""
    plane, wall = STEEL.plane(state), 0.5
    seat = _seat(wall, 96, ROUND, state)
    around = 2 * np.pi * np.arange(360) / 360
    weights, points = seat.places(around)
    smooth = seat.body.compliance.smooth(weights, points)
    np.fill_diagonal(smooth, smooth[0, 1])
    found = 2 * np.pi * BORE * (smooth.mean() - plane.kernel * np.log(BORE))
    a, b = BORE, (1 + wall) * BORE
    # u = A r + B/r, u(b) = 0, −σ_r(a) = −2(λ+G) A + 2G B/a² = 1
    lift = 1.0 / (2 * (plane.lame + plane.shear) / b**2 + 2 * plane.shear / a**2)
    assert found == pytest.approx(lift * (1 / a - a / b**2), rel=1e-3)


@pytest.mark.independent
def test_thin_free_ring_is_a_curved_beam() -> None:
    """Two loads seen across (±90°) and three seen between (60°, 180°), both in balance: beam theory, error O(wall²)."""
    errors = []
    for wall in (0.2, 0.1, 0.05):
        seat = _seat(wall, usual_facets(BORE, wall * BORE) // 2, ROUND, "stress", free=True)
        weights, points = seat.places(np.radians([0.0, 90.0, 60.0, 180.0]))
        c = seat.body.compliance.between(weights, points)[0]
        t = [_ring_theory(STEEL.plane("stress"), BORE, wall * BORE, np.radians(a)) for a in (90, 60, 180)]
        errors.append([c[1] / t[0] - 1, (2 * c[2] + c[3]) / (2 * t[1] + t[2]) - 1])
    size = np.abs(errors)
    assert (size[-1] < 2e-3).all()
    assert (size[:-1] / size[1:] > 2.5).all()


@pytest.mark.exact
def test_ring_theory_here_is_timoshenkos() -> None:
    """Thin ring under two opposite forces: across it moves by −(2/π − ½)/2·PR³/EI each side (Timoshenko)."""
    plane, wall = STEEL.plane("stress"), 1e-5
    bend = plane.modulus * (wall * BORE) ** 3 / 12
    printed = -0.5 * (2 / np.pi - 0.5) * BORE**3 / bend
    assert 2 * _ring_theory(plane, BORE, wall * BORE, np.pi / 2, 400) == pytest.approx(printed, rel=1e-4)


# --- equilibrium ------------------------------------------------------------------------------------------------------


@pytest.mark.independent
@pytest.mark.parametrize("bearing", [PLAIN, LOOSE, TIGHT])
@pytest.mark.parametrize("disc", [False, True])
def test_agrees_with_the_contacts_of_a_drive(bearing: RollerBearing, disc: bool) -> None:
    """The position solver with rollers in a hole, as in a K-H-V drive, gives the same seat, loads and stiffness.

    On the ring with feet, and in the bore of a free cycloid disc.
    """
    seat, load = _cycloid_disc() if disc else _seat(0.25, 52), np.array([2000.0, -5000.0])
    law, count = roller_seat(bearing, seat), bearing.rollers
    whole = PowerLaw(iso16281_constant(bearing.length), EXPONENT)
    matrix = seat_compliance(bearing, seat, float(np.linalg.norm(load)))
    weights, points = seat.places(roller_angles(bearing))
    exchange = matrix[0, 0] - seat.body.compliance.between(weights, points)[0, 0] / WIDTH
    pitch = BORE - bearing.roller_radius - 0.5 * bearing.clearance
    rollers = on_circle(pitch, roller_angles(bearing))
    pair = HolePair(
        Member(np.zeros(2), 0.0, np.zeros((3, 2))),
        Member(np.zeros(2), 0.0, np.eye(3, 2)),
        np.zeros((count, 2)),
        BORE,
        rollers,
        bearing.roller_radius,
        Seat.on(0, [seat.surface] * count),
    )
    family = Family("rollers", pair, np.full(count, 2 * law.kernel), np.full(count, exchange), whole)
    drive = Assembly((family,), (seat.body,), np.zeros((2, 2)), load, follow=False)
    contact, found = solve_position(drive), solve_seated(bearing, matrix, load)
    assert matrix == pytest.approx(seat_coupling(drive, family, np.zeros(2)), rel=1e-9)
    assert found.loads == pytest.approx(contact.touches["rollers"].force, abs=1e-6 * found.loads.max())
    assert found.displacement == pytest.approx(contact.motion, rel=1e-6)
    assert found.stiffness[:2, :2] == pytest.approx(contact.stiffness, rel=1e-5)


@pytest.mark.property
@settings(max_examples=25, deadline=None)
@given(bearings, sizes, directions, angles)
def test_balanced_pressed_and_stable(
    bearing: RollerBearing, size: float, direction: float, angle0: float
) -> None:
    """Loads balance, none pulls, gaps close exactly; the 4×4 is symmetric and positive semi-definite."""
    load = size * on_circle(1.0, np.array([direction]))[0]
    matrix = seat_compliance(bearing, _seat(0.25, 52), size, angle0)
    s = solve_seated(bearing, matrix, load, angle0)
    largest = s.loads.max()
    assert s.load == pytest.approx(load, abs=1e-9 * max(size, largest))
    assert (s.loads >= 0.0).all()
    closed = on_circle(1.0, s.angles) @ s.displacement - 0.5 * bearing.clearance - s.yielding
    own = (s.loads / iso16281_constant(bearing.length)) ** 0.9
    scale = np.abs(s.displacement).max() + abs(bearing.clearance)
    assert np.abs(closed - own)[s.loads > 0].max() < 1e-9 * scale
    assert closed[s.loads == 0].max(initial=0.0) < 1e-9 * scale
    assert np.array_equal(s.stiffness, s.stiffness.T)
    assert np.linalg.eigvalsh(s.stiffness).min() > -1e-9 * np.trace(s.stiffness)


@pytest.mark.exact
@pytest.mark.parametrize("bearing", [PLAIN, LOOSE, TIGHT])
def test_stiffness_and_energy_are_the_derivatives(bearing: RollerBearing) -> None:
    """With the seat as it is: F is the gradient of the energy, K that of F (central differences)."""
    matrix, load, step = seat_compliance(bearing, _seat(0.25, 52), 5385.0), np.array([2000.0, -5000.0]), 0.5
    state = solve_seated(bearing, matrix, load)
    moved = np.zeros((2, 2))
    for i, e in enumerate(np.eye(2)):
        plus, minus = (solve_seated(bearing, matrix, load + sign * step * e) for sign in (1, -1))
        moved[:, i] = (plus.displacement - minus.displacement) / (2 * step)
        work = load @ (plus.displacement - minus.displacement)
        assert plus.energy - minus.energy == pytest.approx(work, rel=1e-5)
    assert np.linalg.inv(moved) == pytest.approx(state.stiffness[:2, :2], rel=1e-5)


@pytest.mark.property
def test_scale_of_length_does_not_matter() -> None:
    """Lengths × 1000, forces × 10⁶ (metres read as millimetres): stresses and ratios stay, stiffness is × 1000."""
    big = RollerBearing(16, 3.0, 22.0, 10.0, clearance=30e-3)
    one, two = (
        _seated(LOOSE, _seat(0.25, 52), DOWN),
        _seated(big, _seat(0.25, 52, scale=1e3), 1e6 * DOWN),
    )
    assert two.loads == pytest.approx(1e6 * one.loads, rel=1e-7)
    assert two.displacement == pytest.approx(1e3 * one.displacement, rel=1e-7, abs=1e-12)
    assert two.stiffness[:2, :2] == pytest.approx(1e3 * one.stiffness[:2, :2], rel=1e-6, abs=1.0)


@pytest.mark.property
def test_turned_together_nothing_changes() -> None:
    """A ring held all round has no direction: load and rollers turned together (by no multiple of a facet)."""
    seat, turn = _seat(0.25, 52, ROUND), 0.3
    c, s = np.cos(turn), np.sin(turn)
    rotation = np.array([[c, -s], [s, c]])
    load = np.array([1000.0, -5000.0])
    one, two = _seated(PLAIN, seat, load), _seated(PLAIN, seat, rotation @ load, turn)
    assert two.loads == pytest.approx(one.loads, abs=2e-4 * one.loads.max())
    turned = rotation.T @ two.stiffness[:2, :2] @ rotation
    assert turned == pytest.approx(one.stiffness[:2, :2], rel=2e-4, abs=2e-4 * one.stiffness[0, 0])


@pytest.mark.property
def test_mirrored_feet_mirror_the_loads() -> None:
    """Feet, load and rollers are alike left and right."""
    state = _seated(PLAIN, _seat(0.25, 104), DOWN)
    mirrored = state.loads[(8 - np.arange(16)) % 16]
    assert state.loads == pytest.approx(mirrored, abs=1e-3 * state.loads.max())


# --- how wrong --------------------------------------------------------------------------------------------------------


@lru_cache(maxsize=16)
def _report(wall: float, feet: tuple[tuple[float, float], ...] = FEET) -> SeatReport:
    facets = usual_facets(BORE, wall * BORE)
    return rigid_ring_error(PLAIN, lambda n: _seat(wall, n, feet), facets, DOWN)


@pytest.mark.property
def test_thinner_walls_make_the_rigid_ring_more_wrong() -> None:
    """On the same feet, walls of 1/4, 1/2 and 1 bore radius; each step is beyond the errors of both numbers."""
    reports = [_report(w) for w in (0.25, 0.5, 1.0)]
    for thin, thick in itertools.pairwise(reports):
        assert (
            thin.stiffness.value - thin.stiffness.error > thick.stiffness.value + thick.stiffness.error > 1.0
        )


@pytest.mark.regression
@pytest.mark.parametrize(
    ("feet", "load", "stiffness", "shape", "largest"),
    [
        (FEET, DOWN, 1.499, 1.164, 1.064),
        (FEET, -DOWN, 2.962, 1.941, 0.8543),
        (FEET, np.array([5000.0, 0.0]), 3.195, 1.517, 2.207),
        (ROUND, DOWN, 1.029, 1.010, 0.9994),
    ],
)
def test_numbers_of_the_manual(
    feet: tuple[tuple[float, float], ...], load: Array, stiffness: float, shape: float, largest: float
) -> None:
    """docs/model.md, wall of a quarter of the bore's radius, to the errors given there."""
    facets = usual_facets(BORE, 0.25 * BORE)
    report = rigid_ring_error(PLAIN, lambda n: _seat(0.25, n, feet), facets, load, np.radians(4.0))
    found = (report.stiffness, report.shape, report.largest)
    assert [f.value for f in found] == pytest.approx([stiffness, shape, largest], abs=3e-3)
    assert max(f.error for f in found) <= 3.5e-3


@pytest.mark.property
def test_more_supports_never_soften() -> None:
    """The same ring held all round: its compliance is less for every set of roller loads."""
    feet, everywhere = (seat_compliance(PLAIN, _seat(0.25, 52, held), 5e3) for held in (FEET, ROUND))
    values = np.linalg.eigvalsh(feet - everywhere)
    assert values.min() > -2e-3 * values.max()


@pytest.mark.property
def test_softer_material_yields_more() -> None:
    """Half the modulus: more displacement, less stiffness along the load, more compliance in every mode."""
    outline = ring_outline(BORE, 0.25 * BORE, 52, FEET)
    mesh = mesh_outline(outline)
    seats = [
        seat_of(
            build_body(mesh, Material(e, 0.3).plane("stress"), ("held0", "held1")), outline.holes[0], WIDTH
        )
        for e in (210e9, 105e9)
    ]
    hard, soft = (_seated(PLAIN, seat, DOWN) for seat in seats)
    assert soft.displacement[1] < hard.displacement[1] < 0.0
    assert soft.stiffness[1, 1] < hard.stiffness[1, 1]
    less = seat_compliance(PLAIN, seats[1], 5e3) - seat_compliance(PLAIN, seats[0], 5e3)
    assert np.linalg.eigvalsh(less).min() > 0.0


@pytest.mark.property
@pytest.mark.parametrize("feet", [FEET, ROUND])
def test_error_brackets_a_finer_mesh(feet: tuple[tuple[float, float], ...]) -> None:
    """Four times the facets: all three numbers lie within the estimated errors."""
    report = _report(0.5, feet)
    facets = 4 * usual_facets(BORE, 0.5 * BORE)
    fine = rigid_ring_error(PLAIN, lambda n: _seat(0.5, n, feet), facets, DOWN)
    for one, two in zip(*((r.stiffness, r.shape, r.largest) for r in (report, fine)), strict=True):
        assert abs(one.value - two.value) <= one.error
        assert two.error < one.error
        assert one.error < 0.01 * one.value


# --- hard cases -------------------------------------------------------------------------------------------------------


@pytest.mark.exact
def test_no_load_with_clearance_is_open() -> None:
    """Nothing presses: no load, no stiffness, and it is said; there is no ratio of stiffnesses."""
    state = solve_seated(LOOSE, seat_compliance(LOOSE, _seat(0.25, 52), 0.0), np.zeros(2))
    assert state.touching == 0
    assert not state.stiffness.any()
    assert "open" in state.note
    with pytest.raises(TrochoidError, match="no roller carries"):
        rigid_ring_error(LOOSE, lambda n: _seat(0.25, n), 52, np.zeros(2))


@pytest.mark.exact
@pytest.mark.parametrize("size", [1e-6, 1.0])
def test_one_roller_carries(size: float) -> None:
    """Little load on a roller, in a bearing with clearance: a single force, and stiffness along it alone."""
    state = _seated(LOOSE, _seat(0.25, 52), np.array([size, 0.0]))
    assert state.touching == 1
    assert state.loads[0] == pytest.approx(size, rel=1e-9)
    assert "single roller" in state.note
    assert state.stiffness[0, 0] > 0.0
    assert abs(state.stiffness[1, 1]) < 1e-9 * state.stiffness[0, 0]
    report = rigid_ring_error(LOOSE, lambda n: _seat(0.25, n), 104, np.array([size, 0.0]))
    assert report.carrying == (1, 1)
    assert report.largest.value == pytest.approx(1.0, rel=1e-6)


@pytest.mark.exact
def test_preload_without_load() -> None:
    """Preload alone: the rollers press, the resultant vanishes."""
    state = _seated(TIGHT, _seat(0.25, 52), np.zeros(2))
    assert state.touching == 13
    assert np.abs(state.load).max() < 1e-9 * state.loads.max()


@pytest.mark.exact
def test_wall_thinner_than_facets_is_refused() -> None:
    """24 facets of 6.5 mm beside a wall of 2.5 mm; the number that it asks for is taken."""
    with pytest.raises(
        Infeasible, match=r"wall beside \"bore\" is 2\.5\d* mm thin .* give at least (6\d) facets"
    ):
        _seat(0.1, 24, ROUND)
    _seat(0.1, 64, ROUND)


@pytest.mark.exact
def test_what_no_plane_seat_carries_is_refused() -> None:
    """Balls, tapered and profiled rollers; a cylindrical row is taken."""
    taper = RollerRow(16, 6e-3, 44e-3, 10e-3, contact_angle=0.2)
    profiled = RollerRow(16, 6e-3, 44e-3, 10e-3, drop=logarithmic(6e-3, 10e-3))
    with pytest.raises(Infeasible, match="BallBearing presses its seat at points"):
        plain_rollers(DEEP)
    for row in (taper, profiled):
        with pytest.raises(Infeasible, match="straight steel rollers at contact angle 0"):
            plain_rollers(row)
    assert plain_rollers(row_of(LOOSE)) == LOOSE


@pytest.mark.exact
def test_what_does_not_fit_is_refused() -> None:
    """Rollers longer than the body, of another circle, a bore that is no hole, arcs that overlap, bad numbers."""
    seat = _seat(0.25, 52)
    with pytest.raises(Infeasible, match="at least as wide as the rollers"):
        seat_compliance(RollerBearing(16, 3e-3, 22e-3, 13e-3), seat, 1e3)
    with pytest.raises(Infeasible, match="nearest is a pitch radius of 22 mm"):
        seat_compliance(RollerBearing(16, 3e-3, 21e-3, 10e-3), seat, 1e3)
    disc = Loop("rim", Circle((0.0, 0.0), BORE), 24)
    with pytest.raises(Infeasible, match="must be a round hole"):
        seat_of(build_body(mesh_outline(Outline(disc)), STEEL.plane("stress")), disc, WIDTH)
    with pytest.raises(Infeasible, match="end before the next one"):
        ring_outline(BORE, 5e-3, 52, ((0.0, 1.0), (0.5, 1.5)))
    with pytest.raises(Infeasible, match="positive and finite"):
        ring_outline(BORE, -5e-3, 52)
    with pytest.raises(TrochoidError, match="two finite numbers"):
        solve_seated(PLAIN, np.zeros((16, 16)), np.array([np.nan, 0.0]))
    with pytest.raises(TrochoidError, match="for each of 16 rollers"):
        solve_seated(PLAIN, np.zeros((3, 3)), DOWN)
    with pytest.raises(Infeasible, match="stiffer than all of the contact"):
        solve_seated(PLAIN, -1e-8 * np.eye(16), DOWN)
