"""The cycloid flank against the motion that generates it, closed forms and printed numbers."""

import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from trochoid.kinematics.cycloid import Cycloid, Modification, gap, gap_first_order
from trochoid.kinematics.errors import Infeasible

Array = npt.NDArray[np.float64]
EXAMPLE = Cycloid(20, 19, 0.08, 0.005, 0.0025)
RV40 = Cycloid(40, 39, 0.064, 0.003, 0.0013)


@st.composite
def cycloids(draw: st.DrawFn) -> Cycloid:
    """Feasible profiles of 4 to 120 pins, K from 0.02 to 0.98, the pin up to 99.9 % of its limit."""
    pins = draw(st.integers(4, 120))
    k = draw(st.floats(0.02, 0.98))
    radius = 10.0 ** draw(st.floats(-2.0, 0.0))
    thin = Cycloid(pins, pins - 1, radius, 1e-6 * radius, k * radius / pins)
    limit = min(thin.undercut_radius, radius * math.sin(math.pi / pins))
    return Cycloid(pins, pins - 1, radius, draw(st.floats(0.02, 0.999)) * limit, thin.eccentricity)


def plane(z: npt.NDArray[np.complex128]) -> Array:
    return np.stack((z.real, z.imag), axis=-1)


def turned(points: Array, angle: npt.ArrayLike) -> Array:
    return plane((points[..., 0] + 1j * points[..., 1]) * np.exp(1j * np.asarray(angle)))


def posed(cycloid: Cycloid, points: Array, crank: Array) -> Array:
    """Carry points of the disc to the ring's frame: turned by −φ/z_c, centre at e(cos φ, sin φ)."""
    center = cycloid.eccentricity * np.stack((np.cos(crank), np.sin(crank)), axis=-1)
    return turned(points, -crank / cycloid.lobes) + center


def pins_of(cycloid: Cycloid) -> Array:
    angle = 2.0 * math.pi * np.arange(cycloid.pins) / cycloid.pins
    return cycloid.pin_circle_radius * np.stack((np.cos(angle), np.sin(angle)), axis=-1)


@pytest.mark.property
@given(cycloid=cycloids(), seed=st.integers(0, 2**32 - 1))
@settings(max_examples=60, deadline=None)
def test_every_pin_touches_the_flank_at_every_crank_angle(cycloid: Cycloid, seed: int) -> None:
    """Conjugacy: point and normal at the contact parameter lead to the pin centre, r away, within 1e-12 R.

    The common normal also goes through the pitch point e z_p (cos φ, sin φ) (law of gearing).
    """
    crank = np.random.default_rng(seed).uniform(-20.0, 20.0, (12, 1))
    t = cycloid.contact_parameter(np.arange(cycloid.pins), crank)
    pins, scale = pins_of(cycloid), cycloid.pin_circle_radius
    contact = posed(cycloid, cycloid.point(t), crank)
    normal = turned(cycloid.normal(t), -crank / cycloid.lobes)
    assert np.abs(contact + cycloid.pin_radius * normal - pins).max() < 1e-12 * scale
    pitch = cycloid.eccentricity * cycloid.pins * np.stack((np.cos(crank), np.sin(crank)), axis=-1)
    arm = pitch - contact
    assert np.abs(arm[..., 0] * normal[..., 1] - arm[..., 1] * normal[..., 0]).max() < 1e-12 * scale


@pytest.mark.property
@given(cycloid=cycloids(), seed=st.integers(0, 2**32 - 1))
@settings(max_examples=20, deadline=None)
def test_no_pin_cuts_into_the_disc(cycloid: Cycloid, seed: int) -> None:
    """At any crank angle no flank point is nearer to any pin centre than r."""
    crank = np.random.default_rng(seed).uniform(0.0, 2.0 * math.pi)
    t = np.linspace(0.0, 2.0 * math.pi, 60 * cycloid.lobes)
    flank = posed(cycloid, cycloid.point(t), np.array([crank]))
    away = np.linalg.norm(flank[:, None] - pins_of(cycloid), axis=-1)
    assert away.min() > cycloid.pin_radius - 1e-12 * cycloid.pin_circle_radius


