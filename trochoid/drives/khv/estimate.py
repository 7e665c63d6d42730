"""What the two mesh levels of a K-H-V drive are compared by (see `drives.mesh_error`)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from trochoid.drives.mesh_error import (
    AT_POSITIONS,
    FLOOR,
    SHARE,
    position_errors,
    relative,
    scalar_error,
    worst_of,
)

if TYPE_CHECKING:
    from trochoid.drives.khv.series import Series

__all__ = [
    "AT_POSITIONS",
    "FLOOR",
    "NUMBERS",
    "SHARE",
    "STIFFNESS",
    "TWIST",
    "differences",
    "position_errors",
    "scalar_error",
    "worst_error",
]

TWIST, STIFFNESS = "the twist", "the torsional stiffness"


def worst_error(fine: Series, coarse: Series) -> tuple[float, str]:
    """Return the largest relative error among what the scene's answers rest on, and its name."""
    return worst_of(differences(fine, coarse))


def differences(one: Series, other: Series) -> dict[str, float]:
    """Return how far two solutions are apart, relative to the first, by the names of the numbers."""
    found = {}
    resists = bool((one.torsional_stiffness > 0).all())
    for name, get in NUMBERS.items():
        if name == TWIST and not resists:  # free within its play: no number
            continue
        found[name] = relative(get(one), get(other))
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
