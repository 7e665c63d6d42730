"""Discretisation error of finite-element numbers, from two mesh levels.

What the contacts give converges with the second to third power of the facet length: the torsional stiffness and the
twist with the second from eight facets per lobe on, forces and pressures with nearly the third (medians over random
drives). Half the facet length then leaves a third to a seventh of the difference between the levels. Half of it is
reported, because single numbers scatter, and because the levels of any one number may agree by chance: none is
believed to be much better than the worst. So the error is bracketed for nine of ten numbers of random drives
(benchmarks/choice.py).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    from trochoid.drives.khv.series import Series

SHARE, AT_POSITIONS = 1 / 2, 1 / 3  # of the difference: of one number, and where all positions vouch for each
FLOOR = 0.3  # least share of the worst number's relative difference that any number is taken to have
TWIST, STIFFNESS = "the twist", "the torsional stiffness"


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


def worst_error(fine: Series, coarse: Series) -> tuple[float, str]:
    """Return the largest relative error among what the scene's answers rest on, and its name."""
    errors = differences(fine, coarse)
    worst = max(errors, key=lambda name: errors[name])
    return SHARE * errors[worst], worst


def differences(one: Series, other: Series) -> dict[str, float]:
    """Return how far two solutions are apart, relative to the first, by the names of the numbers."""
    found = {}
    resists = bool((one.torsional_stiffness > 0).all())
    for name, get in NUMBERS.items():
        if name == TWIST and not resists:  # free within its play: no number
            continue
        a, b = get(one), get(other)
        found[name] = abs(a - b) / abs(a) if a else 0.0
    return found


NUMBERS: dict[str, Callable[[Series], float]] = {
    STIFFNESS: lambda s: float(s.torsional_stiffness.mean()),
    "the largest contact force": lambda s: float(s.ring.force.max()),
    "the largest output-pin force": lambda s: float(s.output.force.max()),
    "the largest contact pressure": lambda s: float(s.ring.pressure.max()),
    "the largest output-pin pressure": lambda s: float(s.output.pressure.max()),
    "the largest roller pressure": lambda s: 0.0 if s.bearing is None else float(s.bearing.pressure.max()),
    TWIST: lambda s: float(s.twist.mean()),
}
