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

from dataclasses import dataclass

import numpy as np

from trochoid.fem.equalities import missing, opened, tangents
from trochoid.fem.pivoting import PIVOTS, Pivoted, pivot
from trochoid.fem.problem import Alike, Group, Problem, Solution, Unit
from trochoid.fem.rows import joined, taken
from trochoid.fem.scales import Scale, force_size, gap_size, scales
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
STUCK = (
    "contact: no complementary solution after {} pivots; check that gaps and compliances are finite and the "
    "stiffness of the bodies differs by less than 1e9"
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
    softest = np.minimum(scale.stiffness[:, None] / scale.motion**2 * 1e-9, kappa)
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
    for _ in range(STEPS):
        found = pivot(work.problem, work.side, work.motion, work.kappa, work.scale, most)
        solution, settled, lost = _judged(work, found)
        for row in np.flatnonzero(lost):
            faults[int(work.rows[row])] = STUCK.format(most)
        finished = settled | lost
        if finished.any():
            done.append((work.rows[finished], taken(solution, np.flatnonzero(finished))))
        if finished.all():
            break
        work = taken(_softened(work, found), np.flatnonzero(~finished))
    else:
        done.append((work.rows, taken(solution, np.flatnonzero(~finished))))
        for row, message in zip(work.rows, _unresisted(work), strict=True):
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


def _judged(work: _Work, found: Pivoted) -> tuple[Solution, BoolArray, BoolArray]:
    """Return what was found, where the proximal springs carry nothing, and where there is no solution."""
    held = missing(work.problem, found.step)
    size = force_size(work.scale, work.problem, found.step.forces)
    imbalance = np.abs(held * work.scale.motion).max(axis=1, initial=0.0) / size
    deepest = _penetration(found) / gap_size(work.scale, work.problem, found.step)
    pivots = work.pivots + found.pivots
    solution = Solution(found.step.forces, found.step.motion, found.side, pivots, imbalance, deepest)
    return solution, np.asarray(imbalance <= ROUNDING), found.lost


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


def _unresisted(work: _Work) -> list[str]:
    """Name each position's motion whose load nothing carries."""
    zero = [np.zeros_like(g.gap) for g in work.problem.groups]
    held = missing(work.problem, opened(work.problem, zero, work.motion))
    worst = np.argmax(np.abs(held) * work.scale.motion, axis=1)
    return [
        f"contact: nothing resists motion {i} although it carries a load of {load[i]:g}; "
        "support it, or let a contact act on it"
        for i, load in zip(worst, work.problem.load, strict=True)
    ]
