"""What an index asks of the slot: how far the pin travels in it, whether it finds it, how it pushes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.indexer import Indexer, motion
from trochoid.kinematics.indexer_measure import rest_samples
from trochoid.kinematics.types import Array
from trochoid.kinematics.zeros import zeros_between

SAMPLES = 193


@dataclass(frozen=True, slots=True)
class Slot:
    """Angles (rad) from the wheel's axis to the pin over an index: least, largest, and at its ends.

    Where `farthest` is beyond `entry`, a rim that holds the whole index meets the pin before it starts: the pin is
    then off the middle of the slot by up to `offset` (rad on the sphere), and would turn the wheel by `disturbance`
    (rad) while it should rest.
    """

    nearest: float
    farthest: float
    entry: float
    nearest_at: float
    farthest_at: float
    offset: float
    disturbance: float


def slot(indexer: Indexer) -> Slot:
    """Travel of the pin in its slot, extremes refined to rounding."""
    t = np.linspace(0.0, indexer.half_turn, SAMPLES)
    turning = zeros_between(lambda x: _rising(indexer, x), t[:-1], t[1:], 1e-14)
    tries = np.concatenate((t[[0, -1]], turning))
    reach = indexer.reach(tries)
    low, high = int(reach.argmin()), int(reach.argmax())
    entry = float(reach[1])
    farthest = float(reach[high]) if reach[high] > entry + 1e-12 else entry
    offset, disturbance = _missed(indexer, farthest) if farthest > entry else (0.0, 0.0)
    return Slot(
        float(reach[low]),
        farthest,
        entry,
        float(tries[low]),
        float(tries[high]) if farthest > entry else indexer.half_turn,
        offset,
        disturbance,
    )


def pressure_angle(indexer: Indexer, t: npt.ArrayLike) -> Array:
    """Angle (rad) between the pin's path and the normal of its slot, along which it pushes, 0 to π/2."""
    normal = slot_normal(indexer, t)
    across = np.sum(indexer.path.tangent(t) * normal, axis=-1)
    along = np.linalg.norm(np.cross(indexer.path.tangent(t), normal), axis=-1)
    angle: Array = np.arctan2(along, np.abs(across))
    return angle


def slot_normal(indexer: Indexer, t: npt.ArrayLike) -> Array:
    """Unit normal (..., 3) of the slot at the pin, in the sense of growing ψ."""
    across = np.cross(indexer.path.point(t), indexer.axis)  # ψ grows about −o
    normal: Array = across / np.linalg.norm(across, axis=-1, keepdims=True)
    return normal


def _rising(indexer: Indexer, t: Array) -> Array:
    rising: Array = -(indexer.path.derivatives(t, 1)[1] @ indexer.axis)
    return rising


def _missed(indexer: Indexer, rim: float) -> tuple[float, float]:
    """How far the pin is off the middle of the resting slot while it is within the rim: rad on the sphere, of ψ."""
    t = np.linspace(indexer.half_turn, math.pi, 8 * rest_samples(indexer.path.ratio))
    t = np.concatenate((t, zeros_between(lambda x: indexer.reach(x) - rim, t[:-1], t[1:], 1e-14)))
    at, end = motion(indexer, t).angle, motion(indexer, indexer.half_turn).angle
    reach = indexer.reach(t)
    off = np.where(reach < rim + 1e-12, np.abs(np.angle(np.exp(1j * (at - end)))), 0.0)
    aside = np.arctan2(np.sin(reach) * np.sin(off), np.hypot(np.cos(reach), np.sin(reach) * np.cos(off)))
    return float(np.where(off > 0.0, aside, 0.0).max()), float(off.max())
