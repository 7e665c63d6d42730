"""Forces as arrows: filled outlines, as long as the force is large, and what the pointer reads at them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from trochoid.kinematics.types import Array
from trochoid.results.outcome import Arrow, DrawingFrame
from trochoid.results.text import number

_SHAFT, _HEAD = 0.0022, 0.0065  # half widths as shares of the drawing
_LONG = 2.6  # length of a head over its half width


def magnitude(arrow: Arrow) -> float:
    """Return the force in N."""
    return float(np.hypot(arrow.vector[0], arrow.vector[1]))


def outlines(arrows: Sequence[Arrow], scale: float, width: float) -> Array:
    """Return the outlines (n,2), with gaps, of arrows of length `scale`·force in a drawing `width` wide."""
    return np.vstack([_outline(arrow, scale, width) for arrow in arrows] or [np.empty((0, 2))])


def reading(arrow: Arrow) -> str:
    """Return "disc 1 · pin 3 · 405.5 N"."""
    return " · ".join(filter(None, (arrow.group, arrow.label, f"{number(round(magnitude(arrow), 1))} N")))


def summary(frame: DrawingFrame) -> str:
    """Return how many forces act on each group and which is the largest."""
    groups: dict[str, list[Arrow]] = {}
    for arrow in frame.arrows:
        if magnitude(arrow) > 0.0:
            groups.setdefault(arrow.group or "drive", []).append(arrow)
    parts = []
    for group, acting in groups.items():
        top = max(acting, key=magnitude)
        where = f" ({top.label})" if top.label else ""
        many = f"{len(acting)} forces, largest" if len(acting) > 1 else "1 force,"
        parts.append(f"{group}: {many} {number(magnitude(top), 4)} N{where}")
    return "; ".join(parts) or "nothing touches"


def _outline(arrow: Arrow, scale: float, width: float) -> Array:
    length = scale * magnitude(arrow)
    along = np.asarray(arrow.vector) / magnitude(arrow)
    across = np.array([-along[1], along[0]])
    full = _LONG * _HEAD * width
    head = min(full, 0.6 * length)
    half, wide, neck = _SHAFT * width * head / full, head / _LONG, length - head
    upper = [(0.0, half), (neck, half), (neck, wide), (length, 0.0)]
    path = [*upper, *((a, -b) for a, b in reversed(upper)), upper[0]]
    return np.vstack([*(arrow.origin + a * along + b * across for a, b in path), [np.nan, np.nan]])
