"""One Newton step over local laws and poses: the linearised contact problem, its solution, and what follows from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem import complementarity as lcp
from trochoid.fem.assembly import Assembly, Contact, Touch
from trochoid.fem.pair import State
from trochoid.fem.rows import joined, taken
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, BoolArray

QUICK = 30  # pivots within which a step with turning arms must be found
FLOOR = 1e-9  # of the largest force: laws are linearised there at the least
ROUNDING = 1e-15  # of the coordinates: gaps are not known better
FAINT = 1e-12  # of the largest force: less is rounding
UNSTABLE = 1e-9  # of a motion's stiffness: less is rounding
AWAY = (
    "contact: members have moved so far that surfaces no longer face each other; what holds them is too soft for the "
    "load"
)


@dataclass(frozen=True, slots=True)
class Point:
    """Where the laws are linearised: `states` and `forces` (n, c) per family, `motion` (n, k)."""

    states: tuple[State, ...]
    forces: tuple[Array, ...]
    motion: Array

    @property
    def arms(self) -> Array:
        """All arms (n, C, k)."""
        return np.concatenate([s.arms for s in self.states], axis=1)

    @property
    def largest(self) -> Array:
        """The largest force of each position (n,)."""
        return np.asarray(np.max([f.max(axis=1, initial=0.0) for f in self.forces], axis=0))


def linearised(assembly: Assembly, point: Point, coupling: Array) -> lcp.Problem:
    """Return the contact problem in forces and in the change of the motion, so that rounding stays small."""
    size = point.largest
    floor = FLOOR * np.where(size > 0, size, 1.0)[:, None]
    groups = []
    for family, state, force in zip(assembly.families, point.states, point.forces, strict=True):
        at = np.maximum(force, floor)
        approach, slope = family.law_at(state).approach(at)
        gap = gap_from(assembly, state, point.motion) + approach - slope * at
        groups.append(lcp.Group(slope[..., None, None], gap[..., None], state.arms[:, :, None]))
    return problem_of(assembly, tuple(groups), coupling, point.motion)


def problem_of(
    assembly: Assembly, groups: tuple[lcp.Group, ...], coupling: Array, motion: Array
) -> lcp.Problem:
    """Return the problem of the change from a motion: loads less what the springs take there."""
    springs = np.broadcast_to(assembly.springs, (len(motion), *assembly.springs.shape))
    return lcp.Problem(groups, coupling, springs, assembly.load - motion @ assembly.springs)


def gap_from(assembly: Assembly, state: State, motion: Array) -> Array:
    """Return the gaps (n, c) after a motion."""
    if assembly.follow:
        return state.gap
    return np.asarray(state.gap - np.einsum("nck,nk->nc", state.arms, motion))


def stepped(problem: lcp.Problem, turning: Array, start: lcp.Solution | None) -> lcp.Solution:
    """Solve a Newton step with arms that turn, or with what of that keeps the problem convex when it must be."""
    soft = replace(problem, springs=problem.springs + convex(turning))
    if start is None:
        return lcp.solve_all(soft)
    exact = replace(problem, springs=problem.springs + turning)
    good = stable(lcp.tangents(exact, start), 1e-6)
    tried = np.flatnonzero(good)
    done = []
    if len(tried):
        quick = lcp.attempt(taken(exact, tried), taken(start, tried), most=QUICK)
        fine = np.array([i not in quick.faults for i in range(len(tried))])
        done.append((tried[fine], taken(quick.solution, np.flatnonzero(fine))))
        good[tried[~fine]] = False
    rest = np.flatnonzero(~good)
    if len(rest):
        done.append((rest, lcp.solve_all(taken(soft, rest), taken(start, rest))))
    return joined(done)


def turning(assembly: Assembly, point: Point) -> Array:
    """Return the stiffness (n, k, k) of all arms that turn with the motions under their forces."""
    count = point.motion.shape[1]
    total = np.zeros((len(point.motion), count, count))
    if assembly.follow:
        for family, state, force in zip(assembly.families, point.states, point.forces, strict=True):
            with np.errstate(
                invalid="ignore"
            ):  # members far out of place: `convex` refuses what is no number
                total += family.pair.turning(state, point.motion, force)
    return total


def convex(stiffness: Array) -> Array:
    """Return the positive part of symmetric matrices (n, k, k): with it each step stays a convex problem."""
    if not np.isfinite(stiffness).all():
        raise NotConverged(AWAY)
    own = np.einsum("nkk->nk", stiffness)
    felt = own != 0.0  # the other motions stay free, without rounding
    both = felt[:, :, None] & felt[:, None]
    size = np.sqrt(np.abs(np.where(felt, own, 1.0)))  # metres and radians weigh alike
    unit = size[:, :, None] * size[:, None]
    values, vectors = np.linalg.eigh(np.where(both, stiffness / unit, 0.0))
    shapes = size[..., None] * vectors
    return np.where(both, (shapes * np.maximum(values, 0.0)[:, None]) @ shapes.transpose(0, 2, 1), 0.0)


def stable(stiffness: Array, least: float) -> BoolArray:
    """Return whether stiffnesses resist every motion that has a diagonal entry, by `least` of that entry (n,)."""
    own = np.einsum("nkk->nk", stiffness)
    size = np.sqrt(np.maximum(own, 0.0))
    scale = np.divide(1.0, size, out=np.zeros_like(size), where=size > 0)
    unitless = stiffness * scale[:, :, None] * scale[:, None] + (size == 0)[..., None] * np.eye(size.shape[1])
    return np.asarray((own >= 0).all(axis=1) & (np.linalg.eigvalsh(unitless).min(axis=1) >= least))


def rounding(point: Point, problem: lcp.Problem) -> tuple[Array, Array]:
    """Return what rounding of the coordinates leaves uncertain in a gap (n,) in m and in a force (n,) in N."""
    size = np.max([np.abs(s.point).max(axis=(1, 2), initial=s.size) for s in point.states], axis=0)
    least = np.min([g.diagonal.min(axis=(1, 2), initial=np.inf) for g in problem.groups], axis=0)
    return ROUNDING * size, ROUNDING * size / least


def result(
    assembly: Assembly, point: Point, problem: lcp.Problem, solution: lcp.Solution, iterations: int
) -> Contact:
    """Return the contact that a solution of the linearised problem at `point` stands for; its motion is the point's."""
    noise = rounding(point, problem)[1]
    solution = _without_faint(solution, noise)
    touches = {}
    for family, state, force in zip(assembly.families, point.states, solution.forces, strict=True):
        total = force.sum(axis=2)
        line = family.line_at(state)
        half, peak = line.half_width(total), line.peak(total)
        empty = np.zeros((*total.shape, 0))
        touches[family.name] = Touch(state, total, half, peak, empty, empty)
    point = replace(point, forces=tuple(touches[f.name].force for f in assembly.families))
    stiffness = _tangents(problem, assembly, solution, turning(assembly, point))
    return Contact(
        touches,
        point.motion,
        stiffness,
        _imbalance(assembly, point, problem, stiffness, noise),
        solution.penetration,
        np.full(len(noise), iterations),
    )


