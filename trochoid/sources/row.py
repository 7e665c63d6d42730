"""What the page is made of: printed numbers with the call that computes them, misprints, and their sources."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

Value = float | int | Fraction
How = Literal["rounded", "cut", "inside", "above", "claim"]


@dataclass(frozen=True, slots=True)
class Finding:
    """What became of a claim that is no number: the numbers in words, and whether the claim is true."""

    shown: str
    true: bool


@dataclass(frozen=True, slots=True)
class Row:
    """A printed number (or a few of one line) and how it is computed.

    `published` is as printed; `computed` returns as many values in the same unit (rad for angles written 28°43′40″),
    one value that stands for all, or a Finding; None where the number is not computed.  `how` says what counts as
    reproduced: "rounded" or "cut" to the printed digits, "inside" the two printed bounds, "above" the printed one,
    or a "claim".  `reason` says why a number is known to differ, or why it is not computed; `test` is
    "file.py::test_name".
    """

    where: str
    what: str
    published: tuple[str, ...]
    computed: Callable[[], Sequence[Value] | Finding] | None
    test: str = ""
    unit: str = ""
    how: How = "rounded"
    note: str = ""
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Erratum:
    """A misprint: the printed form, the right one, and the test, "file.py::test_name", that shows the former failing.

    `gives` returns what both come to for one quantity, named in `of` with its unit.
    """

    where: str
    printed: str
    right: str
    test: str
    of: str = ""
    gives: Callable[[], tuple[Value, Value]] | None = None


@dataclass(frozen=True, slots=True)
class Source:
    """One of the five texts: its title, what its numbers stand for, rows, errata, and what a reader may trip over."""

    number: int
    name: str
    title: str
    intro: str
    rows: tuple[Row, ...]
    errata: tuple[Erratum, ...]
    remarks: tuple[str, ...] = ()
