"""All contacts of rollers and rim together, slice by slice, at many positions side by side.

Newton runs over laws and pose at once, and the complementarity core solves each step exactly: each roller is a contact
with its slices as strips.  There contacts act on each other through their totals; what that mean leaves out between
the slices of pressed contacts is put into the gaps and follows the forces from step to step.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, replace

import numpy as np

from trochoid.fem import complementarity as lcp
from trochoid.fem.cone_assembly import ConeAssembly, ConeContact
from trochoid.fem.cone_elastic import Elastic, beside, elastic_at, updated, whole, yielded
from trochoid.fem.cone_law import FAINT
from trochoid.fem.cone_pair import ConeState
from trochoid.fem.pivoting import PIVOTS
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array

STEPS, LONGEST = 60, 300
NEARLY = 1e-2  # of the largest force: what settles slowly is below that after STEPS
SETTLED = 1e-10  # of the largest force
ROUNDING = 1e-14  # of the gaps: they are not known better
ROOM = 4e8  # bytes for what pressed slices do to each other, at all positions that are solved side by side
MOVED = 1e-6  # rad or m, over which arms and laws are differenced


def solve_cone(
    assembly: ConeAssembly,
    at_once: int = 16,
    steps: int = STEPS,
    pivots: int = PIVOTS,
    start: ConeContact | None = None,
) -> ConeContact:
    """Solve all positions, the rows of `assembly.load`; forces must have nearly settled after so many steps.

    A step takes so many pivots at the most.  Steps are those of Newton but for arms, which follow the motion: near the
    largest load that is carried, where they decide, they settle slowly.  `start` holds motions and forces of the same
    positions under a load not far off, where there are such.
    Raises NotConverged with the row of the position.
    """
    parts = []
    pressed = 0.5 * len(assembly.pair.rollers) * len(assembly.rim.slices.middle)
    at_once = max(1, min(at_once, int(ROOM / (8.0 * pressed**2))))
    for first in range(0, len(assembly.load), at_once):
        rows = np.arange(first, min(first + at_once, len(assembly.load)))
        some = replace(assembly, pair=assembly.pair.rows(rows), load=assembly.load[rows])
        try:
            begin = None if start is None else (start.motion[rows], start.force[rows])
            parts.append(_solved(some, steps, pivots, begin))
        except NotConverged as fault:
            raise NotConverged(str(fault), None if fault.row is None else first + fault.row) from fault
    return _joined(parts) if len(parts) > 1 else parts[0]


def _joined(parts: Sequence[ConeContact]) -> ConeContact:
    """Return all positions in one."""
    first = parts[0]
    contact = {
        f.name: np.concatenate([getattr(p, f.name) for p in parts])
        for f in fields(ConeContact)
        if f.name not in ("state", "steps")
    }
    state = {f.name: np.concatenate([getattr(p.state, f.name) for p in parts]) for f in fields(ConeState)}
    return replace(first, **contact, state=ConeState(**state), steps=max(p.steps for p in parts))


def _solved(
    assembly: ConeAssembly, steps: int, pivots: int, begin: tuple[Array, Array] | None
) -> ConeContact:
    motion = np.zeros_like(assembly.load) if begin is None else begin[0]
    state = assembly.pair.at(motion)
    elastic = elastic_at(assembly, state)
    force = _guess(assembly, state) if begin is None else begin[1]
    solution: lcp.Solution | None = None
    change = np.full(len(motion), np.inf)
    for step in range(1, LONGEST + 1):
        problem = _problem(assembly, elastic, state, force, motion)
        solution = lcp.solve_all(
            problem, None if solution is None else replace(solution, motion=0.0 * motion), pivots
        )
        new = solution.forces[0]
        size = np.maximum(new.max(axis=(1, 2), initial=0.0), 1e-300)
        change = np.abs(new - force).max(axis=(1, 2), initial=0.0) / size
        noise = _noise(problem, state)
        _fail_if_drowned(assembly, state, new, noise)
        new = np.where((size > noise)[:, None, None], new, 0.0)  # less is rounding: nothing touches
        change = np.where(new.any(axis=(1, 2)), change - noise / size, 0.0)
        motion, force = motion + solution.motion, new
        state = assembly.pair.at(motion)
        if np.all(change < SETTLED):
            return _contact(assembly, elastic, state, force, motion, step)
        if step >= steps and np.any(change > NEARLY):
            break
        elastic = updated(assembly, elastic, state, force)
    worst = int(np.argmax(change))
    raise NotConverged(
        f"contact of rollers and rim: forces still change by {change[worst]:.1e} of the largest after {step} steps; "
        "reduce the clearance or the load, or give the free motions springs",
        worst,
    )


def _noise(problem: lcp.Problem, state: ConeState) -> Array:
    """Return the force (n,) in N by which rounding of the gaps may press a slice."""
    least = problem.groups[0].diagonal.min(axis=(1, 2))
    return np.asarray(ROUNDING * np.abs(state.gap).max(axis=(1, 2)) / least)


def _fail_if_drowned(assembly: ConeAssembly, state: ConeState, force: Array, noise: Array) -> None:
    """Refuse loads that contacts carry (springs may carry them instead) with forces that are no more than rounding."""
    carried = np.abs(np.einsum("ncsk,ncs->nk", state.arms, force))
    needed = (carried > 1e-3 * np.abs(assembly.load)) & (assembly.load != 0.0)
    drowned = np.flatnonzero((force.max(axis=(1, 2), initial=0.0) <= noise) & needed.any(axis=1))
    if len(drowned):
        row = int(drowned[0])
        raise NotConverged(
            f"contact of rollers and rim: a load of {np.abs(assembly.load[row]).max():.3g} drowns in rounding, which "
            f"alone presses slices with {noise[row]:.1e} N; take no load at all, or a larger one",
            row,
        )


def _guess(assembly: ConeAssembly, state: ConeState) -> Array:
    """Return forces (n, C, s) that share the load evenly among the contacts that can carry it."""
    arms, load = state.arms, assembly.load
    work = np.einsum("ncsk,nk->ncs", arms, load)
    square = np.einsum("nk,nk->n", load, load)
    carrying = work > 0.0
    lifted = np.where(carrying, work, 0.0).sum(axis=(1, 2))
    share = np.divide(square, lifted, out=np.zeros_like(square), where=lifted > 0.0)
    return np.where(carrying, share[:, None, None], 0.0)


def _problem(
    assembly: ConeAssembly, elastic: Elastic, state: ConeState, force: Array, motion: Array
) -> lcp.Problem:
    largest = force.max(axis=(1, 2), initial=0.0)
    floor = FAINT * np.where(largest > 0.0, largest, 1.0)
    at = np.maximum(force, floor[:, None, None])
    approach, slope = elastic.law.approach(at)
    gap = state.gap + approach - slope * at + beside(elastic, force)
    slices = np.arange(gap.shape[-1])
    local = elastic.own.copy()
    local[..., slices, slices] += slope
    springs = np.broadcast_to(assembly.springs, (len(motion), *assembly.springs.shape))
    return lcp.Problem(
        (lcp.Group(local, gap, state.arms),),
        elastic.spread,
        springs,
        assembly.load - motion @ assembly.springs,
    )


def _contact(
    assembly: ConeAssembly, elastic: Elastic, state: ConeState, force: Array, motion: Array, steps: int
) -> ConeContact:
    law = elastic.law
    stiffness = np.empty((len(motion), motion.shape[1], motion.shape[1]))
    residual = np.zeros(len(motion))
    turning, yielding = _moving(assembly, force, motion)
    slope = law.approach(np.maximum(force, 1e-300))[1]
    value = np.where(force > 0.0, law.approach(np.maximum(force, 1e-300))[0], 0.0)
    for i in range(len(motion)):
        matrix = whole(elastic, i)
        flat, gap = force[i].ravel(), state.gap[i].ravel()
        pressed = np.flatnonzero(flat > 0.0)
        opening = gap + matrix @ flat + value[i].ravel()
        overlap = np.where(flat > 0.0, np.abs(opening), np.maximum(-opening, 0.0))
        residual[i] = overlap.max() / max(float(np.abs(value[i]).max()), 1e-300) if len(pressed) else 0.0
        inner = matrix[np.ix_(pressed, pressed)] + np.diag(slope[i].ravel()[pressed])
        arms = state.arms[i].reshape(-1, motion.shape[1])[pressed]
        closing = arms - yielding[i].reshape(-1, motion.shape[1])[pressed]
        tangent = assembly.springs + turning[i] + arms.T @ np.linalg.solve(inner, closing)
        stiffness[i] = 0.5 * (tangent + tangent.T)
    return ConeContact(
        force, law.pressure(force), law.half_width(force), motion, stiffness, state, steps, residual
    )


def _moving(assembly: ConeAssembly, force: Array, motion: Array) -> tuple[Array, Array]:
    """Return what changes as contacts move along the flank under their forces, by central differences.

    Σ F ∂arm/∂motion (n, k, k), and the approach per unit motion (n, C, s, k) through radius and S.
    """
    turning, yielding = [], []
    for step in MOVED * np.eye(motion.shape[1]):
        states = [assembly.pair.at(motion + s * step) for s in (1.0, -1.0)]
        turning.append(np.einsum("ncsk,ncs->nk", states[0].arms - states[1].arms, force))
        yielding.append(np.subtract(*(yielded(assembly, state, force) for state in states)))
    double = 2.0 * MOVED
    return np.stack(turning, axis=-1) / double, np.stack(yielding, axis=-1) / double
