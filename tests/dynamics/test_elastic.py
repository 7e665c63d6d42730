"""Stiffness-aware motion against closed forms, exact fractions and brute-force time integration."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.linalg import sqrtm

from trochoid.dynamics.elastic import Frame, Response, explain, respond
from trochoid.dynamics.modes import natural_modes
from trochoid.dynamics.spectrum import harmonics, synthesize
from trochoid.dynamics.supports import Support, assemble, shaft_bearing, support_forces
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

SPEED = 1500.0 * np.pi / 30.0
PHI = 2.0 * np.pi * np.arange(60) / 60
seeds = st.integers(0, 2**31 - 1)


def _system(seed: int, n: int = 3) -> tuple[Array, Array]:
    """Return coupled M and K with modes between about 2 and 20 times the speed."""
    rng = np.random.default_rng(seed)
    a, b = rng.normal(size=(2, n, n))
    mass = np.eye(n) + 0.2 * a @ a.T
    stiffness = SPEED**2 * (6.0 * np.eye(n) + 5.0 * b @ b.T)
    return mass, stiffness


def _motion(seed: int, n: int = 3, top: int = 4) -> tuple[Array, Array]:
    """Return coefficients (2, top, n) of cos hφ and sin hφ and the samples (60, n)."""
    coefficients = np.random.default_rng(seed).normal(size=(2, top, n)) * 1e-6
    order = np.arange(1, top + 1)
    samples = np.cos(np.outer(PHI, order)) @ coefficients[0] + np.sin(np.outer(PHI, order)) @ coefficients[1]
    return coefficients, samples


def _viscous(mass: Array, stiffness: Array, ratio: float) -> Array:
    """Return C = 2ζ M^½ (M^-½ K M^-½)^½ M^½, the modal damping without any modes."""
    root = np.real(sqrtm(mass))
    back = np.linalg.inv(root)
    return np.asarray(2.0 * ratio * root @ np.real(sqrtm(back @ stiffness @ back)) @ root)


def _steady(mass: Array, damping: Array, stiffness: Array, coefficients: Array, swing: float = 0.0) -> Array:
    """Return y (60, n) by time integration: the fixed point of the map over one period, found by shooting.

    `swing` modulates the stiffness by 1 + swing·cos 2φ.
    """
    n, order = len(mass), np.arange(1, coefficients.shape[1] + 1)
    inverse = np.linalg.inv(mass)

    def rate(t: float, state: Array) -> Array:
        phase = order * SPEED * t
        speedup = (order * SPEED) ** 2
        acceleration = (
            -(np.cos(phase) * speedup) @ coefficients[0] - (np.sin(phase) * speedup) @ coefficients[1]
        )
        y = state.reshape(2, n, -1)
        force = (1.0 + swing * np.cos(2.0 * SPEED * t)) * stiffness @ y[0] + damping @ y[1]
        push = np.zeros(y.shape[2])
        push[0] = 1.0
        return np.concatenate([y[1], -inverse @ force - np.outer(acceleration, push)]).ravel()

    period = 2.0 * np.pi / SPEED
    start = np.hstack([np.zeros((2 * n, 1)), np.diag([1e-6] * n + [1e-6 * SPEED] * n)])
    options = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-17}
    end = solve_ivp(rate, (0.0, period), start.ravel(), **options).y[:, -1].reshape(2 * n, -1)
    transition = end[:, 1:] @ np.linalg.inv(start[:, 1:])
    initial = np.linalg.solve(np.eye(2 * n) - transition, end[:, 0])
    times = period * np.arange(60) / 60
    return np.asarray(solve_ivp(rate, (0.0, period), initial, t_eval=times, **options).y[:n].T)


@pytest.mark.exact
@pytest.mark.parametrize("ratio", [0.1, 0.9, 1.0, 1.1, 5.0])
def test_one_oscillator(ratio: float) -> None:
    """y = r²/(1 − r² + 2iζr)·q for q = cos 3φ, r = 3ω/ω₀; natural frequency √(k/m)/2π."""
    zeta, mass = 0.03, 2.0
    natural = 3.0 * SPEED / ratio
    samples = 1e-6 * np.cos(3.0 * PHI)[:, None]
    response = respond(samples, np.array([[mass]]), np.array([[mass * natural**2]]), SPEED, zeta)
    expected = 1e-6 * ratio**2 / (1.0 - ratio**2 + 2j * zeta * ratio)
    assert response.correction[:, 0] == pytest.approx(
        np.real(expected * np.exp(3j * PHI)), rel=1e-10, abs=1e-18
    )
    assert response.natural_frequencies[0] == pytest.approx(natural / 2.0 / np.pi, rel=1e-14)
    assert response.resonance is not None
    assert response.resonance.harmonic == 3
    factor = abs(1.0 + 2j * zeta * ratio) / abs(1.0 - ratio**2 + 2j * zeta * ratio)
    assert response.resonance.factor == pytest.approx(factor, rel=1e-12)
    assert bool(response.warnings) == (factor > 5.0)


@pytest.mark.independent
@pytest.mark.parametrize("seed", [1, 2])
def test_against_time_integration(seed: int) -> None:
    """solve_ivp (DOP853, rtol 1e-11) to the periodic orbit, C from matrix square roots: no modes, no FFT."""
    mass, stiffness = _system(seed)
    coefficients, samples = _motion(seed + 10)
    reference = _steady(mass, _viscous(mass, stiffness, 0.05), stiffness, coefficients)
    response = respond(samples, mass, stiffness, SPEED, 0.05)
    assert response.correction == pytest.approx(reference, abs=1e-8 * np.abs(reference).max())


@pytest.mark.independent
@pytest.mark.parametrize("swing", [0.03, 0.4])
def test_varying_stiffness_against_time_integration(swing: float) -> None:
    """K(1 + swing cos 2φ) integrated in time (solve_ivp), where the mean stiffness alone is visibly wrong."""
    mass, stiffness = _system(5)
    coefficients, samples = _motion(6)
    varying = (1.0 + swing * np.cos(2.0 * PHI))[:, None, None] * stiffness
    response = respond(samples, mass, varying, SPEED, 0.05)
    reference = _steady(mass, _viscous(mass, stiffness, 0.05), stiffness, coefficients, swing)
    assert response.correction == pytest.approx(reference, abs=1e-6 * np.abs(reference).max())
    plain = respond(samples, mass, stiffness, SPEED, 0.05).correction
    size = np.sqrt(np.diag(stiffness))
    hidden = np.linalg.norm((reference - plain) * size) / np.linalg.norm(reference * size)
    assert hidden > 1e-3
    assert response.variation_effect == pytest.approx(hidden, rel=1e-4)
    # the largest of cos 2φ on the 60 positions is 1; the norm of D^-½ K D^-½ is at least 1
    scale = 1.0 / np.sqrt(np.diag(stiffness))
    norm = np.linalg.norm(stiffness * np.outer(scale, scale), ord=2)
    assert response.stiffness_variation == pytest.approx(swing * norm, rel=1e-9)


def _turns(angle: Array) -> Array:
    """Return matrices (n, 5, 5) that turn x, y and tilts about x, y by an angle; the fifth coordinate is a rotation."""
    made = np.tile(np.eye(5), (*np.shape(angle), 1, 1))
    for i in (0, 2):
        made[..., i, i] = made[..., i + 1, i + 1] = np.cos(angle)
        made[..., i, i + 1], made[..., i + 1, i] = -np.sin(angle), np.sin(angle)
    return made


@pytest.mark.independent
def test_turning_frame_against_time_integration_in_the_fixed_one() -> None:
    """A shaft that tilts and spins, and a rotation, coupled by springs that turn: solve_ivp along fixed axes.

    There K, C and the load turn, momentum is the only gyroscopic term, and nothing is centrifugal.
    """
    rng = np.random.default_rng(4)
    mass, momentum = np.diag([2.0, 2.0, 0.5, 0.5, 0.7]), 0.4 * SPEED
    a = rng.normal(size=(5, 5))
    inner = SPEED**2 * (30.0 * np.diag(np.diag(mass)) + 6.0 * a @ a.T)
    rate = SPEED * (_turns(np.array(0.5 * np.pi)) - np.diag([0.0, 0.0, 0.0, 0.0, 1.0]))
    spins = np.zeros((5, 5))
    spins[2, 3], spins[3, 2] = momentum, -momentum
    frame = Frame(2.0 * mass @ rate + spins, mass @ rate @ rate + spins @ rate, rate)
    varying = (1.0 + 0.2 * np.cos(2.0 * PHI))[:, None, None] * inner
    coefficients, samples = _motion(9, 5)
    samples = samples + 1e-6 * rng.normal(size=5)  # what stands still in the frame goes round outside
    found = respond(samples, mass, varying, SPEED, 0.05, frame)
    damper, inverse = _viscous(mass, inner, 0.05), np.linalg.inv(mass)
    offset = samples.mean(axis=0)
    order = np.arange(1, coefficients.shape[1] + 1)

    def still(t: float) -> tuple[Array, Array]:
        """Velocity and acceleration of the quasi-static motion along fixed axes, by the product rule."""
        phase = order * SPEED * t
        at = offset + np.cos(phase) @ coefficients[0] + np.sin(phase) @ coefficients[1]
        once = (-(order * SPEED) * np.sin(phase)) @ coefficients[0]
        once = once + ((order * SPEED) * np.cos(phase)) @ coefficients[1]
        twice = -((order * SPEED) ** 2 * np.cos(phase)) @ coefficients[0]
        twice = twice - ((order * SPEED) ** 2 * np.sin(phase)) @ coefficients[1]
        turn = _turns(np.array(SPEED * t))
        return turn @ (once + rate @ at), turn @ (twice + 2.0 * rate @ once + rate @ rate @ at)

    def change(t: float, flat: Array) -> Array:
        y = flat.reshape(2, 5, -1)
        turn = _turns(np.array(SPEED * t))
        springs = turn @ ((1.0 + 0.2 * np.cos(2.0 * SPEED * t)) * inner) @ turn.T
        velocity, acceleration = still(t)
        push = np.zeros(y.shape[2])
        push[0] = 1.0
        load = -mass @ acceleration - spins @ velocity
        force = springs @ y[0] + (turn @ damper @ turn.T + spins) @ y[1]
        return np.concatenate([y[1], inverse @ (np.outer(load, push) - force)]).ravel()

    period = 2.0 * np.pi / SPEED
    start = np.hstack([np.zeros((10, 1)), np.diag([1e-6] * 5 + [1e-6 * SPEED] * 5)])
    options = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-17}
    end = solve_ivp(change, (0.0, period), start.ravel(), **options).y[:, -1].reshape(10, -1)
    initial = np.linalg.solve(np.eye(10) - end[:, 1:] @ np.linalg.inv(start[:, 1:]), end[:, 0])
    times = period * np.arange(60) / 60
    reference = solve_ivp(change, (0.0, period), initial, t_eval=times, **options).y[:5].T
    outside = np.einsum("nij,nj->ni", _turns(PHI), found.correction)
    assert outside == pytest.approx(reference, abs=1e-7 * np.abs(reference).max())
    # and its energy: what damping takes there is the loss
    felt = found.velocity + found.correction @ rate.T
    assert found.loss == pytest.approx(float((felt * (felt @ damper)).sum(axis=1).mean()), rel=1e-9)


@pytest.mark.independent
def test_long_records_couple_low_harmonics_only() -> None:
    """A motion of few harmonics sampled 4 times as often gives the same response, though fewer lines are coupled."""
    mass, stiffness = _system(5)
    _, samples = _motion(6)
    many = synthesize(harmonics(samples), 240)
    dense = np.arange(240) * 2.0 * np.pi / 240
    short = respond(samples, mass, (1.0 + 0.3 * np.cos(2.0 * PHI))[:, None, None] * stiffness, SPEED, 0.05)
    long = respond(many, mass, (1.0 + 0.3 * np.cos(2.0 * dense))[:, None, None] * stiffness, SPEED, 0.05)
    assert long.correction[::4] == pytest.approx(short.correction, abs=1e-6 * np.abs(short.correction).max())


@pytest.mark.exact
def test_forces_and_inertia_balance() -> None:
    """M (q̈ + ÿ) + K̄ (y + T ẏ) = 0 at every position: what the springs pass on is what the masses need."""
    mass, stiffness = _system(3)
    _, samples = _motion(4)
    response = respond(samples, mass, stiffness, SPEED, 0.05)
    spring = response.spring_correction @ stiffness
    assert response.inertia == pytest.approx(spring, abs=1e-11 * np.abs(spring).max())
    assert response.inertia == pytest.approx(-response.acceleration @ mass, rel=1e-14)


@pytest.mark.exact
def test_stiff_members_become_rigid() -> None:
    """K·10⁶ with q·10⁻⁶ (same loads): the change of the reactions falls by 10⁶, below 1e-3 of what it was."""
    mass, stiffness = _system(7)
    _, samples = _motion(8)
    soft = respond(samples, mass, stiffness, SPEED, 0.02)
    hard = respond(samples * 1e-6, mass, stiffness * 1e6, SPEED, 0.02)
    changes = [r.spring_correction @ k for r, k in ((soft, stiffness), (hard, stiffness * 1e6))]
    static = np.abs(samples @ stiffness).max()
    assert np.abs(changes[0]).max() > 0.1 * static
    assert np.abs(changes[1]).max() < 1e-5 * static


@pytest.mark.exact
def test_free_bodies_do_not_shake_as_a_whole() -> None:
    """Two free masses and a spring: the centre of mass stands still, the rest is one oscillator."""
    mass, k = np.diag([2.0, 3.0]), 5e6
    stiffness = k * np.array([[1.0, -1.0], [-1.0, 1.0]])
    samples = 1e-6 * np.stack([np.cos(PHI) + np.sin(2 * PHI), np.cos(2 * PHI)], axis=1)
    response = respond(samples, mass, stiffness, SPEED, 0.0)
    assert response.natural_frequencies[0] == 0.0
    assert response.motion @ [2.0, 3.0] == pytest.approx(0.0, abs=1e-18)
    natural = np.sqrt(k / 2.0 + k / 3.0)
    relative = harmonics(samples[:, 0] - samples[:, 1])[1:3]
    ratio = (np.array([1.0, 2.0]) * SPEED / natural) ** 2
    answer = response.amplitudes[:2, 0] - response.amplitudes[:2, 1]
    assert answer == pytest.approx(relative / (1.0 - ratio), rel=1e-9)


@pytest.mark.exact
def test_soft_is_not_free() -> None:
    """Two masses m on a joint k, one of them on 1e-9·k: ω² ≈ 1e-9·k/2m, not taken for free."""
    k, soft = 1e8, 0.1
    basis = natural_modes(2.0 * np.eye(2), np.array([[k + soft, -k], [-k, k]]))
    assert basis.angular_frequencies[0] == pytest.approx(np.sqrt(soft / 4.0), rel=1e-6)
    assert basis.angular_frequencies[1] == pytest.approx(np.sqrt(k), rel=1e-8)
    assert natural_modes(2.0 * np.eye(2), np.array([[k, -k], [-k, k]])).angular_frequencies[0] == 0.0


@pytest.mark.exact
def test_mass_ratio_of_a_thousand_million() -> None:
    """1 g on 1000 t, both on springs, undamped: solved in exact fractions beside the program."""
    small, large = Fraction(1, 1000), Fraction(10**6)
    joint, ground = Fraction(10**4), Fraction(10**10)
    omega = Fraction(150)
    q = (Fraction(1, 10**6), Fraction(1, 10**7))
    a, b, d = joint - omega**2 * small, -joint, joint + ground - omega**2 * large
    f = (omega**2 * small * q[0], omega**2 * large * q[1])
    determinant = a * d - b * b
    exact = ((d * f[0] - b * f[1]) / determinant, (a * f[1] - b * f[0]) / determinant)
    mass = np.diag([float(small), float(large)])
    stiffness = np.array([[float(joint), float(-joint)], [float(-joint), float(joint + ground)]])
    samples = np.cos(PHI)[:, None] * np.array([float(q[0]), float(q[1])])
    response = respond(samples, mass, stiffness, 150.0, 0.0)
    assert response.correction[0] == pytest.approx([float(value) for value in exact], rel=1e-9)


@pytest.mark.exact
def test_identical_frequencies() -> None:
    """Equally stiff in x and y: the modes coincide, the answer is the single oscillator's."""
    mass, stiffness = 2.0 * np.eye(2), 2.0 * (4.0 * SPEED) ** 2 * np.eye(2)
    samples = 1e-6 * np.stack([np.cos(PHI), np.sin(PHI)], axis=1)
    response = respond(samples, mass, stiffness, SPEED, 0.0)
    assert response.correction == pytest.approx(samples / 15.0, rel=1e-9, abs=1e-18)


