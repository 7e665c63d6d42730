"""Motion of the indexed wheel: derivatives, symmetry, invariance, peaks, dwell, the plane limit."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.kinematics.indexer_cases import DEGREE, eighth_order, indexers, pin_at, speed_of_wheel
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.geneva import geneva
from trochoid.kinematics.indexer import Indexer, motion, shock
from trochoid.kinematics.indexer_measure import dwell, dwell_within, peaks, similarity
from trochoid.kinematics.indexer_synthesis import Task, by_duration
from trochoid.kinematics.spherical_trochoid import SphericalTrochoid

NINE = np.arange(-4, 5)
EXAMPLE = by_duration(Task(90 * DEGREE, 4), 0.2902)[0].indexer


@pytest.mark.independent
@given(indexer=indexers(), phi=st.floats(-3.0, 3.0))
@settings(max_examples=100, deadline=None)
def test_derivatives(indexer: Indexer, phi: float) -> None:
    """ω by a complex step in a chain of rotation matrices to 1e-12; ε and jerk by differences of eighth order."""
    assume(float(np.sin(indexer.reach(phi))) > 0.2)
    here = motion(indexer, phi)
    scale = (1.0 + abs(indexer.path.ratio)) / 0.2
    assert float(here.velocity) == pytest.approx(speed_of_wheel(indexer, phi), abs=1e-12 * scale)
    step = 0.02 / scale
    near = motion(indexer, phi + step * NINE)
    assert float(here.acceleration) == pytest.approx(eighth_order(near.velocity, step), abs=1e-8 * scale**2)
    assert float(here.jerk) == pytest.approx(eighth_order(near.acceleration, step), abs=1e-8 * scale**3)
    np.testing.assert_allclose(here.power, here.velocity * here.acceleration)


@pytest.mark.property
@given(indexer=indexers(), phi=st.floats(0.0, 3.0))
@settings(max_examples=60, deadline=None)
def test_symmetric_about_the_middle(indexer: Indexer, phi: float) -> None:
    """ψ and ε are odd, ω and the jerk even; so is N odd."""
    assume(float(np.sin(indexer.reach(phi))) > 1e-2)
    there, back = motion(indexer, phi), motion(indexer, -phi)
    np.testing.assert_allclose(np.exp(1j * (there.angle + back.angle)), 1.0, atol=1e-11)
    for one, other in (
        (there.velocity, back.velocity),
        (there.acceleration, -back.acceleration),
        (there.jerk, back.jerk),
        (there.power, -back.power),
    ):
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-9 * (1.0 + float(np.abs(there.jerk))))


@pytest.mark.property
@given(indexer=indexers(), phi=st.floats(-3.0, 3.0), seed=st.integers(0, 999), radius=st.floats(1e-3, 1e3))
@settings(max_examples=60, deadline=None)
def test_neither_size_nor_place_matters(indexer: Indexer, phi: float, seed: int, radius: float) -> None:
    """ψ is the angle between the planes through the wheel's axis, on a sphere of any radius, turned anyhow."""
    assume(float(np.sin(indexer.reach(phi))) > 1e-2)
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    pin = radius * turn @ pin_at(indexer.path, phi).real
    axis, drive = turn @ indexer.axis, turn @ [0.0, 0.0, 1.0]
    a, b = drive - (drive @ axis) * axis, pin - (pin @ axis) * axis
    found = math.atan2(-np.cross(a, b) @ axis, a @ b)  # against the wheel's axis: with the drive's at D = 0
    assert math.remainder(found - float(motion(indexer, phi).angle), 2 * math.pi) == pytest.approx(
        0.0, abs=1e-10
    )


@pytest.mark.exact
@pytest.mark.parametrize("ratio", [4.0, -4.0])
def test_plane_limit(ratio: float) -> None:
    """On a large sphere it is the plane mechanism: centre distance d, arm g, pin b; the difference falls as R⁻²."""
    phi, g, b, d = np.linspace(-0.9, 0.9, 7), 1.0, 0.2, 1.7
    plane = g * np.exp(1j * phi) + b * np.exp(1j * (phi + math.pi + ratio * phi))
    expected = np.angle(d - plane.real + 1j * plane.imag)
    error = []
    for small in (1e-2, 5e-3):
        made = Indexer(SphericalTrochoid(small * g, small * b, ratio, math.pi), small * d, 1.0)
        error.append(np.abs(motion(made, phi).angle - expected).max())
    assert error[0] < 1e-3
    assert math.log2(error[0] / error[1]) == pytest.approx(2.0, abs=0.02)


