"""What two solutions of an RV drive are compared by: two mesh levels, or two contact models."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.choosing import POSITIONS
from trochoid.drives.mesh_error import relative, worst_of

if TYPE_CHECKING:
    from trochoid.drives.rv.bodies import Level
    from trochoid.drives.rv.design import Design
    from trochoid.drives.rv.series import Series

TWIST, STIFFNESS = "the twist", "the torsional stiffness"

NUMBERS: dict[str, Callable[[Series], float]] = {
    STIFFNESS: lambda s: float(s.compliance.mean()),
    "the largest ring-pin force": lambda s: float(s.ring.force.max()),
    "the largest roller force": lambda s: float(s.arm.force.max()),
    "the largest ring-pin pressure": lambda s: float(s.ring.pressure.max()),
    "the largest roller pressure": lambda s: float(s.arm.pressure.max()),
    "the largest force of a crank bearing": lambda s: float(np.linalg.norm(s.bearing_force, axis=-1).max()),
    TWIST: lambda s: float(s.twist.mean()),
}


def differences(one: Series, other: Series) -> dict[str, float]:
    """Return how far two solutions are apart, relative to the first, by the names of the numbers."""
    resists = not np.isnan(one.compliance).any()
    # a drive that is free within its play has no stiffness, and one twist of many
    return {
        name: relative(get(one), get(other))
        for name, get in NUMBERS.items()
        if resists or name not in (TWIST, STIFFNESS)
    }


def worst_error(fine: Series, coarse: Series) -> tuple[float, str]:
    """Return the largest relative error among what the scene's answers rest on, and its name."""
    return worst_of(differences(fine, coarse))


def model_error(design: Design, level: Level) -> float:
    """Return the largest relative difference of level 0 from strips at a few positions.

    The stiffness is left out, which moves by 1e-3 as strips come into contact one by one.

    Raises NotConverged where strips find no solution: nobody knows then how wrong Hertz is (see `choosing.or_level0`).
    """
    from trochoid.drives.rv.series import solve_series, turn_angles

    angle = np.linspace(0.0, turn_angles(design, 1)[-1], POSITIONS, endpoint=False)
    found, true = (solve_series(design, rung, level, angle) for rung in ("level0", "strips"))
    return max(size for name, size in differences(true, found).items() if name != STIFFNESS)
