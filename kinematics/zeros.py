"""Zeros of a smooth function of one variable, many at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from trochoid.kinematics.types import Array


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
