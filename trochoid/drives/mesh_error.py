"""Discretisation error of finite-element numbers, from two mesh levels.

What the contacts give converges with the second to third power of the facet length: the torsional stiffness and the
twist with the second from eight facets per lobe on, forces and pressures with nearly the third (medians over random
drives). Half the facet length then leaves a third to a seventh of the difference between the levels. Half of it is
reported, because single numbers scatter, and because the levels of any one number may agree by chance: none is
believed to be much better than the worst. So the error is bracketed for nine of ten numbers of random drives
(benchmarks/choice.py).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from trochoid.kinematics.types import Array

SHARE, AT_POSITIONS = 1 / 2, 1 / 3  # of the difference: of one number, and where all positions vouch for each
FLOOR = 0.3  # least share of the worst number's relative difference that any number is taken to have

T = TypeVar("T")
U = TypeVar("U")


@dataclass(frozen=True, slots=True)
class Pair(Generic[T]):
    """A value on the finer mesh level and on the coarser one; None where there is no mesh."""

    fine: T
    coarse: T | None

    def map(self, make: Callable[[T], U]) -> Pair[U]:
        """Make something of both."""
        return Pair(make(self.fine), None if self.coarse is None else make(self.coarse))


def position_errors(fine: Array, coarse: Array) -> Array:
    """Return the estimated error (n,) of a number at each position, not less than the typical one.

    Where the levels happen to cross, their difference says nothing; the root mean square over all positions
    stands in.
    """
    difference = np.abs(fine - coarse)
    return np.asarray(AT_POSITIONS * np.maximum(difference, np.sqrt(np.mean(difference**2))))


def scalar_error(fine: float, coarse: float, worst: float = 0.0) -> float:
    """Return the estimated error of one number, given the largest relative difference of all."""
    return SHARE * max(abs(fine - coarse), FLOOR * worst * abs(fine))


def worst_of(differences: Mapping[str, float]) -> tuple[float, str]:
    """Return the largest relative error among named differences of two levels, and its name."""
    worst = max(differences, key=lambda name: differences[name])
    return SHARE * differences[worst], worst


def relative(one: float, other: float) -> float:
    """Return how far two numbers are apart, relative to the first; 0 where that is 0."""
    return abs(one - other) / abs(one) if one else 0.0
