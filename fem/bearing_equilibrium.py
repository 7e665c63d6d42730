"""Displacement of a roller bearing under a given load."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.bearing import EXPONENT, BearingState, RollerBearing, iso16281_constant, load_distribution
from trochoid.kinematics.errors import NotConverged, TrochoidError
from trochoid.kinematics.types import Array


def solve(
    bearing: RollerBearing,
    load: Array,
    roller_angle0: float = 0.0,
    tolerance: float = 1e-10,
    max_iterations: int = 100,
) -> BearingState:
    """Return the state under a load (4,); raises NotConverged with what to try.

    The energy is convex, so a damped Newton iteration finds its minimum; a load that is small against the
    clearance is reached from larger ones.  No load and no preload gives the centred, open bearing of zero
    stiffness (see `note`).
    """
    target = np.asarray(load, dtype=np.float64)
    if target.shape != (4,) or not np.isfinite(target).all():
        raise TrochoidError(f"bearing load must be four finite numbers (F_x, F_y, M_x, M_y), given {load!r}")
    state = load_distribution(bearing, _start(bearing, target), roller_angle0)
    for level in _levels(bearing, target):
        goal = _Goal(bearing, target * level, roller_angle0, tolerance)
        state, converged = _newton(goal, state, max_iterations)
    if not converged:
        raise NotConverged(
            f"roller bearing: no equilibrium under load {target.tolist()} after {max_iterations} iterations "
            f"(residual {goal.residual(state):.3g} N); try more iterations (max_iterations), "
            f"a larger tolerance, a larger load or a smaller clearance"
        )
    return state


def _scale(bearing: RollerBearing) -> Array:
    """Return the lever (4,) that turns moments into forces at the roller ends."""
    return np.array([1.0, 1.0, 0.5 * bearing.length, 0.5 * bearing.length])


def _reach(bearing: RollerBearing, size: float) -> float:
    """Return half the clearance and the deflection under the Stribeck share 4.08·F/Z of a load, m."""
    share = 4.08 * size / bearing.rollers / iso16281_constant(bearing.length)
    return float(0.5 * max(bearing.clearance, 0.0) + share ** (1.0 / EXPONENT))


def _levels(bearing: RollerBearing, target: Array) -> list[float]:
    """Return multiples of the load, the last one 1; small loads start from one that closes the clearance."""
    size = float(np.linalg.norm(target / _scale(bearing)))
    play = 0.5 * max(bearing.clearance, 0.0)
    closing = bearing.rollers * iso16281_constant(bearing.length) * play**EXPONENT
    if closing <= 300.0 * size or size == 0.0:
        return [1.0]
    steps = int(np.ceil(np.log(closing / size) / np.log(30.0)))
    return [float(v) for v in 30.0 ** np.arange(steps, -1, -1)]


def _start(bearing: RollerBearing, target: Array) -> Array:
    """Return a displacement that overshoots the first load, where Newton on a convex energy is safe."""
    unit = _scale(bearing)
    forces = target / unit * _levels(bearing, target)[0]
    size = float(np.linalg.norm(forces))
    return forces / unit * (4.0 * _reach(bearing, size) / size) if size > 0.0 else np.zeros(4)


@dataclass(frozen=True, slots=True)
class _Goal:
    """A load to be reached and how closely."""

    bearing: RollerBearing
    target: Array
    roller_angle0: float
    tolerance: float

    @property
    def size(self) -> float:
        """Return the size of the load as a force, N."""
        return float(np.linalg.norm(self.target / _scale(self.bearing)))

    def residual(self, state: BearingState) -> float:
        """Return the size of what is left of the load, N."""
        return float(np.linalg.norm((self.target - state.load) / _scale(self.bearing)))

    def reached(self, state: BearingState) -> bool:
        """Say whether the load is balanced to the tolerance or, with preload or clearance, to rounding."""
        extent = float(np.abs(state.displacement * _scale(self.bearing)).max()) + abs(self.bearing.clearance)
        slope = float(np.trace(state.stiffness[:2, :2]))
        rounding = min(float(np.finfo(float).eps) * extent * slope, 1e-3 * self.size)
        preload = 1e-13 * float(state.slice_loads.sum())
        return self.residual(state) <= self.tolerance * self.size + 4.0 * rounding + preload


def _newton(goal: _Goal, state: BearingState, max_iterations: int) -> tuple[BearingState, bool]:
    """Return the state that minimises the energy, by Newton's method with a line search.

    A trace of the diagonal keeps the step finite where nothing touches yet.
    """
    unit = _scale(goal.bearing)
    secant = goal.size / _reach(goal.bearing, goal.size) if goal.size > 0.0 else 1.0
    for _ in range(max_iterations):
        if goal.reached(state):
            break
        hessian = state.stiffness / np.outer(unit, unit)
        regular = hessian + 1e-12 * (np.trace(hessian) + secant) * np.eye(4)
        step = np.linalg.solve(regular, (goal.target - state.load) / unit) / unit
        state = _search(goal, state, step)
    return state, goal.reached(state)


def _search(goal: _Goal, state: BearingState, step: Array) -> BearingState:
    """Return the state along `step` where the convex energy has come close to its minimum (Illinois' rule).

    A step from an open gap ends deep in contact; halving alone would not find the narrow place where the
    rollers just carry a small part of the load.
    """
    start = float(step @ (state.load - goal.target))
    trial = load_distribution(goal.bearing, state.displacement + step, goal.roller_angle0)
    slope = float(step @ (trial.load - goal.target))
    low, high, below, above = 0.0, 1.0, start, slope
    for _ in range(80):
        if abs(slope) <= 0.3 * abs(start) or above <= 0.0:
            break
        part = low + (high - low) * min(max(-below / (above - below), 0.02), 0.98)
        trial = load_distribution(goal.bearing, state.displacement + part * step, goal.roller_angle0)
        slope = float(step @ (trial.load - goal.target))
        if slope < 0.0:
            low, below, above = part, slope, 0.5 * above
        else:
            high, above, below = part, slope, 0.5 * below
    return trial
