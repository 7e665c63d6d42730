"""A planetary set near one that cannot be built: shifts, planets, centre distance, ring or cutter, checked as a whole.

What is advised stands in round numbers and passes all checks with just these numbers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from trochoid.geometry.blocking_line import Line
from trochoid.geometry.planetary import PlanetarySet, planetary
from trochoid.geometry.planetary_quality import Limits, least_margin, quality
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute_pair import mesh_at, needed_shift
from trochoid.kinematics.types import Array

Reasons = Callable[[PlanetarySet], tuple[str, ...]]

LOW, HIGH = -3.0, 5.0  # shifts of the sun that are tried
SPARE = 2e-5  # margins that rounding to five digits leaves
FINE, COARSE = 8001, 401  # shifts tried at the given centre distance, and at others
STEP, REACH = 0.05, 3.0  # steps of other centre distances, and how far they go, in modules
MOST_PLANETS = 24
TRIES = 24  # sets that only `also` refuses


def advice(
    given: PlanetarySet, limits: Limits, reasons: Reasons, also: Reasons | None = None
) -> tuple[str, ...]:
    """Sentences: what to change, in the keys of a scene, so that `reasons` and `also` have nothing against the set.

    If only `also` (of what is around the teeth) speaks against every set near, its sentences follow.  Without any set
    near, the conditions that exclude each other.
    """
    refused: list[tuple[PlanetarySet, tuple[str, ...]]] = []
    for near in _sets(given, limits):
        if reasons(near):
            continue
        more = () if also is None else also(near)
        if not more:
            return (_said(given, near),)
        refused.append((near, more))
        if len(refused) == TRIES:
            break
    if refused:
        near, more = refused[0]
        return (_said(given, near), *(f"and with these: {each}" for each in more))
    ring = _usual_ring(given)
    other = "" if ring == given.teeth[2] else f", nor with z_ring = {ring}"
    return (
        "no set near it can be built with other shifts, another number of planets or another centre distance"
        f"{other} ({_conflict(given, limits)}); change the teeth, the addendum, the cutter or the limits",
    )


def _sets(given: PlanetarySet, limits: Limits) -> Iterator[PlanetarySet]:
    """Sets to try: fewest changes first, each nearest first."""
    for each in _cutters(given):
        yield from _counts(each)
    yield from _remade(given, limits)
    if given.planets > 1:  # one planet goes with any teeth, which is seldom what is wanted
        yield from _remade(replace(given, planets=1), limits)


def _remade(given: PlanetarySet, limits: Limits) -> Iterator[PlanetarySet]:
    """Sets with other shifts, at their centre distance or another, of this ring or the usual one."""
    few = tuple(_cutters(given))[:: max(1, given.teeth[2] // 8)]
    for each in few:
        yield from _shifted(each, limits, FINE)
    for each in few:
        yield from _elsewhere(each, limits)
    if (ring := _usual_ring(given)) != given.teeth[2]:
        other = replace(given, teeth=(*given.teeth[:2], ring))
        for each in tuple(_cutters(other))[:: max(1, ring // 8)]:
            yield from _shifted(each, limits, FINE)
            yield from _elsewhere(each, limits)


def _cutters(given: PlanetarySet) -> Iterator[PlanetarySet]:
    """The set's own cutter if it is smaller than the ring, else smaller ones of the same addendum."""
    cutter, ring = given.cutter, given.teeth[2]
    if cutter.teeth < ring:
        yield given
        return
    for teeth in range(ring - 1, 2, -1):
        tip = cutter.tip_diameter - given.module * (cutter.teeth - teeth)
        yield replace(given, cutter=replace(cutter, teeth=teeth, tip_diameter=tip))


def _counts(given: PlanetarySet) -> Iterator[PlanetarySet]:
    """The set with numbers of planets that can be assembled, its own first; one planet only if it has one."""
    total, n = given.teeth[0] + given.teeth[2], given.planets
    for count in sorted(range(min(n, 2), MOST_PLANETS + 1), key=lambda k: (abs(k - n), -k)):
        if total % count == 0:
            yield replace(given, planets=count)


