"""Contact problems as quadratic programs for a library, and their optimality in extended precision.

    min ½ pᵀC p + gᵀp + ½ (F − Rᵀp)ᵀ K⁻¹ (F − Rᵀp),   lower ≤ p ≤ upper;   Rᵀp = F where a motion has no spring

quadprog (Goldfarb and Idnani, a dual active set) finds which strips touch; their forces are then solved for by
dense equations whose residuals are taken in extended precision. Nothing here is shared with `trochoid.fem`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
import quadprog

from trochoid.fem.complementarity import Alike, Group, Problem, Solution
from trochoid.kinematics.types import Array, BoolArray

FINE = np.longdouble
ROUNDING = 1e-14  # of the forces: so near a bound a strip is at it
FineArray: TypeAlias = npt.NDArray[np.longdouble]
WITHIN_REACH = (
    1e3  # of what all forces together press in: strips farther open than that are left out at first
)


@dataclass(frozen=True)
class Flat:
    """A problem over all n strips in one row: C (n, n), g (n,), R (n, k), K (k, k), F (k,), bounds (n,)."""

    compliance: Array
    gap: Array
    arms: Array
    springs: Array
    load: Array
    lower: Array
    upper: Array


def flat(problem: Problem) -> Flat:
    """Return a problem without its block structure; strips that can never touch may carry nothing."""
    size = sum(g.gap.size for g in problem.groups)
    total = np.zeros((len(problem.coupling), size))  # strips → totals of the contacts
    compliance, at, contact = np.zeros((size, size)), 0, 0
    for group in problem.groups:
        for local in _blocks(group):
            m = len(local)
            compliance[at : at + m, at : at + m] = local
            total[contact, at : at + m] = 1.0
            at, contact = at + m, contact + 1
    compliance += total.T @ problem.coupling @ total
    gap = np.concatenate([g.gap.ravel() for g in problem.groups])
    never = np.isinf(gap)
    bounds = [
        np.concatenate([_bound(g, name, g.gap.shape, default) for g in problem.groups])
        for name, default in (("lower", 0.0), ("upper", np.inf))
    ]
    return Flat(
        compliance,
        np.where(never, 0.0, gap),
        np.concatenate([_arms(g) for g in problem.groups]),
        problem.springs,
        problem.load,
        bounds[0],
        np.where(never, bounds[0], bounds[1]),
    )


def _blocks(group: Group) -> Array:
    """Return the compliances (c, m, m) of a group, written out."""
    if isinstance(group.local, Alike):
        return np.asarray(group.local.factor[..., None, None] * group.local.unit.matrix)
    return group.local


def _arms(group: Group) -> Array:
    """Return the arms (c·m, k) of a group's strips, written out."""
    shape = (*group.gap.shape, group.arms.shape[-1])
    return np.broadcast_to(group.arms, shape).reshape(-1, shape[-1])


def _bound(group: object, name: str, shape: tuple[int, ...], default: float) -> Array:
    given = getattr(group, name, None)
    return np.full(shape, default).ravel() if given is None else np.broadcast_to(given, shape).ravel()


def forces_of(solution: Solution) -> Array:
    """Return the strip forces of all groups in one row."""
    return np.concatenate([f.ravel() for f in solution.forces])


@dataclass(frozen=True)
class Residuals:
    """What is missing of each condition, relative: balance and bounds to the forces, openings to the gaps |g − R a|."""

    imbalance: float
    bound: float
    penetration: float
    product: float

    @property
    def largest(self) -> float:
        """The worst of the four."""
        return max(self.imbalance, self.bound, self.penetration, self.product)


