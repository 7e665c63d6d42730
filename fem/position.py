"""All contacts of a drive, solved together, at many positions side by side.

What comes in: pairs with their local laws, the tabulated compliances of the bodies they press, springs and loads on the
motions. Newton runs over the local laws and the poses at once: at each step the laws are linearised, the gaps are taken
afresh from the displaced curves, and the contact problem is solved exactly. *Level 0* has one force per contact;
*strips* resolves the pressure of the touching contacts afterwards, on the same coupling (see `pressure`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem import complementarity as lcp
from trochoid.fem.assembly import Assembly, Contact, Family, Touch
from trochoid.fem.coupling import ElasticBody, coupling
from trochoid.fem.newton import AWAY, ROUNDING, Point, guess, linearised, result, rounding, stepped, turning
from trochoid.fem.pair import State
from trochoid.fem.pressure import SETTLED, resolved
from trochoid.fem.rows import joined, taken
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, BoolArray, IntArray

__all__ = [
    "Assembly",
    "Contact",
    "ElasticBody",
    "Family",
    "Touch",
    "seat_coupling",
    "solve_position",
    "solve_positions",
]

NEWTON = 40
PLACE = 1e-7  # of the coordinates: contacts that moved less keep their coupling, which varies over facets
FREE = 1e-12  # of the coordinates: how little what nothing presses on must move


def solve_position(assembly: Assembly, resolve: bool = False, start: Contact | None = None) -> Contact:
    """Solve one position, whose arrays have no axis of positions; `start` is the solution of a neighbouring one.

    Raises NotConverged.
    """
    one = replace(assembly, load=assembly.load[None])
    return taken(solve_positions(one, resolve, None if start is None else taken(start, None)), 0)


def solve_positions(assembly: Assembly, resolve: bool = False, start: Contact | None = None) -> Contact:
    """Solve n positions, the rows of `assembly.load`; `resolve` gives the pressed contacts strips of pressure.

    `start` are solutions nearby. Raises NotConverged with the row of the position.
    """
    work = _begun(assembly, start)
    done: list[tuple[IntArray, Contact]] = []
    for step in range(1, NEWTON + 1):
        try:
            found = _newton(work)
            rows = np.flatnonzero(found.settled)
            if len(rows):
                done.append((work.rows[rows], _finished(work, found, rows, step, resolve)))
        except NotConverged as fault:
            row = None if fault.row is None else int(work.rows[fault.row])
            raise NotConverged(_reason(work, fault), row) from fault
        if found.settled.all():
            return joined(done)
        work = _moved(work, found, np.flatnonzero(~found.settled))
    raise NotConverged(
        f"contact: forces still change by {found.change.max():.1e} of the largest after {NEWTON} steps; "
        "reduce the clearance or the load, or start from a neighbouring position",
        int(work.rows[0]),
    )


@dataclass(frozen=True, slots=True)
class _Work:
    """Positions that are not settled yet, and where they stand."""

    rows: IntArray
    assembly: Assembly
    point: Point
    coupling: Array
    solution: lcp.Solution | None


@dataclass(frozen=True, slots=True)
class _Found:
    """A Newton step: problem and solution, the new motion, how far contacts moved (n,), what is settled (n,)."""

    problem: lcp.Problem
    solution: lcp.Solution
    motion: Array
    change: Array
    moved: Array
    place: Array
    settled: BoolArray


def _reason(work: _Work, fault: NotConverged) -> str:
    """Return why a step failed: what it says itself, unless members had left each other before."""
    return AWAY if fault.row is not None and _away(work.point)[fault.row] else str(fault)


def _away(point: Point) -> BoolArray:
    """Return (n,) whether contacts have moved by more than the members are large."""
    moved = np.abs(np.einsum("nck,nk->nc", point.arms, point.motion)).max(axis=1, initial=0.0)
    size = np.max([np.abs(s.point).max(axis=(1, 2), initial=s.size) for s in point.states], axis=0)
    return np.asarray(~(moved <= size))


def _begun(assembly: Assembly, start: Contact | None) -> _Work:
    motion = np.zeros_like(assembly.load) if start is None else start.motion
    at = motion if assembly.follow else np.zeros_like(motion)
    states = tuple(f.pair.at(at) for f in assembly.families)
    solution = None
    if start is None:
        forces = guess(assembly, states)
    else:
        forces = tuple(start.touches[f.name].force for f in assembly.families)
        side = tuple(np.where(f > 0, 0, -1)[..., None] for f in forces)
        nothing = np.zeros(len(motion))
        solution = lcp.Solution((), np.zeros_like(motion), side, nothing.astype(int), nothing, nothing)
    return _Work(
        np.arange(len(motion)), assembly, Point(states, forces, motion), _coupled(assembly, states), solution
    )


def _newton(work: _Work) -> _Found:
    try:
        with np.errstate(invalid="ignore"):  # no radius of curvature where members are far out of place
            problem = linearised(work.assembly, work.point, work.coupling)
            solution = stepped(problem, turning(work.assembly, work.point), work.solution)
    except np.linalg.LinAlgError as fault:
        raise NotConverged(AWAY) from fault
    new = [f[..., 0] for f in solution.forces]
    size = np.max([f.max(axis=1, initial=0.0) for f in new], axis=0)
    changes = [np.abs(a - b).max(axis=1, initial=0.0) for a, b in zip(new, work.point.forces, strict=True)]
    change = np.max(changes, axis=0)
    arms, (length, force) = work.point.arms, rounding(work.point, problem)
    motion = work.point.motion + solution.motion
    steps = np.abs(np.einsum("nck,nk->nc", arms, solution.motion)) * work.assembly.follow
    pressing = np.concatenate(new, axis=1) > 0
    moved = steps.max(axis=1, initial=0.0)
    pressed = np.where(pressing, steps, 0.0).max(axis=1, initial=0.0)
    far = np.abs(np.einsum("nck,nk->nc", arms, motion)).max(axis=1, initial=0.0)
    settled = (change <= SETTLED * size + force) & (pressed <= SETTLED * far + length)
    settled &= moved <= FREE / ROUNDING * length
    relative = np.divide(change, size, out=np.zeros_like(size), where=size > 0)
    return _Found(problem, solution, motion, relative, moved, PLACE / ROUNDING * length, settled)


def _finished(work: _Work, found: _Found, rows: IntArray, step: int, resolve: bool) -> Contact:
    assembly = work.assembly.rows(rows)
    point = replace(taken(work.point, rows), motion=found.motion[rows])
    contact = result(assembly, point, taken(found.problem, rows), taken(found.solution, rows), step)
    return resolved(assembly, contact, work.coupling[rows]) if resolve else contact


def _moved(work: _Work, found: _Found, rows: IntArray) -> _Work:
    """Return the positions that go on, their gaps taken afresh, and their coupling where contacts moved visibly."""
    assembly, states = work.assembly.rows(rows), taken(work.point.states, rows)
    motion, coupled = found.motion[rows], work.coupling[rows]
    if assembly.follow:
        states = tuple(f.pair.at(motion, s.parameter) for f, s in zip(assembly.families, states, strict=True))
        far = np.flatnonzero(found.moved[rows] > found.place[rows])
        if len(far):
            coupled[far] = _coupled(assembly.rows(far), taken(states, far))
    forces = tuple(f[rows][..., 0] for f in found.solution.forces)
    solution = replace(taken(found.solution, rows), motion=np.zeros_like(motion))
    return _Work(work.rows[rows], assembly, Point(states, forces, motion), coupled, solution)


def _coupled(assembly: Assembly, states: tuple[State, ...]) -> Array:
    seated = [f.seated(s) for f, s in zip(assembly.families, states, strict=True)]
    return coupling(assembly.bodies, seated)


def seat_coupling(assembly: Assembly, family: Family, motion: Array) -> Array:
    """Return the compliance (c, c) in m/N of one family's seat at a motion (k,): of the body and of the round sides."""
    return np.asarray(coupling(assembly.bodies, [family.seated(family.pair.at(motion[None]))])[0])
