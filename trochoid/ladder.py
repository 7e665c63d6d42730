"""What a drive offers to those who ask what accuracy costs: models of its contacts, mesh levels, and its own choice."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from trochoid.clock import Clock


@dataclass(frozen=True, slots=True)
class Rung:
    """A contact model: its name, what it is in one phrase, and whether it has a mesh."""

    name: str
    what: str
    meshed: bool


@dataclass(frozen=True, slots=True)
class Pick:
    """The rung and mesh level (None: no mesh) that a scene's tolerance picks, and why.

    `estimate` is the relative error that was estimated without knowing the truth (None: nothing to tell it from)
    and `of` the number that has it; `levels` are all that had to be solved; `named`: rung or level stand in the
    scene.
    """

    rung: str
    level: int | None
    estimate: float | None
    of: str
    levels: tuple[int, ...]
    named: bool


@dataclass(frozen=True, slots=True)
class Oracle:
    """A slow, independent model of one position: what it is, the drive's stages by it, and the same position taken
    from other stages.
    """

    what: str
    stages: Callable[[Any, Clock], Any]
    same: Callable[[Any], Any]


@dataclass(frozen=True, slots=True)
class Ladder:
    """Rungs from the cheapest to the best, and mesh levels from coarse to fine, each twice the one before.

    `title` names the drive, `quantities` are those asked for that its models answer, `unit` says what a level
    counts, `order` is the power of the mesh size with which numbers converge. `build(level, clock)` makes what all
    rungs share on a level; `stages(rung, built, clock)` are the drive's stages with its contacts on that rung and
    level alone (`built` is None for a rung without mesh). `pick(solved)` is the drive's automatic choice from
    `solved(rung, level)`, the stages there; it raises NotConverged when no level meets the tolerance.
    """

    title: str
    quantities: tuple[str, ...]
    rungs: tuple[Rung, ...]
    levels: tuple[int, ...]
    unit: str
    order: float
    build: Callable[[int, Clock], Any]
    stages: Callable[[str, Any, Clock], Any]
    pick: Callable[[Callable[[str, int | None], Any]], Pick]
    oracle: Oracle | None = None
