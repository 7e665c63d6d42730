"""What the two mesh levels of sphere teeth are compared by (see `drives.mesh_error`)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from trochoid.drives.mesh_error import relative, worst_of

if TYPE_CHECKING:
    from trochoid.drives.precessional.contact import Series

PRESSURE = "the largest pressure"

NUMBERS: dict[str, Callable[[Series], float]] = {
    "the torsional stiffness": lambda s: float(s.torsional_stiffness.mean()),
    "the wind-up": lambda s: float(s.lag.mean()),
    "the largest force of a contact": lambda s: float(s.total.max()),
    PRESSURE: lambda s: float(s.pressure.max()),
}


def differences(one: Series, other: Series) -> dict[str, float]:
    """Return how far two solutions are apart, relative to the first, by the names of the numbers."""
    if one.torque == 0.0:
        return dict.fromkeys(NUMBERS, 0.0)
    edge = one.edge.any()  # without a bound there, and then no mesh is fine enough
    return {
        name: relative(get(one), get(other))
        for name, get in NUMBERS.items()
        if not (edge and name == PRESSURE)
    }


def worst_error(fine: Series, coarse: Series) -> tuple[float, str]:
    """Return the largest relative error among what the scene's answers rest on, and its name."""
    return worst_of(differences(fine, coarse))
