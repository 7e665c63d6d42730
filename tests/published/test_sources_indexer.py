"""Nadezhdin, spherical planetary-pin mechanisms (sources §5): every number and claim, and every erratum.

Reproduced ones hold to their digits; for the others the test shows the printed form failing and what is right.
"""

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.kinematics.indexer_cases import DEGREE, paths, tasks
from trochoid.kinematics.geneva import geneva
from trochoid.kinematics.indexer import Indexer, motion, shock
from trochoid.kinematics.indexer_design import synthesise
from trochoid.kinematics.indexer_limits import Wish
from trochoid.kinematics.indexer_measure import dwell, peaks, similarity
from trochoid.kinematics.indexer_synthesis import Solution, Task, by_duration, by_pin, cusped
from trochoid.kinematics.spherical_trochoid import SphericalTrochoid
from trochoid.kinematics.types import Array
from trochoid.kinematics.zeros import zeros_between

ORTHOGONAL = Task(90 * DEGREE, 4)
CURTATE = by_duration(ORTHOGONAL, 0.2902)[0].indexer
WITHOUT_SOFT_SHOCK = Indexer(
    SphericalTrochoid(47.77587 * DEGREE, 2.77587 * DEGREE, -4.0, math.pi), 90 * DEGREE, 90 * DEGREE
)


def hypo_cusp(swing: float, planet: int = 4) -> Indexer:
    """Index from cusp to cusp of a hypocycloid, orthogonal shafts."""
    served = [x for x in cusped(Task(swing * DEGREE, planet)) if x.kind == "hypo" and not x.fault]
    assert len(served) == 1
    return served[0].indexer


# --- numbers -----------------------------------------------------------------------------------------------


@pytest.mark.published
def test_geneva_constants() -> None:
    """B = 2.00 and C = 5.53 of the Geneva wheel at ψ_Σ = 90°: reproduced, 2 and 5.52974528736."""
    found = similarity(geneva(90 * DEGREE))
    assert found.velocity == pytest.approx(2.0, abs=1e-14)
    assert found.acceleration == pytest.approx(5.52974528736, abs=5e-12)
    assert round(found.velocity, 2) == 2.00
    assert round(found.acceleration, 2) == 5.53


@pytest.mark.published
def test_indexer_constants() -> None:
    """B = 1.71 and C = 4.77 at k = 0.25, i = 4: not reproducible; only the hypo cusp serves, 1.55947 and 4.91856."""
    served = [x for x in by_duration(ORTHOGONAL, 0.25) if not x.fault]
    assert [(x.kind, x.place, x.cusp) for x in served] == [("hypo", "near", True)]
    found = similarity(served[0].indexer)
    assert found.velocity == pytest.approx(1.55947, abs=5e-6)
    assert found.acceleration == pytest.approx(4.91856, abs=5e-6)
    # the equations have no other pair either: those that do not serve are far from it
    for x in by_duration(ORTHOGONAL, 0.25):
        made = similarity(x.indexer)
        assert abs(made.velocity - 1.71) > 0.1
        assert abs(made.acceleration - 4.77) > 0.1


@pytest.mark.published
def test_where_the_printed_velocity_is_met() -> None:
    """B = 1.7100 is met at k = 0.2902, ρ = 0.527, with C = 4.7952: near the printed pair, but k is not 1/i."""
    k = float(zeros_between(_velocity_beyond(1.71), np.array([0.28]), np.array([0.30]))[0])
    made = synthesise(ORTHOGONAL, Wish(duration=k, kind="hypo")).indexer
    found = similarity(made)
    assert k == pytest.approx(0.2902, abs=5e-5)
    assert made.path.pin_ratio == pytest.approx(0.527, abs=5e-4)
    assert found.velocity == pytest.approx(1.7100, abs=1e-12)
    assert found.acceleration == pytest.approx(4.7952, abs=5e-5)
    back = [x for x in by_pin(ORTHOGONAL, made.path.pin_ratio) if not x.fault]
    assert min(abs(x.indexer.duration - k) for x in back) < 1e-9


def _velocity_beyond(value: float) -> Callable[[Array], Array]:
    return lambda k: np.array([_constants(float(x))[0] - value for x in k])


@pytest.mark.published
def test_printed_pair_has_no_mechanism() -> None:
    """Along the family of near hypotrochoids, i = 4, D = 90°, no k rounds to 1.71 and 4.77: 0.01 off at best."""
    pairs = np.array([_constants(k) for k in np.linspace(0.251, 0.36, 219)])
    off = np.abs(pairs - [1.71, 4.77]).max(axis=1)
    assert off.min() > 0.009


