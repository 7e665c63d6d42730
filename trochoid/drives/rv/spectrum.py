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


def order_of(design: Design) -> float:
    """Return how often a crankshaft turns, seen from the carrier, in a turn of the input."""
    return abs(design.turning)
