"""The automatic choice: the cheapest contact model, then the coarsest mesh, that meet the scene's tolerance.

Level 0 takes every contact for one between half-planes under Hertz's pressure. How wrong that is does not depend on
the mesh (the differences on 8 and on 32 facets per lobe agree to a hundredth), so a few positions on the coarsest
level tell, where strips are affordable. The mesh follows from the error that two levels suggest.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from trochoid.drives.khv.estimate import STIFFNESS, differences, worst_error
from trochoid.kinematics.errors import NotConverged

if TYPE_CHECKING:
    from trochoid.drives.khv.bodies import Level
    from trochoid.drives.khv.design import Design
    from trochoid.drives.khv.series import Series

MODEL_SHARE = 0.25  # of the tolerance that the model may take; the rest is the mesh's
POSITIONS = 7  # at which level 0 is compared with strips; odd, so that few of them are alike


@dataclass(frozen=True, slots=True)
class Chosen:
    """The rung, the mesh levels that were solved on it (the last two count), the estimated error of the number
    `of`, the largest, for the mesh, and that of the model.
    """

    rung: str
    levels: tuple[int, ...]
    error: float
    of: str
    model_error: float


def choose(
    tolerance: float,
    levels: Sequence[int],
    solve: Callable[[str, int], Series],
    model_error: Callable[[], float],
    rung: str | None = None,
) -> Chosen:
    """Return the first of the `levels`, coarse to fine, whose estimated error meets the tolerance.

    `solve(rung, level)` gives the contacts over a turn, `model_error()` that of level 0, which is not asked for
    when the scene names a `rung`. Raises NotConverged when no level is fine enough.
    """
    off = 0.0
    if rung is None:
        off = model_error()
        rung, off = ("level0", off) if off <= MODEL_SHARE * tolerance else ("strips", 0.0)
    coarse = solve(rung, levels[0])
    error, name = float("inf"), ""
    for count, level in enumerate(levels[1:], start=2):
        fine = solve(rung, level)
        error, name = worst_error(fine, coarse)
        if error <= tolerance:
            return Chosen(rung, tuple(levels[:count]), error, name, off)
        coarse = fine
    raise NotConverged(
        f"the error of {name} is estimated at {error:.1e} with {levels[-1]} facets per lobe, more than "
        f"accuracy.tolerance = {tolerance:g}; raise the tolerance to {error:.1e}, or name accuracy.facets_per_lobe "
        "and accept the error"
    )


def model_error(design: Design, level: Level) -> float:
    """Return the largest relative difference of level 0 from strips at a few positions.

    The stiffness is left out: that of strips moves by 1e-3 as they come into contact one by one, that of level 0
    is the derivative of its twist. Raises NotConverged where strips find no solution, as where surfaces conform:
    nobody knows then how wrong Hertz is.
    """
    from trochoid.drives.khv.series import solve_series

    try:
        found, true = (solve_series(design, rung, level.elastic, POSITIONS) for rung in ("level0", "strips"))
    except NotConverged as fault:
        raise NotConverged(
            f'no model can be chosen, for level0 cannot be compared with strips: {fault}; accuracy.model = "level0" '
            "takes Hertz's pressure all the same, with an error that nobody knows"
        ) from fault
    return max(size for name, size in differences(true, found).items() if name != STIFFNESS)
