"""Blocking contours of a set, the line of its coaxial shifts, and the best shifts on that line."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.drives.planetary.design import Design
from trochoid.geometry.blocking import inner_contour, outer_contour, volume
from trochoid.geometry.blocking_contour import Contour
from trochoid.geometry.blocking_line import Aim, Choice, Line, choose, coaxial_line

AIMS: dict[str, Aim] = {
    "largest_contact_ratio": "contact_ratio",
    "equal_specific_sliding": "sliding",
    "thickest_tips": "tips",
}


@dataclass(frozen=True, slots=True)
class Blocking:
    """Plane contours (x1, x2) and (x2, x3), the volume of their joint body, the line through the set's own shifts,
    and the best shifts by the names of `AIMS`.
    """

    outer: Contour
    inner: Contour
    volume: float
    line: Line
    best: dict[str, Choice]


def blocking(design: Design) -> Blocking:
    """Trace both contours and search the line; its sums are those of the set's own shifts."""
    given, limits = design.given, design.limits
    x1, x2, x3 = given.shifts
    outer, inner = outer_contour(given, limits), inner_contour(given, limits)
    line = coaxial_line(given, (x1 + x2, x3 - x2), limits)
    best = {name: choose(given, aim, line) for name, aim in AIMS.items()} if line.stretches else {}
    return Blocking(outer, inner, volume(outer, inner), line, best)
