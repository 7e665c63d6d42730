"""A drive with friction along a path: loops that close, work that balances, Coulomb's law, and none at μ = 0."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

from tests.fem.cases import STEEL, small_mesh, whole_drive
from trochoid.fem.assembly import Assembly
from trochoid.fem.body import build_body
from trochoid.fem.compliance import press
from trochoid.fem.coupling import ElasticBody
from trochoid.fem.friction_position import Drag, Dragged, drag, running
from trochoid.fem.position import solve_position
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

TORQUE = 200.0


@lru_cache(maxsize=1)
def rubbed_disc() -> ElasticBody:
    mesh, outline = small_mesh()
    return ElasticBody(press(build_body(mesh, STEEL), outline.loops, tangential=True), 0.010)


def drive(torque: float, crank_angle: float = 0.3, turned: float = 0.0) -> Assembly:
    return replace(whole_drive(crank_angle, torque, turned), bodies=(rubbed_disc(),))


def rubs(mu: float) -> Drag:
    return Drag({"ring": mu, "output": mu})


def legs(steps: int, count: int) -> list[float]:
    """Return torques to and fro, beginning at the top."""
    leg, path = np.linspace(TORQUE, -TORQUE, steps + 1), [TORQUE]
    for number in range(count):
        path += [float(t) for t in (leg if number % 2 == 0 else -leg)[1:]]
    return path


@lru_cache(maxsize=4)
def loop(steps: int, mu: float) -> tuple[Dragged, ...]:
    """Return the states of a closed loop, from −T over T to −T, after one leg that reaches it."""
    return tuple(drag([drive(t) for t in legs(steps, 3)], rubs(mu))[steps:])


def twist(states: Sequence[Dragged]) -> Array:
    return np.array([s.motion[3] for s in states])


def balance(assembly: Assembly, found: Dragged) -> float:
    """Return the largest load that is not carried, over the loads of the largest force at its arm."""
    at = found.motion[None]
    rest = assembly.load - assembly.springs @ found.motion
    size = np.zeros_like(rest)
    for family in assembly.families:
        state = family.pair.at(at)
        slide = family.pair.sliding(state, at)[0]
        rest = rest - state.arms[0].T @ found.force[family.name] + slide.T @ found.tangential[family.name]
        size = np.maximum(size, np.abs(state.arms[0]).max(axis=0) * found.force[family.name].max())
    return float((np.abs(rest) / size).max())


@pytest.mark.exact
def test_no_friction_is_the_frictionless_drive() -> None:
    """μ = 0, or no coefficient: bit by bit what `solve_position` gives, also with bodies pressed along normals only."""
    for assembly in (drive(TORQUE), whole_drive(0.3, TORQUE)):
        plain = solve_position(assembly)
        for coefficients in ({}, {"ring": 0.0, "output": 0.0}):
            found = drag(
                [drive(-TORQUE) if assembly.bodies[0] is rubbed_disc() else assembly, assembly],
                Drag(coefficients),
            )[1]
            assert np.array_equal(found.motion, plain.motion)
            for name, touch in plain.touches.items():
                assert np.array_equal(found.force[name], touch.force)
                assert not found.tangential[name].any()
            assert found.work == 0.0


@pytest.mark.property
@pytest.mark.parametrize(("steps", "mu"), [(20, 0.1), (21, 0.1), (21, 0.02)])
def test_torque_loop(steps: int, mu: float) -> None:
    """±T closes to rounding, also through zero torque (even steps); its area is the work lost, to the path's steps."""
    states = loop(steps, mu)
    angle, torque = twist(states), np.array(legs(steps, 3)[steps:])
    assert angle[-1] == pytest.approx(angle[0], rel=1e-9)
    outside = float(np.sum(0.5 * (torque[1:] + torque[:-1]) * np.diff(angle)))
    lost = sum(s.work for s in states[1:])
    assert lost > 0
    assert outside == pytest.approx(lost, rel=5e-3)
    # going up and coming down, the output lags behind the torque
    up, down = angle[: steps + 1], angle[steps:][::-1]
    loaded = np.abs(torque[: steps + 1]) > 1e-9  # without load nothing is pressed, and nothing lags
    loaded[[0, -1]] = False
    assert (down - up)[loaded].min() > 0


