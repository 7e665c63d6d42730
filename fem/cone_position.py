"""All contacts of rollers and rim together, slice by slice, at many positions side by side.

Newton runs over laws and pose at once, and the complementarity core solves each step exactly: each roller is a contact
with its slices as strips.  There contacts act on each other through their totals; what that mean leaves out between
the slices of pressed contacts is put into the gaps and follows the forces from step to step.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from trochoid.fem import complementarity as lcp
from trochoid.fem.cone_law import FAINT, Side, SliceLaw
from trochoid.fem.cone_pair import ConeState, RollerPair
from trochoid.fem.cone_table import RimCompliance, Weights
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, BoolArray, IntArray

STEPS = 60
SETTLED = 1e-9  # of the largest force
ROUNDING = 1e-14  # of the coordinates: gaps are not known better
MOVED = 1e-6  # rad or m, over which arms and laws are differenced
NEAR = 1e-3  # of a station's width: contacts that moved less keep their compliance


@dataclass(frozen=True, eq=False, slots=True)
class Roller:
    """The roller's side of each contact: `kernel` 2/(πE') in 1/Pa, 0 for a rigid one.

    `own` (s, s) in m/N is its S when it is a body of its own (see `cone_roller`), with `ends` (m) and `blunt` (s,) as
    in `Side`; otherwise half a solid cylinder pressed on its far side as well (Johnson, Contact Mechanics, 5.57):
    (2/(πE'))(ln(4r/b) − ½) per unit line load, r the roller's radius.
    """

    kernel: float = 0.0
    poissons_ratio: float = 0.3
    own: Array | None = None
    ends: tuple[float, float] = (0.0, 0.0)
    blunt: Array | None = None


RIGID_ROLLER = Roller()


@dataclass(frozen=True, eq=False, slots=True)
class ConeAssembly:
    """Rim, rollers, springs (k, k) in N·m/rad (N/m) and loads (n, k) in N·m (N) on the rim's motions."""

    rim: RimCompliance
    pair: RollerPair
    springs: Array
    load: Array
    roller: Roller = RIGID_ROLLER


@dataclass(frozen=True, eq=False, slots=True)
class ConeContact:
    """Solved positions.

    `force` (n, C, s) in N on slices, `pressure` (n, C, s) the largest of each in Pa, `half_width` (n, C, s) in m,
    `motion` (n, k), `stiffness` (n, k, k) its tangent, `state` the geometry there, `steps` taken, `residual` (n,) the
    worst overlap, or opening of pressed slices, over the largest approach.

    The stiffness is the symmetric part of the slope of load over motion, arms that turn and contacts that move along
    the flank included.  (Forces act along the normal at the middle of each contact, so that a part is left over, of
    per cents beside the bottoms of tooth spaces, which rollers nearly fill.)
    """

    force: Array
    pressure: Array
    half_width: Array
    motion: Array
    stiffness: Array
    state: ConeState
    steps: int
    residual: Array

    @property
    def total(self) -> Array:
        """Force (n, C) of each contact, N."""
        return np.asarray(self.force.sum(axis=-1))

    def edge(self) -> BoolArray:
        """Say where (n, C) the true pressure at an edge has no bound, and the one given is too low.

        So it is where an end of a roller presses (a crowned one does not), and at the pressed edge of a cut crest.
        """
        ends = (self.force[..., 0] > 0.0) | (self.force[..., -1] > 0.0)
        return np.asarray(ends | (self.state.off & (self.total > 0.0)))


def solve_cone(assembly: ConeAssembly, at_once: int = 16) -> ConeContact:
    """Solve all positions, the rows of `assembly.load`.  Raises NotConverged with the row of the position."""
    parts = []
    for first in range(0, len(assembly.load), at_once):
        rows = np.arange(first, min(first + at_once, len(assembly.load)))
        some = replace(assembly, pair=assembly.pair.rows(rows), load=assembly.load[rows])
        try:
            parts.append(_solved(some))
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


@dataclass(frozen=True, eq=False, slots=True)
class _Elastic:
    """Compliances at the contacts' `place` (n, C): `own` (n, C, s, s), `spread` (n, C, C) between totals, the laws.

    Per position: numbers of contacts that are or were `pressed`, and the compliance `cross` (P, s, P, s) between these.
    """

    place: Array
    own: Array
    spread: Array
    weights: Weights
    law: SliceLaw
    pressed: list[IntArray]
    cross: list[Array]


def _solved(assembly: ConeAssembly) -> ConeContact:
    motion = np.zeros_like(assembly.load)
    state = assembly.pair.at(motion)
    elastic = _elastic(assembly, state)
    force = _guess(assembly, state)
    solution: lcp.Solution | None = None
    change = np.full(len(motion), np.inf)
    for step in range(1, STEPS + 1):
        problem = _problem(assembly, elastic, state, force, motion)
        solution = lcp.solve_all(
            problem, None if solution is None else replace(solution, motion=0.0 * motion)
        )
        new = solution.forces[0]
        size = np.maximum(new.max(axis=(1, 2), initial=0.0), 1e-300)
        change = np.abs(new - force).max(axis=(1, 2), initial=0.0) / size
        noise = _noise(assembly, problem)
        _fail_if_drowned(assembly, size, noise)
        new = np.where((size > noise)[:, None, None], new, 0.0)  # less is rounding: nothing touches
        change = np.where(new.any(axis=(1, 2)), change - noise / size, 0.0)
        motion, force = motion + solution.motion, new
        state = assembly.pair.at(motion)
        if np.all(change < SETTLED):
            return _contact(assembly, elastic, state, force, motion, step)
        elastic = _updated(assembly, elastic, state, force)
    worst = int(np.argmax(change))
    raise NotConverged(
        f"contact of rollers and rim: forces still change by {change[worst]:.1e} of the largest after {STEPS} steps; "
        "reduce the clearance or the load, or give the free motions springs",
        worst,
    )


def _noise(assembly: ConeAssembly, problem: lcp.Problem) -> Array:
    """Return the force (n,) in N by which rounding of the coordinates may press a slice."""
    least = problem.groups[0].diagonal.min(axis=(1, 2))
    return np.asarray(ROUNDING * assembly.rim.slices.outer[-1] / least)


def _fail_if_drowned(assembly: ConeAssembly, size: Array, noise: Array) -> None:
    drowned = np.flatnonzero((size <= noise) & assembly.load.any(axis=1))
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


def _elastic(assembly: ConeAssembly, state: ConeState) -> _Elastic:
    rim = assembly.rim
    place = rim.weights(state.place)
    own = rim.on_itself(place)
    if assembly.roller.own is not None:
        own = own + assembly.roller.own
    count = len(state.place)
    none = [np.zeros(0, dtype=np.intp)] * count
    return _Elastic(
        state.place,
        own,
        rim.spread(place),
        place,
        _law(assembly, state, rim.blunt(place)),
        none,
        [np.zeros((0, 0, 0, 0))] * count,
    )


def _law(assembly: ConeAssembly, state: ConeState, blunt: Array) -> SliceLaw:
    rim, roller, rho = assembly.rim, assembly.roller, assembly.rim.slices.middle
    sides = [Side(rim.kernel, rim.poissons_ratio, rim.ends, blunt[..., None] * rho)]
    if roller.kernel > 0.0 and roller.own is None:
        radius = rho * np.tan(assembly.pair.tooth.pin_angle - assembly.pair.clearance)
        sides.append(Side(roller.kernel, roller.poissons_ratio, (0.0, 0.0), None, np.log(2.0 * radius) - 1.0))
    elif roller.own is not None:
        sides.append(Side(roller.kernel, roller.poissons_ratio, roller.ends, roller.blunt))
    return SliceLaw(rim.slices, tuple(sides), rho / state.bend[..., None])


def _updated(assembly: ConeAssembly, elastic: _Elastic, state: ConeState, force: Array) -> _Elastic:
    """Take compliances afresh where contacts moved, and between slices for those that are pressed."""
    moved = np.abs(state.place - elastic.place).max(axis=1) > NEAR * float(assembly.rim.half_width.min())
    if moved.any():
        elastic = _elastic(assembly, state)
    pressed, cross = list(elastic.pressed), list(elastic.cross)
    for i, total in enumerate(force.sum(axis=-1)):
        touching = np.flatnonzero(total > 0.0)
        if not np.isin(touching, pressed[i]).all():
            touching = np.union1d(touching, pressed[i])
            w = elastic.weights
            at = Weights(w.tooth[i, touching], w.station[i, touching], w.value[i, touching])
            pressed[i], cross[i] = touching, assembly.rim.between(at)
    law = _law(assembly, state, assembly.rim.blunt(elastic.weights))
    return replace(elastic, pressed=pressed, cross=cross, law=law)


def _problem(
    assembly: ConeAssembly, elastic: _Elastic, state: ConeState, force: Array, motion: Array
) -> lcp.Problem:
    largest = force.max(axis=(1, 2), initial=0.0)
    floor = FAINT * np.where(largest > 0.0, largest, 1.0)
    at = np.maximum(force, floor[:, None, None])
    approach, slope = elastic.law.approach(at)
    gap = state.gap + approach - slope * at + _beside(elastic, force)
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


def _beside(elastic: _Elastic, force: Array) -> Array:
    """Return what slices of other contacts press a slice by (n, C, s) beyond what their totals do."""
    found = np.zeros_like(force)
    for i, (chosen, cross) in enumerate(zip(elastic.pressed, elastic.cross, strict=True)):
        if len(chosen):
            f = force[i, chosen]
            exact = np.einsum("asbt,bt->as", cross, f, optimize=True)
            found[i, chosen] = exact - (elastic.spread[i][np.ix_(chosen, chosen)] @ f.sum(axis=-1))[:, None]
    return found


def _contact(
    assembly: ConeAssembly, elastic: _Elastic, state: ConeState, force: Array, motion: Array, steps: int
) -> ConeContact:
    law = elastic.law
    stiffness = np.empty((len(motion), motion.shape[1], motion.shape[1]))
    residual = np.zeros(len(motion))
    turning, yielding = _moving(assembly, force, motion)
    slope = law.approach(np.maximum(force, 1e-300))[1]
    value = np.where(force > 0.0, law.approach(np.maximum(force, 1e-300))[0], 0.0)
    for i in range(len(motion)):
        matrix = _whole(elastic, i)
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
        yielding.append(np.subtract(*(_yielded(assembly, state, force) for state in states)))
    double = 2.0 * MOVED
    return np.stack(turning, axis=-1) / double, np.stack(yielding, axis=-1) / double


def _yielded(assembly: ConeAssembly, state: ConeState, force: Array) -> Array:
    place = assembly.rim.weights(state.place)
    law = _law(assembly, state, assembly.rim.blunt(place))
    own = np.einsum("ncst,nct->ncs", assembly.rim.on_itself(place), force)
    return np.where(force > 0.0, own + law.approach(np.maximum(force, 1e-300))[0], 0.0)


def _whole(elastic: _Elastic, i: int) -> Array:
    """Return the compliance (Cs, Cs) between all slices of one position, without the laws."""
    count, slices = elastic.own.shape[1:3]
    whole = np.repeat(np.repeat(elastic.spread[i], slices, axis=0), slices, axis=1)
    whole = whole.reshape(count, slices, count, slices)
    chosen = elastic.pressed[i]
    if len(chosen):
        whole[np.ix_(chosen, np.arange(slices), chosen, np.arange(slices))] = elastic.cross[i]
    number = np.arange(count)
    whole[number, :, number] = elastic.own[i]
    return whole.reshape(count * slices, count * slices)
