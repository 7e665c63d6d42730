"""All contacts of a drive with friction, along a path of positions or loads; one normal and one tangential force each.

A contact sticks or slips as a whole. Its normal law is linearised as in `newton`; a change of tangential force moves
its surfaces by dh/dF of that law, ln(2/a) times the kernel at the current force, in Hertz contacts (Johnson, Contact
Mechanics, 7.2: the stiffness of a line contact that sticks). Pressing harder under a constant tangential force moves
nothing. Around that, Newton follows laws and poses; inside, `friction` finds who sticks.

Slip is counted from the last position: elastically, and by the mean of how motions slide there and here, so that a
closed path of motions leaves none.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem import complementarity as lcp
from trochoid.fem import friction as coulomb
from trochoid.fem.assembly import Assembly
from trochoid.fem.coupling import rubbing_coupling
from trochoid.fem.friction import Rubbed, Rubbing, System
from trochoid.fem.newton import FLOOR, ROUNDING, Point, convex, linearised, stable, turning
from trochoid.fem.pair import State
from trochoid.fem.position import solve_position
from trochoid.fem.rows import taken
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, IntArray

NEWTON = 40
SETTLED = 1e-10  # change of forces and motions, relative to the largest


@dataclass(frozen=True, slots=True)
class Drag:
    """What rubs: coefficients by family name (0 where none is given), and the smooth tangential compliance (c,) in m/N
    of round sides, by name; where none is given the family's normal one stands for it.
    """

    coefficients: Mapping[str, float]
    round_sides: Mapping[str, Array] | None = None

    def coefficient(self, name: str) -> float:
        """Return a family's coefficient."""
        return float(self.coefficients.get(name, 0.0))


@dataclass(frozen=True, slots=True)
class Dragged:
    """A position with friction, by family name: `states`, normal forces `force` (c,) and `tangential` ones (c,) in N on
    the first member along the normal turned by +90°, `slip` (c,) in m since the path began; `motion` (k,), `work` in J
    that friction took since the last position, the most solves and Newton steps.

    `elastic` and `slide` are what the next position must know: the smooth elastic tangential displacement (C,) and how
    motions slide (C, k).
    """

    states: dict[str, State]
    force: dict[str, Array]
    tangential: dict[str, Array]
    slip: dict[str, Array]
    motion: Array
    work: float
    solves: int
    iterations: int
    elastic: Array
    slide: Array


def drag(assemblies: Sequence[Assembly], rubs: Drag) -> list[Dragged]:
    """Follow a path of single positions (arrays without axis of positions) from one without friction forces, the first.

    Without any coefficient each is `position.solve_position`. Bodies must have been pressed tangentially. Raises
    NotConverged, with the number of the position as its row.
    """
    path: list[Dragged] = []
    for number, assembly in enumerate(assemblies):
        try:
            if not path or not any(rubs.coefficient(f.name) > 0 for f in assembly.families):
                path.append(_frictionless(assembly, rubs))
            else:
                path.append(step(assembly, rubs, path[-1]))
        except NotConverged as fault:
            raise NotConverged(f"position {number} of the path: {fault}", number) from fault
    return path


def step(assembly: Assembly, rubs: Drag, before: Dragged) -> Dragged:
    """Go to a position from where the last one ended, sticking and slipping on the way."""
    return _newton(assembly, rubs, before, None)


def running(assembly: Assembly, rubs: Drag, senses: Mapping[str, IntArray]) -> Dragged:
    """Return a position of a drive that runs: `senses` (c,) by family name is the sign of the speed at which the first
    member slides along the tangent past the second (0 where no family or sense is given: no friction).
    """
    before = _frictionless(assembly, rubs)
    given = [
        np.asarray(senses.get(f.name, np.zeros(len(f.kernel), dtype=np.intp))) for f in assembly.families
    ]
    if not any(rubs.coefficient(f.name) > 0 for f in assembly.families):
        return before
    return _newton(assembly, rubs, before, given)