@pytest.mark.independent
def test_peaks_against_dense_sampling() -> None:
    """The refined extremes are those of half a million samples, and lie where they say."""
    top, t = peaks(EXAMPLE), np.linspace(0.0, EXAMPLE.half_turn, 500_001)
    dense = motion(EXAMPLE, t)
    for found, values in (
        (top.velocity, dense.velocity),
        (top.acceleration, dense.acceleration),
        (top.power, dense.power),
    ):
        assert found == pytest.approx(np.abs(values).max(), rel=1e-10)
        assert found >= np.abs(values).max() * (1.0 - 1e-14)
    assert float(motion(EXAMPLE, top.acceleration_at).jerk) == pytest.approx(0.0, abs=1e-6)
    assert top.start == pytest.approx(float(motion(EXAMPLE, -EXAMPLE.half_turn).acceleration) * EXAMPLE.sense)


@pytest.mark.exact
def test_narrow_peaks_are_found() -> None:
    """A pin that passes 1e-4 rad from the wheel's axis: max ω = sin β/sin(D − β) of a Geneva wheel, in the middle."""
    wheel = geneva(math.pi - 1e-2)
    close = float(wheel.reach(0.0))
    top = peaks(wheel)
    assert top.velocity == pytest.approx(math.sin(wheel.path.arm) / math.sin(close), rel=1e-12)
    # near the middle ψ = atan(φ/h): max |ε| = (3√3/8)/h²
    assert top.acceleration == pytest.approx(3.0 * math.sqrt(3.0) / 8.0 / close**2, rel=1e-3)


@pytest.mark.exact
def test_dwell() -> None:
    """Locked over 1 − k of the turn; over more of it the wheel still moves, as `dwell_within` says."""
    locked = dwell(EXAMPLE)
    assert locked.angle == pytest.approx(2.0 * math.pi * (1.0 - EXAMPLE.duration))
    assert locked.share == pytest.approx(1.0 - 0.2902)
    assert locked.motion == 0.0
    assert locked.clearance == pytest.approx(0.0, abs=1e-15)
    for tolerance in (1e-6, 1e-3, 0.3):
        longer = dwell_within(EXAMPLE, tolerance)
        assert longer > locked.angle
        assert dwell(EXAMPLE, longer).motion == pytest.approx(tolerance, rel=1e-9)
    # soft start: ψ0 − ψ = |ε0| x²/2 at the angle x before the end
    x = 0.5 * (dwell_within(EXAMPLE, 1e-8) - locked.angle)
    assert 0.5 * peaks(EXAMPLE).start * x**2 == pytest.approx(1e-8, rel=1e-3)


@pytest.mark.exact
def test_similarity() -> None:
    """B, C and their like are the peaks freed of T = 2φ0 and ψ_Σ; the law they belong to has no hard shock."""
    top, free = peaks(EXAMPLE), similarity(EXAMPLE)
    T, swing = 2.0 * EXAMPLE.half_turn, EXAMPLE.swing
    assert free.velocity == pytest.approx(top.velocity * T / swing)
    assert free.acceleration == pytest.approx(top.acceleration * T**2 / swing)
    assert free.power == pytest.approx(top.power * T**3 / swing**2)
    assert free.start == pytest.approx(top.start * T**2 / swing)
    assert abs(shock(EXAMPLE)) < 1e-14


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: Indexer(EXAMPLE.path, 0.0, 1.0), "shafts must cross"),
        (lambda: Indexer(EXAMPLE.path, 1.0, math.pi), "less than 360°"),
        (lambda: dwell(EXAMPLE, 7.0), "less than 360°"),
        (lambda: dwell_within(EXAMPLE, 1.0), "less than half the swing"),
    ],
)
def test_refusals(call: object, message: str) -> None:
    with pytest.raises(Infeasible, match=message):
        call()  # type: ignore[operator]
