"""Displacement of a rolling bearing under given loads: a convex energy is minimised, many loads at once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem.rolling import MOTIONS, Rolling, RollingState
from trochoid.kinematics.errors import Infeasible, NotConverged, TrochoidError
from trochoid.kinematics.types import Array, BoolArray, IntArray

LEAST = 1e-12  # of the secant stiffness: keeps the step finite where nothing touches yet
QUICK = 40  # iterations within which most loads are reached at once
STEP = 10.0  # between loads that lead to a small one
SHALLOW = 0.02  # of the length on which contacts turn: smaller deflections make the energy a narrow valley
DEEPEST = 8  # times the displacement that a load may need: no step goes further


def solve(
    bearing: Rolling,
    load: Array,
    held: Mapping[str, float] | None = None,
    turn: float = 0.0,
    tolerance: float = 1e-10,
    max_iterations: int = 300,
) -> RollingState:
    """Return the state under loads (5,) or (m, 5), by Newton's method with a line search.

    `held`: displacements in m or rad of some of x, y, z, tilt_x, tilt_y; the load given there is not used, and
    the state's is the reaction.  No load and no preload is the bearing at rest, open, of zero stiffness (see
    `note`).  Raises Infeasible for a load that the bearing cannot pass, NotConverged with what to try.
    """
    target = np.asarray(load, dtype=np.float64)
    if target.shape[-1:] != (5,) or target.ndim > 2 or not np.isfinite(target).all():
        raise TrochoidError(
            f"bearing load must be five finite numbers (F_x, F_y, F_z, M_x, M_y), or rows of them, given {load!r}"
        )
    goal = _goal(bearing, np.atleast_2d(target), held or {}, turn, tolerance)
    state, shift = _newton(goal, _start(goal), min(QUICK, max_iterations))
    hard = np.flatnonzero(~goal.reached(state))
    if len(hard):
        shift[hard] = _from_above(goal.rows(hard), max_iterations)
        state = goal.respond(shift)
    _fail_if_not_reached(goal, state, max_iterations)
    return state.at(0) if target.ndim == 1 else state


@dataclass(frozen=True, slots=True)
class _Goal:
    """Loads to be reached, in coordinates u = q·unit that are all lengths; `fixed` (5,) where not free."""

    bearing: Rolling
    target: Array
    free: BoolArray
    fixed: Array
    turn: float
    tolerance: float
    unit: Array
    size: Array

    @property
    def depth(self) -> Array:
        """Play and deflection (m,) under each load, m."""
        return self.bearing.play + np.array([self.bearing.deflection(float(s)) for s in self.size])

    @property
    def reach(self) -> Array:
        """Displacement (m,) that each load may need, m: across the contacts' normals it is the longest."""
        depth = self.depth
        return np.asarray(depth + np.sqrt(2.0 * self.bearing.bend * depth))

    def rows(self, which: IntArray) -> _Goal:
        """Return the goal of some of the loads."""
        return replace(self, target=self.target[which], size=self.size[which])

    def scaled(self, level: Array) -> _Goal:
        """Return the goal of multiples (m,) of the loads."""
        return replace(self, target=self.target * level[:, None], size=self.size * level)

    def respond(self, shift: Array) -> RollingState:
        """Return the state at displacements in lengths (m, 5)."""
        return self.bearing.respond(shift / self.unit, self.turn)

    def rest(self, state: RollingState) -> Array:
        """Return what of the free loads is not passed (m, 5), N."""
        rest: Array = np.where(self.free, (self.target - state.load) / self.unit, 0.0)
        return rest

    def reached(self, state: RollingState) -> BoolArray:
        """Say (m,) whether the loads are balanced to the tolerance or, with preload or clearance, to rounding."""
        extent = np.abs(state.displacement * self.unit).max(axis=-1) + self.bearing.play
        slope = np.abs(np.einsum("...ii->...i", state.stiffness) / self.unit**2).max(axis=-1)
        noise = np.minimum(np.finfo(float).eps * extent * slope, 1e-3 * self.size)
        preload = 1e-13 * state.outer_loads.sum(axis=-1)
        left = np.linalg.norm(self.rest(state), axis=-1)
        return np.asarray(left <= self.tolerance * self.size + 4.0 * noise + preload)


def _goal(bearing: Rolling, target: Array, held: Mapping[str, float], turn: float, tolerance: float) -> _Goal:
    for name, value in held.items():
        if name not in MOTIONS or not np.isfinite(value):
            raise TrochoidError(
                f"a bearing holds finite values of {', '.join(MOTIONS)}; given {name} = {value}"
            )
    free = np.array([name not in held for name in MOTIONS])
    fixed = np.array([held.get(name, 0.0) for name in MOTIONS])
    unit = np.array([1.0, 1.0, 1.0, bearing.lever, bearing.lever])
    size = np.linalg.norm(np.where(free, target / unit, 0.0), axis=-1)
    return _Goal(bearing, target, free, fixed, turn, tolerance, unit, size)


def _start(goal: _Goal) -> Array:
    """Return displacements in lengths (m, 5) that overshoot, where Newton on a convex energy is safe."""
    force = np.where(goal.free, goal.target / goal.unit, 0.0)
    far = np.divide(4.0 * goal.depth, goal.size, out=np.zeros_like(goal.size), where=goal.size > 0.0)
    return np.where(goal.free, force * far[:, None], goal.fixed * goal.unit)


