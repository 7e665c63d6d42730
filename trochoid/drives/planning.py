"""The plan of a run whose stages have fixed costs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from trochoid.plan import Plan, PlannedStage
from trochoid.scene import Scene


def planned(
    scene: Scene[Any],
    why: Mapping[str, str],
    stages_of: Mapping[str, Iterable[str]],
    seconds: Mapping[str, float],
    model: str = "closed forms",
    memory: float = 100.0,
) -> Plan:
    """Return what a run would do: the stages in the order of `why`, which says what each is for.

    `stages_of` names the stages of each quantity, `seconds` what a stage costs (0.01 where it says nothing),
    `memory` (MiB) is that of every stage.
    """
    needed = {stage for name in scene.ask.quantities for stage in stages_of[name]}
    stages = tuple(
        PlannedStage(name, reason, seconds.get(name, 0.01), memory, name in needed)
        for name, reason in why.items()
    )
    effects = tuple(effect.type for effect in scene.effects)
    return Plan(stages, effects, scene.ask.quantities, model)
