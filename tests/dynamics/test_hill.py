"""Linear systems whose stiffness varies with their load: against integration in time, and Mathieu's equation."""

from __future__ import annotations

import numpy as np
import pytest

from trochoid.dynamics.elastic import respond
from trochoid.dynamics.floquet import fail_if_growing, growth
from trochoid.dynamics.hill import rate, steady, varied
from trochoid.kinematics.errors import NotConverged, TrochoidError
from trochoid.kinematics.types import Array

SPEED = 300.0
MASS = np.diag([2.0, 0.5])
GYRO = np.array([[0.0, 40.0], [-40.0, 0.0]])
DAMPING = np.diag([60.0, 20.0]) + GYRO
MEAN = np.array([[9e5, -3e5], [-3e5, 5e5]])


def stiffness(angle: Array) -> Array:
    """A strong variation over the period, with two harmonics."""
    change = 0.3 * np.cos(angle) + 0.1 * np.sin(2.0 * angle)
    return np.asarray(MEAN + change[..., None, None] * np.array([[4e5, -2e5], [-2e5, 3e5]]))


def force(angle: Array) -> Array:
    return np.stack([50.0 + 10.0 * np.cos(angle), 20.0 * np.sin(angle - 0.4)], axis=-1)


@pytest.mark.independent
def test_steady_motion_is_where_time_integration_ends() -> None:
    """scipy's integrator, started on the motion, comes back to it after three periods."""
    from scipy.integrate import solve_ivp

    angle = 2.0 * np.pi * np.arange(61) / 61
    y = steady(MASS, DAMPING, stiffness(angle), force(angle), SPEED)
    inverse = np.linalg.inv(MASS)

    def change(time: float, state: Array) -> Array:
        at = np.asarray(SPEED * time)
        return np.concatenate(
            [state[2:], inverse @ (force(at) - DAMPING @ state[2:] - stiffness(at) @ state[:2])]
        )

    start = np.concatenate([y[0], rate(y, SPEED)[0]])
    end = solve_ivp(change, (0.0, 6.0 * np.pi / SPEED), start, rtol=1e-10, atol=1e-14).y[:, -1]
    assert end == pytest.approx(start, rel=1e-6)


@pytest.mark.exact
def test_a_constant_stiffness_is_the_modal_answer() -> None:
    """The same inertia load on the same modes as `elastic.respond`, whose damping is modal."""
    from trochoid.dynamics.members import modal_damping
    from trochoid.dynamics.system import System

    angle = 2.0 * np.pi * np.arange(24) / 24
    slow = 1e-6 * np.stack([np.cos(angle) + np.sin(3.0 * angle), np.sin(2.0 * angle)], axis=1)
    damped = modal_damping(System(MASS, 0.0 * MASS, MEAN), 0.02)
    found = respond(slow, MASS, MEAN, SPEED, 0.02)
    load = -rate(slow, SPEED, 2) @ MASS
    y = steady(MASS, damped.damping, np.tile(MEAN, (24, 1, 1)), load, SPEED)
    assert y == pytest.approx(found.correction, abs=1e-9 * np.abs(found.correction).max())


@pytest.mark.property
def test_the_equations_hold_at_every_instant() -> None:
    angle = 2.0 * np.pi * np.arange(31) / 31
    y = steady(MASS, DAMPING, stiffness(angle), force(angle), SPEED)
    left = rate(y, SPEED, 2) @ MASS + rate(y, SPEED) @ DAMPING.T + varied(stiffness(angle), y)
    assert left == pytest.approx(force(angle), abs=1e-9 * 50.0)


@pytest.mark.published
@pytest.mark.parametrize(("part", "grows"), [(0.0, False), (0.15, True)])
def test_mathieu(part: float, grows: bool) -> None:
    """ÿ + ω²(1 + ε cos 2ωt) y = 0 grows by about exp(ε ω/4 · π/ω) over a period of the stiffness (Hayashi)."""
    angle = 2.0 * np.pi * np.arange(200) / 200
    k = (1.0 + part * np.cos(angle))[:, None, None]
    found = growth(np.eye(1), np.zeros((1, 1)), k, 2.0)
    assert found == pytest.approx(np.exp(0.25 * part * np.pi), rel=2e-3)
    assert (found > 1.001) == grows


@pytest.mark.property
def test_what_nothing_holds_stays_and_what_cannot_be_is_refused() -> None:
    """A coordinate without stiffness is left where it is; a speed of 0 and a resonance without damping are refused."""
    angle = 2.0 * np.pi * np.arange(8) / 8
    k = np.zeros((8, 2, 2))
    k[:, 0, 0] = 1e4
    y = steady(np.eye(2), np.eye(2), k, np.stack([np.cos(angle), 0.0 * angle], axis=1), 10.0)
    assert np.all(y[:, 1] == 0.0)
    assert np.abs(y[:, 0]).max() > 0.0
    with pytest.raises(TrochoidError, match="speed above 0"):
        steady(np.eye(1), np.eye(1), np.ones((8, 1, 1)), np.ones((8, 1)), 0.0)
    with pytest.raises(TrochoidError, match="no steady motion"):
        steady(np.eye(1), np.zeros((1, 1)), np.full((8, 1, 1), 4.0), np.cos(angle)[:, None], 2.0)


