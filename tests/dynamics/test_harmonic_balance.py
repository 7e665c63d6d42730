"""Steady motions by harmonic balance: the gear pair with backlash, linear systems, varying stiffness."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from trochoid.dynamics.harmonic_balance import Periodic, steady
from trochoid.dynamics.local_law import Local, gap, varying
from trochoid.dynamics.members import modal_damping
from trochoid.dynamics.sweep import follow, sweep
from trochoid.dynamics.system import System, receptance
from trochoid.kinematics.errors import NotConverged, TrochoidError
from trochoid.kinematics.types import Array, ComplexArray

HARMONICS = 12
ONE = np.ones((1, 1))
PAIR = System(ONE, 0.1 * ONE, 0.0 * ONE)
BACKLASH = (Local("mesh", np.ones(1), gap(1.0, 1.0), 1.0, play=1.0),)


def loads(speed: float) -> ComplexArray:
    """x\u2033 + 2ζx\u2032 + f(x) = F_m + F_a Ω² cos Ωτ with ζ 0.05, F_m 0.1, F_a 0.05."""
    lines = np.zeros((HARMONICS + 1, 1), dtype=np.complex128)
    lines[0], lines[1] = 0.1, 0.05 * speed**2
    return lines


def swing(motion: Periodic) -> float:
    return float(motion.peak_to_peak[0])


@pytest.mark.published
@pytest.mark.parametrize(("speed", "peak"), [(0.5, 0.0333), (1.0, 0.3740), (1.5, 0.1787)])
def test_gear_pair_with_backlash(speed: float, peak: float) -> None:
    """The nonlinear gear pair of the verification list: peak to peak, to its digits."""
    assert swing(steady(PAIR, BACKLASH, loads(speed), speed)) == pytest.approx(peak, abs=5e-5)


@pytest.mark.published
def test_gear_pair_has_two_branches_and_jumps() -> None:
    """The same pair: both swings at 0.75 and 0.80; it jumps up in (0.80, 0.85) and down in (0.70, 0.75)."""
    speeds = 0.5 + 0.01 * np.arange(101)
    up, down = (
        {round(m.speed, 2): swing(m) for m in sweep(PAIR, BACKLASH, loads, order)}
        for order in (speeds, speeds[::-1])
    )
    assert [up[0.75], down[0.75], up[0.80], down[0.80]] == pytest.approx(
        [0.1267, 0.6367, 0.1735, 0.5714], abs=5e-5
    )
    assert (up[0.80] < 0.2, up[0.85] > 0.5) == (True, True)
    assert (down[0.75] > 0.6, down[0.70] < 0.1) == (True, True)
    curve = follow(PAIR, BACKLASH, loads, (0.5, 1.5))
    high, low = curve.folds
    assert 0.80 < high < 0.85
    assert 0.70 < low < 0.75
    for speed, motions in ((0.75, 3), (1.2, 1)):
        assert np.count_nonzero((curve.speed[:-1] - speed) * (curve.speed[1:] - speed) <= 0) == motions


def integrated(speed: float, start: tuple[float, float], periods: int = 40) -> Array:
    """Return the last period of the gear pair by a Runge–Kutta method, its gap with a sharp corner."""

    def rate(t: float, y: Array) -> list[float]:
        beyond = np.sign(y[0]) * max(abs(y[0]) - 1.0, 0.0)
        return [y[1], 0.1 + 0.05 * speed**2 * np.cos(speed * t) - 0.1 * y[1] - beyond]

    end = 2 * np.pi / speed * periods
    at = np.linspace(end - 2 * np.pi / speed, end, 401)
    return np.asarray(solve_ivp(rate, (0.0, end), start, t_eval=at, rtol=1e-9, atol=1e-11, max_step=0.1).y[0])


@pytest.mark.independent
@pytest.mark.parametrize("speed", [0.5, 1.0])
def test_gear_pair_against_time_integration(speed: float) -> None:
    """The same swing from integrating the motion until it repeats; the rounded corner costs 1e-3."""
    motion = steady(PAIR, BACKLASH, loads(speed), speed)
    assert swing(motion) == pytest.approx(float(np.ptp(integrated(speed, (1.1, 0.0)))), rel=1e-3)


CHAIN = modal_damping(
    System(
        np.diag([2.0, 1.0, 0.5]),
        np.zeros((3, 3)),
        np.array([[3e3, -1e3, 0.0], [-1e3, 1e3, 0.0], [0.0, 0.0, 4e3]]),
    ),
    0.03,
)
MESH = np.array([0.0, 1.0, -1.0])


def pulled(amplitude: float, harmonics: int = 6) -> ComplexArray:
    lines = np.zeros((harmonics + 1, 3), dtype=np.complex128)
    lines[0], lines[1] = [0.0, 40.0, -40.0], [amplitude, 0.0, 0.3j * amplitude]
    return lines


@pytest.mark.exact
@given(speed=st.floats(5.0, 200.0), stiffness=st.floats(1e-3, 1e9))
def test_a_plain_spring_is_the_linear_answer(speed: float, stiffness: float) -> None:
    """A gap of zero: every harmonic is its receptance times its load, whatever the stiffness."""
    spring = (Local("mesh", MESH, gap(stiffness, 0.0), stiffness),)
    whole = System(CHAIN.mass, CHAIN.damping, CHAIN.stiffness + stiffness * np.outer(MESH, MESH))
    motion = steady(CHAIN, spring, pulled(7.0), speed)
    wanted = receptance(whole, speed, pulled(7.0)[1][:, None])[:, 0]
    assert np.abs(motion.amplitudes[1] - wanted).max() <= 1e-9 * np.abs(wanted).max()


@pytest.mark.independent
def test_varying_stiffness_against_time_integration() -> None:
    """Three masses and a mesh whose stiffness varies by a third: the same motion after it has settled."""
    k = 2e3 * (1.0 + 0.3 * np.cos(2 * np.pi * np.arange(16) / 16))
    mesh = (Local("mesh", MESH, varying(k), 2e3),)
    speed = 37.0
    motion = steady(CHAIN, mesh, pulled(7.0, 10), speed)

    def rate(t: float, y: Array) -> Array:
        stiff = 2e3 * (1.0 + 0.3 * np.cos(speed * t))
        force = pulled(7.0)[0].real + (pulled(7.0)[1] * np.exp(1j * speed * t)).real
        force = force - MESH * stiff * (MESH @ y[:3]) - CHAIN.damping @ y[3:] - CHAIN.stiffness @ y[:3]
        return np.concatenate([y[3:], force / np.diag(CHAIN.mass)])

    end = 2 * np.pi / speed * 120
    at = np.linspace(end - 2 * np.pi / speed, end, 201)
    settled = solve_ivp(rate, (0.0, end), np.zeros(6), t_eval=at, rtol=1e-9, atol=1e-12)
    found = float(np.ptp(MESH @ settled.y[:3]))
    assert swing(motion) == pytest.approx(found, rel=2e-4)


@pytest.mark.property
@settings(deadline=None, max_examples=25)
@given(speed=st.floats(0.3, 3.0))
def test_power_balances(speed: float) -> None:
    """What the load puts in over a period is what the damper takes: ½ Re(F* iΩX) summed over the lines.

    The gap takes nothing, but for what few instants do not see of its corner.
    """
    motion = steady(PAIR, BACKLASH, loads(speed), speed, samples=4096)
    order = np.arange(HARMONICS + 1)[:, None] * speed
    velocity = 1j * order * motion.amplitudes
    given_power = 0.5 * np.sum((np.conj(loads(speed)) * velocity).real)
    taken = 0.5 * 0.1 * np.sum(np.abs(velocity) ** 2)
    assert given_power == pytest.approx(taken, rel=1e-6)


@pytest.mark.property
def test_what_has_no_steady_motion_is_refused() -> None:
    """No speed, a member that runs away, a resonance without damping, loads that do not fit, impossible laws."""
    with pytest.raises(TrochoidError, match="speed above 0"):
        steady(PAIR, BACKLASH, loads(1.0), 0.0)
    free = System(np.eye(2), 0.1 * np.eye(2), np.zeros((2, 2)))
    mesh = (Local("mesh", np.array([1.0, -1.0]), gap(1.0, 0.0), 1.0),)
    lines = np.zeros((3, 2), dtype=np.complex128)
    lines[0] = [1.0, 0.0]
    with pytest.raises(TrochoidError, match="not in equilibrium"):
        steady(free, mesh, lines, 1.0)
    undamped = System(ONE, 0.0 * ONE, 0.0 * ONE)
    with pytest.raises(TrochoidError, match="nothing damps it"):
        steady(undamped, BACKLASH, loads(1.0), 1.0)
    with pytest.raises(TrochoidError, match=r"loads must be \(harmonics \+ 1, 1\)"):
        steady(PAIR, BACKLASH, lines, 1.0)
    with pytest.raises(TrochoidError, match="stiffness above 0"):
        gap(0.0, 1.0)
    with pytest.raises(TrochoidError, match="mean above 0"):
        varying(np.zeros(8))


@pytest.mark.property
def test_what_is_not_found_is_said() -> None:
    """A law without any equilibrium ends in a message that names the speed, not in a number."""
    runaway = (Local("mesh", np.ones(1), lambda x, phase: (1.0 + 0.0 * x, 0.0 * x), 1.0),)
    with pytest.raises(NotConverged, match=r"no steady motion was found at 1 rad/s"):
        steady(PAIR, runaway, loads(1.0), 1.0)
