"""What a study of accuracy holds: steps of the ladder, their errors, the scene's choice and what more would cost."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from trochoid.ladder import Pick, Rung

Numbers: TypeAlias = Mapping[str, Mapping[str, tuple[float, str]]]
"""Quantity → part ("" when it has none) → value and unit."""


@dataclass(frozen=True, slots=True)
class Step:
    """One rung on one mesh level (None: no mesh): its numbers, and the seconds of all that they need, by stage."""

    rung: str
    level: int | None
    stages: Mapping[str, float]
    numbers: Numbers

    @property
    def seconds(self) -> float:
        """Seconds of the whole chain."""
        return sum(self.stages.values())


@dataclass(frozen=True, slots=True)
class Error:
    """The largest relative error among the parts of a quantity, and the part that has it ("" for a single value)."""

    size: float
    part: str


@dataclass(frozen=True, slots=True)
class Judged:
    """A step and the error of each of its quantities against the reference.

    `estimated`: the step is the reference itself, and its error follows from the level before.
    """

    step: Step
    errors: Mapping[str, Error]
    estimated: bool = False

    @property
    def worst(self) -> str | None:
        """The quantity with the largest error; None when there is nothing to tell it from."""
        return max(self.errors, key=lambda name: self.errors[name].size, default=None)

    @property
    def error(self) -> float | None:
        """The largest error; None when there is nothing to tell it from."""
        return None if self.worst is None else self.errors[self.worst].size


@dataclass(frozen=True, slots=True)
class Cost:
    """The cheapest way to an error: rung, level, seconds; `measured` or else extrapolated from the finest levels."""

    error: float
    rung: str
    level: int | None
    seconds: float
    measured: bool


@dataclass(frozen=True, slots=True)
class Choice:
    """What the scene's tolerance picks, the step that it is, its measured error and the seconds of a run, which
    solves every level that the pick needed; `tenth`: what a tenth of the error would cost.
    """

    pick: Pick
    judged: Judged
    run_seconds: float
    tenth: Cost | None


@dataclass(frozen=True, slots=True)
class Check:
    """How far the reference is from an independent model at one position, and the seconds of that model."""

    what: str
    errors: Mapping[str, Error]
    seconds: float


@dataclass(frozen=True, slots=True)
class Study:
    """Error against seconds of a scene; `steps` from the cheapest rung and coarsest level on.

    `choice` is None when the tolerance's choice is not among the steps; `remarks` say why, and what was left out.
    """

    scene: Mapping[str, Any]
    title: str
    tolerance: float
    budget: float
    rungs: tuple[Rung, ...]
    unit: str
    steps: tuple[Judged, ...]
    choice: Choice | None
    check: Check | None
    remarks: tuple[str, ...]

    @property
    def reference(self) -> Judged:
        """The step that all others are compared with."""
        return next(judged for judged in self.steps if judged.estimated)
