"""Basic reference rating life of ISO/TS 16281: from the loads of each rolling element, or of each of its slices.

With the factor a_ISO of ISO 281 for lubrication, contamination and fatigue limit.  Not offered: a_ISO slice by
slice for rollers (ISO/TS 16281, 5.4), thrust bearings, several rows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.bearing_rating import Row, dynamic_rating, exponent
from trochoid.fem.rolling import RollingState
from trochoid.fem.rolling_ball import BallBearing
from trochoid.fem.rolling_roller import RollerRow
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array

RELIABILITY = {90: 1.0, 95: 0.64, 96: 0.55, 97: 0.47, 98: 0.37, 99: 0.25}  # a_1 of ISO 281:2007
KAPPA = (0.1, 4.0)  # range of the viscosity ratio
LARGEST = 50.0  # of a_ISO
# ISO 281:2007: a_ISO = 0.1 (1 − (a − b/κ^c)^k (e_C C_u/P)^m)^−n, in three ranges of κ with a continuous bracket
BALL_LUBRICATION = ((2.2649, 0.054381), (1.9987, 0.19087), (1.9987, 0.071739))
ROLLER_LUBRICATION = ((1.3993, 0.054381), (1.2348, 0.19087), (1.2348, 0.071739))


@dataclass(frozen=True, slots=True)
class Life:
    """Life in `revolutions` of ring against ring, 90 % of bearings reach it; `equivalent` load P_ref in N.

    `inner` and `outer`: the lives of the two raceways by themselves.
    """

    revolutions: Array
    equivalent: Array
    inner: Array
    outer: Array

    def hours(self, speed: float) -> Array:
        """Return the life in hours at a constant relative speed of the rings in rad/s."""
        return np.asarray(self.revolutions * 2.0 * np.pi / abs(speed) / 3600.0)


def reference_life(
    row: Row, state: RollingState, rating: float | None = None, inner_turns: bool = True, edges: bool = True
) -> Life:
    """Return the life (…) of ISO/TS 16281 at states (…); infinite where nothing is loaded.

    `rating`: C_r in N if not that of ISO 281; `inner_turns`: the inner ring turns against the load;
    `edges`: count the stress concentration at the ends of rollers, ISO/TS 16281's estimate.
    """
    capacity = dynamic_rating(row) if rating is None else rating
    if not capacity > 0.0:
        raise Infeasible(f"bearing life needs a dynamic load rating > 0, given {rating} N")
    life = _roller_life if isinstance(row, RollerRow) else _ball_life
    inner, outer, slope = life(row, state, capacity, inner_turns, edges)  # type: ignore[arg-type]
    with np.errstate(divide="ignore"):
        total, inside, outside = (1e6 * x**-slope for x in (inner + outer, inner, outer))
        equivalent = capacity / (total / 1e6) ** (1.0 / exponent(row))
    return Life(total, equivalent, inside, outside)


def raceway_ratings(row: Row, rating: float) -> tuple[float, float]:
    """Return Q_ci and Q_ce, the loads of one rolling element that the raceways bear 10⁶ times, N (ISO/TS 16281)."""
    g = row.gamma
    ratio, cosine = (1.0 - g) / (1.0 + g), float(np.cos(row.contact_angle))
    if isinstance(row, RollerRow):
        share, power, load = 1.038 * ratio ** (143.0 / 108.0), 4.5, rating / (0.83 * row.rollers * cosine)
        parts = (0.378, 0.364)
    else:
        inner, outer, d = row.inner_groove_radius, row.outer_groove_radius, row.ball_diameter
        fit = inner / outer * (2.0 * outer - d) / (2.0 * inner - d)
        share, power = 1.044 * ratio**1.72 * fit**0.41, 10.0 / 3.0
        load, parts = rating / (row.balls * cosine**0.7), (0.407, 0.389)
    both = ((1.0 + share ** (s * power)) ** (1.0 / power) for s in (1.0, -1.0))
    one, two = (load / part * b for part, b in zip(parts, both, strict=True))
    return one, two


def life_modification(row: Row, kappa: float, load_ratio: float) -> float:
    """Return a_ISO of ISO 281 for radial bearings: at a viscosity ratio κ and at e_C C_u/P; at most 50.

    L_nm = a_1·a_ISO·L_10 with a_1 of `RELIABILITY`; for balls also a_1·a_ISO·L_10r with P = P_ref.
    """
    if not (KAPPA[0] <= kappa and load_ratio >= 0.0):
        raise Infeasible(
            f"a_ISO needs a viscosity ratio κ ≥ {KAPPA[0]} and e_C C_u/P ≥ 0, given {kappa} and {load_ratio}; "
            f"below κ = 0.1 ISO 281 does not apply"
        )
    kappa = min(kappa, KAPPA[1])
    which = 0 if kappa < 0.4 else 1 if kappa < 1.0 else 2
    if isinstance(row, RollerRow):
        factor, power = ROLLER_LUBRICATION[which]
        film, load, steep = 1.5859 - factor / kappa**power, load_ratio**0.4, 9.185
    else:
        factor, power = BALL_LUBRICATION[which]
        film, load, steep = (2.5671 - factor / kappa**power) ** 0.83, load_ratio ** (1.0 / 3.0), 9.3
    left = 1.0 - film * load
    return float(min(LARGEST, 0.1 * left**-steep)) if left > 0.0 else LARGEST


def edge_factors(slices: int) -> Array:
    """Return the stress riser f (slices,) of ISO/TS 16281 for a roller's slices: 1 − 0.01/ln(1.985|2k−n−1|/(2n−2))."""
    k = np.arange(1, slices + 1)
    with np.errstate(divide="ignore"):
        factors: Array = 1.0 - 0.01 / np.log(1.985 * np.abs(2 * k - slices - 1) / (2 * slices - 2))
    return factors


def _ball_life(
    row: BallBearing, state: RollingState, rating: float, inner_turns: bool, edges: bool
) -> tuple[Array, Array, float]:
    """Return Σ(Q_e/Q_c)^(10/3) of both raceways, and the exponent that makes it a life."""
    at = raceway_ratings(row, rating)
    powers = (3.0, 10.0 / 3.0) if inner_turns else (10.0 / 3.0, 3.0)
    loads = (state.inner_loads, state.outer_loads)
    inner, outer = ((mean(q, p) / c) ** (10.0 / 3.0) for q, p, c in zip(loads, powers, at, strict=True))
    return inner, outer, 0.9


def _roller_life(
    row: RollerRow, state: RollingState, rating: float, inner_turns: bool, edges: bool
) -> tuple[Array, Array, float]:
    """Return ΣΣ(q_e/q_c)^(9/2) of both raceways, and the exponent that makes it a life."""
    shares = row.slices ** (-7.0 / 9.0)
    loads = np.swapaxes(state.slice_loads, -1, -2)
    if edges:
        loads = loads * edge_factors(row.slices)[:, None]
    powers = (4.0, 4.5) if inner_turns else (4.5, 4.0)
    inner, outer = (
        ((mean(loads, p) / (c * shares)) ** 4.5).sum(axis=-1)
        for p, c in zip(powers, raceway_ratings(row, rating), strict=True)
    )
    return inner, outer, 8.0 / 9.0


def mean(loads: Array, power: float) -> Array:
    """Return the power mean of the loads (…, n) of all elements."""
    largest = loads.max(axis=-1, keepdims=True, initial=0.0)
    relative = np.divide(loads, largest, out=np.zeros_like(loads), where=largest > 0.0)
    value: Array = largest[..., 0] * (relative**power).mean(axis=-1) ** (1.0 / power)
    return value
