"""Zeros of a smooth function of one variable, many at once."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from trochoid.kinematics.types import Array, BoolArray, IntArray

PER_WAVE = 24  # samples on the shortest wave of a trigonometric polynomial
FINER, LEVELS = 6, 7  # cells about what may be a zero are parted in six, six times over
SETTLED = 4  # level from which a parabola tells which minima of |f| stay clear of zero


def zeros_between(function: Callable[[Array], Array], a: Array, b: Array, tolerance: float = 1e-15) -> Array:
    """One zero in each of the intervals a (n,) to b (n,) at whose ends the signs differ, shape (≤ n,).

    Regula falsi, Illinois' way: the end that stays counts half.
    """
    fa, fb = function(a), function(b)
    change = np.flatnonzero(np.signbit(fa) != np.signbit(fb))
    a, b, fa, fb = a[change], b[change], fa[change], fb[change]
    for _ in range(80 if change.size else 0):
        flat = fb == fa
        c = np.where(flat, b, b - fb * (b - a) / np.where(flat, 1.0, fb - fa))
        fc = function(c)
        crossed = np.signbit(fc) != np.signbit(fb)
        a, fa = np.where(crossed, b, a), np.where(crossed, fb, 0.5 * fa)
        done = (np.abs(c - b) <= tolerance * (1.0 + np.abs(c))) | (fc == 0.0)
        b, fb = c, fc
        if done.all():
            break
    return b


def zeros_around(function: Callable[[Array], Array], degree: int) -> Array:
    """Zeros in (−π, π] of a trigonometric polynomial (period 2π), rising, shape (n,).

    Cells about changes of sign and about minima of |f| are parted again and again, so that zeros as near to each
    other as 1e-5 of the shortest wave are told apart; double ones count only if rounding parts them.
    """
    count = PER_WAVE * degree
    node, step, first = np.arange(-3, count + 4), 2.0 * math.pi / count, 0.6 * math.pi / count - math.pi
    for level in range(LEVELS):
        x = np.asarray(first + step * node, dtype=np.float64)
        value = function(x)
        joined = np.diff(node) == 1
        change = np.flatnonzero(joined & (np.signbit(value[1:]) != np.signbit(value[:-1])))
        low = _minima(value, joined, level >= SETTLED)
        hot = np.concatenate((node[change], node[low]))
        cells = np.unique(hot[:, None] + np.arange(-2, 2))
        node, step = np.unique(FINER * cells[:, None] + np.arange(FINER + 1)), step / FINER
    found = zeros_between(function, x[change], x[change + 1])
    found = np.sort(np.angle(np.exp(1j * found)))  # the ends of the turn were sampled twice
    return found[np.diff(found, prepend=-math.inf) > 1e-13]


def _minima(value: Array, joined: BoolArray, settled: bool) -> IntArray:
    """Indices of the samples with the least |f| about them; once `settled`, of those that may come to zero."""
    size = np.abs(value)
    least = (size[1:-1] <= size[:-2]) & (size[1:-1] <= size[2:])
    low = np.flatnonzero(joined[1:] & joined[:-1] & least) + 1
    if not settled:
        return low
    before, here, after = value[low - 1], value[low], value[low + 1]
    bend = before - 2.0 * here + after
    summit = here - (after - before) ** 2 / (8.0 * np.where(bend == 0.0, 1.0, bend))
    alike = (np.sign(before) == np.sign(here)) & (np.sign(after) == np.sign(here))
    reaching: IntArray = low[~(alike & (summit * np.sign(here) > 0.8 * np.abs(here)))]
    return reaching
