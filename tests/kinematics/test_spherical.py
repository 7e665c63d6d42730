"""Motions about a fixed point and curves on the sphere against closed forms and finite differences."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.nutation import Nutation, satellite_motion
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.spherical import angle_between, inverse, rotation, turn, unit
from trochoid.kinematics.spherical_curve import SmallCircle, foot_point

MOTION = satellite_motion(Nutation(15, 14, 0.1), np.linspace(0.0, 7.0, 11), 3.0, 2.0)
CIRCLE = SmallCircle((0.3, -0.4, 0.8), 0.35)
HOLE = SmallCircle((0.0, 0.0, 1.0), 0.8, hole=True)


@pytest.mark.exact
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_rotation_leaves_its_axis_and_turns_the_next(axis: int) -> None:
    """Right-handed: the axis after it goes to the one after that in a quarter turn; R Rᵀ = 1, det R = 1."""
    e = np.eye(3)
    quarter = rotation(axis, 0.5 * math.pi)
    np.testing.assert_allclose(quarter @ e[axis], e[axis], atol=1e-16)
    np.testing.assert_allclose(quarter @ e[(axis + 1) % 3], e[(axis + 2) % 3], atol=1e-16)
    many = rotation(axis, np.linspace(-9.0, 9.0, 21).reshape(3, 7))
    assert many.shape == (3, 7, 3, 3)
    np.testing.assert_allclose(many @ np.swapaxes(many, -1, -2), np.broadcast_to(e, many.shape), atol=1e-15)
    np.testing.assert_allclose(np.linalg.det(many), 1.0, rtol=1e-14)


@pytest.mark.exact
def test_points_there_and_back() -> None:
    """Carrying points of the body to the fixed frame and back changes nothing, nor do lengths change."""
    points = np.random.default_rng(1).normal(size=(5, 3))
    fixed = MOTION.to_fixed(points)
    np.testing.assert_allclose(MOTION.to_member(fixed), np.broadcast_to(points, (11, 5, 3)), atol=1e-15)
    np.testing.assert_allclose(
        np.linalg.norm(fixed, axis=-1), np.tile(np.linalg.norm(points, axis=-1), (11, 1)), rtol=1e-14
    )


@pytest.mark.property
def test_points_on_the_instantaneous_axis_stand_still() -> None:
    """ω × r = 0 there; their acceleration ε × r is not 0."""
    axis = MOTION.instantaneous_axis()
    here = np.einsum("nji,nj->ni", MOTION.rotation, axis)[:, None, :]
    np.testing.assert_allclose(MOTION.point_velocity(here), 0.0, atol=1e-14)
    assert np.linalg.norm(MOTION.point_acceleration(here), axis=-1).min() > 0.1


@pytest.mark.property
def test_inversion_twice_is_nothing() -> None:
    """The motion seen from the body, seen from there again, is the motion."""
    back = inverse(inverse(MOTION))
    np.testing.assert_allclose(back.rotation, MOTION.rotation, atol=1e-16)
    np.testing.assert_allclose(back.velocity, MOTION.velocity, atol=1e-14)
    np.testing.assert_allclose(back.acceleration, MOTION.acceleration, atol=1e-14)


@pytest.mark.exact
@pytest.mark.parametrize("angle", [1e-12, 1e-3, 1.0, 3.0, math.pi - 1e-9])
def test_angles_near_zero_and_near_a_half_turn(angle: float) -> None:
    """acos(a·b) would lose half the digits at both ends."""
    a = np.array([1.0, 0.0, 0.0])
    b = np.array([math.cos(angle), math.sin(angle), 0.0])
    assert float(angle_between(a, b)) == pytest.approx(angle, rel=1e-14, abs=1e-15)


@pytest.mark.exact
@pytest.mark.parametrize("circle", [CIRCLE, HOLE])
def test_small_circle(circle: SmallCircle) -> None:
    """Length 2π sin r, area 2π(1 − cos r) by Gauss–Bonnet, normal across point and tangent, out of the material."""
    t = np.linspace(0.0, 7.0, 50)
    point, tangent, normal = circle.point(t), circle.tangent(t), circle.normal(t)
    pole = unit(np.array(circle.pole))
    np.testing.assert_allclose(angle_between(point, np.broadcast_to(pole, point.shape)), circle.radius)
    side = -1.0 if circle.hole else 1.0
    np.testing.assert_allclose(np.cross(tangent, point), side * normal, atol=1e-15)
    assert ArcLength(circle).total == pytest.approx(2.0 * math.pi * math.sin(circle.radius), rel=1e-13)
    turning = side * float(circle.curvature(0.0)) * ArcLength(circle).total
    assert 2.0 * math.pi - turning == pytest.approx(
        2.0 * math.pi * (1.0 - math.cos(circle.radius)), rel=1e-12
    )


@pytest.mark.exact
def test_foot_point_on_a_small_circle() -> None:
    """The signed angle is that to the pole less the radius, negative inside; for a hole the sign turns."""
    rng = np.random.default_rng(3)
    points = unit(np.array([0.3, -0.4, 0.8]) + 0.4 * rng.normal(size=(200, 3)))
    expected = (
        angle_between(points, np.broadcast_to(unit(np.array(CIRCLE.pole)), points.shape)) - CIRCLE.radius
    )
    t, distance = foot_point(CIRCLE, points, np.zeros(200))
    np.testing.assert_allclose(distance, expected, atol=1e-14)
    np.testing.assert_allclose(np.sum(points * CIRCLE.tangent(t), axis=-1), 0.0, atol=1e-13)
    _, other = foot_point(SmallCircle(CIRCLE.pole, CIRCLE.radius, hole=True), points, np.zeros(200))
    np.testing.assert_allclose(other, -expected, atol=1e-14)


@pytest.mark.independent
@given(seed=st.integers(0, 2**31 - 1))
@settings(max_examples=20, deadline=None)
def test_foot_point_on_a_tooth(seed: int) -> None:
    """Points moved off the flank along its normal geodesic come back to where they started."""
    tooth = SphereTooth(15, 14, math.radians(70.0), math.radians(4.0), math.radians(2.5))
    rng = np.random.default_rng(seed)
    t, off = rng.uniform(0.0, 6.0, 30), rng.uniform(-0.01, 0.02, 30)
    moved = np.cos(off)[:, None] * tooth.point(t) + np.sin(off)[:, None] * tooth.normal(t)
    found, distance = foot_point(tooth, moved, t + 1e-3 * rng.normal(size=30))
    np.testing.assert_allclose(distance, off, atol=1e-14)
    np.testing.assert_allclose(found, t, atol=1e-11)


@pytest.mark.exact
def test_foot_point_says_when_it_fails() -> None:
    """One step is not enough: the error says for how many points and what to do."""
    with pytest.raises(NotConverged, match="start nearer"):
        foot_point(CIRCLE, np.array([[1.0, 0.0, 0.0]]), np.array([0.3]), iterations=1)


@pytest.mark.independent
def test_arc_length_of_a_tooth_is_that_of_its_chords() -> None:
    """ArcLength, written for plane curves, against a polygon of 2·10⁵ great-circle arcs, and its inverse."""
    tooth = SphereTooth(30, 29, math.radians(65.0), math.radians(2.5), math.radians(3.0))
    arc = ArcLength(tooth)
    places = tooth.point(np.linspace(0.0, 2.0 * math.pi, 200_001))
    assert arc.total == pytest.approx(float(angle_between(places[1:], places[:-1]).sum()), rel=1e-6)
    s = np.linspace(0.0, arc.total, 40)
    np.testing.assert_allclose(arc.length(arc.parameter(s)), s, atol=1e-13)


@pytest.mark.property
def test_turn_is_the_matrix_product() -> None:
    """Vectors broadcast against any number of matrices."""
    vectors = np.random.default_rng(0).normal(size=(4, 1, 3))
    product = turn(rotation(1, np.linspace(0.0, 1.0, 5)), vectors)
    assert product.shape == (4, 5, 3)
    np.testing.assert_allclose(product[2, 3], rotation(1, 0.75) @ vectors[2, 0], atol=1e-15)
