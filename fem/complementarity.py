"""The contact problem of elastic bodies that may also move rigidly: find strip forces p and motions a with

    w = C p + g − R a ≥ 0,   p ≥ 0,   p·w = 0,   Rᵀp + K a = F.

C is built of small dense blocks (the strips of one contact act on each other) and of a smooth coupling
between the *totals* of contacts; a block may also be a whole conforming contact. K holds springs that motions
rest on (bearings), zero for free motions.

Proximal steps make every motion stiff (spring κ to the last a): the problem is then a linear complementarity
problem with a P-matrix. It is solved by a primal-dual active set (block pivoting) and, when that makes no
progress, by Dantzig's single pivots, which take few steps where few strips touch. κ falls step by step until
the springs carry nothing. What rounding then leaves (a stiff contact beside a soft one) is refined away.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, BoolArray

BLOCK_PIVOTS = 10  # without progress, before single pivots
PIVOTS = 4000
STEPS = 60
TOLERANCE = 1e-12
ROUNDING = 1e-13  # of the force and gap scale: what is left of the equations, before they are refined
REFINEMENTS = 3


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
    """Strip forces per group (c, m) in N, `motion` (k,), pivots, and residuals relative to the scales of force and gap.

    `imbalance` is what Rᵀp + K a misses of F, `penetration` the deepest w below zero.
    """

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


def solve(problem: Problem, start: Solution | None = None, most: int = PIVOTS) -> Solution:
    """Solve the contact problem, from the active set and motion of `start` when given, with at `most` so many pivots.

    Raises NotConverged when a loaded motion is resisted by nothing, or the pivots run out.
    """
    scale, kappa = _scales(problem)
    motion = np.zeros(len(problem.load)) if start is None else start.motion.copy()
    active = (
        [np.isfinite(g.gap) & (g.gap < np.inf) for g in problem.groups]
        if start is None
        else [a.copy() for a in start.active]
    )
    softest = np.minimum(scale.stiffness / scale.motion**2 * 1e-9, kappa)
    if start is not None:
        kappa = np.maximum(kappa * 1e-6, softest)
    pivots = 0
    for _ in range(STEPS):
        anchor = motion
        step, active, used = _lcp(problem, active, anchor, kappa, scale, most)
        pivots += used
        motion = step.motion
        held = _missing(problem, step)
        imbalance = scale.of_force(problem, held, step)
        if imbalance <= ROUNDING:
            deepest = _penetration(step) / scale.length(problem, step)
            return Solution(tuple(step.forces), motion, tuple(active), pivots, imbalance, deepest)
        moved = float(np.max(np.abs(motion - anchor) / scale.motion, initial=0.0))
        kappa = kappa * 1e-3 if moved < scale.far else kappa
        kappa = np.maximum(kappa, softest)
    raise NotConverged(_unresisted(problem, held, scale))


@dataclass(frozen=True, slots=True)
class _Scale:
    force: float
    gap: float
    stiffness: float
    far: float  # a step that no contact of this problem could resist
    motion: Array  # motion of each kind that moves the contact by one unit of length

    def of_force(self, problem: Problem, load: Array, step: _Step) -> float:
        """Return loads on the motions relative to the problem's load, or to what the contacts carry if that is more."""
        carried = np.zeros(len(load))
        for group, force in zip(problem.groups, step.forces, strict=True):
            carried += np.einsum("cmk,cm->k", np.abs(group.arms), np.abs(force))
        largest = float((carried * self.motion).max(initial=0.0))
        return float(np.abs(load * self.motion).max(initial=0.0)) / max(self.force, largest)

    def length(self, problem: Problem, step: _Step) -> float:
        """Return the length that w is small against: the largest |g − R a|."""
        apart = [
            np.abs(np.where(np.isfinite(g.gap), g.gap, 0.0) - g.arms @ step.motion) for g in problem.groups
        ]
        return max(self.gap, *(float(a.max(initial=0.0)) for a in apart))


def _scales(problem: Problem) -> tuple[_Scale, Array]:
    """Sizes of force, gap and stiffness, and the first proximal springs: soft enough that the load closes every gap."""
    arms = np.concatenate([g.arms.reshape(-1, g.arms.shape[-1]) for g in problem.groups])
    compliance = np.concatenate([np.einsum("cii->ci", g.local).ravel() for g in problem.groups])
    typical = float(np.median(compliance[compliance > 0])) if np.any(compliance > 0) else 1.0
    lever = _levers(np.abs(arms).max(axis=0, initial=0.0), np.diag(problem.springs))
    unit = 1.0 / np.where(lever > 0, lever, 1.0)
    gaps = np.concatenate([g.gap[np.isfinite(g.gap)] for g in problem.groups])
    reach = float(np.ptp(gaps)) if len(gaps) else 0.0
    force = float(np.abs(problem.load * unit).max(initial=0.0))
    gap = max(float(np.abs(gaps).max(initial=0.0)), typical * force)
    if force == 0.0:
        force = gap / typical if gap > 0 else 1.0
    gap = gap or typical * force
    distance = 10 * (reach + typical * force)
    far = 1e3 * (gap + float(compliance.max(initial=0.0)) * force)
    return _Scale(force, gap, 1 / typical, far, unit), force / distance / unit**2


def _levers(arms: Array, springs: Array) -> Array:
    """Return the largest arm (k,) of each motion; where contacts have none, what its spring suggests beside others."""
    held = (springs > 0) & (arms > 0)
    if not held.any():
        return arms
    return np.maximum(arms, np.sqrt(np.maximum(springs, 0.0) * np.median(arms[held] ** 2 / springs[held])))


