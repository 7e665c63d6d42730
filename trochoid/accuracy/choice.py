"""What a scene's tolerance picks, what that costs, and what a tenth of its error would."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from trochoid.accuracy.study import Choice, Cost, Judged
from trochoid.kinematics.errors import NotConverged
from trochoid.ladder import Ladder
from trochoid.scene.ask import MOST_FACETS

TENTH = 0.1


class NotSolved(Exception):
    """A step that the drive's choice asks for lies beyond what was solved."""


def choice(
    ladder: Ladder,
    steps: Sequence[Judged],
    solved: Mapping[tuple[str, int | None], Any],
    seconds: Callable[[Sequence[int], str], float],
    remarks: list[str],
) -> Choice | None:
    """Let the drive choose among the solved steps; adds to `remarks` why there is no choice."""

    def stages(rung: str, level: int | None) -> Any:
        if (rung, level) not in solved:
            raise NotSolved(rung if level is None else f"{rung} with {level} {ladder.unit}")
        return solved[rung, level]

    try:
        pick = ladder.pick(stages)
    except NotSolved as beyond:
        remarks.append(
            f"the tolerance asks for {beyond} or finer, which was not solved; raise --budget or the tolerance"
        )
        return None
    except NotConverged as fault:
        remarks.append(f"no level meets the tolerance: {fault}")
        return None
    judged = next(j for j in steps if (j.step.rung, j.step.level) == (pick.rung, pick.level))
    run = seconds(pick.levels, pick.rung) if pick.levels else judged.step.seconds
    tenth = None if not judged.error else cost(ladder, steps, TENTH * judged.error)
    if tenth is not None and not tenth.measured and tenth.level is not None and tenth.level > MOST_FACETS:
        remarks.append(
            f"a tenth of the error would take {tenth.level} {ladder.unit}, more than the {MOST_FACETS} that "
            "accuracy.facets_per_lobe may name"
        )
        tenth = None
    return Choice(pick, judged, run, tenth)


def cost(ladder: Ladder, steps: Sequence[Judged], error: float) -> Cost | None:
    """Return the cheapest step whose error is at most `error`, or else what finer meshes would take."""
    enough = [j for j in steps if j.error is not None and j.error <= error]
    if enough:
        found = min(enough, key=lambda j: j.step.seconds)
        return Cost(error, found.step.rung, found.step.level, found.step.seconds, True)
    reference = next(j.step.rung for j in steps if j.estimated)
    finest = [j for j in steps if j.step.rung == reference and j.step.level]
    last, before = finest[-1], finest[-2]
    if not last.error or last.step.level is None:
        return None
    doublings = math.ceil(math.log2(last.error / error) / ladder.order - 1e-9)
    growth = max(1.0, last.step.seconds / before.step.seconds) if before.step.seconds > 0.0 else 1.0
    level = last.step.level * 2**doublings
    return Cost(error, last.step.rung, level, last.step.seconds * growth**doublings, False)
