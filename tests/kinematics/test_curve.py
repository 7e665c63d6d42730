"""Curves, nearest points and arc lengths against closed forms."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import ellipe

from trochoid.kinematics.curve import ArcLength, Circle, foot_point
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import NotConverged

EXAMPLE = Cycloid(20, 19, 0.08, 0.005, 0.0025)


def path_length(cycloid: Cycloid) -> float:
    """Length of the pin-centre path: R∮√(1 + K² − 2K cos θ) dt = 4R(1 + K) E(m), m = 4K/(1 + K)²."""
    k = cycloid.trochoid_ratio
    return 4.0 * cycloid.pin_circle_radius * (1.0 + k) * float(ellipe(4.0 * k / (1.0 + k) ** 2))


@st.composite
def cycloids(draw: st.DrawFn, pin_share: tuple[float, float] = (0.02, 0.999)) -> Cycloid:
    """Feasible profiles of 4 to 120 pins, K from 0.02 to 0.98, the pin up to 99.9 % of the undercut limit."""
    pins = draw(st.integers(4, 120))
    k = draw(st.floats(0.02, 0.98))
    radius = 10.0 ** draw(st.floats(-2.0, 0.0))
    thin = Cycloid(pins, pins - 1, radius, 1e-6 * radius, k * radius / pins)
    limit = min(thin.undercut_radius, radius * math.sin(math.pi / pins))
    return Cycloid(pins, pins - 1, radius, draw(st.floats(*pin_share)) * limit, thin.eccentricity)


@pytest.mark.exact
def test_circle_nearest_point_is_on_the_ray_from_its_centre() -> None:
    """Closed form of the distance to a circle; a hole has its material outside."""
    points = np.array([[0.4, 0.1], [-0.3, 2.0], [1.5, -0.2]])
    angle = np.arctan2(points[:, 1] - 0.1, points[:, 0] - 0.2)
    away = np.hypot(points[:, 0] - 0.2, points[:, 1] - 0.1) - 0.7
    for hole, sign in ((False, 1.0), (True, -1.0)):
        t, distance = foot_point(Circle((0.2, 0.1), 0.7, hole), points, angle + 0.3)
        np.testing.assert_allclose(t, angle, atol=1e-14)
        np.testing.assert_allclose(distance, sign * away, atol=1e-15)


@pytest.mark.exact
def test_length_of_the_flank_is_the_elliptic_integral_less_a_turn_of_the_pin() -> None:
    """An inner equidistant is shorter than its curve by 2π r (Steiner); the path is an elliptic integral."""
    for pins, radius, pin, eccentricity in (
        (20, 0.08, 0.005, 0.0025),
        (7, 0.03, 0.004, 0.0025),
        (101, 0.2, 2e-3, 1.9e-3),
    ):
        cycloid = Cycloid(pins, pins - 1, radius, pin, eccentricity)
        expected = path_length(cycloid) - 2.0 * math.pi * pin
        assert ArcLength(cycloid).total == pytest.approx(expected, rel=2e-14)


@pytest.mark.property
@given(cycloid=cycloids(), seed=st.integers(0, 2**32 - 1))
@settings(max_examples=60, deadline=None)
def test_foot_point_finds_the_point_an_offset_started_from(cycloid: Cycloid, seed: int) -> None:
    """Points raised by less than the focal distance come back to their parameter and offset."""
    rng = np.random.default_rng(seed)
    t = rng.uniform(0.0, 2.0 * math.pi, 200)
    focal = np.minimum(cycloid.pin_radius, -1.0 / np.minimum(cycloid.curvature(t), -1e-9))
    offset = focal * rng.uniform(0.01, 0.9, t.size)
    points = cycloid.point(t) + offset[:, None] * cycloid.normal(t)
    start = t + 0.02 * math.pi / cycloid.lobes * rng.uniform(-1.0, 1.0, t.size)
    found, distance = foot_point(cycloid, points, start)
    scale = cycloid.pin_circle_radius
    np.testing.assert_allclose(distance, offset, rtol=0.0, atol=3e-14 * scale)
    assert (
        np.abs((found - t) * cycloid.speed(t) * (1.0 + cycloid.curvature(t) * offset)).max() < 3e-13 * scale
    )


@pytest.mark.property
def test_foot_point_converges_quadratically() -> None:
    """From 5 % of a lobe away, five Newton steps reach rounding for thousands of points at once."""
    t = np.linspace(0.0, 2.0 * math.pi, 5000)
    start = t + 0.1 * math.pi / EXAMPLE.lobes
    found, distance = foot_point(EXAMPLE, EXAMPLE.center_path(t), start, iterations=6)
    assert np.abs(distance - EXAMPLE.pin_radius).max() < 1e-14 * EXAMPLE.pin_circle_radius
    assert np.abs(found - t).max() < 1e-13


@pytest.mark.property
def test_foot_point_never_moves_away_from_a_far_start() -> None:
    """With starts a third of a lobe off and pins at 99.99 % of undercut, each answer is a local minimum."""
    thin = Cycloid(12, 11, 0.05, 1e-6, 0.0035)
    cycloid = Cycloid(12, 11, 0.05, 0.9999 * thin.undercut_radius, 0.0035)
    t = np.linspace(0.0, 2.0 * math.pi, 2000)
    points = cycloid.center_path(t)
    found, distance = foot_point(cycloid, points, t + 0.66 * math.pi / cycloid.lobes)
    around = cycloid.point(found[:, None] + np.linspace(-1e-3, 1e-3, 21))
    away = np.linalg.norm(points[:, None] - around, axis=-1).min(axis=1)
    assert np.all(away >= np.abs(distance) - 1e-15)


@pytest.mark.exact
def test_foot_point_says_when_it_did_not_converge() -> None:
    """The message counts the points and names one."""
    with pytest.raises(NotConverged, match="2 of 2 points"):
        foot_point(EXAMPLE, EXAMPLE.center_path(np.array([0.1, 0.2])), np.array([0.12, 0.23]), iterations=1)


@pytest.mark.property
@given(cycloid=cycloids(), seed=st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_arc_length_inverts_over_many_rounds(cycloid: Cycloid, seed: int) -> None:
    """length(parameter(s)) = s, a period adds the total, and ds/dt is the speed."""
    arc = ArcLength(cycloid)
    s = arc.total * np.random.default_rng(seed).uniform(-2.0, 3.0, 300)
    t = arc.parameter(s)
    np.testing.assert_allclose(arc.length(t), s, rtol=0.0, atol=1e-13 * arc.total)
    np.testing.assert_allclose(
        arc.length(t + cycloid.period), s + arc.total, rtol=0.0, atol=1e-13 * arc.total
    )
    np.testing.assert_allclose(
        arc.length(2.0 * math.pi / cycloid.lobes) * cycloid.lobes, arc.total, rtol=1e-13
    )