def _shifted(given: PlanetarySet, limits: Limits, points: int) -> Iterator[PlanetarySet]:
    """The set with shifts that mesh without play at its centre distance, nearest to its own first."""
    found = _margins(given, limits, points)
    if found is None:
        return
    line, x, _, margins = found
    good = x[margins.min(axis=0) >= SPARE]
    if good.size == 0:
        return
    own = given.shifts[0]
    order = good[np.argsort(np.abs(good - own), kind="stable")]
    few = np.linspace(0, order.size - 1, 12 if points == FINE else 3).astype(int)
    for x1 in order[list(dict.fromkeys((0, min(2, order.size - 1), *few.tolist())))]:
        sun = float(f"{own:.10g}") if x1 == own else round(float(x1), 3)
        _, x2, x3 = line.shifts(sun)
        yield from _counts(replace(given, shifts=(sun, round(float(x2), 5), round(float(x3), 5))))


def _elsewhere(given: PlanetarySet, limits: Limits) -> Iterator[PlanetarySet]:
    """The set with other centre distances and shifts for them, nearest first."""
    z1, z2, z3 = given.teeth
    both, step = (0.5 * (z1 + z2), 0.5 * (z3 - z2)), STEP * given.module
    low = max(max(both) * math.cos(given.pressure_angle), min(both) - REACH) * given.module
    high = (max(both) + REACH) * given.module
    own = given.center_distance
    places = np.arange(math.ceil(low / step + 1e-9), math.floor(high / step) + 1) * step
    for place in sorted(places, key=lambda a: abs(a - own)):
        moved = replace(given, center_distance=1e-3 * float(f"{1e3 * place:.7g}"))
        yield from _shifted(moved, limits, COARSE)


def _margins(
    given: PlanetarySet, limits: Limits, points: int
) -> tuple[Line, Array, tuple[str, ...], Array] | None:
    """Line of coaxial shifts, the sun's (n,), names (k,) and margins (k, n) of all conditions; None out of reach."""
    sun, planet, ring = given.gears((0.0, 0.0, 0.0))
    try:
        sums = [
            float(needed_shift(mesh_at(*pair, given.center_distance)))
            for pair in ((sun, planet), (planet, ring))
        ]
    except Infeasible:
        return None
    if not (2.0 * LOW < sums[0] < 2.0 * HIGH and abs(sums[1]) < HIGH - LOW):
        return None  # no planet or ring has such shifts
    line = Line(sums[0], sums[1], ())
    x = np.append(np.linspace(LOW, HIGH, points), given.shifts[0])
    with np.errstate(all="ignore"):
        try:
            made = planetary(given, line.shifts(x))
        except Infeasible:
            return None
        return line, x, *least_margin(quality(made, limits).conditions, given.module)


def _conflict(given: PlanetarySet, limits: Limits) -> str:
    """What excludes what, where the least margin of all conditions is largest."""
    z1, z2, _ = given.teeth
    usual = replace(given, center_distance=0.5 * given.module * (z1 + z2), teeth=(z1, z2, _usual_ring(given)))
    found = _margins(given, limits, COARSE) or _margins(next(_cutters(usual)), limits, COARSE)
    if found is None:
        return "the teeth cannot reach each other"
    _, _, names, margins = found
    never = [name for name, best in zip(names, margins.max(axis=1), strict=True) if best < 0.0]
    if never:
        return f"{', '.join(never[:3])}: no shifts of sun and planet meet the limit"
    worst = margins.argmin(axis=0)[:-1]
    best = int(margins.min(axis=0)[:-1].argmax())
    around = (best, min(best + 1, len(worst) - 1), max(best - 1, 0))
    bound = dict.fromkeys(names[worst[k]] for k in around)
    return f"{' and '.join(bound)}: no shifts meet the limits of both"


def _usual_ring(given: PlanetarySet) -> int:
    return given.teeth[0] + 2 * given.teeth[1]


def _said(given: PlanetarySet, near: PlanetarySet) -> str:
    """What is other than in the given set, in the keys of a scene."""
    changes = []
    if near.teeth[2] != given.teeth[2]:
        changes.append(f"z_ring = {near.teeth[2]}")
    if near.cutter != given.cutter:
        changes.append(f"ring_cutter.z = {near.cutter.teeth}")
    if near.planets != given.planets:
        changes.append(f"planets = {near.planets}")
    if near.center_distance != given.center_distance:
        changes.append(f'center_distance = "{1e3 * near.center_distance:.7g} mm"')
    if near.shifts != given.shifts:
        names = ("x_sun", "x_planet", "x_ring")
        changes += [f"{name} = {x + 0.0:.10g}" for name, x in zip(names, near.shifts, strict=True)]
    return f"the nearest that can be built: {', '.join(changes)}"