@pytest.mark.exact
def test_resonance_without_damping_is_refused() -> None:
    """Harmonic 3 on ω₀, ζ = 0: refused with frequency and advice; with ζ, or not excited, it is solved."""
    stiffness = np.array([[(3.0 * SPEED) ** 2]])
    motion = np.cos(3.0 * PHI)[:, None]
    with pytest.raises(TrochoidError, match=r"harmonic 3 \(75 Hz\).*damping_ratio > 0"):
        respond(motion, np.eye(1), stiffness, SPEED, 0.0)
    damped = respond(motion, np.eye(1), stiffness, SPEED, 0.01)
    assert damped.resonance is not None
    assert damped.resonance.factor == pytest.approx(np.hypot(1.0, 0.02) / 0.02, rel=1e-9)
    assert any("near resonance" in text for text in damped.warnings)
    other = respond(np.cos(2.0 * PHI)[:, None], np.eye(1), stiffness, SPEED, 0.0)
    assert np.isfinite(other.correction).all()


@pytest.mark.exact
def test_nothing_moves_nothing() -> None:
    """No load, no motion: all zero, no resonance, no NaN, even undamped on resonance or without springs."""
    for stiffness in (np.eye(2) * SPEED**2, np.zeros((2, 2))):
        response = respond(np.zeros((60, 2)), np.eye(2), stiffness, SPEED, 0.0)
        assert not response.motion.any()
        assert response.resonance is None
        assert response.warnings == ()
        assert explain(response, ("a", "b")).startswith("elastic members")


