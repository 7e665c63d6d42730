"""All contacts of a drive at one position, solved together.

What comes in: pairs with their local laws, the tabulated compliances of the bodies they press, springs and
loads on the motions. Newton runs over the local laws and the poses at once: at each step the laws are
linearised, the gaps are taken afresh from the displaced curves, and the contact problem is solved exactly.
*Level 0* has one force per contact; *strips* resolves the pressure of the touching contacts afterwards, on
the same coupling.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem import complementarity as lcp
from trochoid.fem.compliance import Compliance, Weights
from trochoid.fem.laws import HertzLine, Law
from trochoid.fem.pair import Pair, Seat, State
from trochoid.fem.strips import REACH, STRIPS, strip_centres, strip_compliance
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array

NEWTON = 40
QUICK = 30  # pivots within which a step with turning arms must be found
WIDENINGS = 12  # of the strips, when pressure reaches their edge
SETTLED = 1e-10  # change of forces and motions, relative to the largest
PLACE = 1e-7  # of the coordinates: contacts that moved less keep their coupling, which varies over facets
FLOOR = 1e-9  # of the largest force: laws are linearised there at the least
ROUNDING = 1e-15  # of the coordinates: gaps are not known better
FAINT = 1e-12  # of the largest force: less is rounding
FREE = 1e-12  # of the coordinates: how little what nothing presses on must move
UNSTABLE = 1e-9  # of a motion's stiffness: less is rounding


@dataclass(frozen=True, slots=True)
class Family:
    """Contacts of one kind.

    `kernel` (c,) is the sum of 2/(πE') of both sides over the face width, `round_side` (c,) the smooth part
    in m/N of a side in closed form (a pin); `law` None means Hertz line contact with the pair's radius, which
    *strips* can resolve; with another law Hertz gives the pressure only.
    """

    name: str
    pair: Pair
    kernel: Array
    round_side: Array
    law: Law | None = None


@dataclass(frozen=True, slots=True)
class ElasticBody:
    """A body as contacts see it: its compliance per unit thickness and its face width in m."""

    compliance: Compliance
    width: float


@dataclass(frozen=True, slots=True)
class Assembly:
    """A drive at one position: families, bodies, springs (k, k) and loads (k,) on the motions.

    `follow`: gaps and arms follow the displaced poses; the classical hand calculation keeps those of the
    nominal pose.
    """

    families: tuple[Family, ...]
    bodies: tuple[ElasticBody, ...]
    springs: Array
    load: Array
    follow: bool = True


@dataclass(frozen=True, slots=True)
class Touch:
    """Result for one family: forces (c,) in N, half widths (c,) in m, and `peak` (c,) in N/m, the largest
    pressure times the face width.
    """

    state: State
    force: Array
    half_width: Array
    peak: Array


@dataclass(frozen=True, slots=True)
class Contact:
    """Result at one position: touches by family name, motion (k,), tangent stiffness (k, k), residuals."""

    touches: dict[str, Touch]
    motion: Array
    stiffness: Array
    imbalance: float
    penetration: float
    iterations: int
    solution: lcp.Solution


def solve_position(assembly: Assembly, resolve: bool = False, start: Contact | None = None) -> Contact:
    """Solve all contacts at one position; `resolve` gives the pressed contacts strips of pressure.

    Raises NotConverged.
    """
    motion = np.zeros(len(assembly.load)) if start is None else start.motion
    states = [f.pair.at(motion if assembly.follow else 0 * motion) for f in assembly.families]
    forces = (
        _guess(assembly, states)
        if start is None
        else [start.touches[f.name].force for f in assembly.families]
    )
    coupling = _coupling(assembly, states)
    solution = None if start is None else _beginning(assembly, start)
    for step in range(1, NEWTON + 1):
        problem = _linearised(assembly, states, coupling, forces, motion)
        solution = _stepped(problem, _turning(assembly, states, forces, motion), solution)
        new = [f[:, 0] for f in solution.forces]
        size = max(float(f.max(initial=0.0)) for f in new)
        change = max(float(np.abs(a - b).max(initial=0.0)) for a, b in zip(new, forces, strict=True))
        arms, (length, force) = _arms(states), _rounding(states, problem)
        steps = np.abs(arms @ solution.motion) if assembly.follow else np.zeros(len(arms))
        moved = float(steps.max(initial=0.0))
        pressed = float(steps[np.concatenate(new) > 0].max(initial=0.0))
        forces, motion = new, motion + solution.motion
        if (
            change <= SETTLED * size + force
            and pressed <= SETTLED * float(np.abs(arms @ motion).max()) + length
            and moved <= FREE / ROUNDING * length
        ):
            contact = _result(assembly, states, problem, solution, motion, step)
            return _resolved(assembly, contact, coupling) if resolve else contact
        solution = replace(solution, motion=np.zeros_like(motion))
        if moved > 0.0:
            states = [f.pair.at(motion, s.parameter) for f, s in zip(assembly.families, states, strict=True)]
        if moved > PLACE / ROUNDING * length:
            coupling = _coupling(assembly, states)
    raise NotConverged(
        f"contact: forces still change by {change / size:.1e} of the largest after {NEWTON} steps; "
        "reduce the clearance or the load, or start from a neighbouring position"
    )


def _guess(assembly: Assembly, states: Sequence[State]) -> list[Array]:
    """Return a first force for every contact: the load at its largest arm, shared by the contacts of a family."""
    lever = np.abs(_arms(states)).max(axis=0)
    size = float(np.divide(np.abs(assembly.load), lever, out=0 * lever, where=lever > 0).max(initial=0.0))
    return [np.full(len(f.kernel), size / len(f.kernel)) for f in assembly.families]


def _beginning(assembly: Assembly, start: Contact) -> lcp.Solution:
    """Return what touched at a neighbouring position, to begin with."""
    touching = tuple((start.touches[f.name].force > 0)[:, None] for f in assembly.families)
    return lcp.Solution((), np.zeros(len(assembly.load)), touching, 0, 0.0, 0.0)


def _arms(states: Sequence[State]) -> Array:
    return np.concatenate([s.arms for s in states])


def _rounding(states: Sequence[State], problem: lcp.Problem) -> tuple[float, float]:
    """Return what rounding of the coordinates leaves uncertain in a gap (m) and in a force (N)."""
    length = ROUNDING * max(float(np.abs(s.point).max(initial=0.0)) for s in states)
    least = min(float(g.local.min(initial=np.inf)) for g in problem.groups)
    return length, length / least


def _turning(assembly: Assembly, states: Sequence[State], forces: Sequence[Array], motion: Array) -> Array:
    """Return the stiffness (k, k) of all arms that turn with the motions under their forces."""
    total = np.zeros((len(motion), len(motion)))
    if assembly.follow:
        for family, state, force in zip(assembly.families, states, forces, strict=True):
            total += family.pair.turning(state, motion, force)
    return total


def _convex(stiffness: Array) -> Array:
    """Return the positive part of a symmetric matrix: with it each step stays a convex problem."""
    felt = np.flatnonzero(np.diag(stiffness))  # the other motions stay free, without rounding
    size = np.sqrt(np.abs(np.diag(stiffness)[felt]))  # metres and radians weigh alike
    values, vectors = np.linalg.eigh(stiffness[np.ix_(felt, felt)] / np.outer(size, size))
    shapes = size[:, None] * vectors
    result = np.zeros_like(stiffness)
    result[np.ix_(felt, felt)] = (shapes * np.maximum(values, 0.0)) @ shapes.T
    return result


def _law(family: Family, state: State) -> Law:
    return family.law if family.law is not None else HertzLine(family.kernel, state.radius)


def _linearised(
    assembly: Assembly, states: Sequence[State], coupling: Array, forces: Sequence[Array], motion: Array
) -> lcp.Problem:
    size = max((float(f.max(initial=0.0)) for f in forces), default=0.0) or 1.0
    groups = []
    for family, state, force in zip(assembly.families, states, forces, strict=True):
        at = np.maximum(force, FLOOR * size)
        approach, slope = _law(family, state).approach(at)
        gap = _gap(assembly, state, motion) + approach - slope * at
        groups.append(lcp.Group(slope[:, None, None], gap[:, None], state.arms[:, None, :]))
    return lcp.Problem(tuple(groups), coupling, assembly.springs, _load(assembly, motion))


def _stepped(problem: lcp.Problem, turning: Array, start: lcp.Solution | None) -> lcp.Solution:
    """Solve a Newton step with arms that turn, or with what of that keeps the problem convex when it must be."""
    if start is not None:
        exact = replace(problem, springs=problem.springs + turning)
        if _stable(lcp.tangent(exact, start), 1e-6):
            with suppress(NotConverged):
                return lcp.solve(exact, start, most=QUICK)
    return lcp.solve(replace(problem, springs=problem.springs + _convex(turning)), start)


def _stable(stiffness: Array, least: float) -> bool:
    """Return whether a stiffness resists every motion that it has a diagonal entry for, by `least` of that entry."""
    size = np.sqrt(np.maximum(np.diag(stiffness), 0.0))
    scale = np.divide(1.0, size, out=np.zeros_like(size), where=size > 0)
    unitless = stiffness * np.outer(scale, scale) + np.diag((size == 0).astype(float))
    return bool((np.diag(stiffness) >= 0).all() and np.linalg.eigvalsh(unitless).min() >= least)


def _gap(assembly: Assembly, state: State, motion: Array) -> Array:
    """Return the gaps after a motion; linear problems count from there, so that rounding stays small."""
    return state.gap if assembly.follow else np.asarray(state.gap - state.arms @ motion)


def _load(assembly: Assembly, motion: Array) -> Array:
    """Return the loads less what the springs take after a motion."""
    return np.asarray(assembly.load - assembly.springs @ motion)


def _coupling(assembly: Assembly, states: Sequence[State]) -> Array:
    """Assemble the smooth compliance between all contacts: through each body, and of the round sides."""
    counts = np.cumsum([0] + [len(s.gap) for s in states])
    total = np.diag(np.concatenate([f.round_side for f in assembly.families]))
    for number, body in enumerate(assembly.bodies):
        on = [
            i
            for i, family in enumerate(assembly.families)
            if family.pair.seat is not None and family.pair.seat.body == number
        ]
        if on:
            index = np.concatenate([np.arange(counts[i], counts[i + 1]) for i in on])
            total[np.ix_(index, index)] += _through(
                body, [assembly.families[i].pair.seat for i in on], [states[i] for i in on]
            )
    return total


def seat_coupling(assembly: Assembly, family: Family, motion: Array) -> Array:
    """Return the compliance (c, c) in m/N of one family's seat: smooth part of the body and of the round sides."""
    state, seat = family.pair.at(motion), family.pair.seat
    total = np.diag(family.round_side)
    return total if seat is None else total + _through(assembly.bodies[seat.body], [seat], [state])


def _through(body: ElasticBody, seats: Sequence[Seat | None], states: Sequence[State]) -> Array:
    weights = [
        seat.weights(state.place)
        for seat, state in zip(seats, states, strict=True)
        if seat is not None and state.place is not None
    ]
    points = np.concatenate([s.point for s in states])
    return body.compliance.between(Weights.joined(weights), points) / body.width


def _without_faint(solution: lcp.Solution, rounding: float) -> lcp.Solution:
    """Return a solution in which contacts whose force is rounding do not touch."""
    largest = max(float(f.sum(axis=1).max(initial=0.0)) for f in solution.forces)
    least = np.inf if largest <= rounding else FAINT * largest
    touching = [f.sum(axis=1, keepdims=True) > least for f in solution.forces]
    return replace(
        solution,
        forces=tuple(np.where(t, f, 0.0) for f, t in zip(solution.forces, touching, strict=True)),
        active=tuple(a & t for a, t in zip(solution.active, touching, strict=True)),
    )


def _result(
    assembly: Assembly,
    states: Sequence[State],
    problem: lcp.Problem,
    solution: lcp.Solution,
    motion: Array,
    iterations: int,
) -> Contact:
    touches, rounding = {}, _rounding(states, problem)[1]
    solution = _without_faint(solution, rounding)
    for family, state, force in zip(assembly.families, states, solution.forces, strict=True):
        total = force.sum(axis=1)
        half = HertzLine(family.kernel, state.radius).half_width(total)
        peak = np.divide(2 * total, np.pi * half, out=np.zeros_like(total), where=half > 0)
        touches[family.name] = Touch(state, total, half, peak)
    forces = [touches[f.name].force for f in assembly.families]
    stiffness = _tangent(assembly, problem, solution, _turning(assembly, states, forces, motion))
    size = max(rounding, *(float(f.max(initial=0.0)) for f in forces))
    seen = np.sqrt(np.maximum(np.diag(stiffness), 0.0) * min(float(g.local.min()) for g in problem.groups))
    scale = size * np.maximum(np.abs(_arms(states)).max(axis=0), seen)
    return Contact(
        touches,
        motion,
        stiffness,
        _imbalance(assembly, states, forces, motion, scale),
        solution.penetration,
        iterations,
        solution,
    )


def _tangent(assembly: Assembly, problem: lcp.Problem, solution: lcp.Solution, turning: Array) -> Array:
    """Return the tangent stiffness; where it says that a free motion stands on a crest, turning arms are left out."""
    exact = lcp.tangent(replace(problem, springs=assembly.springs + turning), solution)
    if _stable(exact, -UNSTABLE):
        return exact
    return lcp.tangent(replace(problem, springs=assembly.springs + _convex(turning)), solution)


def _imbalance(
    assembly: Assembly, states: Sequence[State], forces: Sequence[Array], motion: Array, scale: Array
) -> float:
    """Return the largest sum of all loads on a motion, relative to the largest force at the motion's arm.

    `scale` (k,) is the force that rounding leaves and, for each motion, the arm that its stiffness suggests.
    """
    arms, force = _arms(states), np.concatenate(forces)
    rest = np.abs(arms.T @ force + assembly.springs @ motion - assembly.load)
    relative = float((rest / scale).max(initial=0.0))
    return relative if relative > 1.0 or force.any() else 0.0


def _resolved(assembly: Assembly, level0: Contact, coupling: Array) -> Contact:
    """Give every Hertz contact its strips, wide enough for its force; the others keep their linearised laws.

    Forces and motion change by 1e-4 against level 0, so poses and laws are followed here too.
    """
    states = [level0.touches[f.name].state for f in assembly.families]
    forces = [level0.touches[f.name].force for f in assembly.families]
    motion = level0.motion
    for _ in range(WIDENINGS):
        problem, offsets, start = _strips(assembly, states, coupling, forces, motion)
        solution = lcp.solve(problem, start)
        spilt = [
            len(x) > 0 and bool((p[:, [0, -1]] > 0).any())
            for x, p in zip(offsets, solution.forces, strict=True)
        ]
        arms = _arms(states)
        motion = motion + solution.motion
        moved = float(np.abs(arms @ solution.motion).max(initial=0.0)) if assembly.follow else 0.0
        settled = (
            moved <= SETTLED * float(np.abs(arms @ motion).max(initial=0.0)) + _rounding(states, problem)[0]
        )
        if settled and not any(spilt):
            break
        new = [p.sum(axis=1) for p in solution.forces]
        forces = [
            np.maximum(1.5 * f, p) if wide else p for f, p, wide in zip(forces, new, spilt, strict=True)
        ]
        if not settled:
            states = [f.pair.at(motion, s.parameter) for f, s in zip(assembly.families, states, strict=True)]
    else:
        raise NotConverged(
            f"contact: pressure still reaches the edge of its strips after {WIDENINGS} widenings; "
            "the surfaces conform, which strips on one contact do not cover"
        )
    contact = _result(assembly, states, problem, solution, motion, level0.iterations + 1)
    touches = {
        family.name: _strip_touch(contact.touches[family.name], x, p)
        for family, x, p in zip(assembly.families, offsets, solution.forces, strict=True)
    }
    return replace(contact, touches=touches)


def _strips(
    assembly: Assembly, states: Sequence[State], coupling: Array, forces: Sequence[Array], motion: Array
) -> tuple[lcp.Problem, list[Array], lcp.Solution]:
    """Return the problem with strips, their offsets (c, m) per family (empty: not resolved), and a start for it."""
    base = _linearised(assembly, states, coupling, forces, motion)
    groups, offsets, active = [], [], []
    for family, state, force, plain in zip(assembly.families, states, forces, base.groups, strict=True):
        if family.law is not None:
            groups.append(plain)
            offsets.append(np.zeros(0))
            active.append((force > 0)[:, None])
            continue
        least = 1e-6 * float(force.max(initial=0.0)) or 1e-9
        half = HertzLine(family.kernel, state.radius).half_width(np.maximum(force, least))
        offset = strip_centres() * (REACH * half)[:, None]
        gap = (
            family.pair.gap_along(state, motion, offset)
            + (_gap(assembly, state, motion) - state.gap)[:, None]
        )
        local = strip_compliance(family.kernel, 2 * REACH * half / STRIPS)
        groups.append(lcp.Group(local, gap, np.repeat(state.arms[:, None, :], STRIPS, axis=1)))
        offsets.append(offset)
        active.append((np.abs(offset) < half[:, None]) & (force > 0)[:, None])
    problem = lcp.Problem(tuple(groups), coupling, assembly.springs, _load(assembly, motion))
    return problem, offsets, lcp.Solution((), np.zeros_like(motion), tuple(active), 0, 0.0, 0.0)


def _strip_touch(level0: Touch, offset: Array, strips: Array) -> Touch:
    """Return force, half width and peak of resolved contacts; a² is four times the variance of a Hertz pressure."""
    if len(offset) == 0:
        return level0
    force = strips.sum(axis=1)
    whole = np.where(force > 0, force, 1.0)
    mean = (strips * offset).sum(axis=1) / whole
    variance = (strips * (offset - mean[:, None]) ** 2).sum(axis=1) / whole
    width = offset[:, 1] - offset[:, 0]
    return Touch(level0.state, force, 2 * np.sqrt(variance), strips.max(axis=1) / width)
