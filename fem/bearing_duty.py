"""What a rolling bearing does under the loads of a turn: mean stiffness, load distribution, static safety and life.

The loads go by one after the other and the elements stand anywhere: the stiffness is the mean of the exact Jacobians
over all loads and over places of the elements within a pitch; lives add up by Palmgren's and Miner's rule.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from trochoid.fem.bearing_life import life_modification, reference_life
from trochoid.fem.bearing_rating import (
    PERMISSIBLE,
    Row,
    basic_life,
    dynamic_load,
    dynamic_rating,
    exponent,
    pressures,
    static_load,
    static_rating,
)
from trochoid.fem.rolling import Rolling, RollingState
from trochoid.fem.rolling_ball import BallBearing
from trochoid.fem.rolling_centrifugal import SpinningBallBearing
from trochoid.fem.rolling_equilibrium import solve
from trochoid.fem.rolling_roller import RollerRow
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, frozen

PLACES = 4  # of the elements within a pitch
LOOSE = 1e-9  # of the largest stiffness: less holds nothing
ROLLER_PERMISSIBLE = 4.0e9  # Pa, ISO 76: roller bearings


@dataclass(frozen=True, slots=True)
class Duty:
    """A bearing under loads (m, 5) in N and N·m: `stiffness` (m, 5, 5), mean over places of the elements.

    It is in N/m, N, N·m/rad; `states`: under all loads, one for each place.
    """

    row: Row
    loads: Array
    stiffness: Array
    states: tuple[RollingState, ...]

    @property
    def mean(self) -> Array:
        """Mean stiffness (5, 5) over all loads."""
        return np.asarray(self.stiffness.mean(axis=0))

    @property
    def along(self) -> Array:
        """Stiffness (m,) along each radial load, along x without one, N/m."""
        push = self.loads[:, :2]
        size = np.linalg.norm(push, axis=1, keepdims=True)
        way = np.where(size > 0.0, push / np.where(size > 0.0, size, 1.0), [1.0, 0.0])
        return np.asarray(np.einsum("mi,mij,mj->m", way, self.stiffness[:, :2, :2], way))

    @property
    def element_load(self) -> float:
        """Largest normal force of an element, N."""
        return max(float(state.outer_loads.max()) for state in self.states)

    @property
    def carrying(self) -> tuple[int, int]:
        """Least and largest number of elements that carry."""
        found = np.array([state.touching for state in self.states])
        return int(found.min()), int(found.max())

    @property
    def pressure(self) -> float:
        """Largest Hertz pressure on a raceway, Pa."""
        return max(float(p.max()) for state in self.states for p in pressures(self.row, state))


@dataclass(frozen=True, slots=True)
class Endurance:
    """How long a bearing lasts and how far it is from sinking in.

    `static`: S_0 = C_0r/P_0r under the worst load (ISO 76), `permissible`: the most loaded element's permissible load
    over its own, by the pressure of ISO 76. `basic`: L_10 by the equivalent loads (ISO 281), `reference`: L_10r by the
    elements' own (ISO/TS 16281), `modified`: L_10mr with a_ISO where lubrication is given, all in revolutions, infinite
    where nothing is loaded. `equivalent`: the load P_ref that belongs to `reference`, N; `rating` C_r and
    `static_rating` C_0r, N. `static` and `basic` are None where the standards have no numbers for such a load.
    """

    rating: float
    static_rating: float
    static: float | None
    permissible: float
    basic: float | None
    reference: float
    equivalent: float
    modified: float | None


@dataclass(frozen=True, slots=True)
class Lubrication:
    """What a_ISO follows from: viscosity ratio κ, fatigue load limit C_u in N, contamination factor e_C."""

    viscosity_ratio: float
    fatigue_load: float
    contamination: float


def duty(bearing: Rolling, loads: Array, held: Mapping[str, float], places: int = PLACES) -> Duty:
    """Return the bearing under loads (m, 5), its motions `held` as in `rolling_equilibrium.solve`, which raises."""
    loads = np.atleast_2d(np.asarray(loads, dtype=np.float64))
    row = row_of(bearing)
    pitch = 2.0 * np.pi / elements(row)
    states = tuple(solve(bearing, loads, held, pitch * k / places) for k in range(places))
    stiffness = np.mean([state.stiffness for state in states], axis=0)
    return Duty(row, frozen(loads), frozen(stiffness), states)


def row_of(bearing: Rolling) -> Row:
    """Return the row of elements of a bearing that may spin."""
    row = bearing.bearing if isinstance(bearing, SpinningBallBearing) else bearing
    if not isinstance(row, BallBearing | RollerRow):
        raise TypeError(f"no row of balls or rollers: {type(bearing).__name__}")
    return row


def elements(row: Row) -> int:
    """Return the number of elements."""
    return row.balls if isinstance(row, BallBearing) else row.rollers


def endurance(
    found: Duty,
    rating: float | None = None,
    inner_turns: bool = True,
    lubrication: Lubrication | None = None,
) -> Endurance:
    """Return safety and life under all loads, each for the same share of the revolutions.

    `rating`: C_r in N if not that of ISO 281; `inner_turns`: the inner ring turns against the load.
    """
    row, capacity = found.row, rating or dynamic_rating(found.row)
    each = [reference_life(row, state, capacity, inner_turns).revolutions for state in found.states]
    with np.errstate(divide="ignore"):
        reference = float(1.0 / np.mean(1.0 / np.array(each)))
    equivalent = capacity / (reference / 1e6) ** (1.0 / exponent(row)) if np.isfinite(reference) else 0.0
    radial, axial = np.linalg.norm(found.loads[:, :2], axis=1), np.abs(found.loads[:, 2])
    modified = None
    if lubrication is not None and equivalent > 0.0:
        share = lubrication.contamination * lubrication.fatigue_load / equivalent
        modified = life_modification(row, lubrication.viscosity_ratio, share) * reference
    return Endurance(
        capacity,
        static_rating(row),
        _static(row, radial, axial),
        _permissible(found),
        _basic(row, radial, axial, capacity),
        reference,
        equivalent,
        modified,
    )


def fail_if_loose(name: str, matrix: Array, unit: Array, advice: str) -> None:
    """Raise Infeasible where a stiffness (k, k) resists nothing in some direction; `unit` (k,) m of each motion."""
    values = np.linalg.eigvalsh(matrix / np.outer(unit, unit))
    if values[0] <= LOOSE * max(values[-1], 1e-300):
        raise Infeasible(f"{name} resists nothing in one of its directions: too few elements carry; {advice}")


def _static(row: Row, radial: Array, axial: Array) -> float | None:
    try:
        load = max(static_load(row, float(r), float(a)) for r, a in zip(radial, axial, strict=True))
    except Infeasible:
        return None
    return static_rating(row) / load if load > 0.0 else float("inf")


def _basic(row: Row, radial: Array, axial: Array, rating: float) -> float | None:
    """Return L_10 under the mean equivalent load (Σ P^p/m)^(1/p)."""
    power = exponent(row)
    try:
        loads = np.array([dynamic_load(row, float(r), float(a)) for r, a in zip(radial, axial, strict=True)])
    except Infeasible:
        return None
    mean = float((loads**power).mean() ** (1.0 / power))
    return basic_life(row, mean, rating) if mean > 0.0 else float("inf")


def _permissible(found: Duty) -> float:
    """Return how many times its load the most loaded element bears: pressure³ for balls, pressure² for rollers."""
    ratio = found.pressure / (PERMISSIBLE if isinstance(found.row, BallBearing) else ROLLER_PERMISSIBLE)
    power = 3 if isinstance(found.row, BallBearing) else 2
    return float(ratio**-power) if ratio > 0.0 else float("inf")
