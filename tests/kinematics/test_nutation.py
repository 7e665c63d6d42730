"""The satellite's motion: pure rolling, closed forms, finite differences and the exact plane limit."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.nutation import Nutation, output_angle, satellite_motion
from trochoid.kinematics.spherical import inverse, rotation, turn
from trochoid.kinematics.types import Array

ANGLES = np.linspace(-3.0, 20.0, 41)


@st.composite
def nutations(draw: st.DrawFn) -> Nutation:
    """Any two different tooth numbers and any nutation angle."""
    fixed = draw(st.integers(1, 120))
    satellite = draw(st.integers(1, 120).filter(lambda z: z != fixed))
    return Nutation(fixed, satellite, draw(st.floats(1e-3, 1.5)))


def vee(matrix: Array) -> Array:
    """Axial vector of skew matrices (n, 3, 3)."""
    skew = 0.5 * (matrix - np.swapaxes(matrix, -1, -2))
    return np.stack((skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]), axis=-1)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("fixed", "satellite", "ratio"), [(15, 14, -14), (14, 15, 15), (30, 29, -29), (20, 15, -3)]
)
def test_ratio(fixed: int, satellite: int, ratio: int) -> None:
    """i = ω_3/ω_4 = 1/(1 − q), sources §2; the output angle follows."""
    nutation = Nutation(fixed, satellite, 0.05)
    assert nutation.ratio == Fraction(ratio)
    assert float(output_angle(nutation, 2.0)) == pytest.approx(2.0 / ratio, rel=1e-15)


@pytest.mark.independent
@given(nutation=nutations())
@settings(max_examples=40, deadline=None)
def test_velocity_and_acceleration_are_derivatives_of_the_pose(nutation: Nutation) -> None:
    """Ṙ Rᵀ by differences of tenth order, at a changing speed: φ(τ) = φ₀ + ω τ + α τ²/2."""
    speed, change = 1.3, 0.7
    weights = np.array([2100.0, -600.0, 150.0, -25.0, 2.0]) / 2520.0
    # the fastest line turns with 1 + q: keep its step at 0.05 rad
    step = 0.05 / (1.0 + float(nutation.tooth_ratio)) / speed

    def pose(tau: float) -> tuple[Array, Array]:
        now = satellite_motion(
            nutation, ANGLES + speed * tau + 0.5 * change * tau**2, speed + change * tau, change
        )
        return now.rotation, now.velocity

    def rate(item: int) -> Array:
        terms = [w * (pose(k * step)[item] - pose(-k * step)[item]) for k, w in enumerate(weights, 1)]
        return np.asarray(np.sum(terms, axis=0) / step)

    motion = satellite_motion(nutation, ANGLES, speed, change)
    size = speed * (1.0 + float(nutation.tooth_ratio))
    spin = vee(rate(0) @ np.swapaxes(motion.rotation, -1, -2))
    np.testing.assert_allclose(motion.velocity, spin, atol=1e-10 * size)
    np.testing.assert_allclose(motion.acceleration, rate(1), atol=1e-9 * size**2)


@pytest.mark.property
@given(nutation=nutations())
@settings(max_examples=60, deadline=None)
def test_pitch_cones_roll_on_each_other(nutation: Nutation) -> None:
    """The instantaneous axis stands δ off the fixed axis and δ₂ off the satellite's, sin δ₂/sin δ = z2/z1."""
    axis = satellite_motion(nutation, ANGLES).instantaneous_axis()
    spread = np.sin(nutation.pitch_angle)
    np.testing.assert_allclose(np.hypot(axis[:, 0], axis[:, 1]), spread, atol=1e-12)
    n = turn(rotation(2, ANGLES), nutation.axis)
    own = np.linalg.norm(np.cross(axis, n), axis=-1)
    np.testing.assert_allclose(own * nutation.fixed_teeth, spread * nutation.satellite_teeth, atol=1e-11)


@pytest.mark.exact
@given(nutation=nutations())
@settings(max_examples=40, deadline=None)
def test_closed_form_in_the_fixed_frame(nutation: Nutation) -> None:
    """ω = ω_3 (k − q n) and |ε| = ω_3² q sin ϑ, (1)–(3) of the paper with the sign of (9)."""
    q, k = float(nutation.tooth_ratio), np.array([0.0, 0.0, 1.0])
    n = turn(rotation(2, ANGLES), nutation.axis)
    motion = satellite_motion(nutation, ANGLES, 2.0)
    np.testing.assert_allclose(motion.velocity, 2.0 * (k - q * n), atol=1e-13 * (1.0 + q))
    size = np.linalg.norm(motion.acceleration, axis=-1)
    np.testing.assert_allclose(size, 4.0 * q * math.sin(nutation.angle), rtol=1e-12)
    np.testing.assert_allclose(np.sum(motion.acceleration * n, axis=-1), 0.0, atol=1e-13 * (1.0 + q))


@pytest.mark.property
@given(nutation=nutations())
@settings(max_examples=40, deadline=None)
def test_closure(nutation: Nutation) -> None:
    """After z2/gcd turns of the crank the satellite stands as at first, and not after fewer."""
    turns = np.arange(nutation.closing_turns + 1)
    pose = satellite_motion(nutation, 2.0 * math.pi * turns).rotation
    away = np.abs(pose - pose[0]).max(axis=(1, 2))
    assert away[-1] < 1e-12 * (1.0 + nutation.fixed_teeth)
    assert (away[1:-1] > 1e-3 * min(1.0, nutation.angle)).all()


@pytest.mark.property
@given(nutation=nutations())
@settings(max_examples=40, deadline=None)
def test_inversion(nutation: Nutation) -> None:
    """Seen from the satellite, the fixed wheel nutates about it like a satellite on the other's teeth.

    With q' = 1/q and the crank angle φ' = q φ the poses agree up to the half turn that puts the crank on the
    other side.
    """
    q = float(nutation.tooth_ratio)
    seen = inverse(satellite_motion(nutation, ANGLES)).rotation
    swapped = Nutation(nutation.satellite_teeth, nutation.fixed_teeth, nutation.angle)
    half = rotation(2, math.pi)
    again = satellite_motion(swapped, q * ANGLES).rotation
    np.testing.assert_allclose(seen, half @ again @ half, atol=1e-11)


@pytest.mark.exact
def test_refusals_say_what_to_do() -> None:
    """No teeth, alike teeth, angles outside 0…90°."""
    for given_values, said in (
        ((15, 15, 0.05), "take 14 or 16"),
        ((0, 14, 0.05), "fixed_teeth = 0: at least one tooth"),
        ((15, 14, 0.0), "above 0° and below 90°"),
        ((15, 14, 1.6), "91.6732°: it must be"),
        ((15, 14, math.nan), "must be above"),
    ):
        with pytest.raises(Infeasible, match=said):
            Nutation(*given_values)
