"""The contact problem of elastic bodies that may also move rigidly: find strip forces p and motions a with

    w = C p + g − R a ≥ 0,   p ≥ 0,   p·w = 0,   Rᵀp + K a = F,

or, where forces have an upper bound too (friction), w ≥ 0 at the lower one, w ≤ 0 at the upper one, and w = 0 between.
C is built of small dense blocks (the strips of one contact act on each other) and of a smooth coupling between the
*totals* of contacts; a block may also be a whole conforming contact. K holds springs that motions rest on (bearings),
zero for free motions. Many positions are solved side by side.

Proximal steps make every motion stiff (spring κ to the last a): the problem is then a linear complementarity problem
with a P-matrix. It is solved by a primal-dual active set (block pivoting, see `pivoting`) and, when that makes no
progress, by single pivots. κ falls step by step until the springs carry nothing.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem.equalities import missing, tangents
from trochoid.fem.pivoting import PIVOTS, Pivoted, pivot
from trochoid.fem.problem import Alike, Group, Problem, Solution, Unit
from trochoid.fem.rows import joined, taken
from trochoid.fem.scales import Scale, force_rounding, force_size, gap_size, scales
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, BoolArray, IntArray

__all__ = [
    "Alike",
    "Attempt",
    "Group",
    "Problem",
    "Solution",
    "Unit",
    "attempt",
    "solve",
    "solve_all",
    "tangent",
    "tangents",
]

STEPS = 60
ROUNDING = 1e-13  # of the force and gap scale: what may be left of the equations
SOFT = 1e-9  # of the stiffness of contacts: how soft proximal springs may become
PATIENCE = 12  # steps before what is left is laid to weak springs or to rounding
OWN = 1e-3  # of a motion's own weak spring: how soft the proximal spring becomes then
UNSURE = 1e-9  # of the force scale: where rounding leaves more, forces are not known well enough
STUCK = (
    "contact: no complementary solution after {} pivots; check that gaps and compliances are finite and the "
    "stiffness of the bodies differs by less than 1e9"
)
UNRESISTED = (
    "contact: nothing resists motion {} although it carries a load of {:g}; support it, or let a contact act "
    "on it"
)
UNSETTLED = (
    "contact: no equilibrium after {} steps; motion {} is still out of balance by {:.1e} of the largest force: what "
    "holds it may be too soft for the load"
)
HIDDEN = (
    "contact: a spring of {:.1e} N/m between members that move together leaves {:.1e} N to rounding, beside forces of "
    "{:.1e} N; take {:.0e} N/m at most, or more load"
)


def solve(problem: Problem, start: Solution | None = None, most: int = PIVOTS) -> Solution:
    """Solve one problem, whose arrays have no axis of positions; see `solve_all`."""
    begin = None if start is None else taken(start, None)
    return taken(solve_all(taken(problem, None), begin, most), 0)


def tangent(problem: Problem, solution: Solution) -> Array:
    """Return the stiffness (k, k) of one problem; see `tangents`."""
    return np.asarray(tangents(taken(problem, None), taken(solution, None))[0])


def solve_all(problem: Problem, start: Solution | None = None, most: int = PIVOTS) -> Solution:
    """Solve every position, from sides and motion of `start` when given, with at most so many pivots.

    Raises NotConverged, with the position's number, when a loaded motion is resisted by nothing, or the pivots run out.
    """
    tried = attempt(problem, start, most)
    if tried.faults and start is not None:  # a start is a hint, and never the reason to fail
        lost = np.array(sorted(tried.faults))
        fresh = attempt(taken(problem, lost), None, most)
        left = np.setdiff1d(np.arange(len(problem.load)), lost)
        solution = joined([(left, taken(tried.solution, left)), (lost, fresh.solution)])
        tried = Attempt(solution, {int(lost[i]): message for i, message in fresh.faults.items()})
    if tried.faults:
        row = min(tried.faults)
        raise NotConverged(tried.faults[row], row)
    return tried.solution


@dataclass(frozen=True, slots=True)
class Attempt:
    """A solution in which some positions may be wrong, and why."""

    solution: Solution
    faults: dict[int, str]


def attempt(problem: Problem, start: Solution | None, most: int = PIVOTS) -> Attempt:
    """Solve every position that can be solved."""
    scale, kappa = scales(problem)
    softest = np.minimum(scale.stiffness[:, None] / scale.motion**2 * SOFT, kappa)
    if start is None:
        side = tuple(np.where(np.isfinite(g.gap), 0, -1) for g in problem.groups)
        motion = np.zeros_like(problem.load)
    else:
        side, motion = start.side, start.motion
        kappa = np.maximum(kappa * 1e-6, softest)
    work = _Work(
        np.arange(len(motion)), problem, scale, kappa, softest, side, motion, np.zeros(len(motion), dtype=int)
    )
    done: list[tuple[IntArray, Solution]] = []
    faults: dict[int, str] = {}
    for step in range(STEPS):
        if step == PATIENCE:
            work = replace(work, softest=_own(work))
        found = pivot(work.problem, work.side, work.motion, work.kappa, work.scale, most)
        solution, settled, lost = _judged(work, found, patient=step < PATIENCE)
        for row in np.flatnonzero(lost):
            faults[int(work.rows[row])] = STUCK.format(most)
        finished = settled | lost
        if finished.any():
            done.append((work.rows[finished], taken(solution, np.flatnonzero(finished))))
        if finished.all():
            break
        work = taken(_softened(work, found), np.flatnonzero(~finished))
    else:
        left = np.flatnonzero(~finished)  # `work` holds no other any more, what was found last does
        done.append((work.rows, taken(solution, left)))
        for row, message in zip(work.rows, _reasons(work, taken(found, left)), strict=True):
            faults[int(row)] = message
    return Attempt(joined(done), faults)


@dataclass(frozen=True, slots=True)
class _Work:
    """Positions that are not solved yet."""

    rows: IntArray
    problem: Problem
    scale: Scale
    kappa: Array
    softest: Array
    side: tuple[IntArray, ...]
    motion: Array
    pivots: IntArray


def _judged(work: _Work, found: Pivoted, patient: bool) -> tuple[Solution, BoolArray, BoolArray]:
    """Return what was found, where the proximal springs carry nothing, and where there is no solution.

    Who is not `patient` any more takes for nothing what stiff springs leave to rounding.
    """
    held = np.abs(missing(work.problem, found.step)) * work.scale.motion
    size = force_size(work.scale, work.problem, found.step.forces)
    imbalance = held.max(axis=1, initial=0.0) / size
    unsure: Array | float = 0.0
    if not patient:
        unsure = force_rounding(work.problem, found.step) * work.scale.motion
        unsure = np.minimum(unsure, UNSURE * size[:, None])
    deepest = _penetration(found) / gap_size(work.scale, work.problem, found.step)
    pivots = work.pivots + found.pivots
    solution = Solution(found.step.forces, found.step.motion, found.side, pivots, imbalance, deepest)
    settled = (held <= ROUNDING * size[:, None] + unsure).all(axis=1)
    return solution, np.asarray(settled), found.lost


def _own(work: _Work) -> Array:
    """Return how soft the proximal springs (n, k) must become where a motion rests on a spring that is weaker still:
    they would hold it where it happens to be, and its spring pull it home by a little at each step.
    """
    own = np.einsum("nkk->nk", work.problem.springs)
    felt = own * work.scale.far[:, None] * work.scale.motion**2 > ROUNDING * work.scale.force[:, None]
    return np.where(felt, np.minimum(work.softest, OWN * own), work.softest)


def _softened(work: _Work, found: Pivoted) -> _Work:
    """Return the positions with the motions found, and softer springs where they moved little."""
    moved = (np.abs(found.step.motion - work.motion) / work.scale.motion).max(axis=1, initial=0.0)
    softer = np.where((moved < work.scale.far)[:, None], work.kappa * 1e-3, work.kappa)
    kappa, pivots = np.maximum(softer, work.softest), work.pivots + found.pivots
    motion = found.step.motion
    return _Work(work.rows, work.problem, work.scale, kappa, work.softest, found.side, motion, pivots)


def _penetration(found: Pivoted) -> Array:
    deepest = np.zeros(len(found.step.motion))
    for side, w in zip(found.side, found.step.opening, strict=True):
        deepest = np.maximum(deepest, np.where(side > 0, w, -w).max(axis=(1, 2), initial=0.0))
    return deepest


def _reasons(work: _Work, found: Pivoted) -> list[str]:
    """Say of each position which motion's load nothing carries, or that rounding hides what does."""
    held = np.abs(missing(work.problem, found.step)) * work.scale.motion
    lost = (force_rounding(work.problem, found.step) * work.scale.motion).max(axis=1)
    size = force_size(work.scale, work.problem, found.step.forces)
    own = np.einsum("nkk->nk", work.problem.springs)
    stiffest, felt = own.max(axis=1), _felt(work, found) | (own > 0.0)
    said = []
    for row, worst in enumerate(np.argmax(held, axis=1)):
        if UNSURE * size[row] < lost[row]:
            most = stiffest[row] * UNSURE * size[row] / lost[row]
            said.append(HIDDEN.format(stiffest[row], lost[row], size[row], most))
        elif felt[row, worst]:
            said.append(UNSETTLED.format(STEPS, worst, held[row, worst] / size[row]))
        else:
            said.append(UNRESISTED.format(worst, work.problem.load[row, worst]))
    return said


def _felt(work: _Work, found: Pivoted) -> BoolArray:
    """Return (n, k) which motions close a contact that is pressed."""
    pressed = np.zeros_like(work.problem.load)
    for group, force in zip(work.problem.groups, found.step.forces, strict=True):
        pressed += np.einsum("nck,nc->nk", np.abs(group.arms).max(axis=2), 1.0 * (force > 0).any(axis=2))
    return pressed > 0.0