def _constants(duration: float) -> tuple[float, float]:
    served = [x for x in by_duration(ORTHOGONAL, duration) if not x.fault and x.kind == "hypo"]
    found = similarity(served[0].indexer)
    return found.velocity, found.acceleration


@pytest.mark.published
def test_ratios_from_120_to_60_degrees() -> None:
    """Printed "1.7, 2.25, more than 3" for ω, ε and the soft shock; the cusps with i = 4 give 1.974, 2.077, 2.268."""
    wide, small = peaks(hypo_cusp(120.0)), peaks(hypo_cusp(60.0))
    assert wide.velocity / small.velocity == pytest.approx(1.974, abs=5e-4)
    assert wide.acceleration / small.acceleration == pytest.approx(2.077, abs=5e-4)
    assert wide.start / small.start == pytest.approx(2.268, abs=5e-4)


@pytest.mark.published
def test_peaks_fall_with_the_swing() -> None:
    """Right as printed: a smaller swing has smaller peaks of ω, ε and N; for cusps with i = 4, in steps of 2°."""
    found = [peaks(hypo_cusp(swing)) for swing in np.linspace(120.0, 60.0, 31)]
    for name in ("velocity", "acceleration", "power"):
        assert np.all(np.diff([getattr(top, name) for top in found]) < 0.0)


@pytest.mark.published
def test_both_constants_below_the_geneva_wheels() -> None:
    """Printed: B and C are 1.2 times less; right for the cusp: 1.28 and 1.12."""
    wheel, pin = similarity(geneva(90 * DEGREE)), similarity(hypo_cusp(90.0))
    printed = np.array([2.00 / 1.71, 5.53 / 4.77])
    assert list(printed.round(1)) == [1.2, 1.2]
    assert wheel.velocity / pin.velocity == pytest.approx(1.282, abs=5e-4)
    assert wheel.acceleration / pin.acceleration == pytest.approx(1.124, abs=5e-4)


# --- claims ------------------------------------------------------------------------------------------------


@pytest.mark.published
def test_equal_duration_needs_another_ratio() -> None:
    """The comparison "at equal relative duration" sets k = 0.25 beside 0.5; at k = 0.5 the cusp has i = 2.

    It is still the better one (1.542, 5.170), but not every indexer is: ρ = 0.218, i = 4, k = 0.5 is worse.
    """
    wheel, two = geneva(90 * DEGREE), hypo_cusp(90.0, 2)
    assert two.duration == pytest.approx(wheel.duration)
    assert similarity(two).velocity == pytest.approx(1.5425, abs=5e-5)
    assert similarity(two).acceleration == pytest.approx(5.1703, abs=5e-5)
    worse = similarity(WITHOUT_SOFT_SHOCK)
    assert worse.velocity > 2.0
    assert worse.acceleration > 5.53
    assert worse.power > similarity(wheel).power


@pytest.mark.published
def test_power_and_place_of_the_peak() -> None:
    """Right as printed: the cusp takes much less peak power, and its largest ε is farther from the middle."""
    wheel, pin = geneva(90 * DEGREE), hypo_cusp(90.0)
    assert similarity(wheel).power / similarity(pin).power == pytest.approx(2.170, abs=5e-4)
    assert peaks(wheel).acceleration_at / wheel.half_turn == pytest.approx(0.337, abs=5e-4)
    assert peaks(pin).acceleration_at / pin.half_turn == pytest.approx(0.862, abs=5e-4)
    assert float(motion(pin, 0.0).acceleration) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.published
@pytest.mark.parametrize("planet", [2, 3, 4, 5])
def test_range_of_durations(planet: int) -> None:
    """k = 1/i "from 0.2 to 0.5" for i = 5 to 2: right for cusps, tan δ_c = tan ψ0/sin(π/i) at D = 90°."""
    for swing in (60.0, 90.0, 120.0):
        made = hypo_cusp(swing, planet)
        assert made.duration == pytest.approx(1.0 / planet, abs=1e-15)
        expected = math.tan(0.5 * swing * DEGREE) / math.sin(math.pi / planet)
        assert math.tan(made.path.central_cone) == pytest.approx(expected, rel=1e-12)
        assert dwell(made).clearance > -1e-14


