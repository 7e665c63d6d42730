"""How much the rigid-ring stiffness of a roller bearing is wrong in a given seat, from two mesh levels."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.fem.bearing import BearingState, RollerBearing
from trochoid.fem.bearing_equilibrium import solve
from trochoid.fem.rolling import Rolling
from trochoid.fem.seat import FlexibleSeat, bore_motion, plain_rollers, seat_compliance
from trochoid.fem.seat_equilibrium import SeatedState, ring_stiffness, solve_seated
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

SHARE = 0.5  # of the difference between levels, as for all finite-element numbers
FLOOR = 0.3  # least share of the worst number's relative difference that any number is taken to have


@dataclass(frozen=True, slots=True)
class Estimate:
    """A number and the estimated discretisation error of it."""

    value: float
    error: float

    def __str__(self) -> str:
        """Return value ± error."""
        return f"{self.value:.4g} ± {self.error:.1g}"


@dataclass(frozen=True, slots=True)
class SeatReport:
    """A bearing in a yielding seat beside the same on a rigid ring, under one load.

    `stiffness`: rigid over seated stiffness along the load, more than 1 where the rigid ring is too stiff. `shape`:
    the same with the seated stiffness taken against the bore's mean motion, so without what a spring between housing
    and ground would account for. `largest`: seated over rigid load of the most loaded roller. `carrying`: rollers
    that carry in the seat and on the rigid ring.
    """

    seated: SeatedState
    rigid: BearingState
    stiffness: Estimate
    shape: Estimate
    largest: Estimate
    carrying: tuple[int, int]


def rigid_ring_error(
    bearing: RollerBearing | Rolling,
    seat_at: Callable[[int], FlexibleSeat],
    facets: int,
    load: Array,
    roller_angle0: float = 0.0,
) -> SeatReport:
    """Return how much the rigid ring is wrong under a load (2,) in N; `seat_at` meshes the seat with so many facets.

    The coarser level has half of `facets`. Raises what building the seat and solving raise, and TrochoidError where
    there is no stiffness to compare.
    """
    rollers = plain_rollers(bearing)
    rigid = solve(rollers, np.append(load, [0.0, 0.0]), roller_angle0)
    fine, found = _level(rollers, seat_at(facets), load, rigid, roller_angle0)
    coarse, _ = _level(rollers, seat_at(facets // 2), load, rigid, roller_angle0)
    worst = float(np.max(np.abs(fine - coarse) / np.abs(fine)))
    errors = SHARE * np.maximum(np.abs(fine - coarse), FLOOR * worst * np.abs(fine))
    stiffness, shape, largest = (Estimate(float(v), float(e)) for v, e in zip(fine, errors, strict=True))
    return SeatReport(found, rigid, stiffness, shape, largest, (found.touching, rigid.touching))


def _level(
    bearing: RollerBearing, seat: FlexibleSeat, load: Array, rigid: BearingState, angle0: float
) -> tuple[Array, SeatedState]:
    """Return the three numbers on one mesh, and the state."""
    size = float(np.linalg.norm(load))
    matrix = seat_compliance(bearing, seat, size, angle0)
    state = solve_seated(bearing, matrix, load, angle0)
    along = np.asarray(load, dtype=np.float64) / size if size > 0.0 else np.array([1.0, 0.0])
    hard = float(along @ rigid.stiffness[:2, :2] @ along)
    soft = float(along @ state.stiffness[:2, :2] @ along)
    if soft == 0.0 or hard == 0.0:
        raise TrochoidError(
            f"seat: {state.note or rigid.note}; give a load, or a clearance below 0, to compare stiffnesses"
        )
    shape = ring_stiffness(bearing, state, matrix, bore_motion(bearing, seat, angle0), along)
    largest = float(state.loads.max() / rigid.roller_loads.max())
    return np.array([hard / soft, hard / shape, largest]), state
