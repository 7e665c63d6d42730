"""Rollers in a seat that yields: their loads and their stiffness under a radial load.

The inner ring stays rigid and moves by x and y. Each roller closes by what the ring moves towards it, less half the
clearance, less what the seat yields under all rollers; it pushes and never pulls. That is the contact problem of
`complementarity`, with Newton's method over the rollers' law.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem import complementarity as lcp
from trochoid.fem.bearing import (
    EXPONENT,
    RollerBearing,
    carrying_note,
    iso16281_constant,
    seated_stiffness,
)
from trochoid.fem.laws import PowerLaw
from trochoid.fem.seat import roller_angles
from trochoid.kinematics.errors import Infeasible, NotConverged, TrochoidError
from trochoid.kinematics.types import Array, frozen

NEWTON = 60
SETTLED = 1e-12  # of the largest force
FLOOR = 1e-9  # of the largest force: laws are linearised there at the least
FAINT = 1e-12  # of the largest force: less is rounding


@dataclass(frozen=True, slots=True)
class SeatedState:
    """Roller bearing in a yielding seat under a radial load.

    `displacement` (2,) of the inner ring in m; `angles` (rollers,); `loads` (rollers,) in N; `yielding` (rollers,)
    in m: what the seat gives way beyond the standard's; `load` (2,) in N; `stiffness` (4, 4) on x, y in N/m and
    tilts about x, y in N·m/rad (the seat equally stiff along the roller); `energy` in J, counted from rollers that
    just touch.
    """

    displacement: Array
    angles: Array
    loads: Array
    yielding: Array
    load: Array
    stiffness: Array
    energy: float

    @property
    def touching(self) -> int:
        """Return the number of rollers that carry."""
        return int(np.count_nonzero(self.loads))

    @property
    def note(self) -> str:
        """Say in words what a reader of the stiffness must know, or nothing."""
        return carrying_note(self.touching)


def solve_seated(
    bearing: RollerBearing, compliance: Array, load: Array, roller_angle0: float = 0.0
) -> SeatedState:
    """Return the state under a load (2,) in N on a seat of `compliance` (rollers, rollers) in m/N (`seat_compliance`).

    With zeros it is the bearing on a rigid ring. Raises NotConverged, and Infeasible where the seat is so much stiffer
    than the standard's that nothing would be left of the rollers' own compliance.
    """
    load, compliance = _checked(bearing, compliance, load)
    angles = roller_angles(bearing, roller_angle0)
    arms = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    law = PowerLaw(iso16281_constant(bearing.length), EXPONENT)
    guess = max(4.0 * float(np.linalg.norm(load)) / bearing.rollers, _preload(bearing, law))
    if guess == 0.0:
        return _state(bearing, compliance, law, angles, np.zeros(bearing.rollers), np.zeros(2))
    force, solution = np.full(bearing.rollers, guess), None
    for _ in range(NEWTON):
        at = np.maximum(force, FLOOR * force.max())
        approach, slope = law.approach(at)
        _fail_if_stiff(compliance, slope, force)
        gap = 0.5 * bearing.clearance + approach - slope * at
        group = lcp.Group(slope[:, None, None], gap[:, None], arms[:, None])
        problem = lcp.Problem((group,), compliance, np.zeros((2, 2)), load)
        solution = lcp.solve(problem, solution)
        new = solution.forces[0][:, 0]
        change, force = float(np.abs(new - force).max()), new
        if change <= SETTLED * force.max():
            loads = np.where(force > FAINT * force.max(), force, 0.0)
            return _state(bearing, compliance, law, angles, loads, solution.motion)
    raise NotConverged(
        f"seat: roller loads still change by {change / force.max():.1e} of the largest after {NEWTON} steps under the "
        f"load {load.tolist()} N; give a larger load or a smaller clearance"
    )


def ring_stiffness(
    bearing: RollerBearing, state: SeatedState, compliance: Array, bore: Array, direction: Array
) -> float:
    """Return the stiffness along a `direction` (2,) against the bore's mean motion instead of what holds the body, N/m.

    `bore` (2, rollers) is `bore_motion`. It is what the ring's change of shape leaves of the bearing; the motion of the
    bore as a whole is another spring, in series.
    """
    arms = np.stack([np.cos(state.angles), np.sin(state.angles)], axis=-1)
    rate = _rate(bearing, state.loads)
    pushed = np.linalg.solve(np.eye(bearing.rollers) + rate[:, None] * compliance, rate[:, None] * arms)
    turned = np.linalg.pinv(arms.T @ pushed, rcond=1e-10, hermitian=True)
    moved = float(direction @ (turned - bore @ pushed @ turned) @ direction)
    return 1.0 / moved if moved != 0.0 else 0.0


def _state(
    bearing: RollerBearing, compliance: Array, law: PowerLaw, angles: Array, loads: Array, motion: Array
) -> SeatedState:
    arms = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    yielding = compliance @ loads
    approach = (loads / law.constant) ** (1.0 / law.exponent)
    energy = float(loads @ (approach / (1.0 + law.exponent) + 0.5 * yielding))
    return SeatedState(
        frozen(motion),
        frozen(angles),
        frozen(loads),
        frozen(yielding),
        frozen(arms.T @ loads),
        seated_stiffness(bearing, loads, compliance, float(angles[0])),
        energy,
    )


def _rate(bearing: RollerBearing, loads: Array) -> Array:
    """Return the tangent stiffness (rollers,) of the rollers, N/m; zero where they are open."""
    constant = iso16281_constant(bearing.length)
    return np.asarray(EXPONENT * constant * (loads / constant) ** 0.1)


def _preload(bearing: RollerBearing, law: PowerLaw) -> float:
    return float(law.constant * max(-0.5 * bearing.clearance, 0.0) ** law.exponent)


def _checked(bearing: RollerBearing, compliance: Array, load: Array) -> tuple[Array, Array]:
    load, compliance = np.asarray(load, dtype=np.float64), np.asarray(compliance, dtype=np.float64)
    if load.shape != (2,) or not np.isfinite(load).all():
        raise TrochoidError(
            f"seat: the load must be two finite numbers (F_x, F_y) in N, given {load.tolist()}"
        )
    if compliance.shape != (bearing.rollers,) * 2 or not np.isfinite(compliance).all():
        raise TrochoidError(
            f"seat: the compliance must be finite, one row and column for each of {bearing.rollers} rollers, "
            f"given {compliance.shape}"
        )
    return load, 0.5 * (compliance + compliance.T)


def _fail_if_stiff(compliance: Array, slope: Array, force: Array) -> None:
    """Refuse rollers and seat that together would move against their load."""
    on = force > FLOOR * force.max()
    total = compliance[np.ix_(on, on)] + np.diag(slope[on])
    least = float(np.linalg.eigvalsh(total).min())
    if least <= 0.0:
        raise Infeasible(
            f"seat: rollers that yield {slope[on].min():.3g} m/N on the standard's seat would yield {least:.3g} m/N on "
            f"this one: it is stiffer than all of the contact that the standard contains; take the rigid ring"
        )