def _without_faint(solution: lcp.Solution, noise: Array) -> lcp.Solution:
    """Return a solution in which contacts whose force is rounding do not touch."""
    totals = [f.sum(axis=2, keepdims=True) for f in solution.forces]
    largest = np.max([t.max(axis=(1, 2), initial=0.0) for t in totals], axis=0)
    least = np.where(largest <= noise, np.inf, FAINT * largest)[:, None, None]
    return replace(
        solution,
        forces=tuple(np.where(t > least, f, 0.0) for f, t in zip(solution.forces, totals, strict=True)),
        side=tuple(np.where(t > least, s, -1) for s, t in zip(solution.side, totals, strict=True)),
    )


def _tangents(problem: lcp.Problem, assembly: Assembly, solution: lcp.Solution, turn: Array) -> Array:
    """Return the tangent stiffness; where it says that a free motion stands on a crest, turning arms are left out."""
    exact = lcp.tangents(replace(problem, springs=assembly.springs + turn), solution)
    crest = ~stable(exact, -UNSTABLE)
    if crest.any():
        soft = lcp.tangents(replace(problem, springs=assembly.springs + convex(turn)), solution)
        exact = np.where(crest[:, None, None], soft, exact)
    return exact


def _imbalance(
    assembly: Assembly, point: Point, problem: lcp.Problem, stiffness: Array, noise: Array
) -> Array:
    """Return the largest sum of all loads on a motion (n,), relative to the largest force at the motion's arm.

    The arm is that of the contacts, or what the motion's stiffness suggests beside theirs.
    """
    arms, force = point.arms, np.concatenate(point.forces, axis=1)
    least = np.min([g.diagonal.min(axis=(1, 2), initial=np.inf) for g in problem.groups], axis=0)
    seen = np.sqrt(np.maximum(np.einsum("nkk->nk", stiffness), 0.0) * least[:, None])
    scale = np.maximum(noise, point.largest)[:, None] * np.maximum(
        np.abs(arms).max(axis=1, initial=0.0), seen
    )
    rest = np.einsum("nck,nc->nk", arms, force) + point.motion @ assembly.springs - assembly.load
    rest = np.abs(rest)
    relative = np.divide(rest, scale, out=np.where(rest > 0, np.inf, 0.0), where=scale > 0).max(
        axis=1, initial=0.0
    )
    return np.where((relative > 1.0) | force.any(axis=1), relative, 0.0)


def guess(assembly: Assembly, states: Sequence[State]) -> tuple[Array, ...]:
    """Return a first force for every contact: the load at its largest arm, shared by the contacts of a family."""
    lever = np.abs(np.concatenate([s.arms for s in states], axis=1)).max(axis=1)
    pushed = np.divide(np.abs(assembly.load), lever, out=np.zeros_like(lever), where=lever > 0)
    size = pushed.max(axis=1, initial=0.0)[:, None]
    return tuple(np.repeat(size / len(f.kernel), len(f.kernel), axis=1) for f in assembly.families)
