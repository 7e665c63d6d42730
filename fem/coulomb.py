"""Coulomb friction on strips once it is known which of them touch, stick and slip: one linear problem.

Forces x = (p, q) of m strips each (normal, tangential) and motions a obey

    w = C x + g − R a,      Rᵀx + K a = F,

    p ≥ 0, w_n ≥ 0, p·w_n = 0;      |q| ≤ μp;  stick: w_t = 0;  slip: q = ±μp against w_t.

w_t is how far the first body's surface slips along its tangent past the second's in this step. Friction makes the
problem nonsymmetric: a strip that slips lets its q follow p. From a guess, strips change between touching, sticking
and slipping until none is wrong (a semismooth Newton method); from a good guess that takes a few linear solves.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from trochoid.kinematics.types import Array, BoolArray, IntArray

TOLERANCE = 1e-12  # of forces: what is wrong by less is rounding
ROUNDING = 8 * float(np.finfo(np.float64).eps)  # of the terms that an opening is the sum of
TRIES = 12  # linear solves from one guess


@dataclass(frozen=True, slots=True)
class Whole:
    """All strips of a step, without their block structure: `matrix` (2m, 2m), `gap` (2m,), `arms` (2m, k), normal
    strips first, then tangential ones; `springs` (k, k), `load` (k,) and `friction` (m,).

    `sense` (m,) prescribes which way strips slide: 1 or −1 is the sign of w_t, 0 lets them stick and slip. `size` in N
    is the largest force before the step: with the load and the forces found it is what residuals are small against.
    """

    matrix: Array
    gap: Array
    arms: Array
    springs: Array
    load: Array
    friction: Array
    sense: IntArray
    size: float = 0.0


@dataclass(frozen=True, slots=True)
class Status:
    """Strips that `touch` (m,), and the `way` (m,) q points: 0 sticks, ±1 slips with q = ±μp."""

    touch: BoolArray
    way: IntArray


@dataclass(frozen=True, slots=True)
class Balance:
    """Forces (2m,), motion (k,), openings and slips w (2m,), the strips' status, and the linear solves it took.

    `residual` is the largest violation of any condition, relative to the sizes of forces and of elastic displacements,
    beyond what rounding leaves.
    """

    force: Array
    motion: Array
    opening: Array
    status: Status
    solves: int
    residual: float


def settle(whole: Whole, status: Status, motion: Array) -> Balance:
    """Return the best balance found from a guess of the strips' status and of the motion; see its residual."""
    best: Balance | None = None
    seen: set[bytes] = set()
    for number, (guess, force, moved) in enumerate(_tries(whole, status, motion), start=1):
        opening = _opening(whole, force, moved)
        residual = _violation(whole, force, opening, moved)
        if best is None or residual < best.residual:
            best = Balance(force, moved, opening, guess, number, residual)
        key = _key(guess)
        if _key(changed(whole, guess, force, opening, moved)) == key:  # no strip is wrong
            return Balance(force, moved, opening, guess, number, residual)
        if number == TRIES or key in seen:
            return replace(best, solves=number)
        seen.add(key)
    raise AssertionError("tries end inside the loop")


def judged(whole: Whole, status: Status, force: Array, motion: Array) -> Balance:
    """Return forces (2m,) and a motion (k,) found elsewhere, and how far they are from a balance."""
    opening = _opening(whole, force, motion)
    return Balance(force, motion, opening, status, 0, _violation(whole, force, opening, motion))


def _tries(whole: Whole, status: Status, motion: Array) -> Iterator[tuple[Status, Array, Array]]:
    while True:
        force, motion = _solved(whole, status, motion)
        yield status, force, motion
        status = changed(whole, status, force, _opening(whole, force, motion), motion)


def _key(status: Status) -> bytes:
    return status.touch.tobytes() + status.way.tobytes()


def changed(whole: Whole, status: Status, force: Array, opening: Array, motion: Array) -> Status:
    """Return the status of strips after those that are wrong have changed theirs."""
    count = len(whole.friction)
    p, q, apart, slip = force[:count], force[count:], opening[:count], opening[count:]
    size, noise = _sizes(whole, force)[0], _noise(whole, force, motion)
    touch = np.where(status.touch, p > -TOLERANCE * size, apart < -noise[:count])
    beyond = (status.way == 0) & (np.abs(q) > whole.friction * p + TOLERANCE * size)
    back = status.way * slip > noise[count:]
    way = np.where(beyond, np.sign(q), np.where(back, 0, status.way))
    way = np.where(status.touch, way, 0)
    way = np.where(whole.sense != 0, -whole.sense, way)
    return Status(touch, np.where(whole.friction > 0, way, 0).astype(np.intp))


