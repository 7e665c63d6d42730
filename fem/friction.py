"""Coulomb friction between elastic bodies that may also move rigidly, step by step along a path of loads.

Every rubbing contact has normal strips p ≥ 0 and tangential strips |q| ≤ μp on the same places. q pulls the first body
along its tangent (the outward normal turned by +90°); the slip is how far its surface has moved along that tangent past
the second's: elastically, C_tt q + C_tn p, and rigidly. A strip sticks when its slip stays what it was before the step,
and slips with q = ±μp against the change otherwise; what is not pressed slips freely. Slip and forces at the end of a
step are all that the next one must know.

A step begins with what touched, stuck and slipped before, as a linear problem whose strips change their status until
all conditions hold (`coulomb`). Where that leads nowhere, the contact problem with bounds b on friction (Tresca;
`complementarity` solves it for certain) gives a better guess, and b = μp the next bounds. What meets all conditions to
1e-9 is taken; at large μ bounds and pressures may not settle: then the step is refused.

Strips of one contact act on each other normally and tangentially by the same kernel, and not across, as on half-planes
of like materials (Dundurs' β = 0); for unlike ones that is an approximation. Totals of contacts act in both ways.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem import complementarity as lcp
from trochoid.fem.coulomb import Balance, Status, judged, settle
from trochoid.fem.rubbing import Rubbing, System, bounded, dragged, flat, shaped, side_by_side, zeros
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, IntArray

__all__ = ["Rubbed", "Rubbing", "System", "run", "step"]

ROUNDS = 60  # of bounds, before a step is refused
DAMPED = 15  # rounds after which bounds follow pressure by half
ACCEPTED = 1e-9  # violation of any condition, relative


@dataclass(frozen=True, slots=True)
class Rubbed:
    """Where a step ended: strip forces `normal`, `tangential` in N and `slip` in m, each (c, m) per group of contacts
    (zero where nothing rubs), and `motion` (k,).

    `sides`: where each normal strip is (0 touching, −1 open), then which way each tangential one slips (q = ±μp), 0 if
    it sticks. `work` in J is what friction took: mean force times change of slip in the step; round a closed loop it is
    the external work. `solves` counts contact problems and linear problems, `residual` is the largest violation.
    """

    normal: tuple[Array, ...]
    tangential: tuple[Array, ...]
    slip: tuple[Array, ...]
    motion: Array
    sides: tuple[IntArray, ...]
    work: float
    solves: int
    residual: float


def step(system: System, before: Rubbed | None = None, size: float = 0.0) -> Rubbed:
    """Go to the loads and gaps of `system` from where the last step ended (None: unloaded, nothing slipped yet).

    `size` in N is the largest force of the path so far, if `before` does not hold it: conditions are met relative to
    it. Without friction this is `complementarity.solve`. Raises NotConverged where no state is found that meets
    Coulomb's conditions to 1e-9.
    """
    if not any(x.friction > 0 for x in system.contacts):
        return _frictionless(system, before)
    slip = zeros(system) if before is None else before.slip
    begun = np.zeros(sum(s.size for s in slip)) if before is None else flat(before.normal)
    whole = side_by_side(system, slip, None, max(size, float(begun.max(initial=0.0))))
    bound = whole.friction * begun
    start, best, solves = None, np.inf, 0
    if before is not None:
        start = _start(system, before)
        found = settle(whole, _read(before.sides), before.motion)
        best, solves = found.residual, found.solves
        if best <= ACCEPTED:
            return _ended(system, before, slip, found, solves)
    for number in range(ROUNDS):
        tresca = lcp.solve(bounded(system, slip, bound), start)
        status, force = _status(system, tresca), _forces(system, tresca)
        found = settle(whole, status, tresca.motion)
        solves += 1 + found.solves
        plain = judged(whole, status, force, tresca.motion)
        found = found if found.residual <= ACCEPTED else plain
        if found.residual <= ACCEPTED:
            return _ended(system, before, slip, found, solves)
        best, start = min(best, found.residual), tresca
        share = 1.0 if number < DAMPED else 0.5
        bound = bound + share * (whole.friction * force[: len(bound)] - bound)
    raise NotConverged(
        _refused(system, best, "in this step; take smaller steps of load, or a smaller coefficient")
    )


def run(system: System, senses: Sequence[IntArray], before: Rubbed | None = None) -> Rubbed:
    """Return the balance while every contact slides: `senses` (c,) per group is the sign of the sliding speed of the
    first body's surface along t past the second's, 0 where it does not slide (no friction force then).

    Slip is not followed (it goes on); `work` is zero. Raises NotConverged as `step` does.
    """
    if not any(x.friction > 0 for x in system.contacts):
        return _frictionless(system, before)
    zero = zeros(system)
    sense = flat(
        [np.repeat(np.asarray(s)[:, None], z.shape[1], axis=1) for s, z in zip(senses, zero, strict=True)]
    )
    whole = side_by_side(system, zero, sense.astype(np.intp))
    force, best, solves = np.zeros(len(sense)), np.inf, 0
    start = None if before is None else _start(system, before, tangential=False)
    for number in range(ROUNDS):
        pressed = lcp.solve(dragged(system, force), start)
        touch = np.concatenate([(s == 0).ravel() for s in pressed.side])
        found = settle(whole, Status(touch, -whole.sense * (whole.friction > 0)), pressed.motion)
        solves += 1 + found.solves
        if found.residual <= ACCEPTED:
            return replace(_ended(system, None, zero, found, solves), slip=zero, work=0.0)
        best, start = min(best, found.residual), pressed
        share = 1.0 if number < DAMPED else 0.5
        force = force + share * (-whole.sense * whole.friction * flat(pressed.forces) - force)
    raise NotConverged(
        _refused(system, best, "while sliding; the contacts may lock themselves at this coefficient")
    )


def _frictionless(system: System, before: Rubbed | None) -> Rubbed:
    normal = tuple(x.normal for x in system.contacts)
    count = sum(g.gap.shape[0] for g in normal)
    problem = lcp.Problem(normal, system.coupling[:count, :count], system.springs, system.load)
    found = lcp.solve(problem, None if before is None else _start(system, before, tangential=False))
    zero = zeros(system)
    sides = (*found.side, *(z.astype(np.intp) for z in zero))
    residual = max(float(found.imbalance), float(found.penetration))
    return Rubbed(found.forces, zero, zero, found.motion, sides, 0.0, 1, residual)


def _status(system: System, tresca: lcp.Solution) -> Status:
    """Read who touches, sticks and slips: at the lower bound q = −b, at the upper one q = b."""
    count = len(system.contacts)
    rest = iter(tresca.side[count:])
    way = [
        next(rest) if x.friction > 0 else np.zeros_like(s)
        for x, s in zip(system.contacts, tresca.side, strict=False)
    ]
    return _read((*tresca.side[:count], *way))


def _forces(system: System, tresca: lcp.Solution) -> Array:
    """Return all forces (2m,), normal ones first; none tangentially where nothing rubs."""
    count = len(system.contacts)
    rest = iter(tresca.forces[count:])
    pairs = zip(system.contacts, tresca.forces[:count], strict=True)
    return flat(
        [*tresca.forces[:count], *(next(rest) if x.friction > 0 else np.zeros_like(p) for x, p in pairs)]
    )


def _read(sides: Sequence[IntArray]) -> Status:
    count = len(sides) // 2
    touch = np.concatenate([(s == 0).ravel() for s in sides[:count]])
    return Status(touch, np.concatenate([w.ravel() for w in sides[count:]]))


def _start(system: System, before: Rubbed, tangential: bool = True) -> lcp.Solution:
    """Return where to begin the contact problem with given friction or bounds on it."""
    count = len(system.contacts)
    rubs = [
        s for s, x in zip(before.sides[count:], system.contacts, strict=True) if tangential and x.friction > 0
    ]
    nothing = np.array(0.0)
    return lcp.Solution((), before.motion, (*before.sides[:count], *rubs), np.array(0), nothing, nothing)


def _ended(
    system: System, before: Rubbed | None, old: Sequence[Array], found: Balance, solves: int
) -> Rubbed:
    count = len(found.force) // 2
    normal, tangential = shaped(system, found.force[:count]), shaped(system, found.force[count:])
    status = found.status
    sticks = status.touch & (status.way == 0)
    moved = shaped(system, np.where(sticks, 0.0, found.opening[count:]))
    change = [np.where(x.friction > 0, s, 0.0) for x, s in zip(system.contacts, moved, strict=True)]
    slip = tuple(o + c for o, c in zip(old, change, strict=True))
    first = zeros(system) if before is None else before.tangential
    work = -sum(float(np.sum(0.5 * (a + b) * c)) for a, b, c in zip(first, tangential, change, strict=True))
    sides = [np.where(t, 0, -1) for t in shaped(system, status.touch)]
    sides += list(shaped(system, status.way))
    return Rubbed(normal, tangential, slip, found.motion, tuple(sides), work, solves, found.residual)


def _refused(system: System, best: float, where: str) -> str:
    largest = max(x.friction for x in system.contacts)
    return (
        f"friction: no forces found that obey Coulomb's law with μ = {largest:g} {where} "
        f"(nearest: violated by {best:.1e} of the largest)"
    )