@pytest.mark.property
@settings(max_examples=25, deadline=None)
@given(seeds, st.floats(-5.0, 5.0), st.floats(-3.0, 3.0))
def test_linear_and_indifferent_to_axes(seed: int, factor: float, turn: float) -> None:
    """y is linear in q, and turning x and y turns y."""
    mass, stiffness = _system(seed, 2)
    _, first = _motion(seed, 2)
    _, second = _motion(seed + 1, 2)
    c, s = np.cos(turn), np.sin(turn)
    matrix = np.array([[c, -s], [s, c]])

    def answer(q: Array, m: Array = mass, k: Array = stiffness) -> Response:
        return respond(q, m, k, SPEED, 0.03)

    parts = answer(first).correction + factor * answer(second).correction
    size = np.abs(parts).max() + 1e-6
    assert answer(first + factor * second).correction == pytest.approx(parts, abs=1e-9 * size)
    turned = answer(first @ matrix.T, matrix @ mass @ matrix.T, matrix @ stiffness @ matrix.T)
    expected = answer(first).correction @ matrix.T
    assert turned.correction == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


@pytest.mark.property
@settings(max_examples=25, deadline=None)
@given(seeds, st.floats(-4.0, 4.0), st.floats(-4.0, 4.0))
def test_units_do_not_matter(seed: int, length: float, mass_unit: float) -> None:
    """Each coordinate in its own unit (mm beside rad) and another unit of mass: the same motion, to 1e-9."""
    mass, stiffness = _system(seed)
    _, samples = _motion(seed + 2)
    scale = np.array([1.0, 10.0**length, 10.0 ** (-length)])
    other = 10.0**mass_unit / np.outer(scale, scale)
    plain = respond(samples, mass, stiffness, SPEED, 0.03)
    scaled = respond(samples * scale, mass * other, stiffness * other, SPEED, 0.03)
    size = np.abs(plain.correction).max()
    assert scaled.correction / scale == pytest.approx(plain.correction, abs=1e-9 * size)
    assert scaled.natural_frequencies == pytest.approx(plain.natural_frequencies, rel=1e-9)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"speed": 0.0}, "speed above 0"),
        ({"speed": float("nan")}, "speed above 0"),
        ({"damping_ratio": -0.1}, "damping_ratio"),
        ({"motion": np.zeros((2, 2))}, "at least 3"),
        ({"motion": np.full((60, 2), np.nan)}, "finite"),
        ({"mass": np.diag([1.0, 0.0])}, "coordinate 1 has mass 0"),
        ({"mass": np.array([[1.0, 2.0], [2.0, 1.0]])}, "not positive definite"),
        ({"stiffness": np.diag([1e6, -1e6])}, "positive semi-definite"),
        ({"stiffness": np.array([[1e6, 5e5], [0.0, 1e6]])}, "not symmetric"),
        ({"stiffness": np.zeros((7, 2, 2))}, "does not belong"),
    ],
)
def test_bad_input_is_refused(changes: dict[str, object], said: str) -> None:
    """Speed zero, one position, mass zero, an unstable or one-sided spring: a message, not a number."""
    good: dict[str, object] = {
        "motion": np.stack([np.cos(PHI), np.sin(PHI)], axis=1),
        "mass": np.eye(2),
        "stiffness": 1e6 * np.eye(2),
        "speed": SPEED,
        "damping_ratio": 0.02,
    }
    with pytest.raises(TrochoidError, match=said):
        respond(**(good | changes))  # type: ignore[arg-type]