@pytest.mark.property
def test_work_balances_better_with_smaller_steps() -> None:
    """Trapezes of a path with contacts that open and close: the difference falls at least as the steps."""
    missing = []
    for steps in (9, 37):
        states = loop(steps, 0.1)
        torque = np.array(legs(steps, 3)[steps:])
        outside = float(np.sum(0.5 * (torque[1:] + torque[:-1]) * np.diff(twist(states))))
        missing.append(abs(outside / sum(s.work for s in states[1:]) - 1))
    assert missing[1] < 0.25 * missing[0]


@pytest.mark.property
def test_balance_and_coulombs_law() -> None:
    """Every state of the loop carries its load and keeps |q| ≤ μp; where nothing rubs nothing pulls."""
    for torque, state in zip(legs(21, 3)[21:], loop(21, 0.1), strict=True):
        assert balance(drive(torque), state) < 1e-9
        largest = max(float(f.max()) for f in state.force.values())
        for name in ("ring", "output"):
            assert (np.abs(state.tangential[name]) <= 0.1 * state.force[name] + 1e-9 * largest).all()
        assert not state.tangential["bearing"].any()


@pytest.mark.property
def test_small_turns_stick() -> None:
    """Turning back a little from the loop's end the drive is stiffer than without friction, and hardly loses work."""
    start = legs(21, 1)
    path = drag([drive(t) for t in [*start, -0.99 * TORQUE]], rubs(0.1))
    stuck = path[-1].motion[3] - path[-2].motion[3]
    free = solve_position(drive(-0.99 * TORQUE)).motion[3] - solve_position(drive(-TORQUE)).motion[3]
    assert 0 < stuck < free
    assert abs(path[-1].work) < 1e-3 * 0.01 * TORQUE * stuck


@pytest.mark.property
def test_turned_drive() -> None:
    """The whole drive turned in the plane: the same forces and twist along the path."""
    path = legs(9, 2)
    one = drag([drive(t) for t in path], rubs(0.1))[-1]
    two = drag([drive(t, turned=0.7) for t in path], rubs(0.1))[-1]
    assert two.motion[3] == pytest.approx(one.motion[3], rel=1e-7)
    for name, pull in one.tangential.items():
        assert two.tangential[name] == pytest.approx(pull, abs=1e-6 * one.force[name].max())


@pytest.mark.property
@pytest.mark.parametrize("mu", [0.01, 0.1, 0.3])
def test_running_drive(mu: float) -> None:
    """Every contact slides as told: q = −σμp, balance; told nothing, it is the frictionless drive.

    `solve_position` keeps the coupling of contacts that move less than 1e-7 of the coordinates: so near they agree.
    """
    assembly = drive(TORQUE)
    plain = solve_position(assembly)
    rng = np.random.default_rng(4)
    senses = {"ring": rng.choice([-1, 1], 20), "output": rng.choice([-1, 1], 8)}
    for sign in (1, -1):
        found = running(assembly, rubs(mu), {n: sign * s for n, s in senses.items()})
        assert balance(assembly, found) < 1e-9
        for name, sense in senses.items():
            largest = found.force[name].max()
            assert found.tangential[name] == pytest.approx(
                -sign * sense * mu * found.force[name], abs=1e-9 * largest
            )
    nothing = running(assembly, rubs(mu), {})
    for name, touch in plain.touches.items():
        assert nothing.force[name] == pytest.approx(touch.force, abs=1e-7 * touch.force.max())


@pytest.mark.property
def test_bodies_must_have_been_pressed_tangentially() -> None:
    """The refusal says what to do."""
    with pytest.raises(TrochoidError, match="tangential=True"):
        drag([whole_drive(0.3), whole_drive(0.3, 100.0)], rubs(0.1))
