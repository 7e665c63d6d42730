"""Linear equations between fractions, without rounding."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

Row = list[Fraction]


def null_space(rows: Iterable[Row], columns: int) -> list[Row]:
    """Basis of the solutions of rows·x = 0, by Gauss–Jordan elimination without rounding."""
    work = [list(row) for row in rows]
    pivots: list[int] = []
    for column in range(columns):
        done = len(pivots)
        found = next((i for i in range(done, len(work)) if work[i][column] != 0), None)
        if found is None:
            continue
        work[done], work[found] = work[found], work[done]
        scale = work[done][column]
        work[done] = [value / scale for value in work[done]]
        for i, row in enumerate(work):
            if i != done and row[column] != 0:
                factor = row[column]
                work[i] = [a - factor * b for a, b in zip(row, work[done], strict=True)]
        pivots.append(column)
    basis = []
    for free in (column for column in range(columns) if column not in pivots):
        vector = [Fraction(int(column == free)) for column in range(columns)]
        for row, pivot in zip(work, pivots, strict=False):
            vector[pivot] = -row[free]
        basis.append(vector)
    return basis
