"""*Strips*: the pressure of every Hertz contact, resolved by strips of constant pressure on the same coupling."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem import complementarity as lcp
from trochoid.fem.assembly import Assembly, Contact, Family, Touch
from trochoid.fem.newton import Point, gap_from, linearised, problem_of, result, rounding
from trochoid.fem.pair import State
from trochoid.fem.rows import joined, taken
from trochoid.fem.strips import REACH, strip_centres, strip_unit
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, BoolArray, IntArray

WIDENINGS = 12  # of the strips, when pressure reaches their edge
SETTLED = 1e-10  # change of forces and motions, relative to the largest


def resolved(assembly: Assembly, level0: Contact, coupling: Array) -> Contact:
    """Give every Hertz contact its strips, wide enough for its force; the others keep their linearised laws.

    Forces and motion change by 1e-4 against level 0, so poses and laws are followed here too. Raises NotConverged.
    """
    touches = [level0.touches[f.name] for f in assembly.families]
    point = Point(tuple(t.state for t in touches), tuple(t.force for t in touches), level0.motion)
    rows, done = np.arange(len(level0.motion)), list[tuple[IntArray, Contact]]()
    iterations = level0.iterations
    for _ in range(WIDENINGS):
        problem, offsets, start = _strips(assembly, point, coupling)
        try:
            solution = lcp.solve_all(problem, start)
        except NotConverged as fault:
            raise NotConverged(str(fault), None if fault.row is None else int(rows[fault.row])) from fault
        moved = replace(point, motion=point.motion + solution.motion)
        length, noise = rounding(point, problem)
        spilt = [_spilt(x, p, noise) for x, p in zip(offsets, solution.forces, strict=True)]
        good = _settled(assembly, moved, solution.motion, length)
        stand = ~good
        good &= ~np.any([s.any(axis=1) for s in spilt], axis=0)
        if good.any():
            chosen = np.flatnonzero(good)
            part = taken(_Strips(moved, problem, solution, offsets), chosen)
            done.append((rows[chosen], _contact(assembly.rows(chosen), part, iterations[rows[chosen]])))
        if good.all():
            return joined(done)
        left = np.flatnonzero(~good)
        point = taken(_followed(assembly, moved, solution, spilt, stand), left)
        assembly, coupling, rows = assembly.rows(left), coupling[left], rows[left]
    raise NotConverged(
        f"contact: pressure still reaches the edge of its strips after {WIDENINGS} widenings; "
        "the surfaces conform, or bend within the contact, and strips on half-planes do not cover that",
        int(rows[0]),
    )


@dataclass(frozen=True, slots=True)
class _Strips:
    point: Point
    problem: lcp.Problem
    solution: lcp.Solution
    offsets: tuple[Array, ...]


def _spilt(offset: Array, strips: Array, noise: Array) -> BoolArray:
    """Return which contacts (n, c) carry at the edge of their strips, and more than rounding (n,)."""
    if offset.shape[2] == 0:
        return np.zeros(offset.shape[:2], dtype=bool)
    return np.asarray((strips[..., [0, -1]] > 0).any(axis=2) & (strips.sum(axis=2) > noise[:, None]))


def _settled(assembly: Assembly, point: Point, motion: Array, length: Array) -> BoolArray:
    """Return (n,) whether the last change of the motion moves no contact."""
    if not assembly.follow:
        return np.ones(len(motion), dtype=bool)
    arms = point.arms
    last, all_ = (
        np.abs(np.einsum("nck,nk->nc", arms, m)).max(axis=1, initial=0.0) for m in (motion, point.motion)
    )
    return np.asarray(last <= SETTLED * all_ + length)


def _followed(
    assembly: Assembly, point: Point, solution: lcp.Solution, spilt: Sequence[BoolArray], moved: BoolArray
) -> Point:
    """Return the point with the forces found, wider where pressure reached the edge, and gaps taken afresh."""
    totals = [p.sum(axis=2) for p in solution.forces]
    forces = tuple(
        np.where(wide, np.maximum(1.5 * f, p), p)
        for f, p, wide in zip(point.forces, totals, spilt, strict=True)
    )
    states = point.states
    if moved.any():
        states = tuple(
            f.pair.at(point.motion, s.parameter) for f, s in zip(assembly.families, states, strict=True)
        )
    return Point(states, forces, point.motion)


def _strips(
    assembly: Assembly, point: Point, coupling: Array
) -> tuple[lcp.Problem, tuple[Array, ...], lcp.Solution]:
    """Return the problem with strips, their offsets (n, c, m) per family (m = 0: not resolved), and a start for it.

    What a logarithm counts from, the length that all strips of a contact cover, acts on their total alone.
    """
    plain = linearised(assembly, point, coupling)
    groups, offsets, side, own = [], [], [], []
    for family, state, force, group in zip(
        assembly.families, point.states, point.forces, plain.groups, strict=True
    ):
        if family.law is not None:
            groups.append(group)
            offsets.append(np.zeros((*force.shape, 0)))
            side.append(np.where(force > 0, 0, -1)[..., None])
            own.append(np.zeros_like(force))
            continue
        half = _widths(family, state, force)
        offset = strip_centres() * (REACH * half)[..., None]
        gap = family.pair.gap_along(state, point.motion, offset)
        gap = gap + (gap_from(assembly, state, point.motion) - state.gap)[..., None]
        alike = lcp.Alike(strip_unit(), np.broadcast_to(family.kernel, force.shape))
        groups.append(lcp.Group(alike, gap, state.arms[:, :, None]))
        offsets.append(offset)
        side.append(np.where((np.abs(offset) < half[..., None]) & (force > 0)[..., None], 0, -1))
        own.append(-family.kernel * np.log(2 * REACH * half))
    total = coupling + np.concatenate(own, axis=1)[..., None] * np.eye(coupling.shape[1])
    problem = problem_of(assembly, tuple(groups), total, point.motion)
    nothing = np.zeros(len(point.motion))
    start = lcp.Solution((), np.zeros_like(point.motion), tuple(side), nothing.astype(int), nothing, nothing)
    return problem, tuple(offsets), start


def _widths(family: Family, state: State, force: Array) -> Array:
    """Return the half widths (n, c) that strips are laid for, in m."""
    most = force.max(axis=1, initial=0.0, keepdims=True)
    return family.line_at(state).reach(np.maximum(force, np.where(most > 0, 1e-6 * most, 1e-9)))


def _contact(assembly: Assembly, found: _Strips, iterations: IntArray) -> Contact:
    contact = result(assembly, found.point, found.problem, found.solution, 0)
    touches = {
        family.name: _touch(contact.touches[family.name], x, p)
        for family, x, p in zip(assembly.families, found.offsets, found.solution.forces, strict=True)
    }
    return replace(contact, touches=touches, iterations=iterations + 1)


def _touch(plain: Touch, offset: Array, strips: Array) -> Touch:
    """Return force, half width and peak of resolved contacts; a² is four times the variance of a Hertz pressure."""
    if offset.shape[2] == 0:
        return plain
    force = strips.sum(axis=2)
    whole = np.where(force > 0, force, 1.0)
    mean = (strips * offset).sum(axis=2) / whole
    variance = (strips * (offset - mean[..., None]) ** 2).sum(axis=2) / whole
    width = offset[..., 1] - offset[..., 0]
    return Touch(
        plain.state, force, 2 * np.sqrt(np.maximum(variance, 0.0)), strips.max(axis=2) / width, offset, strips
    )
