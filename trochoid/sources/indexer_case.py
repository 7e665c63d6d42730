"""The mechanisms of sources §5 and what is computed of them."""

from __future__ import annotations

import math

import numpy as np

from trochoid.kinematics.geneva import geneva
from trochoid.kinematics.indexer import Indexer, motion, shock
from trochoid.kinematics.indexer_measure import Similarity, dwell, peaks, similarity
from trochoid.kinematics.indexer_synthesis import Task, by_duration, by_pin, cusped
from trochoid.kinematics.spherical_trochoid import SphericalTrochoid
from trochoid.kinematics.types import Array
from trochoid.kinematics.zeros import zeros_between
from trochoid.sources.row import Finding

DEGREE = math.pi / 180.0
TASK = Task(90.0 * DEGREE, 4)
NO_SOFT_SHOCK = Indexer(
    SphericalTrochoid(47.77587 * DEGREE, 2.77587 * DEGREE, -4.0, math.pi), 90.0 * DEGREE, 90.0 * DEGREE
)


def cusp(swing: float = 90.0, planet: int = 4) -> Indexer:
    """The hypocycloid that indexes from cusp to cusp and serves; swing in degrees, shafts at 90°."""
    (only,) = (x for x in cusped(Task(swing * DEGREE, planet)) if x.kind == "hypo" and not x.fault)
    return only.indexer


def curtate(duration: float) -> Indexer:
    """The near hypotrochoid with k = duration, i = 4, ψ_Σ = 90°."""
    return next(x.indexer for x in by_duration(TASK, duration) if not x.fault and x.kind == "hypo")


def pair(indexer: Indexer) -> tuple[float, float]:
    """B and C."""
    found: Similarity = similarity(indexer)
    return found.velocity, found.acceleration


def at_quarter() -> tuple[float, float]:
    """B and C of the only mechanism with i = 4 and k = 0.25 that serves."""
    (only,) = (x for x in by_duration(TASK, 0.25) if not x.fault)
    return pair(only.indexer)


def duration_for(velocity: float) -> float:
    """k at which B has this value along the near hypotrochoids."""

    def off(k: Array) -> Array:
        return np.array([pair(curtate(float(x)))[0] - velocity for x in k])

    return float(zeros_between(off, np.array([0.28]), np.array([0.30]))[0])


def where_printed_velocity_is() -> tuple[float, float, float, float]:
    """k, ρ, B, C where B is the printed one."""
    k = duration_for(1.71)
    made = curtate(k)
    return k, made.path.pin_ratio, *pair(made)


def nearest_to_printed_pair() -> Finding:
    """How near the family of near hypotrochoids comes to the printed B and C."""
    pairs = np.array([pair(curtate(float(k))) for k in np.linspace(0.251, 0.36, 110)])
    off = float(np.abs(pairs - [1.71, 4.77]).max(axis=1).min())
    return Finding(f"the nearest misses by {off:.3f}", off < 0.005)


def from_120_to_60(name: str) -> float:
    """A peak at a swing of 120° over that at 60°, from cusp to cusp."""
    wide, small = (getattr(peaks(cusp(swing)), name) for swing in (120.0, 60.0))
    return float(wide / small)


def shares() -> Finding:
    """k of the cusps for i = 5 to 2, whose pins stay clear of the wheel while it rests."""
    made = [cusp(planet=i).duration for i in (5, 4, 3, 2)]
    clear = all(dwell(cusp(planet=i)).clearance > -1e-14 for i in (2, 3, 4, 5))
    right = clear and np.allclose(made, [1 / 5, 1 / 4, 1 / 3, 1 / 2], atol=1e-14)
    return Finding(", ".join(f"{k:.3f}" for k in made) + " for i = 5, 4, 3, 2", bool(right))


def share_is_the_ratio() -> Finding:
    """Whether every serving mechanism with i = 4 has k = 1/4."""
    found = [by_pin(TASK, rho)[0] for rho in (0.3, 0.527, 0.8, 1.0)]
    words = [f"{x.indexer.duration:.4f}" for x in found]
    right = all(math.isclose(x.indexer.duration, 0.25) for x in found)
    return Finding("k = " + ", ".join(words) + " for i = 4 and ρ = 0.3, 0.527, 0.8, 1", right)


def always_soft_shock() -> Finding:
    """The start of a mechanism whose acceleration is zero there, against its peak."""
    start = peaks(NO_SOFT_SHOCK).start
    ratio = abs(start) / peaks(NO_SOFT_SHOCK).acceleration
    return Finding(
        "less than 1e-6 of the largest ε at the start" if ratio < 1e-6 else "a soft shock", ratio > 1e-6
    )


def geneva_shares() -> Finding:
    """k of the Geneva wheel at three angles between the shafts."""
    made = [geneva(90.0 * DEGREE, D * DEGREE).duration for D in (60.0, 90.0, 120.0)]
    words = ", ".join(f"{k:.4f}" for k in made)
    return Finding(f"{words} for shafts at 60°, 90°, 120°", all(math.isclose(k, 0.5) for k in made))


