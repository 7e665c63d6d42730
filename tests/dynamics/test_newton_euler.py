"""Rigid reactions against statics in closed form, and Newton's and Euler's balance."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.dynamics.newton_euler import (
    RotatingMass,
    inertia_forces,
    inertia_wrench,
    shaft_residual,
    support_reactions,
)
from trochoid.dynamics.wrench import balance_residual, couple, moved, total, wrench
from trochoid.kinematics.errors import TrochoidError

PHI = 2.0 * np.pi * np.arange(24) / 24
SPEED = 1500.0 * np.pi / 30.0
DISCS = (RotatingMass(0.9, 2.5e-3, 0.0, -6e-3), RotatingMass(0.9, 2.5e-3, np.pi, 6e-3))
seeds = st.integers(0, 2**31 - 1)


@pytest.mark.exact
def test_two_discs_cancel_in_force_but_not_in_couple() -> None:
    """Sum of forces 0; couple m e ω² (z₂ − z₁), turning with the crank (issue 2, chain 5)."""
    load = inertia_wrench(DISCS, PHI, SPEED)
    size = 0.9 * 2.5e-3 * SPEED**2
    assert load.force == pytest.approx(0.0, abs=1e-13 * size)
    expected = size * 12e-3 * np.stack([np.sin(PHI), -np.cos(PHI), 0.0 * PHI], axis=1)
    assert load.moment == pytest.approx(expected, abs=1e-13 * size)


@pytest.mark.exact
def test_bearings_carry_the_couple() -> None:
    """Reactions ± m e ω² (z₂ − z₁)/(z_B − z_A), turning with the crank."""
    forces = inertia_forces(DISCS, PHI, SPEED)
    supports = np.array([-30e-3, 50e-3])
    reactions = support_reactions(supports, forces, np.array([-6e-3, 6e-3]))
    size = 0.9 * 2.5e-3 * SPEED**2 * 12e-3 / 80e-3
    direction = np.stack([np.cos(PHI), np.sin(PHI)], axis=1)
    assert reactions[:, 1] == pytest.approx(size * direction, rel=1e-12, abs=1e-12)
    assert reactions[:, 0] == pytest.approx(-size * direction, rel=1e-12, abs=1e-12)


@pytest.mark.exact
def test_overhung_load() -> None:
    """Lever rule: 1 kN at 1.5 spans from A gives −1.5 kN at B and +0.5 kN at A."""
    reactions = support_reactions(np.array([0.0, 0.1]), np.array([[[1e3, 0.0]]]), np.array([0.15]))
    assert reactions[0, :, 0] == pytest.approx([500.0, -1500.0], rel=1e-14)


@pytest.mark.exact
def test_pure_couple() -> None:
    """A couple M about y is held by ∓M/span along x, a couple about x by ±M/span along y."""
    nothing = np.zeros((1, 1, 2))
    reactions = support_reactions(np.array([0.0, 0.1]), nothing, np.array([0.0]), np.array([[3.0, 5.0]]))
    assert reactions[0, :, 0] == pytest.approx([50.0, -50.0], rel=1e-14)
    assert reactions[0, :, 1] == pytest.approx([-30.0, 30.0], rel=1e-14)
    sum_of_moments = np.cross([[0, 0, 0.0], [0, 0, 0.1]], np.pad(reactions[0], ((0, 0), (0, 1)))).sum(axis=0)
    assert sum_of_moments == pytest.approx([-3.0, -5.0, 0.0], abs=1e-13)


@pytest.mark.property
@settings(max_examples=50, deadline=None)
@given(seeds, st.integers(1, 6))
def test_any_shaft_is_in_balance(seed: int, count: int) -> None:
    """Forces and moments of loads and reactions vanish to rounding, for any loads and places."""
    rng = np.random.default_rng(seed)
    loads, places = rng.normal(size=(7, count, 2)), rng.normal(size=count)
    supports = np.array([rng.uniform(-1, 0), rng.uniform(0.2, 1)])
    reactions = support_reactions(supports, loads, places)
    assert shaft_residual(supports, reactions, loads, places) < 1e-13
    spoiled = reactions + np.array([[1e-3, 0.0], [0.0, 0.0]])
    assert shaft_residual(supports, spoiled, loads, places) > 1e-6


@pytest.mark.property
@settings(max_examples=30, deadline=None)
@given(seeds, st.floats(-3.0, 3.0), st.floats(1e-3, 1e3))
def test_turning_scaling_and_adding(seed: int, turn: float, factor: float) -> None:
    """Reactions are linear in the loads, turn with the axes and do not know the unit of length."""
    rng = np.random.default_rng(seed)
    loads, more, places = rng.normal(size=(4, 3, 2)), rng.normal(size=(4, 3, 2)), rng.normal(size=3)
    supports = np.array([-0.7, 0.4])
    c, s = np.cos(turn), np.sin(turn)
    matrix = np.array([[c, -s], [s, c]])
    plain = support_reactions(supports, loads, places)
    assert support_reactions(supports, loads @ matrix.T, places) == pytest.approx(plain @ matrix.T, abs=1e-12)
    assert support_reactions(factor * supports, loads, factor * places) == pytest.approx(plain, abs=1e-11)
    summed = support_reactions(supports, 2.0 * loads + more, places)
    assert summed == pytest.approx(2.0 * plain + support_reactions(supports, more, places), abs=1e-12)


@pytest.mark.property
@settings(max_examples=30, deadline=None)
@given(seeds)
def test_wrench_does_not_depend_on_the_point(seed: int) -> None:
    """Moving the point of reduction there and back, or reducing there at once, is the same."""
    rng = np.random.default_rng(seed)
    points, forces, place = rng.normal(size=(5, 4, 3)), rng.normal(size=(5, 4, 3)), rng.normal(size=3)
    here, there = wrench(points, forces), wrench(points, forces, place)
    assert moved(here, place).moment == pytest.approx(there.moment, abs=1e-13)
    assert moved(moved(here, place), here.about).moment == pytest.approx(here.moment, abs=1e-13)
    assert total([here, there]).moment == pytest.approx(2.0 * here.moment, abs=1e-12)


@pytest.mark.exact
def test_casing_feels_the_sum_of_inertia_forces() -> None:
    """What the bearings put on the casing is what the discs' inertia makes, whatever acts in between."""
    inner = np.stack(
        [np.stack([1e3 + 0 * PHI, 200.0 * np.sin(PHI)], -1), np.stack([-4e2 + 0 * PHI, PHI], -1)], 1
    )
    places, supports = np.array([-6e-3, 6e-3]), np.array([-30e-3, 50e-3])
    inertia = inertia_forces(DISCS, PHI, SPEED)
    reactions = support_reactions(supports, inertia + inner, places)
    at = np.array([[0.0, 0.0, -30e-3], [0.0, 0.0, 50e-3]])
    discs = np.array([[0.0, 0.0, -6e-3], [0.0, 0.0, 6e-3]])
    on_casing = total([wrench(at, -reactions), wrench(discs, -inner)])
    balanced = inertia_wrench(DISCS, PHI, SPEED)
    torque = couple(np.tile([0.0, 0.0, 400.0], (24, 1)))
    opposite = couple(np.tile([0.0, 0.0, -400.0], (24, 1)))
    negative = wrench(discs, -inertia_forces(DISCS, PHI, SPEED))
    assert on_casing.moment == pytest.approx(balanced.moment, abs=1e-12)
    assert balance_residual([on_casing, negative, torque, opposite]) < 1e-13


@pytest.mark.exact
def test_no_load_no_reaction_and_no_division_by_zero() -> None:
    """Zero loads: zero reactions and a residual of 0, not NaN."""
    loads = np.zeros((3, 2, 2))
    reactions = support_reactions(np.array([0.0, 0.1]), loads, np.array([0.02, 0.04]))
    assert not reactions.any()
    assert shaft_residual(np.array([0.0, 0.1]), reactions, loads, np.array([0.02, 0.04])) == 0.0


@pytest.mark.exact
@pytest.mark.parametrize("supports", [[0.05, 0.05], [0.0, 0.0], [0.0, 0.1, 0.2], [0.1]])
def test_supports_that_cannot_hold_are_refused(supports: list[float]) -> None:
    """Coinciding bearings, one or three bearings: said, not solved."""
    with pytest.raises(TrochoidError, match="bearings"):
        support_reactions(np.array(supports), np.ones((1, 1, 2)), np.array([0.0]))
