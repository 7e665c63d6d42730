"""A wheel driven by an elastic pin: closed forms of steps, balances of energy, friction that holds."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.dynamics.indexing import Index, respond
from trochoid.dynamics.indexing_parts import Output
from trochoid.dynamics.pin_law import PinLaw, pin_law
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array

K, J = 1e6, 0.01  # 1e4 rad/s


def linear(play: float = 0.0) -> PinLaw:
    return pin_law(lambda u: K * u, 1e-3, play)


def step(acceleration: float = 100.0, duration: float = 0.01, rest: float = 0.01) -> Index:
    """A base whose acceleration jumps from 0 to a constant."""

    def sample(t: Array) -> tuple[Array, Array, Array]:
        return np.full_like(t, 0.5 * math.pi), acceleration * t, np.full_like(t, acceleration)

    return Index(duration, rest, sample)


def humped(duration: float, rest: float = 0.01, swing: float = 0.1) -> Index:
    """A half turn of a cosine: accelerations jump at both ends, the lever varies."""
    w = math.pi / duration

    def sample(t: Array) -> tuple[Array, Array, Array]:
        velocity, acceleration = 0.5 * swing * w * np.sin(w * t), 0.5 * swing * w**2 * np.cos(w * t)
        return np.arcsin(0.9 + 0.1 * np.sin(w * t)), velocity, acceleration

    return Index(duration, rest, sample)


@pytest.mark.exact
def test_a_step_of_acceleration_doubles_the_torque() -> None:
    """Duhamel: d = ε/ω² (1 − cos ωt), torque Jε (1 − cos ωt), at every instant; the method is of fourth order."""
    errors = []
    for steps in (16, 32, 64):
        found = respond(step(), Output(J, 0.0, K), linear(), steps).index
        expected = J * 100.0 * (1.0 - np.cos(1e4 * found.time))
        errors.append(float(np.abs(found.torque - expected).max()))
    assert errors[2] < 1e-4
    assert errors[1] / errors[2] == pytest.approx(16.0, rel=0.1)
    assert found.torque.max() == pytest.approx(2.0, abs=2e-5)


@pytest.mark.exact
def test_a_damped_step() -> None:
    """The first overshoot is 1 + exp(−πζ/√(1 − ζ²)) for a contact whose damping adds to its torque c d', c = βk."""
    zeta = 0.05
    found = respond(step(), Output(J, 0.0, K, 2.0 * zeta / 1e4), linear(), 128).index
    root = math.sqrt(1.0 - zeta**2)
    t = 1e4 * found.time
    lag = 1e-6 * (1.0 - np.exp(-zeta * t) * (np.cos(root * t) + zeta / root * np.sin(root * t)))
    np.testing.assert_allclose(found.lag, lag, atol=1e-10)
    assert found.lag.max() * 1e6 == pytest.approx(1.0 + math.exp(-math.pi * zeta / root), abs=1e-3)


@pytest.mark.exact
def test_the_dwell_rings_down() -> None:
    """After the stop the output swings with the energy that it had, decaying by exp(−ζωt)."""
    found = respond(humped(0.01, 0.005), Output(J, 0.0, K, 2.0 * 0.02 / 1e4), linear(), 128)
    dwell, zeta, w = found.dwell, 0.02, 1e4
    wd, start, rate = w * math.sqrt(1 - zeta**2), dwell.deviation[0], dwell.speed[0]
    expected = np.exp(-zeta * w * dwell.time) * (
        start * np.cos(wd * dwell.time) + (rate + zeta * w * start) / wd * np.sin(wd * dwell.time)
    )
    np.testing.assert_allclose(dwell.deviation, expected, atol=1e-4 * np.abs(expected).max())
    assert not found.stuck


@pytest.mark.exact
def test_friction_takes_a_constant_part_of_each_swing() -> None:
    """Undamped, Coulomb: extremes fall by 2 M_f/k per half swing until M_f holds the spring."""
    base = step(100.0, math.pi / 1e4, 0.01)  # at the end d = 2ε/ω² with the base still moving
    found = respond(base, Output(J, 0.05, K), linear(), 256)
    away = found.dwell.deviation
    turns = np.flatnonzero((away[1:-1] - away[:-2]) * (away[2:] - away[1:-1]) < 0.0) + 1
    peaks = np.abs(away[turns])
    np.testing.assert_allclose(peaks[:-1] - peaks[1:], 2.0 * 0.05 / K, rtol=2e-3)
    assert found.stuck
    assert abs(away[-1]) <= 0.05 / K * (1.0 + 1e-9)


