"""The study on the terminal: a table on a screen, aligned plain text in a pipe."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO

from trochoid.accuracy import words
from trochoid.accuracy.study import Judged, Study
from trochoid.results import text

Row = tuple[str, ...]


def show(study: Study, files: Sequence[Path] = (), stream: IO[str] | None = None) -> None:
    """Print steps, errors of each quantity, and what follows from them, to standard output by default."""
    out = sys.stdout if stream is None else stream
    if out.isatty():
        _show_rich(study, files, out)
        return
    lines = "\n".join(_plain_lines(study, files)) + "\n"
    out.write(lines if text.speaks_unicode(out) else text.plain(lines))


def step_rows(study: Study) -> Iterator[Row]:
    """Yield the table of steps, its head first."""
    yield "model", study.unit, "seconds", "error", "largest in", ""
    for judged in study.steps:
        yield (
            judged.step.rung,
            words.level(judged),
            words.seconds(judged.step.seconds),
            words.percent(judged.error),
            words.worst(judged),
            words.remark(study, judged),
        )


def quantity_rows(study: Study) -> Iterator[Row]:
    """Yield the error of each quantity in percent by step, after two rows of head: models and mesh levels."""
    yield "error in % of", *(judged.step.rung for judged in study.steps)
    yield "", *(words.level(judged) for judged in study.steps)
    for name in study.reference.step.numbers:
        cells = (judged.errors.get(name) for judged in study.steps)
        yield text.label(name), *(words.NONE if cell is None else words.digits(cell.size) for cell in cells)


def _plain_lines(study: Study, files: Sequence[Path]) -> Iterator[str]:
    yield from (f"{study.title}: what accuracy costs", "")
    yield from _aligned(list(step_rows(study)), right=(1, 2, 3))
    rows = list(quantity_rows(study))
    if len(rows) > 3:
        yield from ("", *_aligned(rows, right=range(1, len(rows[0]))))
    yield from ("", *words.sentences(study), "", *_models(study))
    if files:
        yield from ("", *(f"wrote {path}" for path in files))


def _models(study: Study) -> Iterator[str]:
    width = max(len(rung.name) for rung in study.rungs)
    for rung in study.rungs:
        yield f"{rung.name:<{width}}  {rung.what}"


def _aligned(table: Sequence[Row], right: Sequence[int]) -> Iterator[str]:
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    for row in table:
        cells = (
            cell.rjust(w) if i in right else cell.ljust(w)
            for i, (cell, w) in enumerate(zip(row, widths, strict=True))
        )
        yield "  ".join(cells).rstrip()


def _show_rich(study: Study, files: Sequence[Path], stream: IO[str]) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    def table(rows: Sequence[Row], right: Sequence[int], styles: Sequence[str | None]) -> Table:
        made = Table(box=None, pad_edge=False, header_style="dim", padding=(0, 2, 0, 0))
        for index, name in enumerate(rows[0]):
            made.add_column(escape(name), justify="right" if index in right else "left", overflow="fold")
        for row, style in zip(rows[1:], styles, strict=True):
            made.add_row(*map(escape, row), style=style)
        return made

    console = Console(file=stream, highlight=False)
    console.print(f"\n[bold]{escape(study.title)}[/bold]: what accuracy costs\n")
    console.print(table(list(step_rows(study)), (1, 2, 3), [_style(study, judged) for judged in study.steps]))
    models, levels, *rows = quantity_rows(study)
    if len(rows) > 1:
        console.print()
        head = tuple(f"{model}\n{level}" for model, level in zip(models, levels, strict=True))
        console.print(table([head, *rows], range(1, len(head)), [None] * len(rows)))
    console.print()
    said = Table.grid(padding=(0, 1))
    for sentence in words.sentences(study):
        said.add_row("·", escape(sentence))
    console.print(said)
    console.print()
    for line in _models(study):
        console.print(f"[dim]{escape(line)}[/dim]", soft_wrap=True)
    if files:
        console.print()
    for path in files:
        console.print(f"[dim]wrote[/dim] {escape(str(path))}", soft_wrap=True)


def _style(study: Study, judged: Judged) -> str | None:
    if study.choice is not None and study.choice.judged is judged:
        return "bold green"
    return "dim" if judged.estimated else None
