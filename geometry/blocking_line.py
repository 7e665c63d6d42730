"""The coaxiality line: shifts that keep the given centre distance, its feasible part, and the best point on it.

With the sums X12 = x1 + x2 and X23 = x3 − x2 fixed by the centre distance, one shift is free: x1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from trochoid.geometry.planetary import Planetary, PlanetarySet, planetary
from trochoid.geometry.planetary_quality import Limits, inner_conditions, least_margin, outer_conditions
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute_pair import needed_shift
from trochoid.kinematics.types import Array

Aim = Literal["contact_ratio", "sliding", "tips"]


@dataclass(frozen=True, slots=True)
class Stretch:
    """A feasible stretch of the line, from `low` to `high` (x1), and the conditions that bind at its ends."""

    low: float
    high: float
    low_condition: str
    high_condition: str


@dataclass(frozen=True, slots=True)
class Line:
    """Coaxiality line x1 + x2 = `outer`, x3 − x2 = `inner`, and its feasible stretches."""

    outer: float
    inner: float
    stretches: tuple[Stretch, ...]

    def shifts(self, x1: Any) -> tuple[Any, Any, Any]:
        """Shifts of sun, planet, ring for the sun's shift x1 (number or array)."""
        return x1, self.outer - x1, self.inner + self.outer - x1


@dataclass(frozen=True, slots=True)
class Choice:
    """Best shifts for an aim, its value there, and the condition that ends the line there ("" inside it).

    The value is the lesser contact ratio, the specific sliding of sun and planet, or the thinnest tip in m.
    """

    aim: Aim
    shifts: tuple[float, float, float]
    value: float
    bound: str


def needed_sums(given: PlanetarySet) -> tuple[float, float]:
    """x1 + x2 and x3 − x2 that mesh without play at the set's centre distance; raises Infeasible."""
    set_ = planetary(given)
    return float(needed_shift(set_.outer)), float(needed_shift(set_.inner))


def coaxial_line(
    given: PlanetarySet,
    sums: tuple[float, float] | None = None,
    limits: Limits | None = None,
    span: tuple[float, float] = (-3.0, 5.0),
) -> Line:
    """Feasible stretches of the line for x1 in `span`; `sums` default to those of a mesh without play."""
    outer, inner = needed_sums(given) if sums is None else sums
    line = Line(outer, inner, ())
    limits = limits or Limits()
    x = np.linspace(*span, 4001)
    names, margins = _margins(given, line, x, limits)
    good = margins.min(axis=0) >= 0.0
    edges = np.flatnonzero(good[1:] != good[:-1])
    inside, outside = (
        np.where(good[edges], x[edges], x[edges + 1]),
        np.where(good[edges], x[edges + 1], x[edges]),
    )
    for _ in range(48):
        middle = 0.5 * (inside + outside)
        feasible = _margins(given, line, middle, limits)[1].min(axis=0) >= 0.0
        inside, outside = np.where(feasible, middle, inside), np.where(feasible, outside, middle)
    binding = (
        [names[k] for k in _margins(given, line, outside, limits)[1].argmin(axis=0)] if edges.size else []
    )
    ends = [(float(at), name) for at, name in zip(inside, binding, strict=True)]
    if good[0]:
        ends.insert(0, (span[0], "end of the span searched"))
    if good[-1]:
        ends.append((span[1], "end of the span searched"))
    pairs = zip(ends[::2], ends[1::2], strict=True)
    return Line(outer, inner, tuple(Stretch(low, high, why, other) for (low, why), (high, other) in pairs))


def _margins(given: PlanetarySet, line: Line, x1: Array, limits: Limits) -> tuple[tuple[str, ...], Array]:
    set_ = planetary(given, line.shifts(x1))
    (sun, planet, ring), boundary = set_.tips, set_.boundaries[2]
    outer = outer_conditions(set_.outer, (sun, planet), limits)
    return least_margin(
        (*outer, *inner_conditions(set_.inner, (planet, ring), boundary, limits)), given.module
    )


def choose(given: PlanetarySet, aim: Aim, line: Line | None = None) -> Choice:
    """Shifts on the feasible line for an aim; raises Infeasible when nothing on the line is feasible.

    "contact_ratio": the lesser of both contact ratios is largest; "sliding": sun and planet wear alike, their
    specific sliding at the ends of the active flanks is equal; "tips": the thinnest tip is thickest (m).
    """
    line = line or coaxial_line(given)
    if not line.stretches:
        raise Infeasible(
            f"no shifts with x1 + x2 = {line.outer:.6g} and x3 − x2 = {line.inner:.6g} fulfil all conditions; change "
            "the centre distance, the teeth or the limits"
        )
    best: tuple[float, float, str] | None = None
    for stretch in line.stretches:
        low, high = stretch.low, stretch.high
        for _ in range(5):  # each time around the best of 401 points
            x = np.linspace(low, high, 401)
            merit = _merit(planetary(given, line.shifts(x)), aim)
            k = int(merit.argmax())
            low, high = float(x[max(0, k - 1)]), float(x[min(400, k + 1)])
        at = float(x[k])
        bound = {stretch.low: stretch.low_condition, stretch.high: stretch.high_condition}.get(at, "")
        if best is None or merit[k] > best[0]:
            best = (float(merit[k]), at, bound)
    assert best is not None
    shifts = line.shifts(best[1])
    return Choice(aim, shifts, _worth(planetary(given, shifts), aim, best[0]), best[2])


def _merit(set_: Planetary, aim: Aim) -> Array:
    sun, planet, ring = set_.tips
    if aim == "contact_ratio":
        lesser: Array = np.minimum(
            set_.outer.contact_ratio(sun, planet), set_.inner.contact_ratio(planet, ring)
        )
        return lesser
    if aim == "sliding":
        one, two = set_.outer.sliding(sun, planet)
        difference: Array = -np.abs(one - two)
        return difference
    thinnest: Array = np.min(
        [g.thickness_at(tip) for g, tip in zip(set_.gears, set_.tips, strict=True)], axis=0
    )
    return thinnest


def _worth(set_: Planetary, aim: Aim, merit: float) -> float:
    """What is reported for an aim: its merit, for sliding the larger specific sliding of sun and planet."""
    if aim != "sliding":
        return merit
    return float(min(set_.outer.sliding(*set_.tips[:2])))
