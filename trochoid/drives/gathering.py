"""What the outcomes of all drives begin and end with."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any, Protocol

from trochoid.clock import Clock
from trochoid.results.outcome import Outcome, Quantity, Stage


class Headline(Protocol):
    """A drive's module of that name: what it is called, and its main data."""

    def title(self, stages: Any, /) -> str:
        """Return the line above a report."""
        ...

    def facts(self, stages: Any, /) -> Mapping[str, Quantity]:
        """Return what a reader wants to know before any answer, by its label."""
        ...


def begun(
    stages: Any,
    quantities: Mapping[str, Quantity],
    planned: Iterable[str],
    headline: Headline,
    not_simulated: Mapping[str, str],
) -> Outcome:
    """Return the scene, the answers and the words at their head; `planned` names the stages that could have run."""
    ran = tuple(stages.clock.seconds)  # the headline may start a stage of its own
    return Outcome(
        scene=stages.scene.model_dump(mode="json"),
        quantities=quantities,
        not_needed=tuple(name for name in planned if name not in ran),
        title=headline.title(stages),
        facts=headline.facts(stages),
        not_simulated=not_simulated,
    )


def timed(outcome: Outcome, clock: Clock) -> Outcome:
    """Return an outcome with the stages that ran, those of its own pictures among them."""
    return replace(outcome, stages=tuple(Stage(name, seconds) for name, seconds in clock.seconds.items()))