@pytest.mark.published
@given(task=tasks())
@settings(max_examples=60, deadline=None)
def test_duration_is_not_the_ratio(task: Task) -> None:
    """Printed: "in general k = 1/i"; right: then ρ = 1, unless cos D = cot(π/i) cot ψ0; other k have other ρ."""
    phi, half = math.pi / task.planet, 0.5 * task.swing
    special = math.cos(task.shaft_angle) - 1.0 / (math.tan(phi) * math.tan(half))
    found = by_duration(task, 1.0 / task.planet)
    if abs(special) > 1e-3:
        assert all(x.indexer.path.pin_ratio == pytest.approx(1.0, rel=1e-9) for x in found)


@pytest.mark.published
def test_the_one_exception() -> None:
    """cos D = cot(π/i) cot ψ0: k = 1/i with any ρ. i = 4, ψ_Σ = 120°: D = 54.7356°."""
    task = Task(120 * DEGREE, 4, math.acos(1.0 / math.tan(60 * DEGREE)))
    assert task.shaft_angle / DEGREE == pytest.approx(54.7356, abs=5e-5)
    for rho in (0.3, 0.6, 0.9):
        made = [x.indexer for x in by_pin(task, rho) if abs(x.indexer.duration - 0.25) < 1e-12]
        assert made
        for x in made:
            assert x.path.pin_ratio == pytest.approx(rho, rel=1e-9)
            assert abs(shock(x)) < 1e-12
    off = Task(task.swing, 4, task.shaft_angle + 1e-3)
    assert all(abs(x.indexer.duration - 0.25) > 1e-9 for x in by_pin(off, 0.6))


@pytest.mark.published
def test_soft_shock_is_no_must() -> None:
    """Printed: "there always is a soft shock". Hypo near, i = 4, k = 0.5, γ = 47.77587°, β = 2.77587°: ε0 = 0."""
    made = WITHOUT_SOFT_SHOCK
    assert made.swing / DEGREE == pytest.approx(90.0, abs=1e-12)
    assert made.duration == 0.5
    assert abs(shock(made)) < 1e-15
    top = peaks(made)
    assert abs(top.start) < 1e-6 * top.acceleration
    assert made.path.pin_ratio == pytest.approx(0.2179, abs=5e-5)
    # it is the member of the family k = 0.5, γ − β = 45°, at which ε0 changes sign
    starts = [peaks(_half_turn_member(x)).start for x in (2.77, 2.7758, 2.7759, 2.78)]
    assert starts[0] * starts[1] > 0.0 > starts[1] * starts[2]
    served = synthesise(ORTHOGONAL, Wish(pin_ratio=made.path.pin_ratio, kind="hypo", place="near"))
    assert served.fault == ""


def _half_turn_member(pin: float) -> Indexer:
    path = SphericalTrochoid((45.0 + pin) * DEGREE, pin * DEGREE, -4.0, math.pi)
    return Indexer(path, 90 * DEGREE, 90 * DEGREE)


@pytest.mark.published
@pytest.mark.parametrize(("shaft_angle", "duration"), [(60.0, 0.3524), (90.0, 0.5), (120.0, 0.6476)])
def test_geneva_duration(shaft_angle: float, duration: float) -> None:
    """Printed: "k = 0.5 for spherical Geneva wheels"; right only for D = 90°: tan φ0 = 1/(cos D tan ψ0)."""
    wheel = geneva(90 * DEGREE, shaft_angle * DEGREE)
    assert wheel.duration == pytest.approx(duration, abs=5e-5)


@pytest.mark.published
def test_quarter_is_the_plane_geneva_wheel() -> None:
    """ "k = 0.25 at 90° corresponds to the Geneva wheel of outer engagement": to the plane one with four slots."""
    assert geneva(90 * DEGREE, 1e-6).duration == pytest.approx(0.25, abs=1e-12)


@pytest.mark.published
@given(task=tasks(), duration=st.floats(0.05, 0.95))
@settings(max_examples=40, deadline=None)
def test_condition_without_hard_shock(task: Task, duration: float) -> None:
    """|ẏ/ẋ| = tan ψ0 at both ends, x along the slot of mid-index: right as printed, away from cusps."""
    for x in by_duration(task, duration):
        _, first = x.indexer.path.derivatives(x.indexer.half_turn * np.array([-1.0, 1.0]), 1)
        along = math.sin(task.shaft_angle) * first[:, 2] - math.cos(task.shaft_angle) * first[:, 0]
        size = np.abs(first).max()
        if size > 1e-3:
            off = np.abs(first[:, 1]) * math.cos(0.5 * task.swing) - np.abs(along) * abs(
                math.sin(0.5 * task.swing)
            )
            assert np.abs(off).max() < 1e-8 * (1.0 + size)


