"""What an indexer is judged by: peaks of its motion, the soft shock, and the rest of the wheel.

A soft shock is the acceleration with which an index starts: it jumps there, where a hard shock jumps in speed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.indexer import Indexer, WheelMotion, motion
from trochoid.kinematics.types import Array
from trochoid.kinematics.zeros import zeros_between

SAMPLES = 97  # per half index; what lies between is refined
NARROW = 49  # more of them, ever closer to the middle, where a pin near the wheel's axis makes a narrow peak


@dataclass(frozen=True, slots=True)
class Peaks:
    """Largest values over one index at unit drive speed, and the drive angles (rad, from the middle) where they are.

    `start` is ε at the start of the index, positive in the sense of the motion: the soft shock.
    """

    velocity: float
    acceleration: float
    power: float
    start: float
    velocity_at: float
    acceleration_at: float
    power_at: float


@dataclass(frozen=True, slots=True)
class Similarity:
    """Peaks freed of time T and swing ψ_Σ: B = max|ω|T/ψ_Σ, C = max|ε|T²/ψ_Σ, and likewise N and the soft shock."""

    velocity: float
    acceleration: float
    power: float
    start: float


@dataclass(frozen=True, slots=True)
class Dwell:
    """Rest of the wheel in one turn of the drive: `angle` (rad of the drive), its `share`, `motion` left (rad).

    `clearance` (rad) is how far the pin stays outside the wheel's rim, at least; negative: it hits the wheel.
    """

    angle: float
    share: float
    motion: float
    clearance: float


def peaks(indexer: Indexer) -> Peaks:
    """Largest |ω|, |ε| and |N| of an index, refined to rounding, and the soft shock.

    Extremes are the zeros of ε, of the jerk and of N' = ε² + ω ψ''', and the ends.
    """
    close = np.geomspace(1e-7, 0.5 / SAMPLES, NARROW)
    t = indexer.half_turn * np.concatenate(([0.0], close, np.linspace(0.0, 1.0, SAMPLES)[1:]))
    at = motion(indexer, t)
    w_at = _largest(indexer, t, at, lambda m: m.velocity, lambda m: m.acceleration)
    e_at = _largest(indexer, t, at, lambda m: m.acceleration, lambda m: m.jerk)
    n_at = _largest(indexer, t, at, lambda m: m.power, lambda m: m.acceleration**2 + m.velocity * m.jerk)
    top = motion(indexer, np.array([w_at, e_at, n_at]))
    return Peaks(
        velocity=abs(float(top.velocity[0])),
        acceleration=abs(float(top.acceleration[1])),
        power=abs(float(top.power[2])),
        start=-float(at.acceleration[-1]) * indexer.sense,  # ε is odd about the middle
        velocity_at=w_at,
        acceleration_at=e_at,
        power_at=n_at,
    )


def similarity(indexer: Indexer, found: Peaks | None = None) -> Similarity:
    """B, C and their like for power and soft shock, sources §5; T = 2φ0."""
    top = found or peaks(indexer)
    T, swing = 2.0 * indexer.half_turn, indexer.swing
    return Similarity(
        top.velocity * T / swing,
        top.acceleration * T**2 / swing,
        top.power * T**3 / swing**2,
        top.start * T**2 / swing,
    )


def dwell(indexer: Indexer, angle: float | None = None) -> Dwell:
    """Rest of the wheel about φ = π.

    Over 2π − 2φ0, if `angle` (rad) is not given, the wheel is locked; a longer dwell holds some `motion`, rad.
    """
    locked = 2.0 * (math.pi - indexer.half_turn)
    held = locked if angle is None else angle
    if not 0.0 < held < 2.0 * math.pi:
        raise Infeasible(
            f"a dwell of {math.degrees(held):g}° of the drive; take more than 0°, less than 360°"
        )
    t = math.pi - 0.5 * held
    left = (
        abs(float(np.diff(motion(indexer, np.array([t, indexer.half_turn])).angle)[0]))
        if held > locked
        else 0.0
    )
    rest = np.linspace(indexer.half_turn, math.pi, rest_samples(indexer.path.ratio))
    height = np.cos(indexer.reach(rest))
    clearance = math.acos(min(1.0, float(highest(height)))) - math.acos(height[0])
    return Dwell(held, held / (2.0 * math.pi), left, clearance)


def rest_samples(ratio: float) -> int:
    """Return how many positions of the pin over half a dwell show how near it comes, with `highest`."""
    return 32 * (4 + math.ceil(abs(ratio)))


def highest(samples: Array) -> Array:
    """Largest value (...) of a smooth function sampled evenly along the last axis, by parabolas about maxima."""
    before, here, after = samples[..., :-2], samples[..., 1:-1], samples[..., 2:]
    bend = before - 2.0 * here + after
    top = (here > before) & (here >= after)
    summit = np.where(
        top, here - (after - before) ** 2 / (8.0 * np.where(top & (bend != 0.0), bend, -1.0)), -math.inf
    )
    value: Array = np.maximum(samples.max(axis=-1), summit.max(axis=-1))
    return value


def dwell_within(indexer: Indexer, tolerance: float) -> float:
    """Drive angle (rad) about φ = π over which the wheel moves by no more than `tolerance` (rad) from its rest.

    Holds for indexers whose wheel turns one way.  Raises Infeasible where the tolerance is no part of the swing.
    """
    half = 0.5 * indexer.swing
    if not 0.0 <= tolerance < half:
        raise Infeasible(
            f"a tolerance of {math.degrees(tolerance):g}° on a swing of {math.degrees(2 * half):g}°; "
            "take at least 0° and less than half the swing"
        )
    if tolerance == 0.0:
        return 2.0 * (math.pi - indexer.half_turn)
    start, end = np.zeros(1), np.array([indexer.half_turn])
    edge = zeros_between(lambda x: np.abs(motion(indexer, x).angle) - (half - tolerance), start, end)
    return 2.0 * (math.pi - float(edge[0]))


def _largest(
    indexer: Indexer,
    t: Array,
    at: WheelMotion,
    value: Callable[[WheelMotion], Array],
    slope: Callable[[WheelMotion], Array],
) -> float:
    sign = np.signbit(slope(at))
    change = np.flatnonzero(sign[1:] != sign[:-1])
    inner = zeros_between(lambda x: slope(motion(indexer, x)), t[change], t[change + 1], 1e-9)
    tries = np.concatenate((t[[0, -1]], inner))
    return float(tries[np.abs(value(motion(indexer, tries))).argmax()])
