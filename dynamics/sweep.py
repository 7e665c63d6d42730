"""Steady motions over the speed: swept up or down, or followed round the folds where they jump."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from trochoid.dynamics.continuation import crossings, curve
from trochoid.dynamics.harmonic_balance import Balance, Periodic, balance, steady
from trochoid.dynamics.local_law import Local
from trochoid.dynamics.system import System
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, ComplexArray, frozen

Loads = Callable[[float], ComplexArray]
"""Speed (rad/s) → loads (H + 1, n)."""


def sweep(
    system: System, locals_: Sequence[Local], loads: Loads, speeds: Iterable[float]
) -> tuple[Periodic, ...]:
    """Return the motions at `speeds` in their order, each started from the one before: a slow run up, or down.

    Where the branch ends in a fold, the motion jumps to where the curve comes by again.  Raises NotConverged.
    """
    found: list[Periodic] = []
    for speed in speeds:
        motion = None
        if not found:
            motion = steady(system, locals_, loads(speed), speed)
        else:
            with suppress(NotConverged):
                motion = steady(system, locals_, loads(speed), speed, found[-1].unknowns)
        if motion is None or (found and motion.side != found[-1].side):
            motion = _beyond_the_fold(system, locals_, loads, found[-1], speed)
        found.append(motion)
    return tuple(found)


def _beyond_the_fold(
    system: System, locals_: Sequence[Local], loads: Loads, last: Periodic, speed: float
) -> Periodic:
    """Follow the curve from the last motion until it comes to `speed` on the same side of the folds."""
    made = _at(system, locals_, loads)
    with suppress(NotConverged):
        for start in crossings(made, last.unknowns, last.speed, speed, 0.01):
            motion = steady(system, locals_, loads(speed), speed, start)
            if motion.side == last.side:
                return motion
    raise NotConverged(
        f"beyond {last.speed:.6g} rad/s the curve of steady motions ends or is lost: none found at {speed:.6g} rad/s"
    )


def _at(system: System, locals_: Sequence[Local], loads: Loads) -> Callable[[float], Balance]:
    """Return speed → the equations there."""
    return lambda speed: balance(system, locals_, loads(speed), speed)


@dataclass(frozen=True, eq=False, slots=True)
class Branch:
    """A curve of steady motions: `speed` (p,), `swing` (p, m), the peak to peak of each local deflection, and the
    speeds at its `folds`, where a motion that is swept past them jumps.
    """

    speed: Array
    swing: Array
    folds: tuple[float, ...]


def follow(
    system: System, locals_: Sequence[Local], loads: Loads, span: tuple[float, float], step: float = 0.02
) -> Branch:
    """Follow the curve of steady motions from one end of `span` (rad/s) to the other, round its folds.

    `step` is the length between points, in shares of the larger speed and of the first deflection.  Raises NotConverged
    where the curve is lost.
    """
    first, last = span
    begin = steady(system, locals_, loads(first), first)
    waves = balance(system, locals_, loads(first), first).waves
    speeds, swings = [], []
    for speed, unknowns in curve(_at(system, locals_, loads), begin.unknowns, first, last, step):
        speeds.append(speed)
        swings.append(np.ptp(waves @ unknowns, axis=0))
        if (last - speed) * (last - first) <= 0.0:
            break
    speed_of = np.array(speeds)
    folds = tuple(
        _vertex(speed_of[i : i + 3]) for i, (a, b) in enumerate(pairwise(np.diff(speed_of))) if a * b < 0.0
    )
    return Branch(frozen(speed_of), frozen(np.array(swings)), folds)


def _vertex(three: Array) -> float:
    """Return the extremum of the parabola through three values at equal distances."""
    a, b, c = three
    bend = a - 2 * b + c
    return float(b - (c - a) ** 2 / (8 * bend)) if bend else float(b)