@pytest.mark.published
def test_conditions_on_the_path() -> None:
    """The author's conditions hold for the curtate example: nearest in the middle, one inflection per half at most.

    The hypo cusp serves although its pin is nearest to the wheel's axis at the ends.
    """
    curtate: Solution = by_duration(ORTHOGONAL, 0.2902)[0]
    assert (curtate.nearest, curtate.inflections) == (True, 1)
    cusp = next(x for x in cusped(ORTHOGONAL) if not x.fault)
    assert (cusp.nearest, cusp.inflections) == (False, 0)


# --- errata ------------------------------------------------------------------------------------------------


def corrected_3(indexer: Indexer, phi: Array) -> Array:
    """ψ by (3) as corrected in the sources' README."""
    path, D = indexer.path, indexer.shaft_angle
    s, i = math.copysign(1.0, path.ratio), abs(path.ratio)
    theta, g, rho = path.phase + path.ratio * phi, path.arm, path.pin_ratio
    first = i + s * math.cos(g)
    z = first / math.tan(g) - rho * math.sin(g) * np.cos(theta)
    x = first * np.cos(phi) + rho * (math.cos(g) * np.cos(phi) * np.cos(theta) - np.sin(phi) * np.sin(theta))
    y = first * np.sin(phi) + rho * (math.cos(g) * np.sin(phi) * np.cos(theta) + np.cos(phi) * np.sin(theta))
    return np.asarray(np.arctan2(y, math.sin(D) * z - math.cos(D) * x))


def printed_3(indexer: Indexer, phi: Array, radius: float) -> Array:
    """ψ by (3) as printed; `radius` of the sphere, and one δ for the shaft angle and the arm."""
    delta, rho, i = indexer.shaft_angle, indexer.path.pin_ratio, abs(indexer.path.ratio)
    X = radius * math.cos(0.5 * indexer.swing) * math.cos(delta)
    Y = radius * math.sin(0.5 * indexer.swing)
    top = (i + math.cos(delta)) * np.sin(phi) + rho * np.cos(i * phi) * (
        np.sin(phi) * math.cos(delta) + np.cos(phi)
    )
    root = np.sqrt(Y**2 - (rho * np.sin(phi)) ** 2)
    return np.arctan2(top, X - rho * math.sin(delta) * root / Y)


def printed_4(planet: float, rho: float, Y: float, phi: npt.ArrayLike, last: str = "cos") -> Array:
    """ψ by (4) as printed, and with its last cos replaced."""
    phi = np.asarray(phi, dtype=np.float64)
    wave = np.cos(planet * phi) if last == "cos" else np.sin(planet * phi)
    top = planet * np.sin(phi) + rho * np.cos(phi) * wave
    return np.asarray(np.arctan(top / (rho / Y * np.sqrt(Y**2 - (rho * np.sin(phi)) ** 2))))


@pytest.mark.published
@given(
    path=paths().filter(lambda p: p.arm > 0.05 and p.pin > 1e-3),
    shaft_angle=st.floats(0.1, 3.0),
    phi=st.floats(-3.0, 3.0),
)
@settings(max_examples=100, deadline=None)
def test_corrected_3_is_the_motion(path: SphericalTrochoid, shaft_angle: float, phi: float) -> None:
    """(3) corrected, at any shaft angle, both kinds, near and far."""
    made = Indexer(path, shaft_angle, 1.0)
    if float(np.sin(made.reach(phi))) > 1e-3:
        off = corrected_3(made, np.array(phi)) - motion(made, phi).angle
        assert math.remainder(float(off), 2.0 * math.pi) == pytest.approx(0.0, abs=1e-10)


@pytest.mark.published
@given(planet=st.integers(2, 8), rho=st.floats(0.05, 3.0), Y=st.floats(0.05, 3.0))
@settings(max_examples=60, deadline=None)
def test_4_as_printed_starts_at_45_degrees(planet: int, rho: float, Y: float) -> None:
    """ψ(0) = 45° for every input, where it must be 0; with sin in place of the last cos it is."""
    assert float(printed_4(planet, rho, Y, 0.0)) / DEGREE == pytest.approx(45.0, abs=1e-12)
    assert float(printed_4(planet, rho, Y, 0.0, "sin")) == 0.0


