"""Lines of the transmission error: everything but the rollers repeats after a turn of the crankshafts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.rv.design import Design
from trochoid.dynamics.spectrum import close_turn, harmonics
from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    from trochoid.drives.rv.series import Series


def twist_lines(series: Series) -> Array:
    """Return amplitudes (m,), rad, of the ring's twist at 0, 1, 2 … periods in a turn of the crankshafts.

    The series has both ends of the turn; what rollers keep from repeating is taken out as a ramp.
    """
    closed, _ = close_turn(series.twist)
    return np.asarray(np.abs(harmonics(closed)))


def force_lines(force: Array) -> Array:
    """Return amplitudes (lines,), N, of the largest of m force vectors (n, m, 2) at 0, 1, 2 … periods in a turn.

    The end of a vector runs round an ellipse in each line; its larger half axis counts.
    """
    lines = harmonics(force)
    squares = (np.abs(lines) ** 2).sum(axis=-1) + np.abs((lines**2).sum(axis=-1))
    size = np.sqrt(0.5 * squares)
    size[0] = np.linalg.norm(lines[0], axis=-1)
    return np.asarray(size.max(axis=-1))


def order_of(design: Design) -> float:
    """Return how often a crankshaft turns, seen from the carrier, in a turn of the input."""
    return abs(design.turning)
