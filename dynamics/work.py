"""Energy balance of a steady motion: what loads give over a period, damping takes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from trochoid.kinematics.types import Array


def unmet(velocity: Array, loads: Sequence[Array], loss: float) -> float:
    """Return by how much the mean power of `loads` (n, k) each, at velocities (n, k), is not the `loss` (W), relative.

    Beside the mean sizes of all powers: they swing to and fro much more than damping takes.
    """
    powers = [(velocity * load).sum(axis=1) for load in loads]
    gross = sum(float(np.abs(power).mean()) for power in powers) + abs(loss)
    left = sum(float(power.mean()) for power in powers) - loss
    return abs(left) / gross if gross > 0.0 else 0.0