def residuals(f: Flat, forces: Array, motion: Array) -> Residuals:
    """Return by how much forces (n,) and motion (k,) miss the conditions of the program, in extended precision."""
    p, a = forces.astype(FINE), motion.astype(FINE)
    apart = f.gap - f.arms.astype(FINE) @ a
    w = f.compliance.astype(FINE) @ p + apart
    some = f.lower < f.upper
    length = max(float(np.abs(apart[some]).max(initial=0.0)), 1e-300)
    unit = _unit(f)
    carried = (np.abs(f.arms).T @ np.abs(p) + np.abs(f.springs) @ np.abs(a)) * unit
    size = max(float(carried.max(initial=0.0)), float((np.abs(f.load) * unit).max(initial=0.0)), 1e-300)
    rest = f.arms.astype(FINE).T @ p + f.springs.astype(FINE) @ a - f.load
    outside = np.maximum(f.lower - p, p - f.upper).max(initial=0.0)
    low, high = p <= f.lower + ROUNDING * size, p >= f.upper - ROUNDING * size
    open_, closed = np.where(low, -w, np.abs(w)), np.where(high, w, np.abs(w))
    wrong = np.minimum(open_, closed)  # between its bounds a strip touches
    push, pull = np.where(w > 0, p - f.lower, 0.0), np.where(w < 0, f.upper - p, 0.0)
    work = np.abs(w) * (push + np.where(np.isfinite(pull), pull, 0.0))
    return Residuals(
        float((np.abs(rest) * unit).max(initial=0.0)) / size,
        float(outside) / size,
        float(wrong[some].max(initial=0.0)) / length,
        float(work[some].max(initial=0.0)) / (size * length),
    )


def _unit(f: Flat) -> Array:
    arms = np.abs(f.arms).max(axis=0, initial=0.0)
    stiff = np.sqrt(np.diag(f.springs) * np.median(np.diag(f.compliance)))
    return 1 / np.where(arms > 0, arms, np.where(stiff > 0, stiff, 1.0))


def answer(f: Flat, origin: Array) -> tuple[Array, Array]:
    """Return forces (n,) and motion (k,) of the program.

    `origin` (k,) is a motion that gaps are counted from: this adds a constant to the program and changes no force,
    but gaps near the answer's are known better. Strips out of reach are left out, and looked at afterwards.
    """
    gap = f.gap - f.arms.astype(FINE) @ origin
    load = (f.load - f.springs.astype(FINE) @ origin).astype(np.float64)
    size = max(float((np.abs(f.load) * _unit(f)).max(initial=0.0)), 1e-300)
    reach = WITHIN_REACH * (float(np.diag(f.compliance).max()) * size + float(max(-gap.min(), 0.0)))
    for _ in range(8):
        near = np.flatnonzero((gap <= reach) & (f.lower < f.upper))
        some = Flat(
            f.compliance[np.ix_(near, near)],
            gap[near].astype(np.float64),
            f.arms[near],
            f.springs,
            load,
            f.lower[near],
            f.upper[near],
        )
        inner, step = _polished(some, gap[near], *_at_bounds(some))
        forces = np.where(f.lower < f.upper, f.lower, 0.0).astype(FINE)
        forces[near] = inner
        w = f.compliance.astype(FINE) @ forces + gap - f.arms.astype(FINE) @ step
        left = np.setdiff1d(np.flatnonzero(f.lower < f.upper), near)
        if not (w[left] < 0).any():
            return forces.astype(np.float64), (origin + step).astype(np.float64)
        reach *= 1e3
    raise AssertionError("strips out of reach are pressed")