@pytest.mark.exact
def test_shaft_on_two_bearings() -> None:
    """Mass m, inertia J on springs k at ±l: √(2k/m) twice, √(2kl²/J) twice; forces sum to −m a."""
    m, j, k, half = 3.0, 0.01, 2e7, 0.05
    columns = (0, 1, 2, 3)
    bearings = [shaft_bearing(name, z, k, columns, 4) for name, z in (("A", -half), ("B", half))]
    stiffness = assemble(bearings, 4)
    mass = np.diag([m, m, j, j])
    basis = natural_modes(mass, stiffness)
    expected = sorted([np.sqrt(2 * k / m)] * 2 + [np.sqrt(2 * k * half**2 / j)] * 2)
    assert basis.angular_frequencies == pytest.approx(expected, rel=1e-12)
    wobble = 1e-6 * np.stack([np.cos(PHI), np.sin(PHI), 20 * np.cos(2 * PHI), 0 * PHI], axis=1)
    response = respond(wobble, mass, stiffness, SPEED, 0.02)
    forces = [support_forces(bearing, response.spring_correction) for bearing in bearings]
    assert sum(forces) == pytest.approx(response.inertia[:, :2], abs=1e-12 * k * 1e-6)
    moment = half * (forces[0][:, 1] - forces[1][:, 1])
    assert moment == pytest.approx(response.inertia[:, 2], abs=1e-12 * k * 1e-6)


@pytest.mark.exact
def test_spring_between_members() -> None:
    """A spring on a difference of coordinates passes k (q₀ − q₁) and assembles to k [[1, −1], [−1, 1]]."""
    spring = Support("mesh", np.array([[1.0, -1.0]]), np.array([[4e6]]))
    assert assemble([spring], 2) == pytest.approx(4e6 * np.array([[1.0, -1.0], [-1.0, 1.0]]))
    assert support_forces(spring, np.array([[3e-6, 1e-6]])) == pytest.approx(np.array([[8.0]]))


@pytest.mark.exact
def test_the_stated_reason_names_member_and_mode() -> None:
    """The sentence names the coordinate with the largest effort and the amplified line."""
    samples = 1e-6 * np.stack([np.cos(3 * PHI), 0.01 * np.cos(PHI)], axis=1)
    response = respond(samples, np.eye(2), np.diag([(4 * SPEED) ** 2, (9 * SPEED) ** 2]), SPEED)
    text = explain(response, ("disc0.x", "disc0.y"))
    assert "disc0.x" in text
    assert "harmonic 3 (75 Hz)" in text
    assert "100 Hz" in text