@pytest.mark.independent
def test_tangent_speed_and_curvature_are_those_of_the_points() -> None:
    """Spectral derivatives of the points (FFT over a round) know no formula for normal or curvature."""
    for cycloid in (EXAMPLE, RV40, Cycloid(7, 6, 0.03, 0.004, 0.0025)):
        n = 1 << 15
        t = 2.0 * math.pi * np.arange(n) / n
        wave = 1j * np.fft.fftfreq(n, 1.0 / n)
        points = cycloid.point(t)
        spectrum = np.fft.fft(points[:, 0] + 1j * points[:, 1])
        spectrum[np.abs(spectrum) < 1e-13 * np.abs(spectrum).max()] = 0.0
        first, second = np.fft.ifft(wave * spectrum), np.fft.ifft(wave**2 * spectrum)
        speed = np.abs(first)
        np.testing.assert_allclose(cycloid.speed(t), speed, rtol=1e-8)
        np.testing.assert_allclose(cycloid.tangent(t), plane(first / speed), atol=1e-8)
        np.testing.assert_allclose(cycloid.normal(t), plane(-1j * first / speed), atol=1e-8)
        bend = (first.conj() * second).imag / speed**3
        np.testing.assert_allclose(cycloid.curvature(t), bend, atol=1e-6 * np.abs(bend).max())


@pytest.mark.property
@given(cycloid=cycloids())
@settings(max_examples=40, deadline=None)
def test_symmetries_of_the_flank(cycloid: Cycloid) -> None:
    """Mirror symmetry about valley and crest, one lobe like the next, closed after a period."""
    t = np.linspace(0.0, 1.0, 50)
    mirror, scale = np.array([1.0, -1.0]), cycloid.pin_circle_radius
    pitch = 2.0 * math.pi / cycloid.lobes
    for got, expected in (
        (cycloid.point(-t), cycloid.point(t) * mirror),
        (turned(cycloid.point(pitch - t), -pitch), cycloid.point(t) * mirror),
        (cycloid.point(t + pitch), turned(cycloid.point(t), pitch)),
        (cycloid.point(t + cycloid.period), cycloid.point(t)),
    ):
        np.testing.assert_allclose(got, expected, atol=2e-14 * cycloid.pins * scale)


@pytest.mark.property
@given(cycloid=cycloids(), scale=st.floats(1e-3, 1e3))
@settings(max_examples=40, deadline=None)
def test_scale_invariance(cycloid: Cycloid, scale: float) -> None:
    """Lengths, speeds and levers grow with the drive, angles stay, curvature falls."""
    large = Cycloid(
        cycloid.pins,
        cycloid.lobes,
        scale * cycloid.pin_circle_radius,
        scale * cycloid.pin_radius,
        scale * cycloid.eccentricity,
    )
    t = np.linspace(0.1, 6.0, 100)
    size = cycloid.pin_circle_radius
    np.testing.assert_allclose(large.point(t) / scale, cycloid.point(t), atol=1e-13 * size)
    np.testing.assert_allclose(large.normal(t), cycloid.normal(t), atol=1e-11)
    np.testing.assert_allclose(large.lever(t) / scale, cycloid.lever(t), atol=1e-11 * size)
    np.testing.assert_allclose(large.pressure_angle(t), cycloid.pressure_angle(t), atol=1e-11)
    np.testing.assert_allclose(large.curvature(t) * scale, cycloid.curvature(t), rtol=1e-7)
    assert large.undercut_radius / scale == pytest.approx(cycloid.undercut_radius, rel=1e-10)