def _at_bounds(f: Flat) -> tuple[BoolArray, BoolArray]:
    """Return which strips quadprog holds at their lower, and which at their upper bound."""
    held = f.springs.any(axis=1)
    unit = _unit(f)
    compliance, linear = f.compliance.copy(), f.gap.copy()
    if held.any():
        soft = np.linalg.inv(f.springs[np.ix_(held, held)])
        compliance += f.arms[:, held] @ soft @ f.arms[:, held].T
        linear -= f.arms[:, held] @ (soft @ f.load[held])
    stiff = 1 / float(np.median(np.diag(compliance)))
    force = max(float((np.abs(f.load) * unit).max(initial=0.0)), float(np.abs(linear).max()) * stiff * 1e-6)
    free = ~held & (np.abs(f.arms).max(axis=0) > 0)
    arms = (f.arms * unit)[:, free]
    if np.linalg.eigvalsh(compliance)[0] <= 0:  # where C leaves out rigid motions; ½|Rᵀp|² is a constant
        compliance += 1e3 / stiff * arms @ arms.T
        linear -= 1e3 / stiff * arms @ (f.load * unit)[free]
    one = np.eye(len(linear))
    upper = np.isfinite(f.upper)
    constraints = np.concatenate([arms, one, -one[:, upper]], axis=1)
    limits = np.concatenate([(f.load * unit)[free], f.lower, -f.upper[upper]]) / force
    _, _, _, _, _, active = quadprog.solve_qp(
        compliance * stiff, -linear * stiff / force, constraints, limits, int(free.sum())
    )
    named = np.asarray(active, dtype=np.intp) - 1 - int(free.sum())
    low, high = np.zeros((2, len(linear)), dtype=bool)
    low[named[(named >= 0) & (named < len(linear))]] = True
    high[np.flatnonzero(upper)[named[named >= len(linear)] - len(linear)]] = True
    return low, high


def _polished(f: Flat, gap: FineArray, low: BoolArray, high: BoolArray) -> tuple[FineArray, FineArray]:
    """Solve w = 0 on the strips between their bounds, refined with residuals in extended precision."""
    between = ~(low | high)
    inverse, unit, stiff = _inverse(f, between)
    n = int(between.sum())
    p, a = np.where(high, f.upper, np.where(low, f.lower, 0.0)).astype(FINE), np.zeros(len(unit), dtype=FINE)
    exact = f.compliance.astype(FINE), f.arms.astype(FINE), f.springs.astype(FINE)
    for _ in range(6):
        w = exact[0] @ p + gap - exact[1] @ a
        rest = exact[1].T @ p + exact[2] @ a - f.load
        right = np.concatenate([-w[between] * stiff, -rest * unit]).astype(np.float64)
        change = inverse @ right
        p[between] += change[:n]
        a += change[n:] * unit / stiff
    return np.asarray(p), np.asarray(a)


def _inverse(f: Flat, between: BoolArray) -> tuple[Array, Array, float]:
    """Return what turns −w and missing loads into forces and motions, all as forces: units of motions and 1/C."""
    n, unit = int(between.sum()), _unit(f)
    stiff = 1 / float(np.median(np.diag(f.compliance)))
    arms = f.arms[between] * unit
    matrix = np.zeros((n + len(unit),) * 2)
    matrix[:n, :n] = f.compliance[np.ix_(between, between)] * stiff
    matrix[:n, n:], matrix[n:, :n] = -arms, arms.T
    matrix[n:, n:] = f.springs * np.outer(unit, unit) / stiff
    try:
        inverse = np.linalg.inv(matrix)
        sound = float(np.linalg.norm(matrix, 1) * np.linalg.norm(inverse, 1)) < 1e14
    except np.linalg.LinAlgError:
        sound = False
    if not sound:  # so few strips touch that a motion is free within the gaps
        inverse = np.linalg.pinv(matrix, rcond=1e-14)
    return np.asarray(inverse, dtype=np.float64), unit, stiff


def uncertainty(f: Flat, forces: Array, motion: Array) -> float:
    """Return how far forces may change when gaps are rounded: no solver in double precision knows more.

    A gap is rounded where it is given, where motions close it (a product and a sum), and where it is pressed open.
    """
    between = (forces > f.lower) & (forces < f.upper)
    inverse, _, stiff = _inverse(f, between)
    rounding = 4 * np.finfo(np.float64).eps * (np.abs(f.gap) + np.abs(f.arms) @ np.abs(motion))[between]
    n = int(between.sum())
    return float((np.abs(inverse[:n, :n]) @ rounding).max(initial=0.0) * stiff)
