"""The page of the documentation, docs/sources.md, as Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from trochoid.sources.book import Chapter, Failing, chapters, summary
from trochoid.sources.verdict import Judged

INTRO = """\
# The sources, reproduced

Docstrings and tests refer to five texts as "sources §1" to "§5". Below stands every number that they print, and every
number of the reference cases and hand calculations that go with them, beside the number computed here; and every
misprint with the test in which the printed form fails.

This page is written by `python examples/sources.py --docs`, which calls the library for each number and each verdict;
`tests/sources/test_page.py` fails when the page is not what it would write today. `python examples/sources.py` makes a
report of the same: `out/sources/report.html`.

* *computed* has two digits more than printed. *difference* is computed − published, the largest of a line.
* *verdict* compares: to the printed digits means rounded to them. A number that differs says why. Nothing that is
  printed is left out: what is not computed says so.
* *where* is the equation, table or chapter of the text; a *check value*, *reference case*, *closed form* or *hand
  calculation* is not of the text, but of an independent model of what it describes."""


def markdown(made: tuple[Chapter, ...] | None = None) -> str:
    """Return the whole page."""
    made = chapters() if made is None else made
    parts = [INTRO, _table(summary(made), right=5)]
    parts += [part for chapter in made for part in _chapter(chapter)]
    return "\n\n".join(parts) + "\n"


def _chapter(chapter: Chapter) -> Iterable[str]:
    source = chapter.source
    yield f"## §{source.number} · {source.name}"
    yield f"{source.title}."
    yield source.intro
    head = ("number", "where", "published", "computed", "difference", "verdict", "test")
    yield _table([head, *(_row(each) for each in chapter.rows)])
    yield f"### Misprints of §{source.number}"
    columns = ("where", "printed", "right", "what both come to", "test")
    yield _table([columns, *(_erratum(each) for each in chapter.errata)])
    if source.remarks:
        yield "\n".join(f"* {remark}" for remark in source.remarks)


def _row(each: Judged) -> tuple[str, ...]:
    row = each.row
    what = row.what + (f", {row.unit}" if row.unit else "") + (f" ({row.note})" if row.note else "")
    return (what, row.where, each.published, each.computed, each.difference, each.verdict, _link(row.test))


def _erratum(each: Failing) -> tuple[str, ...]:
    erratum = each.erratum
    comes_to = f"{erratum.of}: **{each.printed}**, right **{each.right}**" if erratum.of else "–"
    return erratum.where, erratum.printed, erratum.right, comes_to, _link(erratum.test)


def _link(test: str) -> str:
    """A link to the file of a test, by the test's name."""
    file, _, name = test.partition("::")
    return f"[`{name}`](../{file})" if test else "–"


def _table(rows: Sequence[Sequence[str]], right: int = 0) -> str:
    """A table with its head; the last `right` columns are aligned to the right."""
    width = len(rows[0])
    rule = ["---"] * (width - right) + ["---:"] * right
    escaped = [[cell.replace("|", "\\|") for cell in row] for row in rows]
    return "\n".join("| " + " | ".join(row) + " |" for row in (escaped[0], rule, *escaped[1:]))