@pytest.mark.property
@given(cycloid=cycloids())
@settings(max_examples=40, deadline=None)
def test_lever_and_pressure_angle_follow_from_point_and_normal(cycloid: Cycloid) -> None:
    """lever = r × n; the largest is e z_c at cos θ = K, where the pressure angle is least, acos K."""
    t = np.linspace(0.0, 2.0 * math.pi, 300)
    point, normal = cycloid.point(t), cycloid.normal(t)
    cross = point[:, 0] * normal[:, 1] - point[:, 1] * normal[:, 0]
    np.testing.assert_allclose(cycloid.lever(t), cross, atol=1e-12 * cycloid.pin_circle_radius)
    best = -math.acos(cycloid.trochoid_ratio) / cycloid.lobes
    assert cycloid.lever(best) == pytest.approx(cycloid.eccentricity * cycloid.lobes, rel=1e-12)
    assert cycloid.pressure_angle(best) == pytest.approx(math.acos(cycloid.trochoid_ratio), rel=1e-9)
    assert cycloid.pressure_angle(t).min() >= math.acos(cycloid.trochoid_ratio) - 1e-12


@pytest.mark.independent
@given(pins=st.integers(4, 150), k=st.floats(0.01, 0.95))
@settings(max_examples=60, deadline=None)
def test_undercut_limit_is_the_least_radius_of_curvature(pins: int, k: float) -> None:
    """Sources §3, r limit, against a brute-force search of the convex curvature of the pin-centre path."""
    cycloid = Cycloid(pins, pins - 1, 1.0, 1e-3, k / pins)
    t = np.linspace(0.0, math.pi, 20001) / cycloid.lobes
    limit = 1.0 / cycloid.center_path_curvature(t).max()
    assert cycloid.undercut_radius == pytest.approx(limit, rel=1e-4)


@pytest.mark.exact
def test_undercut_begins_where_the_speed_changes_sign() -> None:
    """A pin 1e-6 below the limit leaves a regular flank, one 1e-6 above turns it back."""
    t = np.linspace(0.0, math.pi, 200001) / EXAMPLE.lobes
    for share, regular in ((1.0 - 1e-6, True), (1.0 + 1e-6, False)):
        cycloid = Cycloid(20, 19, 0.08, share * EXAMPLE.undercut_radius, 0.0025)
        assert bool((cycloid.speed(t) > 0.0).all()) is regular


@pytest.mark.exact
def test_other_tooth_differences_are_refused() -> None:
    """The equations hold for one lobe less than pins only."""
    with pytest.raises(Infeasible, match="take lobes = 19 or pins = 19"):
        Cycloid(20, 18, 0.08, 0.005, 0.0025)


def shared(cycloid: Cycloid, torque: float, crank: float, stiffness: float, gaps: Array | float) -> Array:
    """Pin forces of a rigid disc on equal springs: F = k (l β − g)₊, ΣF l = T."""
    lever = cycloid.lever(cycloid.contact_parameter(np.arange(cycloid.pins), crank))

    def forces(turn: float) -> Array:
        return stiffness * np.maximum(0.0, lever * turn - gaps)

    turn = brentq(lambda b: float(forces(b) @ lever) - torque, 0.0, 1.0, xtol=1e-18, rtol=1e-14)
    return forces(turn)


@pytest.mark.published
def test_pin_forces_of_the_textbook_hand_calculation() -> None:
    """Sources §3: z_p 40, R 64, r 3, e 1.3 mm, 206 N·m, α = 0.2: F_max 405.469 N on 20 pins."""
    force = shared(RV40, 206.0, 0.2, 2e8, 0.0)
    assert force.max() == pytest.approx(405.469, abs=5e-4)
    assert np.count_nonzero(force) == 20


@pytest.mark.published
def test_peak_pin_force_of_the_cycloidgen_release_note() -> None:
    """cycloidgen 7.2.0 release note: R 50, r 4, e 1.5 mm, z_p 12, 2.5 N·m per disc.

    Peak pin force 49.859 N at crank angle 0, and 49.271 N one lobe pitch (360°/11) later, in the direction
    of turning in which the loaded flank is the one with positive lever.
    """
    cycloid = Cycloid(12, 11, 0.05, 0.004, 0.0015)
    assert shared(cycloid, 2.5, 0.0, 1e8, 0.0).max() == pytest.approx(49.859, abs=5e-4)
    assert shared(cycloid, 2.5, 2.0 * math.pi / 11, 1e8, 0.0).max() == pytest.approx(49.271, abs=5e-4)