def _opening(whole: Whole, force: Array, motion: Array) -> Array:
    return np.asarray(whole.matrix @ force + whole.gap - whole.arms @ motion)


def _noise(whole: Whole, force: Array, motion: Array) -> Array:
    """Return what rounding leaves uncertain in each opening and slip (2m,): they are sums of larger terms."""
    gap = np.where(np.isfinite(whole.gap), np.abs(whole.gap), 0.0)
    terms = np.abs(whole.matrix) @ np.abs(force) + gap + np.abs(whole.arms) @ np.abs(motion)
    return np.asarray(ROUNDING * terms)


def _solved(whole: Whole, status: Status, motion: Array) -> tuple[Array, Array]:
    """Solve the equations of this status, from a motion that what nothing resists keeps."""
    count = len(whole.friction)
    pressed = np.flatnonzero(status.touch)
    stuck = count + np.flatnonzero(status.touch & (status.way == 0) & (whole.friction > 0))
    rows = np.concatenate([pressed, stuck])
    force = np.zeros((2 * count, len(rows)))
    force[rows, np.arange(len(rows))] = 1.0
    force[count + pressed, np.arange(len(pressed))] += (status.way * whole.friction)[pressed]
    arms = whole.arms[rows]
    unit, lever = _units(whole)
    inner = whole.matrix[rows] @ force / unit
    cross = (force.T @ whole.arms / lever).T
    system = np.block([[inner, -arms / lever], [cross, whole.springs * (unit / np.outer(lever, lever))]])
    found, moved = np.zeros(2 * count), motion
    for _ in range(3):  # what rounding left is solved for again
        opening = _opening(whole, found, moved)[rows] / unit
        lack = (whole.load - whole.arms.T @ found - whole.springs @ moved) / lever
        answer = _answer(system, np.concatenate([-opening, lack]))
        found = found + force @ answer[: len(rows)]
        moved = moved + answer[len(rows) :] * unit / lever
    return found, moved


def _answer(system: Array, right: Array) -> Array:
    """Solve; where nothing resists a motion, with the least change."""
    try:
        found = np.linalg.solve(system, right)
    except np.linalg.LinAlgError:
        found = np.full(len(right), np.nan)
    if np.abs(found).max(initial=0.0) < 1e9 * max(1.0, float(np.abs(right).max(initial=0.0))):
        return np.asarray(found)
    return np.asarray(np.linalg.lstsq(system, right, rcond=1e-12)[0])


def _units(whole: Whole) -> tuple[float, Array]:
    """Return a typical compliance and the arms (k,) of the motions."""
    own = np.diag(whole.matrix)
    unit = float(np.median(own[own > 0])) if np.any(own > 0) else 1.0
    lever = np.abs(whole.arms).max(axis=0, initial=0.0)
    held = np.sqrt(np.maximum(np.diag(whole.springs), 0.0) * unit)
    lever = np.maximum(lever, held)
    return unit, np.where(lever > 0, lever, 1.0)


def _sizes(whole: Whole, force: Array) -> tuple[float, float]:
    """Return the largest force, and the length that bodies yield by."""
    unit, lever = _units(whole)
    load = float(np.abs(whole.load / lever).max(initial=0.0))
    size = max(load, whole.size, float(np.abs(force).max(initial=0.0)))
    own = np.abs(np.diag(whole.matrix) * force)
    length = max(float(own.max(initial=0.0)), unit * size)
    return size or 1.0, length or 1.0


def _violation(whole: Whole, force: Array, opening: Array, motion: Array) -> float:
    """Return the largest violation of Coulomb's and Signorini's conditions and of the balance of loads."""
    count = len(whole.friction)
    size, length = _sizes(whole, force)
    p, q = force[:count] / size, force[count:] / size
    seen = np.sign(opening) * np.maximum(np.abs(opening) - _noise(whole, force, motion), 0.0)
    apart, slip = seen[:count] / length, seen[count:] / length
    room = whole.friction * p
    lever = _units(whole)[1]
    lack = (whole.load - whole.arms.T @ force - whole.springs @ motion) / (lever * size)
    touching = np.minimum(np.maximum(p, 0.0), np.abs(np.where(np.isfinite(apart), apart, 1.0)))
    # q may be anything within ±μp where nothing slips, and stands against the slip at a bound where it does
    against = np.abs(q + np.sign(slip) * np.maximum(room, 0.0))
    along = np.where(whole.friction > 0, np.minimum(np.abs(slip), against), np.abs(q))
    along = np.where(whole.sense != 0, np.abs(q + whole.sense * room), along)
    parts = (-p, -apart, touching, np.abs(q) - room, along, np.abs(lack))
    worst = max(float(x.max(initial=0.0)) for x in parts)
    return worst if np.isfinite(worst) and np.isfinite(force).all() else np.inf
