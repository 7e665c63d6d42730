"""The drives: what each is made of, in the words of the wings. A further drive is a further folder here."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any, cast

from trochoid.clock import Clock
from trochoid.ladder import Ladder
from trochoid.plan import Plan

if TYPE_CHECKING:
    from trochoid.results.outcome import Outcome, Quantity


@dataclass(frozen=True, slots=True)
class Drive:
    """What a drive's folder offers: its stages of a scene, its quantities and outcome made from them, its plan, and
    the ladder of its models (None: closed forms, and nothing to choose).
    """

    stages: Callable[[Any, Clock], Any]
    quantities: Mapping[str, Callable[[Any], Quantity]]
    outcome: Callable[[Any, Mapping[str, Quantity]], Outcome]
    plan: Callable[[Any], Plan]
    ladder: Callable[[Any, Clock], Ladder] | None = None


def drive_of(kind: str) -> Drive:
    """Return the drive of this type; the scene has checked that there is one."""
    return cast(Drive, import_module(f"trochoid.drives.{kind}").DRIVE)
