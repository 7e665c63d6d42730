"""Choice of a spherical indexer for a task, or the limit that stands against it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from itertools import islice

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.indexer_limits import Wish, nearest_swing, serving_free, serving_swings
from trochoid.kinematics.indexer_synthesis import Solution, Task, by_duration, by_pin

Accepts = Callable[[Task, Solution], bool]

BESIDE = 1e-9  # rad
TRIED = 40  # swings, and k or ρ, that are tried for one that is accepted


def solutions(task: Task, wish: Wish) -> tuple[Solution, ...]:
    """All solutions of the wanted kind and place, those that serve first, by rising C.  Raises Infeasible."""
    if wish.duration is not None:
        found = by_duration(task, wish.duration)
    else:
        assert wish.pin_ratio is not None
        found = by_pin(task, wish.pin_ratio)
    return tuple(x for x in found if wish.kind in (None, x.kind) and wish.place in (None, x.place))


def synthesise(task: Task, wish: Wish, accepts: Accepts | None = None) -> Solution:
    """Return the solution that serves with the least C.

    Raises Infeasible with what binds and the nearest swing, and the nearest k or ρ, that has a solution, all else the
    same; of these only what `accepts`, as of pins and wheels that must have room.
    """
    found = solutions(task, wish)
    if found and not found[0].fault:
        return found[0]
    if wish.duration is not None:
        _fail_if_any_arm_solves(task, wish.duration)
    raise Infeasible(_refusal(task, wish, accepts))


def _fail_if_any_arm_solves(task: Task, duration: float) -> None:
    phi, half = math.pi * duration, 0.5 * task.swing
    whole = abs(math.sin(task.planet * phi)) < 1e-12
    A3 = math.cos(half) * math.cos(phi) - math.cos(task.shaft_angle) * math.sin(half) * math.sin(phi)
    if whole and abs(A3) < 1e-12:
        raise Infeasible(
            f"k = {duration:g} leaves the arm free: cos D = cot φ0 cot ψ0 with a whole i·k, so every ρ has its "
            "arm; give ρ in place of k"
        )


def _refusal(task: Task, wish: Wish, accepts: Accepts | None) -> str:
    """Say what was asked, what binds, and the nearest swing, k or ρ."""
    asked = (
        f"no indexer without hard shock turns its wheel by {math.degrees(task.swing):g}° with i = {task.planet}, "
        f"shafts at {math.degrees(task.shaft_angle):g}° and {wish}"
    )
    free = _first(((task, other) for other in serving_free(task, wish)), accepts)
    instead = f"; with this swing {free[1].free} has one" if free else ""
    limit = nearest_swing(task, wish)
    if limit is None:
        what = "k or i" if wish.duration is not None else "ρ or i"
        return f"{asked}; no other swing has one either: change {what}{instead}"
    nearest = _inwards(limit[0], task.swing)
    near = _first(
        ((replace(task, swing=math.radians(x)), wish) for x in _swings(nearest, task, wish)), accepts
    )
    if near is None:
        return f"{asked}: {limit[1]}; no swing near has one that leaves room for pin and wheel{instead}"
    swing = math.degrees(near[0].swing)
    what = "the nearest swing" if abs(swing - nearest) < 1e-9 else "a near swing with room for pin and wheel"
    return f"{asked}: {limit[1]}; {what} is {swing:.8g}°{instead}"


def _swings(nearest: float, task: Task, wish: Wish) -> Iterator[float]:
    """Swings (°) to advise, the limit first."""
    yield nearest
    yield from (_inwards(x, task.swing) for x in serving_swings(task, wish))


def _inwards(swing: float, asked: float) -> float:
    """Round a swing (rad) to 1e-4°, away from the one that was asked for."""
    inwards = math.floor if swing < asked else math.ceil
    return inwards(math.degrees(swing) * 1e4 + (1e-7 if swing < asked else -1e-7)) / 1e4


def _first(choices: Iterable[tuple[Task, Wish]], accepts: Accepts | None) -> tuple[Task, Wish] | None:
    """Return the first choice, as rounded, whose best solution serves and is accepted; None without any.

    It must serve a trifle beside too: what serves at one swing by rounding alone is none.
    """
    for task, wish in islice(choices, TRIED):
        best = _best(task, wish)
        if best is None or any(_best(*each) is None for each in _beside(task, wish)):
            continue
        if accepts is None or accepts(task, best):
            return task, wish
    return None


def _best(task: Task, wish: Wish) -> Solution | None:
    found = solutions(task, wish)
    return found[0] if found and not found[0].fault else None


def _beside(task: Task, wish: Wish) -> Iterator[tuple[Task, Wish]]:
    for step in (-BESIDE, BESIDE):
        yield replace(task, swing=task.swing + step), wish
        yield replace(task, swing=math.nextafter(task.swing, math.copysign(4.0, step))), wish
        if wish.duration is not None:
            yield task, replace(wish, duration=wish.duration + step)
        if wish.pin_ratio is not None:
            yield task, replace(wish, pin_ratio=wish.pin_ratio * (1.0 + step))
