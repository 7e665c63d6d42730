"""Who touches: block pivoting, and single pivots where that makes no progress.

All strips on the wrong side change sides at once; that nearly always ends after a few steps. A position that stops
improving goes on alone from no contact at all: the strip that violates most is let go of its bound, and whichever
reaches a bound on the way there is held (a primal active set, finite because the problem is convex).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem.equalities import Held, Step, missing, opened, solve_held
from trochoid.fem.problem import Group, Problem
from trochoid.fem.rows import joined, taken
from trochoid.fem.scales import Scale, force_size, gap_size
from trochoid.kinematics.types import Array, BoolArray, IntArray

BLOCK_PIVOTS = 10  # without progress, before single pivots
PIVOTS = 4000
TOLERANCE = 1e-12
ROUNDING = 1e-13  # of the force and gap scale: what is left of the equations before they are refined
REFINEMENTS = 3


@dataclass(frozen=True, slots=True)
class Pivoted:
    """A step, the strips' sides, the pivots (n,) it took, and positions `lost` (n,) that ran out of them."""

    step: Step
    side: tuple[IntArray, ...]
    pivots: IntArray
    lost: BoolArray


@dataclass(frozen=True, slots=True)
class _Work:
    rows: IntArray
    problem: Problem
    scale: Scale
    anchor: Array
    kappa: Array
    side: tuple[IntArray, ...]
    best: Array
    patience: IntArray


def pivot(
    problem: Problem,
    side: tuple[IntArray, ...],
    anchor: Array,
    kappa: Array,
    scale: Scale,
    most: int = PIVOTS,
) -> Pivoted:
    """Solve the complementarity problem with proximal springs `kappa` to `anchor` (n, k), from the sides given."""
    count = len(anchor)
    rows = np.arange(count)
    start = np.full(count, np.inf), np.full(count, BLOCK_PIVOTS)
    work = _Work(rows, problem, scale, anchor, kappa, side, *start)
    done: list[tuple[IntArray, Pivoted]] = []
    used = 0
    while len(work.rows):
        step, used = _solved(work, work.side), used + 1
        change = _changes(work, step, work.side)
        bad = sum(c.astype(bool).sum(axis=(1, 2)) for c in change)
        good = bad == 0
        if good.any():
            chosen = np.flatnonzero(good)
            pivots = np.full(len(chosen), used)
            part = Pivoted(
                taken(step, chosen), taken(work.side, chosen), pivots, np.zeros(len(chosen), dtype=bool)
            )
            done.append((work.rows[good], part))
        better = bad < work.best
        patience = np.where(better, BLOCK_PIVOTS, work.patience - 1)
        for row in np.flatnonzero(~good & (patience <= 0)):
            done.append((work.rows[[row]], _one_by_one(taken(work, np.array([row])), used, most)))
        moved = tuple(s + c for s, c in zip(work.side, change, strict=True))
        work = replace(work, side=moved, best=np.minimum(bad, work.best), patience=patience)
        left = np.flatnonzero(~good & (patience > 0))
        work = work if len(left) == len(good) else taken(work, left)
    return joined(done)


def _one_by_one(work: _Work, used: int, most: int) -> Pivoted:
    """Let the strip go that violates most, hold whichever reaches a bound on the way, and so on (one position)."""
    low = tuple(_bound(g, -1) for g in work.problem.groups)
    side = tuple(np.where(np.isfinite(b), -1, 1) for b in low)
    step, used, lost = _solved(work, side), used + 1, False
    while True:
        limit = TOLERANCE * float(gap_size(work.scale, work.problem, step)[0])
        waiting = [np.where(s == 0, np.inf, -s * w) for s, w in zip(side, step.opening, strict=True)]
        group = int(np.argmin([w.min(initial=np.inf) for w in waiting]))
        if waiting[group].min(initial=np.inf) >= -limit:
            break
        side[group].ravel()[np.argmin(waiting[group])] = 0
        forces = step.forces
        while used < most:
            step, used = _solved(work, side), used + 1
            forces, reached = _first_bound(work.problem, side, forces, step.forces)
            if reached is None:
                break
            side[reached[0]].ravel()[reached[1]] = reached[2]
        if used >= most:
            lost = True
            break
    return Pivoted(step, side, np.array([used]), np.array([lost]))