@pytest.mark.published
def test_pin_forces_with_a_modified_flank() -> None:
    """Sources §3: ΔR −0.02, Δr +0.01 mm, 2e5 N/mm, α = 0.2: 6 pins, 1045.1 N, 1043.6 N to first order."""
    change = Modification(equidistant=1e-5, radial=-2e-5)
    t = RV40.contact_parameter(np.arange(40), 0.2)
    exact, _ = gap(RV40, change, RV40.center_path(t), t)
    for gaps, peak in ((exact, 1045.1), (gap_first_order(RV40, change, t), 1043.6)):
        force = shared(RV40, 206.0, 0.2, 2e8, gaps)
        assert force.max() == pytest.approx(peak, abs=0.05)
        assert np.count_nonzero(force) == 6


@pytest.mark.exact
def test_gap_of_an_equidistant_change_is_that_change() -> None:
    """An equidistant of an equidistant is one, so Δr alone opens every gap by Δr; no change opens none."""
    t = EXAMPLE.contact_parameter(np.arange(20), 0.7)
    for change in (0.0, 2e-5, -1e-5):
        g, found = gap(EXAMPLE, Modification(equidistant=change), EXAMPLE.center_path(t), t)
        np.testing.assert_allclose(g, change, atol=1e-16)
        np.testing.assert_allclose(found, t, atol=1e-13)


@pytest.mark.property
def test_first_order_gaps_are_off_by_the_square_of_the_change() -> None:
    """Halving the modification divides the error of sources §3's gap by four, away from the crests."""
    t = EXAMPLE.contact_parameter(np.arange(20), 0.3)

    def error(size: float) -> Array:
        change = Modification(3e-5 * size, -5e-5 * size, 2e-4 * size)
        exact, _ = gap(EXAMPLE, change, EXAMPLE.center_path(t), t)
        return exact - gap_first_order(EXAMPLE, change, t)

    coarse, fine = error(1.0), error(0.5)
    sloping = np.abs(EXAMPLE.lever(t)) > 0.2 * EXAMPLE.eccentricity * EXAMPLE.lobes
    assert sloping.sum() > 10
    np.testing.assert_allclose(coarse[sloping] / fine[sloping], 4.0, rtol=0.15)


@pytest.mark.independent
def test_exact_gap_is_the_distance_to_a_densely_sampled_tooth() -> None:
    """Brute force: a tooth is what both flanks, turned by ±δ, leave: the larger sampled distance counts."""
    change = Modification(2e-5, -4e-5, 3e-4)
    ground = EXAMPLE.modified(change)
    t = EXAMPLE.contact_parameter(np.arange(20), 0.45)
    pins = EXAMPLE.center_path(t)
    g, _ = gap(EXAMPLE, change, pins, t)
    near = t[:, None] + np.linspace(-0.05, 0.05, 40001)

    def sampled(turn: float) -> Array:
        away: Array = np.linalg.norm(turned(ground.point(near), turn) - pins[:, None], axis=-1)
        return np.asarray(away.min(axis=1))

    distance = np.maximum(sampled(change.rotation), sampled(-change.rotation))
    np.testing.assert_allclose(g, distance - EXAMPLE.pin_radius, atol=1e-11)


@pytest.mark.property
def test_rotation_opens_both_flanks_alike() -> None:
    """δ thins the tooth: mirrored pins have equal gaps, none closes, and −δ closes what δ opens."""
    t = np.array([0.02, 0.05, 0.1])
    pins = EXAMPLE.center_path(t)
    mirror = np.array([1.0, -1.0])
    opened, _ = gap(EXAMPLE, Modification(rotation=1e-5), pins, t)
    mirrored, _ = gap(EXAMPLE, Modification(rotation=1e-5), pins * mirror, -t)
    closed, _ = gap(EXAMPLE, Modification(rotation=-1e-5), pins, t)
    np.testing.assert_allclose(mirrored, opened, atol=1e-16)
    assert opened.min() > 0.0
    np.testing.assert_allclose(closed, -opened, rtol=1e-2)
