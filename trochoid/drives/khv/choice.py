"""How wrong level 0 is for a K-H-V drive, and the automatic choice of model and mesh for it (see `drives.choosing`)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from trochoid.drives import choosing
from trochoid.drives.choosing import POSITIONS, Chosen
from trochoid.drives.khv.estimate import STIFFNESS, differences, worst_error

if TYPE_CHECKING:
    from trochoid.drives.khv.bodies import Level
    from trochoid.drives.khv.design import Design
    from trochoid.drives.khv.series import Series


def choose(
    tolerance: float,
    levels: Sequence[int],
    solve: Callable[[str, int], Series],
    model_error: Callable[[], float],
    rung: str | None = None,
) -> Chosen:
    """Return the first of the `levels`, coarse to fine, whose estimated error meets the tolerance.

    Raises NotConverged when no level is fine enough.
    """
    return choosing.choose(tolerance, levels, solve, worst_error, model_error, rung)


def model_error(design: Design, level: Level) -> float:
    """Return the largest relative difference of level 0 from strips at a few positions.

    The stiffness is left out: that of strips moves by 1e-3 as they come into contact one by one, that of level 0
    is the derivative of its twist. Raises NotConverged where strips find no solution, as where surfaces conform:
    nobody knows then how wrong Hertz is (see `choosing.or_level0`).
    """
    from trochoid.drives.khv.series import solve_series

    found, true = (solve_series(design, rung, level.elastic, POSITIONS) for rung in ("level0", "strips"))
    return max(size for name, size in differences(true, found).items() if name != STIFFNESS)
