"""The error that is estimated from two mesh levels against the true one, against a mesh twice finer."""

from __future__ import annotations

import numpy as np
import pytest

from tests.fem.cases import POSITIONS, solve_held
from trochoid.drives.choosing import COARSEST
from trochoid.drives.khv.estimate import position_errors, scalar_error
from trochoid.fem.position import Contact
from trochoid.kinematics.types import Array


@pytest.fixture(scope="module")
def levels() -> list[list[Contact]]:
    """Return the disc of the convergence study on the first two levels of a run, and on one twice finer."""
    return [[solve_held(COARSEST * 2**i, p) for p in POSITIONS] for i in range(3)]


def _numbers(contacts: list[Contact]) -> dict[str, Array]:
    return {
        "rotation": np.array([c.motion[0] for c in contacts]),
        "stiffness": np.array([c.stiffness[0, 0] for c in contacts]),
        "largest pin force": np.array([c.touches["ring"].force.max() for c in contacts]),
    }


@pytest.mark.independent
@pytest.mark.parametrize("name", ["rotation", "stiffness", "largest pin force"])
def test_estimate_brackets_the_true_error(levels: list[list[Contact]], name: str) -> None:
    """At 95 % of 60 positions the estimate is not less than the true error, and not more than 20 times it."""
    coarse, fine, finer = (_numbers(contacts)[name] for contacts in levels)
    estimate, true = position_errors(fine, coarse), np.abs(fine - finer)
    assert np.mean(estimate >= true) >= 0.95
    assert np.mean(estimate <= 20 * true) >= 0.95
    assert np.sqrt(np.mean(estimate**2)) <= 20 * np.sqrt(np.mean(true**2))


@pytest.mark.property
def test_estimate_where_levels_cross() -> None:
    """Two levels that agree at one position by chance do not claim to be right there."""
    fine, coarse = np.array([1.0, 1.0, 1.0]), np.array([1.0, 1.3, 0.7])
    errors = position_errors(fine, coarse)
    assert errors[0] > 0.2 * errors[1]
    assert scalar_error(2.0, 2.0) == 0.0
