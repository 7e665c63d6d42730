"""Fixed points x = f(x) of a few numbers where each f costs a solution of all contacts (Anderson's mixing)."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from trochoid.kinematics.types import Array

MEANT = 0.3  # coefficient of friction up to which a solution is promised
MEMORY = 6  # earlier steps that are mixed
ROUNDS = 40


def fixed_points(
    value: Callable[[Array], tuple[Array, Array]], start: Array, settled: float
) -> tuple[Array, Array]:
    """Return x (n, k) of n problems side by side, and what is left of each (n,): max |f(x) − x| over the scale.

    `value` gives f and the scale of its numbers, both (n, k), at x. It stops when at most `settled` is left of all,
    or after `ROUNDS`: what is left then says so.
    """
    x, places, steps = start, [], []  # type: Array, list[Array], list[Array]
    left = np.full(len(start), np.inf)
    for _ in range(ROUNDS):
        found, scale = value(x)
        size = np.where(scale > 0, scale, 1.0)
        step = found - x
        left = np.abs(step / size).max(axis=1, initial=0.0)
        if (left <= settled).all():
            break
        places, steps = [*places[-MEMORY:], x], [*steps[-MEMORY:], step]
        x = x.copy()
        for row in np.flatnonzero(left > settled):
            x[row] = _mixed([p[row] for p in places], [s[row] for s in steps], size[row])
    return x, left


def unsettled(angle: float, left: float, coefficients: Mapping[str, float]) -> str:
    """Return why a running drive has no solution at an input angle (rad), when so much is left of its forces."""
    given = ", ".join(f"{name} = {value:g}" for name, value in coefficients.items())
    return (
        f"running with friction, at input angle {np.degrees(angle):.6g}°: friction and contact forces do not settle "
        f"({left:.1e} of them is left) with {given}; the drive may lock (take coefficients up to {MEANT:g}), or be "
        "loaded so little that forces drown in rounding (give a larger torque)"
    )


def _mixed(places: list[Array], steps: list[Array], size: Array) -> Array:
    """Return the next place: where a linear map through the last steps has its fixed point, as nearly as they know."""
    here, step = places[-1], steps[-1]
    if len(places) == 1:
        return here + step
    moved = np.stack([here - p for p in places[:-1]], axis=1)
    changed = np.stack([step - s for s in steps[:-1]], axis=1)
    share, *_ = np.linalg.lstsq(changed / size[:, None], step / size, rcond=1e-8)
    return np.asarray(here + step - (moved + changed) @ share)
