"""Discretisation error of finite-element numbers, from two mesh levels.

From eight facets per lobe on, what the contacts give converges with the third power of the facet length
(benchmarks/disc.py). Half the facet length then leaves a seventh of the difference between the levels. A third of
it is reported, as if the order were two, because single positions scatter.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    from trochoid.drives.khv.series import Series

SHARE = 1 / 3
TWIST = "the twist"


def position_errors(fine: Array, coarse: Array) -> Array:
    """Return the estimated error (n,) of a number at each position, not less than the typical one.

    Where the levels happen to cross, their difference says nothing; the root mean square over all positions
    stands in.
    """
    difference = np.abs(fine - coarse)
    return np.asarray(SHARE * np.maximum(difference, np.sqrt(np.mean(difference**2))))


def scalar_error(fine: float, coarse: float) -> float:
    """Return the estimated error of one number."""
    return SHARE * abs(fine - coarse)


def worst_error(fine: Series, coarse: Series) -> tuple[float, str]:
    """Return the largest relative error among what the scene's answers rest on, and its name."""
    errors = {}
    resists = bool((fine.torsional_stiffness > 0).all())
    for name, get in NUMBERS.items():
        if name == TWIST and not resists:  # free within its play: no number
            continue
        a, b = get(fine), get(coarse)
        size = abs(a)
        errors[name] = scalar_error(a, b) / size if size > 0 else 0.0
    worst = max(errors, key=lambda name: errors[name])
    return errors[worst], worst


NUMBERS: dict[str, Callable[[Series], float]] = {
    "the torsional stiffness": lambda s: float(s.torsional_stiffness.mean()),
    "the largest contact force": lambda s: float(s.ring.force.max()),
    "the largest output-pin force": lambda s: float(s.output.force.max()),
    "the largest contact pressure": lambda s: float(s.ring.pressure.max()),
    TWIST: lambda s: float(s.twist.mean()),
}