def _first_bound(
    problem: Problem, side: Sequence[IntArray], before: Sequence[Array], after: Sequence[Array]
) -> tuple[tuple[Array, ...], tuple[int, int, int] | None]:
    """Go from one set of forces towards another until one reaches a bound: forces there, its (group, strip, side)."""
    share, reached = 1.0, None
    for number, (group, s, p, q) in enumerate(zip(problem.groups, side, before, after, strict=True)):
        for sign in (-1, 1):
            bound = _bound(group, sign)
            beyond = np.flatnonzero(((s == 0) & (sign * (q - bound) > 0)).ravel())
            if len(beyond):
                start, end, stop = (np.broadcast_to(x, q.shape).ravel()[beyond] for x in (p, q, bound))
                part = (stop - start) / np.where(end == start, 1.0, end - start)
                if part.min() < share:
                    share = max(float(part.min()), 0.0)
                    reached = number, int(beyond[np.argmin(part)]), sign
    return tuple(p + share * (q - p) for p, q in zip(before, after, strict=True)), reached


def _bound(group: Group, sign: int) -> Array:
    given = group.lower if sign < 0 else group.upper
    if given is not None:
        return given
    return np.zeros_like(group.gap) if sign < 0 else np.full_like(group.gap, np.inf)


def _changes(work: _Work, step: Step, sides: Sequence[IntArray]) -> list[IntArray]:
    """Return how each strip's side must change: −1 or 1 where it is wrong, else 0."""
    limit = TOLERANCE * gap_size(work.scale, work.problem, step)[:, None, None]
    largest = np.max([np.abs(p).max(axis=(1, 2), initial=0.0) for p in step.forces], axis=0)
    pull = TOLERANCE * np.maximum(work.scale.force, largest)[:, None, None]
    found = []
    for group, side, p, w in zip(work.problem.groups, sides, step.forces, step.opening, strict=True):
        low = 0.0 if group.lower is None else group.lower
        change = ((side < 0) & (w < -limit)).astype(np.intp)
        change -= (side == 0) & (p < low - pull)
        if group.upper is not None:
            change -= (side > 0) & (w > limit)
            change += (side == 0) & (p > group.upper + pull)
        found.append(change)
    return found


def _solved(work: _Work, side: Sequence[IntArray]) -> Step:
    """Solve with these sides; then again for what rounding left of the equations, where that is something."""
    problem = work.problem
    touching = tuple(s == 0 for s in side)
    fixed = tuple(_fixed(g, s) for g, s in zip(problem.groups, side, strict=True))
    step = solve_held(problem, Held(touching, fixed), work.anchor, work.kappa)
    for _ in range(REFINEMENTS):
        left = tuple(np.where(a, w, 0.0) for a, w in zip(touching, step.opening, strict=True))
        lack = missing(problem, step) - work.kappa * (step.motion - work.anchor)
        unmet = np.max([np.abs(w).max(axis=(1, 2), initial=0.0) for w in left], axis=0)
        bad = unmet > ROUNDING * gap_size(work.scale, problem, step)
        size = force_size(work.scale, problem, step.forces)
        bad |= np.abs(lack * work.scale.motion).max(axis=1, initial=0.0) > 0.1 * ROUNDING * size
        if not bad.any():
            break
        groups = tuple(
            replace(g, gap=w, lower=None, upper=None) for g, w in zip(problem.groups, left, strict=True)
        )
        rest = replace(problem, groups=groups, load=lack)
        change = solve_held(
            rest, Held(touching, (None,) * len(groups)), np.zeros_like(work.anchor), work.kappa
        )
        some = bad[:, None]
        forces = [
            p + np.where(some[..., None], q, 0.0) for p, q in zip(step.forces, change.forces, strict=True)
        ]
        step = opened(problem, forces, step.motion + np.where(some, change.motion, 0.0))
    return step


def _fixed(group: Group, side: IntArray) -> Array | None:
    """Return the forces of strips on a bound, zero for the others; None when all are zero."""
    if group.lower is None and group.upper is None:
        return None
    low, high = _bound(group, -1), _bound(group, 1)
    return np.where(side < 0, low, np.where(side > 0, high, 0.0))
