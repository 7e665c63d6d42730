"""Contacts under a slowly changing load with friction: each sticks or slips, and what it does depends on the path.

A contact that sticks is a spring along the surface, whose logarithm is that across it, and whose rest the bodies have
tabulated, with what all contacts do to each other. It slips where that spring would pull with more than μN. At each
step of the load Newton's method runs over the local laws, the poses and who sticks and slips at once.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem.assembly import Assembly
from trochoid.fem.coupling import rubbing_coupling
from trochoid.fem.newton import ROUNDING, Point, linearised, turning
from trochoid.fem.position import PLACE, Contact
from trochoid.fem.stick_slip import Found, Linear, rows, solve, sought
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, BoolArray, IntArray

NEWTON = 20
LOOSE = 1e-2  # of the force at the largest load: what presses less after a reversal came through play
GROWTH = 8  # steps in which friction grows where it cannot be found at once
FAINT = 1e-10  # of the force at the largest load of the path: rounding
SETTLED = 1e-8  # change of the normal forces in a Newton step, relative to the largest
LOST = (
    "friction: no forces found that stick and slip as Coulomb's law says; take smaller coefficients of friction "
    "(up to 0.3 are meant)"
)


@dataclass(frozen=True, slots=True)
class Held:
    """Where n drives stand on their load path: contacts and motion, and the way (n, r) that each rubbing contact slips.

    `coupling` (n, 2C, 2C) of all contacts there, as the bodies have tabulated it; `along` (n, r) is the force in N on
    the first body against its sliding along the tangent, of the families with friction in order; `stretch` (n, r) in m
    how far bodies have yielded along the tangent (without the logarithm); `lost` (n,) in J is what friction has taken
    so far; `size` (n, 1) in N are the largest forces of the path, and those below `faint` (n, 1) are nothing on it.
    """

    point: Point
    coupling: Array
    along: Array
    stretch: Array
    way: IntArray
    lost: Array
    size: Array
    faint: Array


def begun(assembly: Assembly, coefficients: Mapping[str, float]) -> Held:
    """Return the drives before any load, in their nominal places; `coefficients` by family.

    `assembly` has the largest loads of the path.
    """
    motion = np.zeros_like(assembly.load)
    states = tuple(f.pair.at(motion) for f in assembly.families)
    nothing = tuple(np.zeros_like(s.gap) for s in states)
    count = len(_rubs(assembly, coefficients)[0])
    none = np.zeros((len(motion), count))
    lever = np.concatenate([np.abs(s.arms) for s in states], axis=1).max(axis=1)
    largest = np.divide(np.abs(assembly.load), lever, out=np.zeros_like(lever), where=lever > 0)
    size = largest.max(axis=1, keepdims=True)
    place = max(float(np.abs(s.point).max(initial=0.0)) for s in states)
    noise = ROUNDING * place / min(float(f.kernel.min()) for f in assembly.families)
    way, lost = none.astype(np.intp), np.zeros(len(motion))
    faint = np.maximum(FAINT * size, noise)
    point = Point(states, nothing, motion)
    return Held(point, _coupled(assembly, point), none, none, way, lost, size, faint)


def smooth(found: Contact, assembly: Assembly) -> Point:
    """Return drives that were solved without friction as points of a path."""
    touches = [found.touches[f.name] for f in assembly.families]
    return Point(tuple(t.state for t in touches), tuple(t.force for t in touches), found.motion)


def landed(assembly: Assembly, before: Held, coefficients: Mapping[str, float], point: Point) -> Held:
    """Go where small loads lead without friction, after a play or before any load: friction under them is nothing."""
    count, rubs = point.arms.shape[1], _rubs(assembly, coefficients)[0]
    coupled = _coupled(assembly, point)
    cross = -coupled[:, :count, count + rubs]
    stretch = np.einsum("ncr,nc->nr", cross, np.concatenate(point.forces, axis=1))
    none = np.zeros_like(before.along)
    way = np.zeros_like(before.way)
    return replace(before, point=point, coupling=coupled, along=none, stretch=stretch, way=way)


def reversed_to(assembly: Assembly, before: Held, coefficients: Mapping[str, float], free: Point) -> Held:
    """Go to small loads the other way round; `free` is where they lead without friction. Raises NotConverged.

    A loose drive goes through its play and lands on other flanks. A preloaded one keeps what holds it; where that is
    not found at once, friction grows in steps from all contacts slipping.
    """
    if (free.largest <= LOOSE * before.size[:, 0]).all():
        return landed(assembly, before, coefficients, free)
    try:
        return loaded(assembly, before, coefficients)
    except NotConverged:
        start: tuple[Point, IntArray | None] = free, None
    for share in np.linspace(0.0, 1.0, GROWTH + 1)[1:]:
        part = {name: float(share) * mu for name, mu in coefficients.items()}
        held = loaded(assembly, before, part, start)
        start = held.point, held.way
    return held


def loaded(
    assembly: Assembly,
    before: Held,
    coefficients: Mapping[str, float],
    start: tuple[Point, IntArray | None] | None = None,
) -> Held:
    """Go to the loads of `assembly` from where the drives stand. Raises NotConverged with the row of the position.

    `start` is where to begin the search and the way that contacts slip there (None: all slip), instead of `before`.
    """
    point, guess = (before.point, before.way) if start is None else start
    touch = np.concatenate(point.forces, axis=1) > 0
    coupled = before.coupling if start is None else _coupled(assembly, point)
    for _ in range(NEWTON):
        problem = _linear(assembly, before, point, coupled, coefficients)
        way = np.sign(problem.pulled).astype(np.intp) * touch[:, problem.rubs] if guess is None else guess
        least = np.minimum(problem.own.min(axis=1), problem.soft.min(axis=1))
        wild = least <= 0  # a contact as wide as the drive: the search has gone astray
        if wild.any():
            raise NotConverged(LOST, int(np.argmax(wild)))
        found = _solved(problem, np.concatenate(point.forces, axis=1), touch, way)
        if not np.isfinite(found.motion).all():
            raise NotConverged(LOST, int(np.argmin(np.isfinite(found.motion).all(axis=1))))
        touch, guess = found.touch, found.way
        change = np.abs(found.normal - np.concatenate(point.forces, axis=1)).max(axis=1)
        change = change / (found.normal.max(axis=1) + before.faint[:, 0] / SETTLED)
        last, point = point, _moved(assembly, point, found)
        if (found.settled & (change <= SETTLED)).all():
            return _arrived(replace(before, coupling=coupled), point, problem, found)
        if assembly.follow and _far(last, found):
            coupled = _coupled(assembly, point)
    raise NotConverged(LOST, int(np.argmax(np.where(found.settled, change, np.inf))))


def _solved(problem: Linear, normal: Array, touch: BoolArray, way: IntArray) -> Found:
    """Solve; where the guess leads nowhere, begin with limits of friction from the last normal forces (n, C)."""
    found = solve(problem, touch, way)
    lost = np.flatnonzero(~found.settled)
    if not len(lost):
        return found
    touch, way = found.touch.copy(), found.way.copy()
    part = rows(problem, lost)
    touch[lost], way[lost] = sought(part, normal[lost], touch[lost], way[lost])
    return solve(problem, touch, way)


def _rubs(assembly: Assembly, coefficients: Mapping[str, float]) -> tuple[IntArray, Array]:
    """Return which contacts have friction (r,), in the order of families, and their coefficients (r,)."""
    own = [np.full(len(f.kernel), coefficients.get(f.name, np.nan)) for f in assembly.families]
    every = np.concatenate(own)
    rubs = np.flatnonzero(np.isfinite(every))
    return rubs, every[rubs]


def _linear(
    assembly: Assembly, before: Held, point: Point, coupled: Array, coefficients: Mapping[str, float]
) -> Linear:
    """Linearise laws and poses; the logarithm of a contact along its surface is that across it."""
    count = point.arms.shape[1]
    problem = linearised(assembly, point, coupled[:, :count, :count])
    own = np.concatenate([g.diagonal[..., 0] for g in problem.groups], axis=1)
    rubs, mu = _rubs(assembly, coefficients)
    pair = count + rubs
    along = coupled[:, pair[:, None], pair] + own[:, rubs, None] * np.eye(len(rubs))
    at = point.motion if assembly.follow else np.zeros_like(point.motion)
    slides = np.concatenate(
        [
            f.pair.sliding(s, at)
            for f, s in zip(assembly.families, point.states, strict=True)
            if f.name in coefficients
        ],
        axis=1,
    )
    slid = np.einsum("nrk,nk->nr", slides, point.motion - before.point.motion)
    return Linear(
        own,
        np.concatenate([g.gap[..., 0] for g in problem.groups], axis=1),
        point.arms,
        coupled[:, :count, :count],
        rubs,
        mu,
        along,
        -coupled[:, :count, pair],  # friction pulls against the tangent
        slid + own[:, rubs] * before.along + before.stretch,
        slides,
        problem.springs + turning(assembly, point),
        problem.load,
        before.faint,
    )


def _moved(assembly: Assembly, point: Point, found: Found) -> Point:
    motion, states = point.motion + found.motion, point.states
    if assembly.follow:
        states = tuple(f.pair.at(motion, s.parameter) for f, s in zip(assembly.families, states, strict=True))
    ends = np.cumsum([f.shape[1] for f in point.forces])[:-1]
    pressed = np.where(found.touch, np.maximum(found.normal, 0.0), 0.0)
    return Point(states, tuple(np.split(pressed, ends, axis=1)), motion)


def _far(point: Point, found: Found) -> bool:
    """Return whether contacts moved so far that their coupling, which varies over facets, must be read afresh."""
    size = PLACE * max(float(np.abs(s.point).max()) for s in point.states)
    return bool(np.abs(np.einsum("nck,nk->nc", point.arms, found.motion)).max() > size)


def _coupled(assembly: Assembly, point: Point) -> Array:
    """Return the compliance (n, 2C, 2C) between normal and tangential forces of all contacts."""
    seated = [f.seated(s) for f, s in zip(assembly.families, point.states, strict=True)]
    return rubbing_coupling(assembly.bodies, seated)


def _arrived(before: Held, point: Point, problem: Linear, found: Found) -> Held:
    """Return where the drives stand now.

    What slips on took its mean force times the slip; what has turned round or come loose slipped with its last force.
    """
    stretch = problem.stretch(found.normal, found.along)
    slip = problem.pulled + np.einsum("nrk,nk->nr", problem.slides, found.motion) - stretch
    force = np.where(found.way == before.way, 0.5 * (found.along + before.along), found.along)
    lost = before.lost + np.where(found.way != 0, force * slip, 0.0).sum(axis=1)
    smooth_part = stretch - problem.own[:, problem.rubs] * found.along
    return Held(point, before.coupling, found.along, smooth_part, found.way, lost, before.size, before.faint)