@pytest.mark.published
def test_4_needs_another_denominator() -> None:
    """At D = 90° the denominator of tan ψ is z of the corrected (3): the sine alone does not mend (4)."""
    made, phi = CURTATE, np.linspace(-0.9, 0.9, 19)
    exact = motion(made, phi).angle
    np.testing.assert_allclose(corrected_3(made, phi), exact, atol=1e-13)
    Y = math.sin(0.5 * made.swing)
    for last in ("cos", "sin"):
        assert np.abs(printed_4(4.0, made.path.pin_ratio, Y, phi, last) - exact).max() > 20 * DEGREE


@pytest.mark.published
def test_3_as_printed_mixes_lengths_with_ratios() -> None:
    """ψ must not depend on the size of the sphere; by (3) as printed it does, and ψ(0) is not 0."""
    made = by_pin(Task(90 * DEGREE, 4, 70 * DEGREE), 0.6)[0].indexer
    phi = np.linspace(0.0, 0.5, 6)
    one, two = printed_3(made, phi, 1.0), printed_3(made, phi, 2.0)
    assert np.abs(one - two).max() > 5 * DEGREE
    assert abs(one[0]) > 20 * DEGREE
    np.testing.assert_allclose(corrected_3(made, phi), motion(made, phi).angle, atol=1e-13)


@pytest.mark.published
def test_3_as_printed_has_one_angle_for_two() -> None:
    """δ is the shaft angle in (3), (4) and the arm's in the numerator: at D = 90° cos γ falls out of it wrongly."""
    made, phi = CURTATE, 0.3
    g, s, i = made.path.arm, -1.0, 4.0
    assert i + s * math.cos(g) == pytest.approx(3.323, abs=1e-3)
    assert i + math.cos(made.shaft_angle) == pytest.approx(4.0)  # as printed
    as_printed = math.atan2(
        4.0 * math.sin(phi), 3.323 / math.tan(g) - made.path.pin_ratio * math.sin(g) * math.cos(math.pi - 1.2)
    )
    assert abs(as_printed - float(motion(made, phi).angle)) > 1 * DEGREE


@pytest.mark.published
def test_ellipse_2_has_no_point_beyond_the_arm() -> None:
    """(2) with x = r sin φ and the half axis b0 = r sin δ: no real y from φ = δ on, where the pin still is."""
    delta, phi = 40 * DEGREE, 50 * DEGREE
    assert 1.0 - (math.sin(phi) / math.sin(delta)) ** 2 < 0.0
    made = Indexer(SphericalTrochoid(delta, 0.1, -4.0, math.pi), 90 * DEGREE, 1.0)
    assert np.isfinite(motion(made, phi).angle)


@pytest.mark.published
@pytest.mark.parametrize("phi", [-0.7, 0.0, 0.7])
def test_transport_speed_is_the_wheels(phi: float) -> None:
    """Printed: v_e = h ω_1; right: h ω_4. What is left of the pin's velocity then runs along the slot."""
    made = CURTATE
    point, velocity = made.path.derivatives(phi, 1)
    omega, h = float(motion(made, phi).velocity), float(np.sin(made.reach(phi)))
    across = np.cross(point, made.axis) / h  # the sense in which ψ grows
    assert velocity @ across == pytest.approx(h * omega, abs=1e-14)
    assert abs(velocity @ across - h * 1.0) > 0.1 * h  # ω_1 = 1
    slot = velocity - h * omega * across
    assert abs(np.cross(point, made.axis) @ slot) < 1e-14


@pytest.mark.published
def test_transport_acceleration_is_the_wheels() -> None:
    """Printed: a_e = h φ̇², h φ̈, zero at constant φ̇ in its second part; right: h ω_4², h ε_4."""
    made, phi = CURTATE, 0.6
    point, first, second = made.path.derivatives(phi, 2)
    at, axis = motion(made, phi), made.axis
    turn = -axis  # ψ grows against the wheel's axis
    omega, epsilon = float(at.velocity) * turn, float(at.acceleration) * turn
    relative = first - np.cross(omega, point)
    rest = second - np.cross(epsilon, point) - np.cross(omega, np.cross(omega, point))
    rest = rest - 2.0 * np.cross(omega, relative)  # what is left is along the slot and to its centre
    across = np.cross(point, axis) / float(np.sin(made.reach(phi)))
    assert abs(rest @ across) < 1e-13
    assert abs(float(at.acceleration)) > 0.5  # so the tangential part is not zero, though φ̈ is
    assert rest @ point == pytest.approx(-(relative @ relative), abs=1e-13)  # ρ_k = R: right as printed
