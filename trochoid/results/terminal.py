"""The summary that a run prints: a table on a terminal, aligned plain text in a pipe."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import IO

from trochoid.results import text
from trochoid.results.outcome import Check, Outcome, Parts, Quantity

_MOST_PARTS = 24
_HEAD = ("quantity", "value", "± error", "unit", "model", "note")
Row = tuple[str, str, str, str, str, str]


def show(outcome: Outcome, files: Sequence[Path] = (), stream: IO[str] | None = None) -> None:
    """Print quantities, checks, warnings, seconds and files to `stream`, standard output by default."""
    out = sys.stdout if stream is None else stream
    if out.isatty():
        _show_rich(outcome, files, out)
    else:
        lines = "\n".join(_plain_lines(outcome, files)) + "\n"
        out.write(lines if text.speaks_unicode(out) else text.plain(lines))


def rows(quantities: Parts, depth: int = 0) -> Iterator[Row]:
    """Yield one row per quantity, parts indented below their name; of many parts only the first are shown."""
    for index, (name, entry) in enumerate(quantities.items()):
        if depth and index == _MOST_PARTS:
            yield ("  " * depth + f"… {len(quantities) - index} more in results.json", "", "", "", "", "")
            return
        if not isinstance(entry, Quantity):
            yield ("  " * depth + name, "", "", "", "", "")
            yield from rows(entry, depth + 1)
            continue
        value, error = text.value_and_error(entry.value, entry.error)
        shown = value if entry.parts is None else ""
        yield (
            "  " * depth + name,
            shown,
            error,
            text.pretty_unit(entry.unit),
            entry.model or "",
            entry.note or "",
        )
        if entry.parts is not None:
            yield from rows(entry.parts, depth + 1)


def _plain_lines(outcome: Outcome, files: Sequence[Path]) -> Iterator[str]:
    if outcome.title:
        yield from (outcome.title, "")
    yield from _aligned([_HEAD, *rows(outcome.quantities)])
    if outcome.checks:
        yield from ("", *_aligned([("check", "value", "limit", "verdict"), *map(_check, outcome.checks)]))
    if outcome.warnings:
        yield from ("", *(f"warning: {warning}" for warning in outcome.warnings))
    yield from ("", _seconds(outcome))
    yield from (f"wrote {path}" for path in files)


def _aligned(table: Sequence[tuple[str, ...]]) -> Iterator[str]:
    """Yield the rows of `table`, the first and the text columns to the left, numbers to the right."""
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    for row in table:
        cells = (
            cell.rjust(w) if i in (1, 2) else cell.ljust(w)
            for i, (cell, w) in enumerate(zip(row, widths, strict=True))
        )
        yield "  ".join(cells).rstrip()


def _check(check: Check) -> tuple[str, str, str, str]:
    return (
        check.name,
        text.number(check.value, 3),
        text.number(check.limit, 3),
        "ok" if check.ok else "FAILED",
    )


def _seconds(outcome: Outcome) -> str:
    parts = ", ".join(f"{stage.name} {stage.seconds:.2f}" for stage in outcome.stages)
    total = sum(stage.seconds for stage in outcome.stages)
    skipped = f"; not needed: {', '.join(outcome.not_needed)}" if outcome.not_needed else ""
    return f"{total:.2f} s{f' ({parts})' if parts else ''}{skipped}"


def _show_rich(outcome: Outcome, files: Sequence[Path], stream: IO[str]) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    def table(head: Iterable[str], body: Iterable[tuple[str, ...]]) -> Table:
        made = Table(box=None, pad_edge=False, header_style="dim", padding=(0, 2, 0, 0))
        for index, name in enumerate(head):
            made.add_column(name, justify="right" if index in (1, 2) else "left", no_wrap=name != "note")
        for row in body:
            made.add_row(*map(escape, row), style="bold red" if row[-1] == "FAILED" else None)
        return made

    console = Console(file=stream, highlight=False)
    if outcome.title:
        console.print(f"\n[bold]{escape(outcome.title)}[/bold]\n")
    console.print(table(_HEAD, rows(outcome.quantities)))
    if outcome.checks:
        console.print()
        console.print(table(("check", "value", "limit", "verdict"), map(_check, outcome.checks)))
    for warning in outcome.warnings:
        console.print(f"\n[yellow]warning[/yellow] {escape(warning)}", soft_wrap=True)
    console.print(f"\n[dim]{escape(_seconds(outcome))}[/dim]", soft_wrap=True)
    for path in files:
        console.print(f"[dim]wrote[/dim] {escape(str(path))}", soft_wrap=True)
