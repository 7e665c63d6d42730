"""The contact problem of the oracle: every facet that may be pressed is an unknown of one dense block.

Gaps and arms are taken afresh from the displaced curves until the motions settle.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem.complementarity import Group, Problem, solve
from trochoid.fem.facing import Facing
from trochoid.fem.laws import Law
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, BoolArray

STEPS = 60
SETTLED = 1e-11  # of the largest way that a contact has gone
ROUNDING = 4e-15  # of the coordinates: gaps are not known better
FLOOR = 1e-9  # of the largest force: laws are linearised there at the least


@dataclass(frozen=True, slots=True)
class Unknowns:
    """Facets before one circle; `law` (of a single unknown) adds what the finite elements do not have."""

    facing: Facing
    law: Law | None = None

    @property
    def count(self) -> int:
        """Number of facets."""
        return len(self.facing.points)


@dataclass(frozen=True, slots=True)
class ResolvedProblem:
    """Contacts in order, their `compliance` (M, M) in m/N over all facets, `springs` (k, k) and `load` (k,) on the
    motions.
    """

    contacts: tuple[Unknowns, ...]
    compliance: Array
    springs: Array
    load: Array


@dataclass(frozen=True, slots=True)
class Resolved:
    """Facet forces (m,) in N of every contact, motion (k,), tangent stiffness (k, k); `imbalance` of the loads on a
    motion and `penetration` relative to the largest load of a motion and to the largest elastic displacement.
    """

    forces: tuple[Array, ...]
    motion: Array
    stiffness: Array
    imbalance: float
    penetration: float
    steps: int


def solve_resolved(problem: ResolvedProblem, motion: Array) -> Resolved:
    """Solve from a motion (k,); raises NotConverged."""
    force, found = np.ones(len(problem.compliance)), None
    rounding = ROUNDING * max(contact.facing.size for contact in problem.contacts)
    for step in range(1, STEPS + 1):
        local, gap, arms = _linearised(problem, motion, force)
        group = Group(local[None], gap[None], arms[None])
        load = problem.load - problem.springs @ motion
        start = None if found is None else replace(found, motion=np.zeros_like(motion))
        found = solve(Problem((group,), np.zeros((1, 1)), problem.springs, load), start)
        change = np.abs(found.forces[0][0] - force).max(initial=0.0)
        force, motion = found.forces[0][0], motion + found.motion
        moved, way = (float(np.abs(arms @ a).max(initial=0.0)) for a in (found.motion, motion))
        lawless = all(contact.law is None for contact in problem.contacts)
        if moved <= SETTLED * way + rounding and (lawless or change <= SETTLED * force.max(initial=0.0)):
            return _result(problem, force, found.active[0][0], motion, step)
    raise NotConverged(
        f"resolved contact: the motions still change by {moved / way:.1e} of their size after {STEPS} steps; "
        "start from a neighbouring position or reduce the load"
    )


def _linearised(problem: ResolvedProblem, motion: Array, force: Array) -> tuple[Array, Array, Array]:
    """Return compliance with the slopes of the laws (M, M), gaps (M,) less what the slopes take, arms (M, k)."""
    found = [contact.facing.gap(motion) for contact in problem.contacts]
    gap, arms = np.concatenate([f[0] for f in found]), np.concatenate([f[1] for f in found])
    local, first = problem.compliance.copy(), 0
    least = FLOOR * max(float(force.max(initial=0.0)), 1e-300)
    for contact in problem.contacts:
        if contact.law is not None:
            at = np.maximum(force[first : first + 1], least)
            approach, slope = contact.law.approach(at)
            gap[first] += approach[0] - slope[0] * at[0]
            local[first, first] += slope[0]
        first += contact.count
    return local, gap, arms


def _result(problem: ResolvedProblem, force: Array, active: BoolArray, motion: Array, steps: int) -> Resolved:
    local, gap, arms = _linearised(problem, motion, force)
    split = np.cumsum([contact.count for contact in problem.contacts])[:-1]
    forces = tuple(np.split(force, split))
    carried = np.linalg.solve(local[np.ix_(active, active)], arms[active])
    stiffness = problem.springs + arms[active].T @ carried
    for contact, part in zip(problem.contacts, forces, strict=True):
        stiffness = stiffness + contact.facing.turning(motion, part)
    rest = np.abs(arms.T @ force + problem.springs @ motion - problem.load)
    scale = np.abs(arms).T @ force + np.abs(problem.load)
    pressed = local @ force
    opening = pressed + gap
    return Resolved(
        forces,
        motion,
        0.5 * (stiffness + stiffness.T),
        float(np.divide(rest, scale, out=np.zeros_like(rest), where=scale > 0).max(initial=0.0)),
        float(-opening.min(initial=0.0)) / max(float(np.abs(pressed).max(initial=0.0)), 1e-300),
        steps,
    )


def half_width(force: Array, offset: Array) -> float:
    """Return the half width in m of a Hertz pressure with the second moment of these forces (m,) at `offset` (m,)."""
    total = float(force.sum())
    if total <= 0.0:
        return 0.0
    mean = float(force @ offset) / total
    return float(2 * np.sqrt(force @ (offset - mean) ** 2 / total))


def peak(force: Array, length: Array) -> float:
    """Return the largest line load per arc length in N/m, by the parabola whose means over three facets are theirs."""
    mean = force / length
    top = int(np.argmax(mean))
    if top in (0, len(mean) - 1) or mean[top] <= 0.0:
        return float(mean[top])
    before, here, after = mean[top - 1 : top + 2]
    bend, slope = before - 2 * here + after, 0.5 * (after - before)
    return float(here - bend / 24 - (0.5 * slope**2 / bend if bend < 0 else 0.0))
