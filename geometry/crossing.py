"""Find where polygons cross themselves or each other, before gmsh runs into it and never returns."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, BoolArray, IntArray


def fail_if_crossing(loops: Sequence[Array]) -> None:
    """Raise TrochoidError with the place where closed polygons (n, 2) cross or two corners coincide."""
    corners = np.concatenate(loops)
    _, count = np.unique(corners, axis=0, return_counts=True)
    if count.max() > 1:
        raise TrochoidError("two facet ends of the outline coincide; remove one, or move the loops apart")
    start, end = corners, np.concatenate([np.roll(loop, -1, axis=0) for loop in loops])
    crossed = _crossed(start, end)
    if crossed.size:
        place = 0.5 * (start[crossed[0]] + end[crossed[0]])
        raise TrochoidError(
            f"facets of the outline cross near {place} m; move the loops apart or refine them"
        )


def _crossed(start: Array, end: Array) -> IntArray:
    """Numbers of segments that cross another one in their interiors, by a sweep over their left ends."""
    left, right = np.minimum(start[:, 0], end[:, 0]), np.maximum(start[:, 0], end[:, 0])
    order = np.argsort(left, kind="stable")
    start, end, left, right = start[order], end[order], left[order], right[order]
    hits: list[IntArray] = []
    for shift in range(1, len(start)):
        index = np.flatnonzero(left[shift:] <= right[:-shift])
        crossing = _cross(start[index], end[index], start[index + shift], end[index + shift])
        hits.append(order[index[crossing]])
        if index.size == 0:  # then none overlap at a larger shift either
            break
    return np.concatenate(hits)


def _cross(a: Array, b: Array, c: Array, d: Array) -> BoolArray:
    """Say which segments a–b and c–d cross in their interiors."""
    apart: BoolArray = _side(a, b, c) * _side(a, b, d) < 0.0
    across: BoolArray = _side(c, d, a) * _side(c, d, b) < 0.0
    return apart & across


def _side(a: Array, b: Array, p: Array) -> Array:
    side: Array = (b - a)[:, 0] * (p - a)[:, 1] - (b - a)[:, 1] * (p - a)[:, 0]
    return np.sign(side)
