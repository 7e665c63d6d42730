"""The verdict on a row: computed now, never written down."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

from trochoid.results import text
from trochoid.sources.numeral import Numeral, numeral, signed
from trochoid.sources.row import Erratum, Finding, How, Row, Value

State = Literal["same", "differs", "not computed", "unexplained"]

_SAME: dict[How, str] = {
    "rounded": "to the printed digits",
    "cut": "to the printed digits, the rest cut off",
    "inside": "inside",
    "above": "above",
    "claim": "true",
}
_EXACT = "exactly"
NOTHING = 1e-9  # what is left of a zero
_JUDGES: dict[How, Callable[[list[Numeral], Sequence[Value]], bool]] = {
    "rounded": lambda printed, found: all(p.same_digits(v) for p, v in zip(printed, found, strict=True)),
    "cut": lambda printed, found: all(
        p.same_digits(v, cut=True) for p, v in zip(printed, found, strict=True)
    ),
    "inside": lambda printed, found: all(printed[0].value <= v <= printed[1].value for v in found),
    "above": lambda printed, found: all(v > printed[0].value for v in found),
}


@dataclass(frozen=True, slots=True)
class Judged:
    """A row with its computed numbers, the largest difference and the verdict, as texts.

    "unexplained" is a row that differs without a reason, or that has a reason and does not differ: a fault.
    """

    row: Row
    published: str
    computed: str
    difference: str
    verdict: str
    state: State


def judged(row: Row) -> Judged:
    """Compute a row and compare it with what is printed."""
    published = _printed(row)
    if row.computed is None:
        return Judged(row, published, "–", "–", f"not computed: {row.reason}", "not computed")
    found = row.computed()
    if isinstance(found, Finding):
        return _judgement(row, published, found.shown, "–", found.true, _SAME["claim"])
    if not all(math.isfinite(v) for v in found):
        return _judgement(row, published, "not finite", "–", False, "")
    printed = [numeral(each) for each in row.published]
    if row.how in ("inside", "above"):
        shown = _joined([text.number(float(v), 4) for v in found])
        return _judgement(row, published, shown, "–", _JUDGES[row.how](printed, found), _SAME[row.how])
    values = list(found) if len(found) >= len(printed) else [found[0]] * len(printed)
    printed = printed if len(printed) == len(values) else printed * len(values)
    shown = _joined([p.text(v) for p, v in zip(printed, values, strict=True)])
    off = max((p.difference(v) for p, v in zip(printed, values, strict=True)), key=abs)
    exact = off == 0.0 and all(not isinstance(v, float) for v in values)
    same = _EXACT if exact else _SAME[row.how]
    angle = "″" if printed[0].angle else ""
    return _judgement(
        row, published, shown, text.number(off, 2) + angle, _JUDGES[row.how](printed, values), same
    )


def _judgement(row: Row, published: str, shown: str, off: str, reproduced: bool, same: str) -> Judged:
    if reproduced and not row.reason:
        return Judged(row, published, shown, off, same, "same")
    if row.reason and not reproduced:
        word = "false" if row.how == "claim" else "differs"
        return Judged(row, published, shown, off, f"{word}: {row.reason}", "differs")
    wrong = (
        "unexplained difference" if not reproduced else f"reproduced, though it should differ: {row.reason}"
    )
    return Judged(row, published, shown, off, wrong, "unexplained")


def both_forms(erratum: Erratum) -> tuple[str, str]:
    """What the printed and the right form come to, as texts; empty where that is not one number."""
    if erratum.gives is None:
        return "", ""
    printed, right = (_plain(value) for value in erratum.gives())
    return printed, right


def _plain(value: Value) -> str:
    """A number that has no printed one beside it."""
    if not isinstance(value, float):
        return signed(str(value))
    return text.number(0 if abs(value) < NOTHING else value, 5)


def _printed(row: Row) -> str:
    if row.how == "inside":
        return " … ".join(row.published)
    if row.how == "above":
        return f"more than {row.published[0]}"
    return ", ".join(row.published)


def _joined(values: list[str]) -> str:
    return values[0] if len(set(values)) == 1 else ", ".join(values)
