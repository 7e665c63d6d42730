"""What a run would do and cost, told before it runs."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class PlannedStage:
    """A stage, why it exists, its estimated seconds and memory in MiB, and whether the scene needs it."""

    name: str
    why: str
    seconds: float
    memory_mib: float
    needed: bool


@dataclass(frozen=True, slots=True)
class Plan:
    """All stages in order, the effects in the equations, the quantities asked for, the contact model."""

    stages: tuple[PlannedStage, ...]
    effects: tuple[str, ...]
    quantities: tuple[str, ...]
    model: str
