"""Discretisation error of finite-element numbers, from two mesh levels, and of too few positions, from fewer still.

What the contacts give converges with the second to third power of the facet length: the torsional stiffness and the
twist with the second from eight facets per lobe on, forces and pressures with nearly the third (medians over random
drives). Half the facet length then leaves a third to a seventh of the difference between the levels. Half of it is
reported, because single numbers scatter, and because the levels of any one number may agree by chance: none is
believed to be much better than the worst. So the error is bracketed for nine of ten numbers of random drives
(benchmarks/choice.py).

Positions are few as well: a mean misses what the record does between them, a peak its top. A half or a third of the
positions misses more: how far these are off stands for what all of them miss, within a factor of a few. A spike that
no position sees, as where an edge passes, is not told by them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from trochoid.kinematics.types import Array

SHARE, AT_POSITIONS = 1 / 2, 1 / 3  # of the difference: of one number, and where all positions vouch for each
OFF = {2: 1.0, 3: 0.25}  # of how far every second or third position is off: what all of them may be
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


def sampling_error(get: Callable[[T], float], whole: T, thinned: Callable[[int], Iterable[T]]) -> float:
    """Return the error that a mean, a peak or a swing has because positions are few.

    `thinned(m)` gives every m-th position from each of the first m on. How far halves are off tells what aliases in a
    mean. They miss a top as all do that lies in the middle of two positions; one third does not have either of these,
    and is off by eight times as much as all are.
    """
    value = get(whole)
    return max((OFF[m] * abs(get(part) - value) for m in OFF for part in thinned(m)), default=0.0)


def worst_of(differences: Mapping[str, float]) -> tuple[float, str]:
    """Return the largest relative error among named differences of two levels, and its name."""
    worst = max(differences, key=lambda name: differences[name])
    return SHARE * differences[worst], worst


def relative(one: float, other: float) -> float:
    """Return how far two numbers are apart, relative to the first; 0 where that is 0."""
    return abs(one - other) / abs(one) if one else 0.0