@pytest.mark.property
@given(
    friction=st.sampled_from([0.0, 0.3, 2.0]),
    shaft=st.sampled_from([0.0, 1e5]),
    damping=st.floats(0.0, 0.1),
    play=st.sampled_from([0.0, 1e-5]),
)
@settings(max_examples=12, deadline=None)
def test_energy_balances(friction: float, shaft: float, damping: float, play: float) -> None:
    """What the pin does is what masses and shaft hold and friction and shaft lose, over index and dwell."""
    output = Output(J, friction, K, 2.0 * damping / 1e4, shaft, 0.02 if shaft else 0.0)
    found = respond(humped(0.02), output, linear(play))
    assert found.index.balance < 1e-4
    assert found.dwell.balance < 1e-3
    assert np.isfinite(found.index.torque).all()


@pytest.mark.exact
def test_a_stiff_pin_is_rigid() -> None:
    """Damped and ten times stiffer, the lag is ten times less; torques away from the start are those of the rigid."""
    lags = []
    for stiff in (1.0, 10.0, 100.0):
        law = pin_law(lambda u, k=stiff * K: k * u, 1e-3)  # type: ignore[misc]
        out = Output(J, 0.5, stiff * K, 2.0 * 0.3 / (1e4 * math.sqrt(stiff)))
        index = humped(0.05)
        found = respond(index, out, law).index
        lags.append(float(np.abs(found.lag).max()))
        rigid = J * index.sample(found.time)[2] + 0.5
        late = (found.time > 0.01) & (found.time < 0.049)
        off = float(np.abs(found.torque - rigid)[late].max())
        assert off < 0.02 / math.sqrt(stiff)
    assert lags[0] / lags[1] == pytest.approx(10.0, rel=0.05)
    assert lags[1] / lags[2] == pytest.approx(10.0, rel=0.05)


@pytest.mark.property
def test_two_masses_without_a_soft_shaft_are_one() -> None:
    """A shaft much stiffer than the contact: the same lag as with both masses in one."""
    one = respond(humped(0.01), Output(0.03, 0.0, K, 1e-5), linear(), 64).index
    two = respond(humped(0.01), Output(0.01, 0.0, K, 1e-5, 1e3 * K, 0.02), linear(), 16).index
    np.testing.assert_allclose(
        np.interp(one.time, two.time, two.lag), one.lag, atol=0.01 * float(np.abs(one.lag).max())
    )


@pytest.mark.exact
def test_frequencies() -> None:
    """Two masses: the roots of the characteristic polynomial by numpy's eigenvalues."""
    out = Output(0.01, 0.0, 1e6, 0.0, 2e5, 0.03)
    matrix = np.array([[1.2e6, -2e5], [-2e5, 2e5]]) / np.array([[0.01], [0.03]])
    np.testing.assert_allclose(out.frequencies, np.sqrt(np.sort(np.linalg.eigvals(matrix))), rtol=1e-12)


@pytest.mark.property
def test_too_slow_to_follow() -> None:
    """An index of very many periods is refused with the reason."""
    with pytest.raises(NotConverged, match=r"natural periods .* take .* times the speed"):
        respond(humped(100.0), Output(J, 0.0, K), linear())


@pytest.mark.exact
def test_law_is_odd_and_inverted() -> None:
    """The table gives the law, its slope and its inverse, to either side of the play."""
    law = pin_law(lambda u: 1e6 * u**1.5, 1e-3, 1e-5)
    u = np.array([1e-6, 1e-4, 7e-4])
    np.testing.assert_allclose(law.moment(u), 1e6 * u**1.5, rtol=1e-10)
    np.testing.assert_allclose(law.slope(u), 1.5e6 * np.sqrt(u), rtol=1e-8)
    np.testing.assert_allclose(law.pressed(law.moment(u)), u, rtol=1e-9)
    torque = law.torque(0.0)
    assert torque(1.1e-4, 0.0, 0.5 * math.pi) == pytest.approx(1.0)
    assert torque(-1.1e-4, 0.0, 0.5 * math.pi) == pytest.approx(-1.0)
    assert torque(0.9e-5, 0.0, 0.5 * math.pi) == 0.0
    assert torque(2.2e-4, 0.0, math.pi / 6.0) == pytest.approx(0.5)
