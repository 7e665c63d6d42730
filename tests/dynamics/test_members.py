"""Rigid members on springs: rigid motions, torsional pairs, whirl of spinning rotors, self-excitation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import mathieu_a, mathieu_b

from trochoid.dynamics.floquet import along, growth, multipliers
from trochoid.dynamics.local_law import Local, varying
from trochoid.dynamics.members import (
    Member,
    column,
    disc_member,
    joint,
    line,
    modal_damping,
    system,
)
from trochoid.dynamics.system import System
from trochoid.dynamics.whirl import campbell, critical_speeds, whirl
from trochoid.kinematics.errors import TrochoidError

BODY = np.diag([2.0, 3.0, 4.0])


@pytest.mark.exact
def test_pair_of_gears_has_the_frequency_of_the_textbook() -> None:
    """Two gears on a mesh spring: ω² = k (r1²/J1 + r2²/J2) between their torsions, all else free."""
    gears = (
        disc_member("pinion", 1.0, 2e-3, 1e-3, 0.0, 0.0),
        disc_member("wheel", 3.0, 8e-3, 4e-3, 0.0, 0.0),
    )
    heavy = tuple(Member(g.name, 1e9, np.diag([1e6, 1e6, g.inertia[2, 2]])) for g in gears)
    apart = (heavy[0], Member("wheel", 1e9, heavy[1].inertia, (0.12, 0.0, 0.0)))
    k, pitch = 3e8, (0.04, 0.0, 0.0)
    mesh = line("mesh", apart, "pinion", "wheel", pitch, (0.0, 1.0, 0.0), k)
    frequencies = system(apart, [mesh]).modes.hertz
    wanted = np.sqrt(k * (0.04**2 / 2e-3 + 0.08**2 / 8e-3)) / (2 * np.pi)
    assert frequencies[-1] == pytest.approx(wanted, rel=1e-6)
    assert np.all(frequencies[:-1] == 0.0)


@pytest.mark.exact
@pytest.mark.parametrize("speed", [0.0, 300.0, 3000.0])
def test_tilting_disc_whirls_as_in_the_textbook(speed: float) -> None:
    """A disc on a tilting spring k: ω = [√((J_p Ω)² + 4 J_d k) ± J_p Ω]/(2 J_d), forward and backward."""
    polar, across, k = 0.02, 0.012, 5e3
    rotor = (disc_member("rotor", 1.0, polar, across, 0.0, speed),)
    bearing = joint("bearing", rotor, None, "rotor", (0.0, 0.0, 0.0), np.diag([1e9, 1e9, 1e9, k, k, 0.0]))
    found = whirl(system(rotor, [bearing]))
    middle, reach = (
        polar * speed / (2 * across),
        np.sqrt((polar * speed) ** 2 + 4 * across * k) / (2 * across),
    )
    wanted = np.array([reach - middle, reach + middle]) / (2 * np.pi)
    assert found.frequency[:2] == pytest.approx(wanted, rel=1e-9)
    assert found.ratio[:2] == pytest.approx([0.0, 0.0], abs=1e-9)
    if speed:
        assert found.direction(3, 4)[:2].tolist() == [-1.0, 1.0]


@pytest.mark.exact
def test_critical_speed_of_a_disc_that_tilts() -> None:
    """The forward whirl meets once per turn at Ω² = k/(J_d − J_p); a flat disc (J_p > J_d) has none."""
    k = 5e3

    def at(polar: float, across: float, speed: float) -> System:
        rotor = (disc_member("rotor", 1.0, polar, across, 0.0, speed),)
        held = np.diag([1e12, 1e12, 1e12, k, k, 1e12])
        return system(rotor, [joint("bearing", rotor, None, "rotor", (0.0, 0.0, 0.0), held)])

    speeds = np.linspace(1.0, 3000.0, 1200)
    thick = campbell(lambda w: at(0.008, 0.012, w), speeds)
    flat = campbell(lambda w: at(0.02, 0.012, w), speeds)
    forward, backward = np.sqrt(k / (0.012 - 0.008)), np.sqrt(k / (0.012 + 0.008))
    assert critical_speeds(speeds, thick) == pytest.approx([backward, forward], rel=1e-4)
    assert critical_speeds(speeds, flat) == pytest.approx([np.sqrt(k / (0.012 + 0.02))], rel=1e-4)


vectors = st.tuples(*[st.floats(-0.5, 0.5)] * 3)


@pytest.mark.property
@given(at=vectors, second=vectors, turn=vectors, move=vectors, seed=st.integers(0, 1000))
def test_joints_do_not_feel_a_rigid_motion_of_all(
    at: tuple[float, float, float],
    second: tuple[float, float, float],
    turn: tuple[float, float, float],
    move: tuple[float, float, float],
    seed: int,
) -> None:
    """Stiffness is symmetric and positive semi-definite, and a common rigid motion costs nothing."""
    square = np.random.default_rng(seed).normal(size=(6, 6))
    pair = (Member("one", 1.0, BODY), Member("two", 2.0, BODY, second))
    k = np.asarray(system(pair, [joint("bearing", pair, "one", "two", at, square @ square.T)]).stiffness)
    assert np.array_equal(k, k.T)
    assert np.linalg.eigvalsh(k).min() >= -1e-10 * np.abs(k).max()
    rigid = np.concatenate([np.append(np.add(move, np.cross(turn, m.center)), turn) for m in pair])
    assert np.abs(k @ rigid).max() <= 1e-12 * np.abs(k).max()


@pytest.mark.property
def test_equal_frequencies_and_free_members_are_sound() -> None:
    """A ball on equal springs has three equal frequencies thrice; a free member has none."""
    ball = (Member("ball", 2.0, 0.5 * np.eye(3)),)
    spring = joint("spring", ball, None, "ball", (0.0, 0.0, 0.0), np.diag([8e3] * 3 + [2e3] * 3))
    damped = modal_damping(system(ball, [spring]), 0.05)
    found = whirl(damped)
    assert 2 * np.pi * found.frequency == pytest.approx([np.sqrt(4e3) * np.sqrt(1 - 0.05**2)] * 6, rel=1e-9)
    assert found.ratio == pytest.approx([0.05] * 6, rel=1e-9)
    assert len(whirl(system(ball, [])).frequency) == 0


@pytest.mark.property
def test_mass_ratios_of_1e9_keep_both_frequencies() -> None:
    """A gram and a thousand tonnes on springs of their own: each keeps its frequency to rounding."""
    pair = (Member("gram", 1e-3, 1e-7 * np.eye(3)), Member("rock", 1e6, 1e6 * np.eye(3), (0.0, 0.0, 1.0)))
    springs = [
        joint("one", pair, None, "gram", (0.0, 0.0, 0.0), np.diag([10.0] * 3 + [1e-3] * 3)),
        joint("two", pair, None, "rock", (0.0, 0.0, 1.0), np.diag([4e8] * 3 + [9e8] * 3)),
    ]
    frequencies = 2 * np.pi * system(pair, springs).modes.hertz
    assert frequencies == pytest.approx([20.0] * 3 + [30.0] * 3 + [100.0] * 6, rel=1e-9)


@pytest.mark.exact
def test_soft_whirl_beside_stiffness_of_1e20() -> None:
    """A spinning disc on soft tilting springs, held 1e20 times as stiff across: both whirls, to ten digits.

    ω = [√(G² + 4 k) ± G]/2 for unit inertia; and a free disc nutates with G, its momentum over its inertia.
    """
    momentum = 3.0
    spins = np.zeros((4, 4))
    spins[2, 3], spins[3, 2] = momentum, -momentum
    stiff = System(np.eye(4), np.zeros((4, 4)), np.diag([1e20, 1e20, 1.0, 1.0]), spins)
    found = whirl(stiff)
    root = np.sqrt(momentum**2 + 4.0)
    wanted = [0.5 * (root - momentum), 0.5 * (root + momentum), 1e10, 1e10]
    assert 2 * np.pi * found.frequency == pytest.approx(wanted, rel=1e-5)
    apart = whirl(System(np.eye(4), np.zeros((4, 4)), np.diag([1e12, 1e12, 1.0, 1.0]), spins))
    assert 2 * np.pi * apart.frequency[:2] == pytest.approx(wanted[:2], rel=1e-9)
    assert found.growth == 0.0
    free = whirl(System(np.eye(4), np.zeros((4, 4)), np.diag([1e12, 1e12, 0.0, 0.0]), spins))
    assert 2 * np.pi * free.frequency == pytest.approx([momentum, 1e6, 1e6], rel=1e-9)


@pytest.mark.exact
def test_mass_ratio_of_1e9_on_one_joint() -> None:
    """A gram on a joint to a thousand tonnes on a soft spring: both frequencies, closed form of two masses."""
    small, large, joint_, ground = 1e-3, 1e6, 1e9, 1e4
    mass = np.diag([small, large])
    stiffness = np.array([[joint_, -joint_], [-joint_, joint_ + ground]])
    found = 2 * np.pi * whirl(System(mass, np.zeros((2, 2)), stiffness)).frequency
    sum_, product = joint_ / small + (joint_ + ground) / large, joint_ * ground / (small * large)
    high = 0.5 * (sum_ + np.sqrt(sum_**2 - 4.0 * product))
    assert found == pytest.approx([np.sqrt(product / high), np.sqrt(high)], rel=1e-9)


@pytest.mark.property
def test_impossible_members_are_refused() -> None:
    """No mass, moments of inertia that no body has, a spinning beam, a direction that is none, a name unknown."""
    with pytest.raises(TrochoidError, match="must be above 0"):
        system((Member("shaft", 0.0, BODY),), [])
    with pytest.raises(TrochoidError, match="no body has the moments"):
        system((Member("shaft", 1.0, np.diag([1.0, 1.0, 3.0])),), [])
    with pytest.raises(TrochoidError, match="not round about its axis"):
        system((Member("beam", 1.0, BODY, spin=(0.0, 0.0, 10.0)),), [])
    with pytest.raises(TrochoidError, match="unit direction"):
        line("mesh", (Member("one", 1.0, BODY),), None, "one", (0.0, 0.0, 0.0), (1.0, 1.0, 0.0), 1.0)
    with pytest.raises(TrochoidError, match="no member 'two'; there are one"):
        column((Member("one", 1.0, BODY),), "two")


@pytest.mark.exact
@pytest.mark.parametrize("q", [0.3, 1.0])
def test_parametric_instability_is_where_mathieu_has_it(q: float) -> None:
    """x″ + (a − 2q cos 2t) x: stable for a in (a0, b1) and (a1, b2), unstable in (b1, a1)."""
    for low, high, stable in (
        (mathieu_a(0, q), mathieu_b(1, q), True),
        (mathieu_b(1, q), mathieu_a(1, q), False),
        (mathieu_a(1, q), mathieu_b(2, q), True),
    ):
        a = 0.5 * float(low + high)
        slopes = (1e3 + a - 2 * q * np.cos(2 * np.pi * np.arange(512) / 512))[:, None]
        one = System(np.ones((1, 1)), np.zeros((1, 1)), -1e3 * np.ones((1, 1)))
        mesh = (Local("mesh", np.ones(1), varying(slopes[:, 0]), 1e3),)
        largest = growth(*along(one, mesh, slopes), 2.0)
        assert (largest < 1 + 1e-6) == stable
        product = np.prod(multipliers(*along(one, mesh, slopes), 2.0))
        assert abs(product - 1.0) < 1e-9  # nothing damps: the volume of states is kept
