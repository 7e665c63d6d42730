"""The contact problem of elastic bodies that may also move rigidly: find strip forces p and motions a with

    w = C p + g − R a ≥ 0,   p ≥ 0,   p·w = 0,   Rᵀp + K a = F.

C is built of small dense blocks (the strips of one contact act on each other) and of a smooth coupling
between the *totals* of contacts; a block may also be a whole conforming contact. K holds springs that motions
rest on (bearings), zero for free motions.

Proximal steps make every motion stiff (spring κ to the last a): the problem is then a linear complementarity
problem with a P-matrix. It is solved by a primal-dual active set (block pivoting) and, when that makes no
progress, by Murty's single pivots, which end after finitely many. κ falls step by step until the springs
carry nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, BoolArray

BLOCK_PIVOTS = 10  # without progress, before single pivots
PIVOTS = 4000
STEPS = 60
TOLERANCE = 1e-12


@dataclass(frozen=True, slots=True)
class Group:
    """Contacts with equally many strips: compliance `local` (c, m, m) in m/N, `gap` (c, m) in m (inf: a
    strip that can never touch), `arms` (c, m, k).
    """

    local: Array
    gap: Array
    arms: Array


@dataclass(frozen=True, slots=True)
class Problem:
    """Groups in order, `coupling` (C, C) between totals of all C contacts in m/N, `springs` (k, k) in N/m
    and `load` (k,) on the motions.
    """

    groups: tuple[Group, ...]
    coupling: Array
    springs: Array
    load: Array


@dataclass(frozen=True, slots=True)
class Solution:
    """Strip forces per group (c, m) in N, `motion` (k,), pivots, and the residuals relative to force and gap scale."""

    forces: tuple[Array, ...]
    motion: Array
    active: tuple[BoolArray, ...]
    pivots: int
    imbalance: float
    penetration: float


@dataclass(slots=True)
class _Step:
    forces: list[Array]
    motion: Array
    opening: list[Array]


def solve(problem: Problem, start: Solution | None = None) -> Solution:
    """Solve the contact problem, from the active set and motion of `start` when given.

    Raises NotConverged when a loaded motion is resisted by nothing, or the pivots run out.
    """
    scale, kappa = _scales(problem)
    motion = np.zeros(len(problem.load)) if start is None else start.motion.copy()
    active = (
        [np.isfinite(g.gap) & (g.gap < np.inf) for g in problem.groups]
        if start is None
        else [a.copy() for a in start.active]
    )
    if start is not None:
        kappa = kappa * 1e-6
    pivots = 0
    for _ in range(STEPS):
        step, active, used = _lcp(problem, active, motion, kappa, scale)
        pivots += used
        held = kappa * (step.motion - motion)
        imbalance = float(np.max(np.abs(held) * scale.motion, initial=0.0)) / scale.force
        moved = float(np.max(np.abs(step.motion - motion) / scale.motion, initial=0.0))
        motion = step.motion
        if imbalance <= 1e-13:
            return Solution(
                tuple(step.forces), motion, tuple(active), pivots, imbalance, _penetration(step) / scale.gap
            )
        kappa = kappa * 1e-3 if moved < 1e3 * scale.gap else kappa
        kappa = np.maximum(kappa, scale.stiffness / scale.motion**2 * 1e-9)
    raise NotConverged(_unresisted(problem, held, scale))


@dataclass(frozen=True, slots=True)
class _Scale:
    force: float
    gap: float
    stiffness: float
    motion: Array  # motion of each kind that moves the contact by one unit of length


def _scales(problem: Problem) -> tuple[_Scale, Array]:
    """Sizes of force, gap and stiffness, and the first proximal springs: soft enough that the load closes every gap."""
    arms = np.concatenate([g.arms.reshape(-1, g.arms.shape[-1]) for g in problem.groups])
    lever = np.abs(arms).max(axis=0, initial=0.0)
    unit = 1.0 / np.where(lever > 0, lever, 1.0)
    compliance = np.concatenate([np.einsum("cii->ci", g.local).ravel() for g in problem.groups])
    typical = float(np.median(compliance[compliance > 0])) if np.any(compliance > 0) else 1.0
    gaps = np.concatenate([g.gap[np.isfinite(g.gap)] for g in problem.groups])
    reach = float(np.ptp(gaps)) if len(gaps) else 0.0
    force = float(np.abs(problem.load * unit).max(initial=0.0))
    gap = max(float(np.abs(gaps).max(initial=0.0)), typical * force)
    if force == 0.0:
        force = gap / typical if gap > 0 else 1.0
    gap = gap or typical * force
    distance = 10 * (reach + typical * force)
    return _Scale(force, gap, 1 / typical, unit), force / distance / unit**2


def _lcp(
    problem: Problem, active: list[BoolArray], anchor: Array, kappa: Array, scale: _Scale
) -> tuple[_Step, list[BoolArray], int]:
    """Solve the complementarity problem with proximal springs by block pivoting, then by single pivots."""
    best, patience = np.inf, BLOCK_PIVOTS
    for pivot in range(PIVOTS):
        step = _equalities(problem, active, anchor, kappa)
        bad = _violations(step, active, scale)
        count = sum(int(b.sum()) for b in bad)
        if count == 0:
            return step, active, pivot + 1
        if count < best:
            best, patience = count, BLOCK_PIVOTS
        else:
            patience -= 1
        if patience > 0:
            active = [a ^ b for a, b in zip(active, bad, strict=True)]
        else:  # Murty: the last violated strip alone changes sides
            group = max(i for i, b in enumerate(bad) if b.any())
            active = [a.copy() for a in active]
            last = np.flatnonzero(bad[group].ravel())[-1]
            active[group].ravel()[last] ^= True
    raise NotConverged(
        f"contact: no complementary solution after {PIVOTS} pivots; check that gaps and compliances are finite and the "
        "stiffness of the bodies differs by less than 1e9"
    )


def _violations(step: _Step, active: Sequence[BoolArray], scale: _Scale) -> list[BoolArray]:
    limit = TOLERANCE * scale.gap
    pull = TOLERANCE * scale.force
    return [
        np.where(a, p < -pull, w < -limit) for a, p, w in zip(active, step.forces, step.opening, strict=True)
    ]


def _equalities(problem: Problem, active: Sequence[BoolArray], anchor: Array, kappa: Array) -> _Step:
    """Solve with w = 0 on the active strips and p = 0 elsewhere.

    Each block is eliminated on its own; what is left couples only contact totals s and motions a:
    (I + t₁S) s − T a = −t_g and −TᵀS s + (A + K + κ) a = F + κ a₀ + b_g.
    """
    eliminated = [_eliminate(g, a) for g, a in zip(problem.groups, active, strict=True)]
    t_one = np.concatenate([e.one.sum(axis=1) for e in eliminated])
    t_gap = np.concatenate([e.gap.sum(axis=1) for e in eliminated])
    t_arm = np.concatenate([e.arms.sum(axis=1) for e in eliminated])
    stiffness = problem.springs + np.diag(kappa)
    load = problem.load + kappa * anchor
    for e, group in zip(eliminated, problem.groups, strict=True):
        stiffness = stiffness + np.einsum("cmk,cml->kl", group.arms, e.arms)
        load = load + np.einsum("cmk,cm->k", group.arms, e.gap)
    total, motion = _totals(problem.coupling, t_one, t_gap, t_arm, stiffness, load)
    pressed = problem.coupling @ total
    forces, opening, first = [], [], 0
    for e, group in zip(eliminated, problem.groups, strict=True):
        share = pressed[first : first + len(group.gap)]
        first += len(group.gap)
        force = e.arms @ motion - e.gap - e.one * share[:, None]
        forces.append(force)
        bent = np.einsum("cij,cj->ci", group.local, force)
        opening.append(bent + group.gap + share[:, None] - group.arms @ motion)
    return _Step(forces, motion, opening)


def tangent(problem: Problem, solution: Solution) -> Array:
    """Return the stiffness (k, k) that the touching contacts and the springs give the motions, in N/m; symmetric."""
    eliminated = [_eliminate(g, a) for g, a in zip(problem.groups, solution.active, strict=True)]
    one = np.concatenate([e.one.sum(axis=1) for e in eliminated])
    arms = np.concatenate([e.arms.sum(axis=1) for e in eliminated])
    stiffness = problem.springs.copy()
    for e, group in zip(eliminated, problem.groups, strict=True):
        stiffness += np.einsum("cmk,cml->kl", group.arms, e.arms)
    system = np.eye(len(one)) + one[:, None] * problem.coupling
    stiffness -= arms.T @ problem.coupling @ np.linalg.solve(system, arms)
    return 0.5 * (stiffness + stiffness.T)


def _totals(
    coupling: Array, one: Array, gap: Array, arms: Array, stiffness: Array, load: Array
) -> tuple[Array, Array]:
    touching = np.flatnonzero(one != 0)
    count = len(touching)
    system = np.zeros((count + len(load), count + len(load)))
    inner = coupling[np.ix_(touching, touching)]
    system[:count, :count] = np.eye(count) + one[touching, None] * inner
    system[:count, count:] = -arms[touching]
    system[count:, :count] = -arms[touching].T @ inner
    system[count:, count:] = stiffness
    size = np.sqrt(np.abs(np.diag(stiffness)))
    size[size == 0] = 1.0
    scale = np.concatenate([np.ones(count), 1 / size])
    # motions are measured in the length that their stiffness gives them, so that radians and metres weigh
    # alike
    system *= scale[None, :]
    system[count:] *= scale[count:, None]
    answer = np.linalg.solve(system, np.concatenate([-gap[touching], load * scale[count:]])) * scale
    total = np.zeros(len(one))
    total[touching] = answer[:count]
    return total, answer[count:]


@dataclass(frozen=True, slots=True)
class _Eliminated:
    arms: Array  # L⁻¹R on the active strips
    gap: Array  # L⁻¹g
    one: Array  # L⁻¹1


def _eliminate(group: Group, active: BoolArray) -> _Eliminated:
    contacts, strips = group.gap.shape
    right = np.empty((contacts, strips, group.arms.shape[-1] + 2))
    right[..., :-2] = group.arms
    right[..., -2] = group.gap
    right[..., -1] = 1.0
    right[~active] = 0.0
    if strips == 1:
        right /= np.where(active, group.local[:, :, 0], 1.0)[..., None]
    else:
        touching = np.flatnonzero(active.any(axis=1))
        pair = active[touching, :, None] & active[touching, None, :]
        matrix = np.where(pair, group.local[touching], np.eye(strips))
        right[touching] = np.linalg.solve(matrix, right[touching])
    return _Eliminated(right[..., :-2], right[..., -2], right[..., -1])


def _penetration(step: _Step) -> float:
    return max((float(-w.min(initial=0.0)) for w in step.opening if w.size), default=0.0)


def _unresisted(problem: Problem, held: Array, scale: _Scale) -> str:
    worst = int(np.argmax(np.abs(held) * scale.motion))
    return (
        f"contact: nothing resists motion {worst} although it carries a load of {problem.load[worst]:g}; "
        "support it, or let a contact act on it"
    )
