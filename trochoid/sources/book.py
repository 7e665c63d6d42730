"""All five sources, computed: rows with their verdicts and errata with both forms, ready to be written."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from trochoid.sources import indexer, khv, planetary, precessional, rv
from trochoid.sources.row import Erratum, Source
from trochoid.sources.verdict import Judged, State, both_forms, judged

SOURCES: tuple[Source, ...] = (rv.SOURCE, precessional.SOURCE, khv.SOURCE, planetary.SOURCE, indexer.SOURCE)


@dataclass(frozen=True, slots=True)
class Failing:
    """An erratum and what its two forms come to, as texts."""

    erratum: Erratum
    printed: str
    right: str


@dataclass(frozen=True, slots=True)
class Chapter:
    """A source with everything computed."""

    source: Source
    rows: tuple[Judged, ...]
    errata: tuple[Failing, ...]

    def count(self, state: State) -> int:
        """How many printed numbers and statements of this chapter have a verdict of this kind."""
        found: Counter[State] = Counter()
        for each in self.rows:
            found[each.state] += len(each.row.published)
        return found[state]

    @property
    def total(self) -> int:
        """How many printed numbers and statements there are."""
        return sum(len(each.row.published) for each in self.rows)


def chapters() -> tuple[Chapter, ...]:
    """Compute all sources; takes a few seconds, most of them in the blocking contours of §4."""
    return tuple(
        Chapter(
            source,
            tuple(judged(row) for row in source.rows),
            tuple(Failing(erratum, *both_forms(erratum)) for erratum in source.errata),
        )
        for source in SOURCES
    )


def summary(made: tuple[Chapter, ...]) -> list[tuple[str, ...]]:
    """Rows of the summary with its head: source, numbers, as printed, differ, not computed, errata."""
    head = ("source", "numbers and statements", "as printed", "not so", "not computed", "errata")
    rows = [
        (
            f"§{c.source.number} {c.source.name}",
            *(str(n) for n in (c.total, c.count("same"), c.count("differs") + c.count("unexplained"))),
            str(c.count("not computed")),
            str(len(c.errata)),
        )
        for c in made
    ]
    whole = ("all", *(str(sum(int(row[i]) for row in rows)) for i in range(1, 6)))
    return [head, *rows, whole]