def power() -> Finding:
    """Peak power of the Geneva wheel over the cusp's."""
    wheel, pin = similarity(geneva(90.0 * DEGREE)).power, similarity(cusp()).power
    return Finding(f"{wheel / pin:.2f} times less for the cusp", wheel > 1.5 * pin)


def worse_at_half() -> Finding:
    """B and C of two mechanisms with the Geneva wheel's k = 0.5."""
    two, four = pair(cusp(planet=2)), pair(NO_SOFT_SHOCK)
    shown = f"cusp, i = 2: {two[0]:.3f}, {two[1]:.3f}; i = 4, ρ = {NO_SOFT_SHOCK.path.pin_ratio:.3f}: "
    right = max(two[0], four[0]) < 2.0 and max(two[1], four[1]) < 5.53
    return Finding(f"{shown}{four[0]:.3f}, {four[1]:.3f}", right)


def place_of_peak() -> Finding:
    """Where the largest ε is, as a share of the half index."""
    at = [peaks(x).acceleration_at / x.half_turn for x in (geneva(90.0 * DEGREE), cusp())]
    return Finding(f"at {at[1]:.3f} of the half index, Geneva {at[0]:.3f}", at[1] > at[0])


def middle() -> Finding:
    """Acceleration of the cusp in mid-index."""
    start = abs(float(motion(cusp(), 0.0).acceleration))
    return Finding("ε = 0 in the middle, and smooth", start < 1e-12)


def no_hard_shock() -> Finding:
    """The condition on the path against the speed of the wheel at the ends."""
    made = curtate(0.3)
    _, first = made.path.derivatives(made.half_turn * np.array([-1.0, 1.0]), 1)
    slope = np.abs(first[:, 1] / first[:, 2])  # D = 90°: the slot of mid-index lies along z
    right = np.allclose(slope, math.tan(45.0 * DEGREE), rtol=1e-9) and abs(shock(made)) < 1e-12
    return Finding("tan ψ0 at both ends, and ω = 0 there" if right else "another slope", bool(right))


def inner_exception() -> tuple[float, ...]:
    """Shaft angle in degrees at which k = 1/i leaves ρ free, i = 4, ψ_Σ = 120°, if it does."""
    task = Task(120.0 * DEGREE, 4, math.acos(1.0 / math.tan(60.0 * DEGREE)))
    durations = [min(abs(x.indexer.duration - 0.25) for x in by_pin(task, rho)) for rho in (0.3, 0.6, 0.9)]
    return (task.shaft_angle / DEGREE if max(durations) < 1e-12 else math.nan,)


def speed_at(indexer: Indexer, phi: float) -> tuple[float, float]:
    """Transport speed of the pin's place in the slot (R = 1): h ω_1 as printed, h ω_4."""
    h = float(np.sin(indexer.reach(phi)))
    return h, h * float(motion(indexer, phi).velocity)


def acceleration_at(indexer: Indexer, phi: float) -> tuple[float, float]:
    """Tangential transport acceleration: h φ̈ at a constant speed of the drive, h ε_4."""
    return 0.0, float(np.sin(indexer.reach(phi))) * float(motion(indexer, phi).acceleration)


def angle_3(indexer: Indexer, phi: float, radius: float) -> float:
    """ψ in degrees by (3) as printed: `radius` of the sphere, one δ for shaft angle and arm."""
    delta, rho, i = indexer.shaft_angle, indexer.path.pin_ratio, abs(indexer.path.ratio)
    X = radius * math.cos(0.5 * indexer.swing) * math.cos(delta)
    Y = radius * math.sin(0.5 * indexer.swing)
    wave = rho * math.cos(i * phi) * (math.sin(phi) * math.cos(delta) + math.cos(phi))
    top = (i + math.cos(delta)) * math.sin(phi) + wave
    root = math.sqrt(Y**2 - (rho * math.sin(phi)) ** 2)
    return math.atan2(top, X - rho * math.sin(delta) * root / Y) / DEGREE


def angle_4(indexer: Indexer, phi: float, last: str = "cos") -> float:
    """ψ in degrees by (4) as printed, or with another last function."""
    rho, i, Y = indexer.path.pin_ratio, abs(indexer.path.ratio), math.sin(0.5 * indexer.swing)
    wave = math.cos(i * phi) if last == "cos" else math.sin(i * phi)
    top = i * math.sin(phi) + rho * math.cos(phi) * wave
    return math.atan(top / (rho / Y * math.sqrt(Y**2 - (rho * math.sin(phi)) ** 2))) / DEGREE


def numerator(indexer: Indexer) -> tuple[float, float]:
    """i + cos δ with the shaft angle for δ, and i + s cos γ with the arm's."""
    i, s = abs(indexer.path.ratio), math.copysign(1.0, indexer.path.ratio)
    return i + round(math.cos(indexer.shaft_angle), 15), i + s * math.cos(indexer.path.arm)


def angle(indexer: Indexer, phi: float) -> float:
    """Exact ψ in degrees."""
    return float(motion(indexer, phi).angle) / DEGREE


def oblique() -> Indexer:
    """An indexer with shafts at 70°."""
    return by_pin(Task(90.0 * DEGREE, 4, 70.0 * DEGREE), 0.6)[0].indexer
