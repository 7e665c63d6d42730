"""A first stage near one that cannot be built: shifts, crankshafts, centre distance, planets, checked as a whole."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from trochoid.drives.rv.first_stage import first_stage
from trochoid.geometry.planetary import outer_tips
from trochoid.geometry.planetary_quality import Limits, least_margin, outer_conditions
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute import Gear
from trochoid.kinematics.involute_pair import mesh_at, needed_shift
from trochoid.kinematics.types import Array
from trochoid.scene.drive_rv import FirstStage

Reasons = Callable[[FirstStage], tuple[str, ...]]

CRANKS = range(2, 7)
LOW, HIGH = -1.5, 2.5  # shifts of the sun that are tried
SPARE = 2e-5  # margins that rounding to five digits leaves
STEP, REACH = 0.05, 2.0  # steps of other centre distances, and how far they go, in modules
TRIES = 24  # stages that only the rest of the drive refuses


def advice(
    table: FirstStage, limits: Limits, reasons: Reasons, also: Reasons, room: tuple[float, float]
) -> tuple[str, ...]:
    """Sentences: what to change in [drive.first_stage] so that `reasons` and `also` have nothing against it.

    `also` tells what stands in the way elsewhere; if it has something against every stage near, that follows.  `room`:
    least and largest radius (m) of the circle of the crankshafts in the discs.
    """
    refused: list[tuple[FirstStage, tuple[str, ...]]] = []
    for near in _tables(table, limits, room):
        if near == table or reasons(near) or not room[0] < first_stage(near).arm < room[1]:
            continue
        more = also(near)
        if not more:
            return (_said(table, near),)
        refused.append((near, more))
        if len(refused) == TRIES:
            break
    if refused:
        near, more = refused[0]
        return (_said(table, near), *(f"and with these: {each}" for each in more))
    low, high = (f"{1e3 * r:.6g}" for r in room)
    place = f"room on a circle of {low} to {high} mm" if room[0] < room[1] else "no room on any circle"
    bound = "" if math.isinf(room[1]) else f"; the crank holes have {place}"
    return (
        "no first stage near can be built with other shifts, another number of crankshafts, another centre distance or "
        f"other planets ({_conflict(table, limits)}{bound}); change the sun, the module or the discs",
    )


def _tables(table: FirstStage, limits: Limits, room: tuple[float, float]) -> Iterator[FirstStage]:
    """Stages to try: fewest changes first, each nearest first."""
    yield from _counts(table)
    yield from _shifted(table, limits)
    yield from _elsewhere(table, limits, room)
    teeth = range(6, 1001)
    for z in sorted(teeth, key=lambda z: abs(z - table.z_planet)):
        usual = 0.5 * table.module * (table.z_sun + z)
        if z == table.z_planet or not room[0] < usual < room[1]:
            continue
        other = table.model_copy(update={"z_planet": z})
        if table.center_distance is not None and abs(table.center_distance - usual) > REACH * table.module:
            other = other.model_copy(update={"center_distance": _round(usual)})
        yield from _counts(other)
        yield from _shifted(other, limits)


def _counts(table: FirstStage) -> Iterator[FirstStage]:
    """The stage with numbers of crankshafts that can be assembled, its own first."""
    for count in sorted(CRANKS, key=lambda k: (abs(k - table.cranks), -k)):
        if (table.z_sun + table.z_planet) % count == 0:
            yield table.model_copy(update={"cranks": count})


def _shifted(table: FirstStage, limits: Limits) -> Iterator[FirstStage]:
    """The stage with shifts that keep its centre distance, nearest to its own first."""
    found = _margins(table, limits)
    if found is None:
        return
    own, total, x, _, margins = found
    good = x[margins.min(axis=0) >= SPARE]
    if good.size == 0:
        return
    order = good[np.argsort(np.abs(good - own), kind="stable")]
    for x1 in order[[0, min(2, order.size - 1), order.size // 2]]:
        sun = float(f"{own:.10g}") if x1 == own else round(float(x1), 3)
        planet = round(total - sun, 5)
        if abs(planet) <= 3.0:
            yield from _counts(table.model_copy(update={"x_sun": sun, "x_planet": planet}))


def _elsewhere(table: FirstStage, limits: Limits, room: tuple[float, float]) -> Iterator[FirstStage]:
    """The stage with other centre distances and shifts for them, nearest first."""
    usual, step = 0.5 * table.module * (table.z_sun + table.z_planet), STEP * table.module
    own = usual if table.center_distance is None else table.center_distance
    places = [usual + k * step for k in range(-round(REACH / STEP), round(REACH / STEP) + 1)]
    for place in sorted(places, key=lambda a: abs(a - own)):
        if room[0] < place < room[1]:
            yield from _shifted(table.model_copy(update={"center_distance": _round(place)}), limits)


def _margins(table: FirstStage, limits: Limits) -> tuple[float, float, Array, tuple[str, ...], Array] | None:
    """Shift of the sun, sum of both, shifts tried (n,), names (k,) and margins (k, n); None out of reach."""
    try:
        stage = first_stage(table)
    except Infeasible:
        return None
    one, two = stage.pair.first, stage.pair.second
    own = float(one.shift)
    given = table.center_distance is not None
    total = float(needed_shift(stage.pair)) if given else own + float(two.shift)
    x = np.append(np.linspace(LOW, HIGH, 1 + round(1e3 * (HIGH - LOW))), own)
    gears: list[Gear] = [replace(one, shift=x), replace(two, shift=total - x)]
    with np.errstate(all="ignore"):
        pair = mesh_at(gears[0], gears[1], stage.arm)
        names, margins = least_margin(outer_conditions(pair, outer_tips(pair), limits), table.module)
    return own, total, x, names, margins


def _conflict(table: FirstStage, limits: Limits) -> str:
    """What excludes what, where the least margin of all conditions is largest."""
    usual = table.model_copy(update={"center_distance": None, "x_planet": None})
    reached = _margins(table, limits)
    table, found = (usual, _margins(usual, limits)) if reached is None else (table, reached)
    if found is None:
        return "the teeth cannot reach each other"
    _, _, _, names, margins = found
    never = [name for name, best in zip(names, margins.max(axis=1), strict=True) if best < 0.0]
    if never:
        return f"{', '.join(never[:3])}: no shifts meet the limit"
    if margins.min(axis=0).max() >= 0.0:
        return f"the crankshafts stand on a circle of {1e3 * first_stage(table).arm:.6g} mm"
    worst = margins.argmin(axis=0)[:-1]
    best = int(margins.min(axis=0)[:-1].argmax())
    around = (best, min(best + 1, len(worst) - 1), max(best - 1, 0))
    bound = dict.fromkeys(names[worst[k]] for k in around)
    return f"{' and '.join(bound)}: no shifts meet the limits of both"


def _round(length: float) -> float:
    return 1e-3 * float(f"{1e3 * length:.7g}")


def _said(table: FirstStage, near: FirstStage) -> str:
    """What is other than in the given table, in the keys of a scene."""
    changes = []
    for name in ("z_planet", "cranks", "center_distance", "x_sun", "x_planet"):
        value = getattr(near, name)
        if value == getattr(table, name):
            continue
        text = f'"{1e3 * value:.7g} mm"' if name == "center_distance" else f"{value + 0.0:.10g}"
        changes.append(f"first_stage.{name} = {text}")
    return f"the nearest that can be built: {', '.join(changes)}"
