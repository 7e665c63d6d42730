"""Contacts with friction, linearised: which ones touch, stick or slip, and with what forces.

What touches obeys w = g + s N + C N + X q − R a = 0; what sticks T q + XᵀN − t − S a = 0, where t is what would pull
if nothing moved now; what slips q = ±μN; motions are in balance, RᵀN + Sᵀq + K a = F. Forces of friction q are on the
first body, against its sliding along the tangent. Who does what is found by solving with a guess and correcting it
until nothing is left to correct.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem import complementarity as lcp
from trochoid.fem.rows import taken
from trochoid.kinematics.types import Array, BoolArray, IntArray

CORRECTIONS = 25
SOFT = 1e-7  # of a motion's stiffness: what holds it in a step when nothing touches
TOLERANCE = 1e-9  # of the largest force: rounding of forces and of what lies between force and opening


@dataclass(frozen=True, slots=True)
class Linear:
    """n problems of C contacts, of which `rubs` (r,) have friction `mu` (r,), and k motions.

    `own` (n, C), `gap` (n, C), `arms` (n, C, k) of the normal direction and `coupling` (n, C, C); `along` T (n, r, r),
    `pulled` t (n, r) and `slides` (n, r, k) of the tangential one; `cross` X (n, C, r); `springs` (n, k, k) and `load`
    (n, k). SI units. Forces below `faint` (n, 1) are nothing.
    """

    own: Array
    gap: Array
    arms: Array
    coupling: Array
    rubs: IntArray
    mu: Array
    along: Array
    cross: Array
    pulled: Array
    slides: Array
    springs: Array
    load: Array
    faint: Array

    @property
    def soft(self) -> Array:
        """What each rubbing contact yields along its surface under its own force (n, r), m/N."""
        return np.asarray(np.einsum("nrr->nr", self.along))

    def stretch(self, normal: Array, along: Array) -> Array:
        """Return the elastic displacement (n, r) along the surfaces, T q + XᵀN."""
        pressed = np.einsum("ncr,nc->nr", self.cross, normal)
        return np.asarray(np.einsum("nrs,ns->nr", self.along, along) + pressed)


@dataclass(frozen=True, slots=True)
class Found:
    """Forces `normal` (n, C) and `along` (n, r) in N and motions (n, k); who touches (n, C), and the way that each
    contact slips (n, r): 0 where it sticks; `settled` (n,) where nothing was left to correct.
    """

    normal: Array
    along: Array
    motion: Array
    touch: BoolArray
    way: IntArray
    settled: BoolArray


def solve(problem: Linear, touch: BoolArray, way: IntArray) -> Found:
    """Solve from a guess of who touches and slips; who slips is corrected once those that touch are found."""
    settled = np.zeros(len(touch), dtype=bool)
    for _ in range(CORRECTIONS):
        normal, along, motion = _forces(problem, touch, way)
        new_touch = _touching(problem, normal, along, motion, touch)
        new_way = _slipping(problem, normal, along, motion, new_touch, touch, way)
        settled = (new_touch == touch).all(axis=1) & (new_way == way).all(axis=1)
        if settled.all():
            break
        touch, way = new_touch, new_way
    return Found(normal, along, motion, touch, way, settled)


def sought(problem: Linear, normal: Array, touch: BoolArray, way: IntArray) -> tuple[BoolArray, IntArray]:
    """Return who touches and slips if friction were limited by μ times given normal forces (n, C): a problem that is
    solved for certain. Where even that fails the guess is kept.
    """
    limit = problem.mu * normal[:, problem.rubs]
    shut = limit > problem.faint
    limit = np.where(shut, limit, 0.0)
    gap = np.where(shut, -problem.pulled, np.inf)  # what is open pulls with nothing
    groups = (
        lcp.Group(problem.own[..., None, None], problem.gap[..., None], problem.arms[:, :, None]),
        lcp.Group(
            problem.soft[..., None, None],
            gap[..., None],
            problem.slides[:, :, None],
            -limit[..., None],
            limit[..., None],
        ),
    )
    contacts = problem.gap.shape[1]
    both = np.zeros((len(gap), contacts + gap.shape[1], contacts + gap.shape[1]))
    both[:, :contacts, :contacts] = problem.coupling
    both[:, :contacts, contacts:] = problem.cross
    both[:, contacts:, :contacts] = problem.cross.swapaxes(1, 2)
    both[:, contacts:, contacts:] = problem.along - problem.soft[..., None] * np.eye(problem.along.shape[1])
    held = _raised(problem.springs)
    tried = lcp.attempt(lcp.Problem(groups, both, held, problem.load), None)
    presses, slips = (x[..., 0] for x in tried.solution.side)
    good = np.array([i not in tried.faults for i in range(len(gap))])[:, None]
    touches = np.where(good, presses == 0, touch)
    ways = np.where(good, slips * shut, way)
    return touches, np.where(touches[:, problem.rubs], ways, 0).astype(np.intp)


def _raised(springs: Array) -> Array:
    """Return the positive part of symmetric matrices (n, k, k): with it the problem is convex."""
    values, vectors = np.linalg.eigh(springs)
    return np.asarray((vectors * np.maximum(values, 0.0)[:, None]) @ vectors.swapaxes(1, 2))


def rows(problem: Linear, chosen: IntArray) -> Linear:
    """Return some of the problems."""
    every = taken((problem.own, problem.gap, problem.arms, problem.coupling), chosen)
    more = (
        problem.along,
        problem.cross,
        problem.pulled,
        problem.slides,
        problem.springs,
        problem.load,
        problem.faint,
    )
    return Linear(*every, problem.rubs, problem.mu, *taken(more, chosen))


def _forces(problem: Linear, touch: BoolArray, way: IntArray) -> tuple[Array, Array, Array]:
    """Solve with who touches and slips given; rows and columns are scaled by what each contact and motion resists."""
    n, contacts = problem.gap.shape
    rubs, k = len(problem.rubs), problem.load.shape[1]
    one, two = slice(0, contacts), slice(contacts, contacts + rubs)
    three = slice(contacts + rubs, contacts + rubs + k)
    stiff = np.einsum("nck,nc->nk", problem.arms**2, 1 / problem.own) + np.abs(
        np.einsum("nkk->nk", problem.springs)
    )
    stiff = np.where(stiff > 0, stiff, 1.0)
    rubbing = touch[:, problem.rubs]
    stick = rubbing & (way == 0)
    matrix, right = np.zeros((n, three.stop, three.stop)), np.zeros((n, three.stop))
    matrix[:, one, one] = problem.coupling * touch[..., None]
    matrix[:, range(contacts), range(contacts)] += problem.own
    matrix[:, one, two] = problem.cross * touch[..., None]
    matrix[:, one, three] = -problem.arms * touch[..., None]
    right[:, one] = -problem.gap * touch
    place, soft = np.arange(rubs), problem.soft
    matrix[:, two, two] = problem.along * stick[..., None]
    matrix[:, contacts + place, contacts + place] = soft
    matrix[:, two, one] = problem.cross.swapaxes(1, 2) * stick[..., None]
    matrix[:, contacts + place, problem.rubs] -= soft * problem.mu * way * rubbing
    matrix[:, two, three] = -problem.slides * stick[..., None]
    right[:, two] = problem.pulled * stick
    matrix[:, three, one] = problem.arms.swapaxes(1, 2)
    matrix[:, three, two] = problem.slides.swapaxes(1, 2)
    matrix[:, three, three] = problem.springs
    matrix[:, range(three.start, three.stop), range(three.start, three.stop)] += SOFT * stiff
    right[:, three] = problem.load
    scale = 1 / np.sqrt(np.concatenate([problem.own, soft, stiff], axis=1))
    matrix *= scale[:, :, None] * scale[:, None, :]
    answer = scale * np.linalg.solve(matrix, (scale * right)[..., None])[..., 0]
    return answer[:, one], answer[:, two], answer[:, three]


def _touching(problem: Linear, normal: Array, along: Array, motion: Array, touch: BoolArray) -> BoolArray:
    """Let go what pulls, let touch what overlaps."""
    least = problem.faint + TOLERANCE * np.abs(normal).max(axis=1, keepdims=True)
    opening = problem.gap + (problem.coupling @ normal[..., None])[..., 0]
    opening += np.einsum("ncr,nr->nc", problem.cross, along) - np.einsum("nck,nk->nc", problem.arms, motion)
    return np.asarray(np.where(touch, normal > -least, opening < -least * problem.own))


def _slipping(
    problem: Linear,
    normal: Array,
    along: Array,
    motion: Array,
    touch: BoolArray,
    before: BoolArray,
    way: IntArray,
) -> IntArray:
    """Let slip what pulls with more than μN and what has just come to touch; let stick what slips back.

    Only where those that touch stay the same: what others would do is not known yet.
    """
    least = problem.faint + TOLERANCE * np.abs(normal).max(axis=1, keepdims=True)
    limit = problem.mu * np.maximum(normal[:, problem.rubs], 0.0)
    trial = problem.pulled + np.einsum("nrk,nk->nr", problem.slides, motion)
    slip = trial - problem.stretch(normal, along)
    over, back = np.abs(along) > limit + least, way * slip < -least * problem.soft
    ways = np.where(way == 0, np.where(over, np.sign(along), 0), np.where(back, 0, way))
    same = (touch == before).all(axis=1, keepdims=True)
    now, then = touch[:, problem.rubs], before[:, problem.rubs]
    kept = np.where(same, ways, np.where(then, way, np.sign(slip)))
    return np.where(now, kept, 0).astype(np.intp)