def _newton(assembly: Assembly, rubs: Drag, before: Dragged, senses: Sequence[IntArray] | None) -> Dragged:
    motion = before.motion
    names = [f.name for f in assembly.families]
    forces = [before.force[n] for n in names]
    start = _memory(before, names)
    last, solves = start, 0
    size = max(float(f.max(initial=0.0)) for f in forces)
    for number in range(1, NEWTON + 1):
        states = _states(assembly, motion)
        system, turns = _system(assembly, rubs, before, states, forces, motion)
        begun = replace(last, slip=start.slip, motion=np.zeros_like(motion))
        found = _turned(system, turns, begun, senses, size)
        solves = max(solves, found.solves)
        new = [p[:, 0] for p in found.normal]
        largest = max(float(f.max(initial=0.0)) for f in new)
        pairs = zip(
            (*found.normal, *found.tangential), (*(f[:, None] for f in forces), *last.tangential), strict=True
        )
        change = max(float(np.abs(a - b).max(initial=0.0)) for a, b in pairs)
        arms = np.concatenate([s.arms for s in states])
        moved, far = (
            np.abs(arms @ found.motion).max(initial=0.0),
            np.abs(arms @ (motion + found.motion)).max(initial=0.0),
        )
        length, noise = _noise(states, system)
        forces, motion, last = new, motion + found.motion, found
        settled = change <= SETTLED * largest + noise and moved <= SETTLED * far + length
        if settled or largest <= noise:  # or nothing is left of the load but rounding
            return _ended(assembly, rubs, before, states, found, motion, solves, number)
    raise NotConverged(
        f"friction: forces still change by {change / (largest or 1.0):.1e} of the largest after {NEWTON} steps; take "
        "smaller steps along the path, or a smaller coefficient"
    )


def _turned(
    system: System, turns: Sequence[Array], begun: Rubbed, senses: Sequence[IntArray] | None, size: float
) -> Rubbed:
    """Solve with the stiffness of turning arms, with what of it keeps the problem convex when it must be."""
    for number, turn in enumerate(turns, start=1):
        turned = replace(system, springs=system.springs + turn)
        try:
            return coulomb.step(turned, begun, size) if senses is None else coulomb.run(turned, senses)
        except NotConverged:
            if number == len(turns):
                raise
    raise AssertionError("there is always a convex one")


def _noise(states: Sequence[State], system: System) -> tuple[float, float]:
    """Return what rounding of the coordinates leaves uncertain in a gap in m and in a force in N."""
    length = ROUNDING * max(float(np.abs(s.point).max(initial=0.0)) for s in states)
    return length, length / min(float(x.normal.diagonal.min(initial=np.inf)) for x in system.contacts)


def _frictionless(assembly: Assembly, rubs: Drag) -> Dragged:
    contact = solve_position(assembly)
    names = [f.name for f in assembly.families]
    force = {n: contact.touches[n].force for n in names}
    zero = {n: np.zeros_like(f) for n, f in force.items()}
    states = [contact.touches[n].state for n in names]
    elastic, slide = np.zeros(0), np.zeros((0, len(contact.motion)))
    if any(rubs.coefficient(n) > 0 for n in names):
        total = np.concatenate([*force.values(), *zero.values()])
        elastic, slide = _elastic(assembly, rubs, states, total), _slide(assembly, states, contact.motion)
    named = dict(zip(names, states, strict=True))
    return Dragged(named, force, zero, zero, contact.motion, 0.0, 1, int(contact.iterations), elastic, slide)


def _states(assembly: Assembly, motion: Array) -> list[State]:
    at = motion if assembly.follow else np.zeros_like(motion)
    return [taken(f.pair.at(at[None]), 0) for f in assembly.families]


def _slide(assembly: Assembly, states: Sequence[State], motion: Array) -> Array:
    """Return how motions slide all first members past the second along their tangents (C, k)."""
    at = (motion if assembly.follow else np.zeros_like(motion))[None]
    families = zip(assembly.families, states, strict=True)
    return np.concatenate([f.pair.sliding(taken(s, None), at)[0] for f, s in families])


def _coupling(assembly: Assembly, rubs: Drag, states: Sequence[State]) -> Array:
    """Return the smooth compliance (2C, 2C) in m/N between all contacts, normal and tangential."""
    families = assembly.families
    seated = [f.seated(taken(s, None)) for f, s in zip(families, states, strict=True)]
    total = rubbing_coupling(assembly.bodies, seated)[0]
    along = rubs.round_sides or {}
    more = np.concatenate([along.get(f.name, f.round_side) - f.round_side for f in families])
    own = len(more) + np.arange(len(more))
    total[own, own] += more
    return np.asarray(total)


