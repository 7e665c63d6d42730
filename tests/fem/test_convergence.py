"""The disc of the convergence study: 20 pins, R 80, r 5, e 2.5, b 10 mm, 200 N·m, bore held, no holes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from tests.fem.cases import FLANK, POSITIONS, solve_held
from trochoid.kinematics.types import Array

LEVELS, FINEST = (8, 12, 16, 20), 32


@dataclass(frozen=True)
class Turn:
    """Rotation (n,), torsional stiffness (n,) and pin forces (n, pins) over the positions."""

    rotation: Array
    stiffness: Array
    force: Array


def _turn(facets: int) -> Turn:
    contacts = [solve_held(facets, p) for p in POSITIONS[:40]]
    return Turn(
        np.array([c.motion[0] for c in contacts]),
        np.array([c.stiffness[0, 0] for c in contacts]),
        np.array([c.touches["ring"].force for c in contacts]),
    )


@pytest.fixture(scope="module")
def turns() -> dict[int, Turn]:
    return {level: _turn(level) for level in (*LEVELS, FINEST)}


def _errors(turns: dict[int, Turn], level: int) -> tuple[float, float, float]:
    """Return the largest relative errors of rotation, stiffness and pin forces (of the largest) at a level."""
    found, best = turns[level], turns[FINEST]
    return (
        float(np.abs(found.rotation / best.rotation - 1).max()),
        float(np.abs(found.stiffness / best.stiffness - 1).max()),
        float((np.abs(found.force - best.force).max(axis=1) / best.force.max(axis=1)).max()),
    )


@pytest.mark.independent
@pytest.mark.parametrize(("level", "limit", "of_force"), [(12, 1e-3, 4e-3), (20, 1e-4, 7e-4)])
def test_disc_reaches_what_was_measured(
    turns: dict[int, Turn], level: int, limit: float, of_force: float
) -> None:
    """Numerics §1: rotation and stiffness to 1e-3 with 12 facets per lobe, 1e-4 with 20; pin forces to 7e-4."""
    rotation, stiffness, force = _errors(turns, level)
    assert rotation < limit
    assert stiffness < limit
    assert force < of_force


@pytest.mark.independent
@pytest.mark.parametrize("quantity", [0, 1, 2])
def test_disc_converges(turns: dict[int, Turn], quantity: int) -> None:
    """From 8 to 16 facets per lobe every number gains more than two powers of the facet length, and never loses."""
    errors = np.array([_errors(turns, level)[quantity] for level in LEVELS])
    assert np.all(np.diff(errors) < 0)
    assert np.log2(errors[0] / errors[2]) > 2.3


@pytest.mark.independent
def test_ripple_converges_not_only_the_mean(turns: dict[int, Turn]) -> None:
    """Numerics §3: the variation of the rotation, is right to 10 % with 12 facets, 4 % with 20."""
    ripple = {level: t.rotation - t.rotation.mean() for level, t in turns.items()}
    size = float(np.abs(ripple[FINEST]).max())
    errors = [float(np.abs(ripple[level] - ripple[FINEST]).max()) / size for level in LEVELS]
    assert size < 6e-3 * float(np.abs(turns[FINEST].rotation).mean())
    assert errors[1] < 0.10
    assert errors[3] < 0.04


@pytest.mark.property
def test_forces_repeat_with_the_pins() -> None:
    """Sources §3: the pin-force set repeats every 360°/z_p of the crank, one pin on, as far as the mesh is alike."""
    start = 0.123
    one, next_one = (solve_held(8, start + 2 * np.pi * i / FLANK.pins) for i in (0, 1))
    first, second = one.touches["ring"].force, next_one.touches["ring"].force
    assert np.roll(first, 1) == pytest.approx(second, abs=3e-3 * float(first.max()))
    assert float(one.motion[0]) == pytest.approx(float(next_one.motion[0]), rel=2e-4)
