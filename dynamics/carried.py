"""Stiffness-aware motion of members that are carried round: seen from a frame that turns evenly about z.

A planet carrier is where planets, cranks and discs repeat their motion, so in its frame their elastic motion w is
periodic and their stiffness K(φ) known.  It turns with Ω, and a mass that moves in it has the acceleration
ẅ + 2Ω ẑ × ẇ − Ω² w.  What that adds to ẅ goes into the motion that `elastic.respond` is given: a linear problem for w.
Left out is Ω² times the mean of w, a load that stands still and is as small as the mean is to the radii.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from trochoid.dynamics.elastic import Response, respond
from trochoid.dynamics.spectrum import harmonics, highest_harmonic, synthesize
from trochoid.dynamics.wrench import Wrench, couple, total, wrench
from trochoid.kinematics.errors import NotConverged, TrochoidError
from trochoid.kinematics.types import Array, ComplexArray, frozen

STEPS, TIGHT, SETTLED = 60, 1e-12, 1e-8  # of the iteration; of the motion: sought, and accepted
ACROSS = np.array([[0.0, -1.0], [1.0, 0.0]])  # ẑ × of x, y


@dataclass(frozen=True, eq=False, slots=True)
class Mass:
    """A mass on the coordinates y (k,): `mass` kg at `place` (3,) m, displaced in the plane by `moves` (2, k) y, and
    `inertia` kg·m² about its axis, turned by `turns` (k,) y.
    """

    mass: float
    place: Array
    moves: Array
    inertia: float
    turns: Array


@dataclass(frozen=True, eq=False, slots=True)
class Carried:
    """Elastic motion in the frame: the `response`, and of each of the p masses d'Alembert's `forces` (n, p, 2) in N and
    `moments` (n, p) in N·m about z.
    """

    response: Response
    forces: Array
    moments: Array


def mass_matrix(masses: Sequence[Mass]) -> Array:
    """Return the matrix (k, k) of masses and moments of inertia."""
    made = [m.mass * m.moves.T @ m.moves + m.inertia * np.outer(m.turns, m.turns) for m in masses]
    return np.asarray(np.sum(made, axis=0))


def respond_carried(
    motion: Array,
    masses: Sequence[Mass],
    stiffness: Array,
    speed: float,
    frame_speed: float,
    damping_ratio: float = 0.02,
) -> Carried:
    """Return the response to a quasi-static `motion` (n, k), periodic with the angular `speed` in the frame, rad/s.

    The frame turns with `frame_speed` (rad/s, either sign); stiffness and damping as in `respond`.  Raises for a
    coordinate without mass; NotConverged where no motion is found.
    """
    mass = mass_matrix(masses)
    if np.linalg.eigvalsh(mass)[0] <= 0.0:
        raise TrochoidError("carried members: every coordinate needs a mass or a moment of inertia")
    order: Array = speed * np.arange(1.0, highest_harmonic(len(motion)) + 1.0)[:, None]
    carry = _carry(masses, mass, order, frame_speed)

    def answer(given: Array) -> Response:
        return respond(given, mass, stiffness, speed, damping_ratio)

    plain = answer(motion)
    if frame_speed == 0.0:
        return _gathered(motion, masses, plain, order, frame_speed)
    whole = _solved(motion + plain.correction, lambda w: answer(carry(w)).correction)
    found = answer(motion + carry(whole))
    left = np.abs(motion + found.correction - whole).max()
    if not left <= SETTLED * np.abs(whole).max():
        raise NotConverged(
            f"reactions: the frame turns with {frame_speed:.4g} rad/s, and the elastic motion in it was not found; "
            "lower operation.input_speed or raise operation.damping_ratio"
        )
    return _gathered(motion, masses, found, order, frame_speed)


def _solved(first: Array, added: Callable[[Array], Array]) -> Array:
    """Solve w = first + added(w) for records (n, k), `added` being linear."""
    from scipy.sparse.linalg import LinearOperator, gmres

    scale = float(np.abs(first).max(initial=0.0))
    if scale == 0.0:
        return first

    def moved(flat: Array) -> Array:
        return np.asarray(flat - added(flat.reshape(first.shape)).ravel())

    operator = LinearOperator((first.size, first.size), matvec=moved, dtype=np.float64)
    found, _ = gmres(operator, first.ravel() / scale, rtol=TIGHT, restart=STEPS, maxiter=1)
    return np.asarray(scale * found.reshape(first.shape))


def _carry(masses: Sequence[Mass], mass: Array, order: Array, speed: float) -> Callable[[Array], Array]:
    """Return what turning adds to a motion (n, k), as a motion of the same inertia."""
    coriolis = np.linalg.solve(mass, np.sum([m.mass * m.moves.T @ ACROSS @ m.moves for m in masses], axis=0))
    central = np.linalg.solve(mass, np.sum([m.mass * m.moves.T @ m.moves for m in masses], axis=0))

    def added(motion: Array) -> Array:
        lines = harmonics(motion)[1:]
        acceleration = 2.0j * speed * order * (lines @ coriolis.T) - speed**2 * (lines @ central.T)
        return _series(-acceleration / order**2, len(motion))

    return added


def _series(lines: ComplexArray, positions: int) -> Array:
    """Return the record (positions, k) without a mean of lines (nh, k)."""
    return synthesize(np.concatenate([np.zeros_like(lines[:1]), lines]), positions)


def _gathered(
    motion: Array, masses: Sequence[Mass], response: Response, order: Array, speed: float
) -> Carried:
    """Gather the true motion, its acceleration in the frame and what inertia makes of it."""
    count, moved = len(motion), harmonics(motion + response.correction)[1:]
    bent, velocity = _series(-(order**2) * moved, count), _series(1.0j * order * moved, count)
    swing = _series(moved, count)
    forces, moments = [], []
    inertia = np.zeros_like(motion)
    for m in masses:
        fixed = (
            bent @ m.moves.T + 2.0 * speed * velocity @ m.moves.T @ ACROSS.T - speed**2 * swing @ m.moves.T
        )
        forces.append(-m.mass * fixed)
        moments.append(-m.inertia * (bent @ m.turns))
        inertia += forces[-1] @ m.moves + moments[-1][:, None] * m.turns
    amplitudes = moved.copy()
    amplitudes.setflags(write=False)
    whole = replace(
        response,
        motion=frozen(motion + response.correction),
        acceleration=frozen(bent),
        inertia=frozen(inertia),
        amplitudes=amplitudes,
    )
    return Carried(whole, frozen(np.stack(forces, axis=1)), frozen(np.stack(moments, axis=1)))


def inertia_wrench(masses: Sequence[Mass], found: Carried) -> Wrench:
    """Return the resultant about the origin of what the masses' elastic motion adds, in the frame."""
    places = np.stack([m.place for m in masses])
    about = np.zeros((len(found.moments), 3))
    about[:, 2] = found.moments.sum(axis=1)
    return total([wrench(places, found.forces), couple(about)])


def to_fixed(load: Wrench, angle: Array, repeats: int, step: float) -> Wrench:
    """Return a load (n, 3) of the frame in fixed axes over `repeats` periods, (repeats·n, 3), about the same point.

    `angle` (n,) of the frame in rad over one period, after which it has turned by `step`.
    """
    turn = (angle + step * np.arange(repeats)[:, None]).ravel()
    c, s = np.cos(turn), np.sin(turn)

    def turned(vectors: Array) -> Array:
        x, y, z = np.tile(vectors, (repeats, 1)).T
        return frozen(np.stack([c * x - s * y, s * x + c * y, z], axis=-1))

    return Wrench(turned(load.force), turned(load.moment), load.about, load.gross)
