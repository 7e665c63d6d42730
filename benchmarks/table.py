"""One table for all benchmarks: measured, target, verdict."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Row:
    """A measured number, and the most (or, with `at_least`, the least) that it should be; None: no target."""

    name: str
    measured: float
    unit: str = ""
    target: float | None = None
    at_least: bool = False

    @property
    def met(self) -> bool | None:
        """Say whether the target is met; None without one."""
        if self.target is None:
            return None
        return self.measured >= self.target if self.at_least else self.measured <= self.target


@dataclass(frozen=True, slots=True)
class Table:
    """What was measured, how, and its rows."""

    title: str
    how: str
    rows: tuple[Row, ...]


def text(table: Table) -> str:
    """Return a table as aligned lines."""
    head = (table.title, "measured", "", "target", "")
    lines = [head, *(_cells(row) for row in table.rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(5)]
    shown = [
        f"{a:<{widths[0]}}  {b:>{widths[1]}} {c:<{widths[2]}}  {d:<{widths[3]}}  {e}".rstrip()
        for a, b, c, d, e in lines
    ]
    return "\n".join([shown[0], f"  ({table.how})", *shown[1:]])


def _cells(row: Row) -> tuple[str, str, str, str, str]:
    sign = "≥" if row.at_least else "≤"
    target = "" if row.target is None else f"{sign} {row.target:g}"
    verdict = {None: "", True: "met", False: "NOT MET"}[row.met]
    return f"  {row.name}", f"{row.measured:.3g}", row.unit, target, verdict


def plain(table: Table) -> dict[str, object]:
    """Return a table as JSON's types."""
    rows = [
        {
            "name": row.name,
            "measured": row.measured,
            "unit": row.unit,
            "target": row.target,
            "at_least": row.at_least,
            "met": row.met,
        }
        for row in table.rows
    ]
    return {"title": table.title, "how": table.how, "rows": rows}


def summary(tables: Sequence[Table]) -> str:
    """Say how many targets are met."""
    verdicts = [row.met for table in tables for row in table.rows if row.met is not None]
    return f"{sum(verdicts)} of {len(verdicts)} targets met"
