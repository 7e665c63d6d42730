"""What the two mesh levels of a planetary set are compared by, and how wrong level 0 is (see `drives.mesh_error`)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.mesh_error import relative, worst_of

if TYPE_CHECKING:
    from trochoid.drives.planetary.series import Series

STIFFNESS = "the torsional stiffness"

NUMBERS: dict[str, Callable[[Series], float]] = {
    STIFFNESS: lambda s: float(s.torsional_stiffness.mean()),
    "the wind-up": lambda s: float(s.lag.mean()),
    "the largest force of a pair on the sun": lambda s: float(s.sun.force.max()),
    "the largest force of a pair in the ring": lambda s: float(s.ring.force.max()),
    "the largest pressure on the sun": lambda s: float(s.sun.pressure.max()),
    "the largest pressure in the ring": lambda s: float(s.ring.pressure.max()),
    "the largest force on a planet's bearing": lambda s: float(
        np.hypot(*np.moveaxis(s.bearing, -1, 0)).max()
    ),
}


def differences(one: Series, other: Series) -> dict[str, float]:
    """Return how far two solutions are apart, relative to the first, by the names of the numbers."""
    return {name: relative(get(one), get(other)) for name, get in NUMBERS.items()}


def worst_error(fine: Series, coarse: Series) -> tuple[float, str]:
    """Return the largest relative error among what the scene's answers rest on, and its name."""
    return worst_of(differences(fine, coarse))


def model_error(level0: Series, strips: Series) -> float:
    """Return the largest relative difference of level 0 from strips.

    The stiffness is left out: that of strips moves as they come into contact one by one.
    """
    found = differences(strips, level0)
    return max(size for name, size in found.items() if name != STIFFNESS)