def _elastic(assembly: Assembly, rubs: Drag, states: Sequence[State], total: Array) -> Array:
    """Return the smooth elastic tangential displacement (C,) in m under forces (2C,)."""
    count = len(total) // 2
    return np.asarray(_coupling(assembly, rubs, states)[count:] @ total)


def _system(
    assembly: Assembly,
    rubs: Drag,
    before: Dragged,
    states: Sequence[State],
    forces: Sequence[Array],
    motion: Array,
) -> tuple[System, list[Array]]:
    """Return the problem of the change from a motion, linearised at forces (c,), and what turning arms may add to its
    springs.
    """
    count = sum(len(s.gap) for s in states)
    coupling = _coupling(assembly, rubs, states)
    point = Point(*(taken((tuple(states), tuple(forces), motion), None)))
    plain = taken(linearised(assembly, point, coupling[None, :count, :count]), 0)
    slide = _slide(assembly, states, motion)
    since = 0.5 * (slide + before.slide) @ (motion - before.motion) - before.elastic
    size = max(float(f.max(initial=0.0)) for f in forces) or 1.0
    contacts, at = [], 0
    for family, state, force, normal in zip(assembly.families, states, forces, plain.groups, strict=True):
        slope = family.law_at(state).approach(np.maximum(force, FLOOR * size))[1]
        rows = slice(at, at + len(force))
        gap = since[rows] - slope * before.tangential[family.name]
        along = lcp.Group(slope[:, None, None], gap[:, None], -slide[rows, None])
        contacts.append(Rubbing(normal, along, rubs.coefficient(family.name)))
        at += len(force)
    return System(tuple(contacts), coupling, plain.springs, plain.load), _turns(assembly, point, plain)


def _turns(assembly: Assembly, point: Point, plain: lcp.Problem) -> list[Array]:
    """Return the stiffness (k, k) of turning arms, if the whole is stable with it, and its positive part."""
    turn = turning(assembly, point)
    side = tuple(np.where(f > 0, 0, -1)[..., None] for f in point.forces)
    nothing = np.zeros(1)
    at = lcp.Solution((), 0 * point.motion, side, nothing.astype(int), nothing, nothing)
    exact = lcp.tangents(taken(replace(plain, springs=plain.springs + turn[0]), None), at)
    return [turn[0], convex(turn)[0]] if stable(exact, 1e-6).all() else [convex(turn)[0]]


def _memory(before: Dragged, names: Sequence[str]) -> Rubbed:
    """Return the last position as a step's beginning; slip counts from there."""
    normal = tuple(before.force[n][:, None] for n in names)
    tangential = tuple(before.tangential[n][:, None] for n in names)
    sides = [np.where(p > 0, 0, -1) for p in normal] + [np.zeros(p.shape, dtype=np.intp) for p in normal]
    slip = tuple(np.zeros_like(p) for p in normal)
    return Rubbed(normal, tangential, slip, np.zeros_like(before.motion), tuple(sides), 0.0, 0, 0.0)


def _ended(
    assembly: Assembly,
    rubs: Drag,
    before: Dragged,
    states: Sequence[State],
    found: Rubbed,
    motion: Array,
    solves: int,
    iterations: int,
) -> Dragged:
    names = [f.name for f in assembly.families]
    force, pull, step_slip = (
        {n: x[:, 0] for n, x in zip(names, part, strict=True)}
        for part in (found.normal, found.tangential, found.slip)
    )
    work = -sum(float(np.sum(0.5 * (before.tangential[n] + pull[n]) * step_slip[n])) for n in names)
    total = np.concatenate([*force.values(), *pull.values()])
    slip = {n: before.slip[n] + step_slip[n] for n in names}
    return Dragged(
        dict(zip(names, states, strict=True)),
        force,
        pull,
        slip,
        motion,
        work,
        solves,
        iterations,
        _elastic(assembly, rubs, states, total),
        _slide(assembly, states, motion),
    )