def _from_above(goal: _Goal, max_iterations: int) -> Array:
    """Return the displacements (m, 5), in lengths, at loads that are small against the play or the grooves' bend.

    There the energy is a narrow, bent valley.  Larger loads have a wide one, and the way down from them is short:
    as the load vanishes the displacement tends to that of rigid rings and elements.
    """
    wide = max(goal.bearing.play, SHALLOW * goal.bearing.bend)
    top = np.array([_load_of(goal.bearing, wide, float(s)) for s in goal.size])
    count = int(np.ceil(np.log(top.max()) / np.log(STEP)))
    levels = [top ** (k / count) for k in range(count, 0, -1)] + [np.ones_like(top)]
    shift = _start(goal.scaled(levels[0]))
    for level in levels:
        shift = _newton(goal.scaled(level), shift, max_iterations)[1]
    return shift


def _load_of(bearing: Rolling, depth: float, force: float) -> float:
    """Return the multiple ≥ 1 of a force that causes at least this deflection."""
    multiple = 1.0
    while force > 0.0 and bearing.deflection(multiple * force) < depth and multiple < 1e30:
        multiple *= STEP
    return multiple


def _newton(goal: _Goal, shift: Array, max_iterations: int) -> tuple[RollingState, Array]:
    """Return the states and displacements in lengths (m, 5) that minimise the energies, if the iterations suffice."""
    state = goal.respond(shift)
    secant = np.divide(goal.size, goal.depth, out=np.ones_like(goal.size), where=goal.size > 0.0)
    scale = np.outer(goal.unit, goal.unit)
    for _ in range(max_iterations):
        open_rows = ~goal.reached(state)
        if not open_rows.any():
            break
        rest = goal.rest(state)
        hessian = np.where(np.outer(goal.free, goal.free), state.stiffness / scale, 0.0)
        least = LEAST * (np.trace(hessian, axis1=-2, axis2=-1) + secant)
        step = np.linalg.solve(hessian + least[:, None, None] * np.eye(5), rest[..., None])[..., 0]
        length = np.linalg.norm(step, axis=-1)
        most = DEEPEST * goal.reach
        step *= np.minimum(1.0, np.divide(most, length, out=np.ones_like(length), where=length > 0.0))[
            :, None
        ]
        step[~open_rows] = 0.0
        shift, state = _search(goal, shift, state, step)
    return state, shift


def _search(goal: _Goal, shift: Array, state: RollingState, step: Array) -> tuple[Array, RollingState]:
    """Return displacements along the steps where the energies are close to their minima (Illinois' rule).

    A step from an open gap ends deep in contact; halving alone would not find the narrow place where the
    elements just carry a small part of the load.
    """
    start = -(step * goal.rest(state)).sum(axis=-1)
    part, low, high = np.ones(len(step)), np.zeros(len(step)), np.ones(len(step))
    trial = shift + step
    tried = goal.respond(trial)
    slope = -(step * goal.rest(tried)).sum(axis=-1)
    below, above = start.copy(), slope.copy()
    for _ in range(80):
        bad = (np.abs(slope) > 0.3 * np.abs(start)) & (above > 0.0)
        if not bad.any():
            break
        span = np.where(above > below, above - below, 1.0)
        part = np.where(bad, low + (high - low) * np.clip(-below / span, 0.02, 0.98), part)
        trial = shift + part[:, None] * step
        tried = goal.respond(trial)
        slope = np.where(bad, -(step * goal.rest(tried)).sum(axis=-1), slope)
        under, over = bad & (slope < 0.0), bad & (slope >= 0.0)
        low, high = np.where(under, part, low), np.where(over, part, high)
        below = np.where(under, slope, np.where(over, 0.5 * below, below))
        above = np.where(over, slope, np.where(under, 0.5 * above, above))
    return trial, tried


def _fail_if_not_reached(goal: _Goal, state: RollingState, iterations: int) -> None:
    reached, beyond = goal.reached(state), goal.bearing.overreached(state)
    if reached.all() and not beyond.any():
        return
    row = int(np.flatnonzero(~reached | beyond)[0])
    load = _said(goal.target[row])
    why = goal.bearing.refusal(goal.target[row], goal.free)
    if why:
        raise Infeasible(f"bearing: {why}")
    if reached[row]:
        raise Infeasible(
            f"bearing: under {load} a ball would leave the part of its grooves that carries, as the inner ring moves "
            f"by {_moved(state.displacement[row])}; give a smaller load, more axial load, or hold z"
        )
    left = float(np.linalg.norm(goal.rest(state)[row]))
    raise NotConverged(
        f"bearing: no equilibrium under {load} within {iterations} iterations (residual {left:.3g} N); "
        f"try more iterations (max_iterations), a larger tolerance, a larger load or a smaller clearance",
        row if len(goal.target) > 1 else None,
    )


def _said(load: Array) -> str:
    """Say a load (5,)."""
    force, moment = (", ".join(f"{v + 0.0:.4g}" for v in values) for values in (load[:3], load[3:]))
    tilting = f" and (M_x, M_y) = ({moment}) N m" if load[3:].any() else ""
    return f"the load (F_x, F_y, F_z) = ({force}) N{tilting}"


def _moved(displacement: Array) -> str:
    """Say a displacement (5,)."""
    along, tilt = (
        ", ".join(f"{v + 0.0:.4g}" for v in 1e6 * values) for values in (displacement[:3], displacement[3:])
    )
    return f"({along}) µm" + (f" and ({tilt}) µrad" if displacement[3:].any() else "")