@pytest.mark.property
def test_stiffness_that_comes_and_goes_is_solved_directly() -> None:
    """A spring that is there for half of the time only: the equations hold, and the mean alone would be far off."""
    angle = 2.0 * np.pi * np.arange(41) / 41
    on = (np.cos(angle) > 0.0).astype(float)[:, None, None]
    k = 2e5 * np.eye(2) + on * np.array([[4e7, -4e7], [-4e7, 4e7]])
    y = steady(MASS, DAMPING, k, force(angle), SPEED)
    left = rate(y, SPEED, 2) @ MASS + rate(y, SPEED) @ DAMPING.T + varied(k, y)
    assert left == pytest.approx(force(angle), abs=1e-7 * 50.0)
    plain = steady(MASS, DAMPING, k.mean(axis=0)[None], force(angle), SPEED)
    assert np.abs(plain - y).max() > 0.2 * np.abs(y).max()


@pytest.mark.exact
def test_free_bodies_under_varying_stiffness_keep_their_centre() -> None:
    """Two masses on a spring between them that varies, nothing to the ground: the centre rests."""
    angle = 2.0 * np.pi * np.arange(31) / 31
    k = 3e5 * (1.0 + 0.4 * np.cos(2.0 * angle))[:, None, None] * np.array([[1.0, -1.0], [-1.0, 1.0]])
    push = 10.0 * np.cos(angle)[:, None] * np.array([1.0, -1.0])
    y = steady(MASS, 0.0 * MASS, k, push, SPEED)
    assert y @ np.diag(MASS) == pytest.approx(0.0, abs=1e-12)
    assert np.abs(y).max() > 1e-5


@pytest.mark.property
def test_a_stiffness_that_excites_itself_is_named() -> None:
    """Mathieu's equation in its first tongue: refused with growth, frequency and what to try; outside, the growth."""
    angle = 2.0 * np.pi * np.arange(200) / 200
    k = (1.0 + 0.15 * np.cos(angle))[:, None, None]
    with pytest.raises(
        NotConverged, match=r"the mesh excites itself: free motions grow 1\.12.*damping_ratio"
    ):
        fail_if_growing(np.eye(1), np.zeros((1, 1)), k, 2.0, "the mesh")
    assert fail_if_growing(np.eye(1), np.full((1, 1), 0.2), k, 2.0, "the mesh") < 1.0
    assert growth(np.eye(1), np.zeros((1, 1)), k, 2.9) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.independent
def test_multipliers_with_damping_and_momentum() -> None:
    """Against scipy's integrator over one period, for all states of two masses with gyroscopic terms."""
    from scipy.integrate import solve_ivp

    from trochoid.dynamics.floquet import multipliers

    inverse = np.linalg.inv(MASS)

    def change(time: float, flat: Array) -> Array:
        y = flat.reshape(4, 4)
        return np.concatenate(
            [y[2:], -inverse @ (DAMPING @ y[2:] + stiffness(np.asarray(SPEED * time)) @ y[:2])]
        ).ravel()

    end = solve_ivp(change, (0.0, 2.0 * np.pi / SPEED), np.eye(4).ravel(), rtol=1e-10, atol=1e-12).y[:, -1]
    expected = np.sort(np.abs(np.linalg.eigvals(end.reshape(4, 4))))
    found = multipliers(MASS, DAMPING, stiffness(2.0 * np.pi * np.arange(800) / 800), SPEED)
    assert np.sort(np.abs(found)) == pytest.approx(expected, rel=2e-4)


@pytest.mark.exact
@pytest.mark.parametrize("turning", [False, True])
def test_damping_of_a_frame_that_turns_faster_than_the_whirl(turning: bool) -> None:
    """A mass on round springs, seen from a frame above its critical speed: what damps at rest damps, what turns drives.

    Jeffcott's rotor: fixed damping c decays with exp(−c t/2m); damping that turns with Ω > ω grows by about
    exp(c (Ω − ω) t/(2 m ω)).
    """
    mass, natural, frame, c = 2.0, 50.0, 120.0, 4.0
    skew = frame * np.array([[0.0, -1.0], [1.0, 0.0]])
    k = (mass * natural**2) * np.eye(2) + mass * skew @ skew + (0.0 if turning else c) * skew
    matrices = np.tile(k, (400, 1, 1))
    found = growth(mass * np.eye(2), 2.0 * mass * skew + c * np.eye(2), matrices, frame)
    rate_ = c * (frame - natural) / (2.0 * mass * natural) if turning else -c / (2.0 * mass)
    assert np.log(found) == pytest.approx(rate_ * 2.0 * np.pi / frame, rel=0.02)
