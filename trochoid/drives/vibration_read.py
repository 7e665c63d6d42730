"""Numbers read from a casing's vibration: velocities at its points and its natural frequencies."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from trochoid.drives.casing_body import COMPARED
from trochoid.drives.vibration import CasingVibration

MOST = 20  # natural frequencies that are told
Read: TypeAlias = Callable[[CasingVibration], float]


def velocity_at(point: int, axis: int | None = None, other: str = "") -> Read:
    """Read the rms velocity at a point along an axis, mm/s, the largest of the three without one.

    `other`: what it is without, "" for the vibration with all that is in the scene.
    """

    def get(found: CasingVibration) -> float:
        rms = (found.others[other] if other else found.elastic).rms[point]
        return 1e3 * float(rms.max() if axis is None else rms[axis])

    return get


def told_frequencies(found: CasingVibration) -> list[float]:
    """Return the natural frequencies of an elastic casing on its mounts that are told, Hz."""
    return [hertz for hertz in found.elastic.natural_frequencies if hertz <= COMPARED][:MOST]


def frequency(i: int) -> Read:
    """Read natural frequency i, Hz; of fewer, the last."""

    def get(found: CasingVibration) -> float:
        hertz = found.elastic.natural_frequencies
        return float(hertz[min(i, len(hertz) - 1)])

    return get
