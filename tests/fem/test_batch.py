"""Many positions side by side are the same positions one by one; forces with two bounds are those of a QP."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from tests.fem.cases import STEEL, whole_drive
from trochoid.fem.complementarity import Alike, Group, Problem, Unit, solve, solve_all
from trochoid.fem.pair import FlankPair, HolePair, Member
from trochoid.fem.position import Assembly, Contact, solve_position, solve_positions
from trochoid.fem.rows import taken
from trochoid.fem.strips import strip_compliance, strip_unit
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array


def _members(singles: list[Member]) -> Member:
    center, angle = np.stack([m.center for m in singles]), np.array([m.angle for m in singles])
    return Member(center, angle, singles[0].moves)


def _side_by_side(cranks: Array, torque: float = 200.0) -> Assembly:
    """Return the whole drive of the cases at many crank angles."""
    singles = [whole_drive(float(crank), torque) for crank in cranks]
    families = []
    for i, family in enumerate(singles[0].families):
        pairs = [single.families[i].pair for single in singles]
        first, disc = pairs[0], _members([p.disc for p in pairs if isinstance(p, FlankPair | HolePair)])
        if isinstance(first, FlankPair):
            start = np.stack([p.parameter for p in pairs if isinstance(p, FlankPair)])
            ring = _members([p.ring for p in pairs if isinstance(p, FlankPair)])
            families.append(replace(family, pair=replace(first, disc=disc, ring=ring, parameter=start)))
        elif isinstance(first, HolePair):
            carrier = _members([p.carrier for p in pairs if isinstance(p, HolePair)])
            families.append(replace(family, pair=replace(first, disc=disc, carrier=carrier)))
    return replace(singles[0], families=tuple(families), load=np.stack([s.load for s in singles]))


def _forces(contact: Contact) -> Array:
    return np.concatenate([t.force for t in contact.touches.values()], axis=-1)


@pytest.mark.property
@pytest.mark.parametrize("resolve", [False, True])
def test_positions_do_not_know_each_other(resolve: bool) -> None:
    """Seven positions at once: each is what it is alone, to rounding, whatever stands beside it and in which order."""
    cranks = np.linspace(0.1, 5.0, 7)
    together = solve_positions(_side_by_side(cranks), resolve)
    turned = solve_positions(_side_by_side(cranks[::-1]), resolve)
    for i, crank in enumerate(cranks):
        alone = solve_position(whole_drive(float(crank)), resolve)
        size = float(_forces(alone).max())
        assert _forces(taken(together, i)) == pytest.approx(_forces(alone), abs=1e-9 * size)
        assert _forces(taken(turned, 6 - i)) == pytest.approx(_forces(alone), abs=1e-9 * size)
        assert together.stiffness[i] == pytest.approx(
            alone.stiffness, rel=1e-6, abs=1e-6 * np.abs(alone.stiffness).max()
        )
    assert together.imbalance.max() < 1e-9


@pytest.mark.property
def test_the_position_that_fails_is_named() -> None:
    """A load that nothing resists at the third of four positions: the error carries its row."""
    group = Group(np.ones((4, 1, 1, 1)), np.zeros((4, 1, 1)), np.ones((4, 1, 1, 1)))
    load = np.array([[1.0], [2.0], [-1.0], [3.0]])
    with pytest.raises(NotConverged, match="nothing resists motion 0") as fault:
        solve_all(Problem((group,), np.zeros((4, 1, 1)), np.zeros((4, 1, 1)), load))
    assert fault.value.row == 2


@pytest.mark.exact
def test_windows_are_inverses() -> None:
    """Unit.windows[i, j] inverts rows and columns i … j; windows that are empty (j < i) are zero."""
    half = np.random.default_rng(1).normal(size=(5, 5))
    matrix = half @ half.T + np.eye(5)
    unit = Unit.of(matrix)
    for i in range(5):
        for j in range(5):
            expected = np.zeros((5, 5))
            if j >= i:
                expected[i : j + 1, i : j + 1] = np.linalg.inv(matrix[i : j + 1, i : j + 1])
            assert unit.windows[i, j] == pytest.approx(expected, abs=1e-12)


@pytest.mark.exact
def test_blocks_that_are_alike_are_dense_blocks() -> None:
    """Strips as multiples of one matrix, the length they cover moved to their total: forces as with dense blocks."""
    rng = np.random.default_rng(5)
    kernel, width = STEEL.kernel * rng.uniform(1, 3, 4), rng.uniform(1e-6, 1e-5, 4)
    gap = rng.uniform(0, 1e-7, (4, 1)) + (np.arange(27) - 13) ** 2 * width[:, None] ** 2 * 50
    arms, half = rng.normal(size=(4, 1, 2)), rng.normal(size=(4, 4))
    coupling, load = STEEL.kernel * (10 * np.eye(4) + half @ half.T), arms[:, 0].T @ [10.0, 30.0, 20.0, 5.0]
    springs = np.zeros((2, 2))
    dense = Group(strip_compliance(kernel, width), gap, np.repeat(arms, 27, axis=1))
    alike = Group(Alike(strip_unit(), kernel), gap, arms)
    covered = coupling - np.diag(kernel * np.log(27 * width))
    one = solve(Problem((dense,), coupling, springs, load))
    two = solve(Problem((alike,), covered, springs, load))
    assert two.forces[0] == pytest.approx(one.forces[0], abs=1e-10 * float(one.forces[0].max()))
    assert two.motion == pytest.approx(one.motion, rel=1e-9)


@pytest.mark.independent
@settings(max_examples=100, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from([1e-3, 0.1, 1.0, 10.0]))
def test_forces_between_two_bounds(seed: int, bound: float) -> None:
    """scipy's bounded least squares: min |Lᵀp + L⁻¹g|², −b ≤ p ≤ b, with motions on springs (C = LLᵀ)."""
    rng = np.random.default_rng(seed)
    half = rng.normal(size=(6, 3, 5))
    local = half @ half.transpose(0, 2, 1) + 0.1 * np.eye(3)
    gap, arms = rng.normal(size=(6, 3)), rng.normal(size=(6, 3, 2))
    limit = bound * rng.uniform(0.1, 1.0, (6, 3))
    springs, load = np.diag(rng.uniform(0.5, 2.0, 2)), rng.normal(size=2)
    problem = Problem((Group(local, gap, arms, -limit, limit),), 0.3 * np.eye(6), springs, load)
    found = solve(problem)
    forces = found.forces[0].ravel()
    soft = np.linalg.inv(springs)
    whole = np.zeros((18, 18))
    for i in range(6):
        whole[3 * i : 3 * i + 3, 3 * i : 3 * i + 3] = local[i] + 0.3
    lever = arms.reshape(18, 2)
    whole += lever @ soft @ lever.T
    linear = gap.ravel() - lever @ soft @ load
    factor = np.linalg.cholesky(whole)
    answer = lsq_linear(
        factor.T, -np.linalg.solve(factor, linear), (-limit.ravel(), limit.ravel()), method="bvls", tol=1e-14
    )
    assert forces == pytest.approx(answer.x, abs=1e-8 * max(1.0, bound))
    opening = whole @ forces + linear
    free = np.abs(forces) < limit.ravel() * (1 - 1e-12)
    assert np.abs(opening[free]).max(initial=0.0) < 1e-11
    assert (opening * np.sign(forces))[~free].max(initial=-1.0) < 1e-11