def _lcp(
    problem: Problem, active: list[BoolArray], anchor: Array, kappa: Array, scale: _Scale, most: int
) -> tuple[_Step, list[BoolArray], int]:
    """Solve the complementarity problem with proximal springs by block pivoting, then by single pivots."""

    def solved(touching: Sequence[BoolArray]) -> _Step:
        return _refined(
            problem, touching, _equalities(problem, touching, anchor, kappa), anchor, kappa, scale
        )

    best, patience, pivots = np.inf, BLOCK_PIVOTS, 0
    while patience > 0:
        step, pivots = solved(active), pivots + 1
        bad = _violations(problem, step, active, scale)
        count = sum(int(b.sum()) for b in bad)
        if count == 0:
            return step, active, pivots
        best, patience = (count, BLOCK_PIVOTS) if count < best else (best, patience - 1)
        active = [a ^ b for a, b in zip(active, bad, strict=True)]
    return _one_by_one(problem, solved, scale, pivots, most)


def _one_by_one(
    problem: Problem,
    solved: Callable[[Sequence[BoolArray]], _Step],
    scale: _Scale,
    pivots: int,
    most: int,
) -> tuple[_Step, list[BoolArray], int]:
    """Press the deepest strip until it just touches, let go whichever comes free on the way, and so on (Dantzig)."""
    active = [np.zeros(g.gap.shape, dtype=bool) for g in problem.groups]
    step, pivots = solved(active), pivots + 1
    while pivots < most:
        waiting = [np.where(a, np.inf, w) for a, w in zip(active, step.opening, strict=True)]
        group = int(np.argmin([w.min(initial=np.inf) for w in waiting]))
        if waiting[group].min(initial=np.inf) >= -TOLERANCE * scale.length(problem, step):
            return step, active, pivots
        active[group].ravel()[np.argmin(waiting[group])] = True
        forces = step.forces
        while pivots < most:
            step, pivots = solved(active), pivots + 1
            forces, freed = _freed_first(active, forces, step.forces)
            if freed is None:
                break
            active[freed[0]].ravel()[freed[1]] = False
    raise NotConverged(
        f"contact: no complementary solution after {most} pivots; check that gaps and compliances are finite and the "
        "stiffness of the bodies differs by less than 1e9"
    )


def _freed_first(
    active: Sequence[BoolArray], before: Sequence[Array], after: Sequence[Array]
) -> tuple[list[Array], tuple[int, int] | None]:
    """Go from one set of forces towards another until a force vanishes; return the forces there, its (group, strip)."""
    share, freed = 1.0, None
    for number, (a, p, q) in enumerate(zip(active, before, after, strict=True)):
        falling = np.flatnonzero((a & (q < 0)).ravel())
        if len(falling):
            reached = p.ravel()[falling] / (p.ravel()[falling] - q.ravel()[falling])
            if reached.min() < share:
                share, freed = float(reached.min()), (number, int(falling[np.argmin(reached)]))
    return [p + share * (q - p) for p, q in zip(before, after, strict=True)], freed


def _violations(problem: Problem, step: _Step, active: Sequence[BoolArray], scale: _Scale) -> list[BoolArray]:
    limit = TOLERANCE * scale.length(problem, step)
    pull = TOLERANCE * max(scale.force, *(float(p.max(initial=0.0)) for p in step.forces))
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
    shares = _split(problem, problem.coupling @ total)
    forces = [e.arms @ motion - e.gap - e.one * s[:, None] for e, s in zip(eliminated, shares, strict=True)]
    return _Step(forces, motion, _opening(problem, forces, motion, shares))


def _split(problem: Problem, contacts: Array) -> list[Array]:
    """Cut a value per contact (C,) into groups."""
    return np.split(contacts, np.cumsum([len(g.gap) for g in problem.groups])[:-1])


def _opening(
    problem: Problem, forces: Sequence[Array], motion: Array, shares: Sequence[Array]
) -> list[Array]:
    """Return w per group; `shares` is what all contacts together press each one open by."""
    return [
        np.einsum("cij,cj->ci", g.local, p) + g.gap + s[:, None] - g.arms @ motion
        for g, p, s in zip(problem.groups, forces, shares, strict=True)
    ]


def _refined(
    problem: Problem, active: Sequence[BoolArray], step: _Step, anchor: Array, kappa: Array, scale: _Scale
) -> _Step:
    """Solve with the same matrix for what rounding left of the equations, until it is nothing."""
    for _ in range(REFINEMENTS):
        left = [np.where(a, w, 0.0) for a, w in zip(active, step.opening, strict=True)]
        unmet = max((float(np.abs(w).max(initial=0.0)) for w in left), default=0.0)
        missing = _missing(problem, step) - kappa * (step.motion - anchor)
        settled = unmet <= ROUNDING * scale.length(problem, step)
        if settled and scale.of_force(problem, missing, step) <= 0.1 * ROUNDING:
            break
        groups = tuple(replace(g, gap=w) for g, w in zip(problem.groups, left, strict=True))
        rest = replace(problem, groups=groups, load=missing)
        change = _equalities(rest, active, np.zeros_like(kappa), kappa)
        forces = [a + b for a, b in zip(step.forces, change.forces, strict=True)]
        motion = step.motion + change.motion
        shares = _split(problem, problem.coupling @ np.concatenate([p.sum(axis=1) for p in forces]))
        step = _Step(forces, motion, _opening(problem, forces, motion, shares))
    return step


def _missing(problem: Problem, step: _Step) -> Array:
    """Return F − Rᵀp − K a."""
    carried = problem.springs @ step.motion
    for group, force in zip(problem.groups, step.forces, strict=True):
        carried = carried + np.einsum("cmk,cm->k", group.arms, force)
    return np.asarray(problem.load - carried)


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
