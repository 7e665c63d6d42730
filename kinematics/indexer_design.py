"""Choice of a spherical indexer for a task, or the limit that stands against it."""

from __future__ import annotations

import math

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.indexer_limits import Wish, nearest_free, nearest_swing
from trochoid.kinematics.indexer_synthesis import Solution, Task, by_duration, by_pin


def solutions(task: Task, wish: Wish) -> tuple[Solution, ...]:
    """All solutions of the wanted kind and place, those that serve first, by rising C.  Raises Infeasible."""
    if wish.duration is not None:
        found = by_duration(task, wish.duration)
    else:
        assert wish.pin_ratio is not None
        found = by_pin(task, wish.pin_ratio)
    return tuple(x for x in found if wish.kind in (None, x.kind) and wish.place in (None, x.place))


def synthesise(task: Task, wish: Wish) -> Solution:
    """Return the solution that serves with the least C.

    Raises Infeasible with what binds and the nearest swing that has a solution, all else the same.
    """
    found = solutions(task, wish)
    if found and not found[0].fault:
        return found[0]
    if wish.duration is not None:
        _fail_if_any_arm_solves(task, wish.duration)
    raise Infeasible(_refusal(task, wish))


def _fail_if_any_arm_solves(task: Task, duration: float) -> None:
    phi, half = math.pi * duration, 0.5 * task.swing
    whole = abs(math.sin(task.planet * phi)) < 1e-12
    A3 = math.cos(half) * math.cos(phi) - math.cos(task.shaft_angle) * math.sin(half) * math.sin(phi)
    if whole and abs(A3) < 1e-12:
        raise Infeasible(
            f"k = {duration:g} leaves the arm free: cos D = cot φ0 cot ψ0 with a whole i·k, so every ρ has its "
            "arm; give ρ in place of k"
        )


def _refusal(task: Task, wish: Wish) -> str:
    """Say what was asked, what binds, and the nearest swing."""
    asked = (
        f"no indexer without hard shock turns its wheel by {math.degrees(task.swing):g}° with i = {task.planet}, "
        f"shafts at {math.degrees(task.shaft_angle):g}° and {wish}"
    )
    found, free = nearest_swing(task, wish), nearest_free(task, wish)
    instead = f"; with this swing {free} has one" if free else ""
    if found is None:
        what = "k or i" if wish.duration is not None else "ρ or i"
        return f"{asked}; no other swing has one either: change {what}{instead}"
    swing, reason = math.degrees(found[0]), found[1]
    inwards = math.floor if found[0] < task.swing else math.ceil
    return f"{asked}: {reason}; the nearest swing is {inwards(swing * 1e4) / 1e4:.8g}°{instead}"
