"""Stiffness-aware motion of members that are carried round: seen from a frame that turns evenly about z.

A planet carrier is where planets, cranks and discs repeat their motion, so in its frame their elastic motion w is
periodic and their stiffness K(φ) known.  It turns with Ω, and a mass that moves in it has the acceleration
ẅ + 2Ω ẑ × ẇ − Ω² w.  Bearings and teeth turn with the frame, and so does the damping that they are given.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.dynamics.elastic import Frame, Response, respond
from trochoid.dynamics.floquet import fail_if_growing
from trochoid.dynamics.hill import rate, varied
from trochoid.dynamics.work import unmet
from trochoid.dynamics.wrench import Wrench, couple, total, wrench
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, frozen

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
    `moments` (n, p) in N·m about z.  `work`: what the work of the masses' inertia and of all springs on the motion
    differs from what damping takes, relative.
    """

    response: Response
    forces: Array
    moments: Array
    work: float


def mass_matrix(masses: Sequence[Mass]) -> Array:
    """Return the matrix (k, k) of masses and moments of inertia."""
    made = [m.mass * m.moves.T @ m.moves + m.inertia * np.outer(m.turns, m.turns) for m in masses]
    return np.asarray(np.sum(made, axis=0))


def carried_frame(masses: Sequence[Mass], speed: float) -> Frame:
    """Return what a frame adds that turns with `speed`, rad/s."""
    gyroscopic = 2.0 * speed * np.sum([m.mass * m.moves.T @ ACROSS @ m.moves for m in masses], axis=0)
    centrifugal = -(speed**2) * np.sum([m.mass * m.moves.T @ m.moves for m in masses], axis=0)
    none = frozen(np.zeros_like(centrifugal))
    return Frame(frozen(gyroscopic), frozen(centrifugal), none, ", seen from the carrier")


def respond_carried(
    motion: Array,
    masses: Sequence[Mass],
    stiffness: Array,
    speed: float,
    frame_speed: float,
    damping_ratio: float = 0.02,
    named: Array | None = None,
) -> Carried:
    """Return the response to a quasi-static `motion` (n, k), periodic with the angular `speed` in the frame, rad/s.

    The frame turns with `frame_speed` (rad/s, either sign); stiffness, damping and
    `named` as in `respond`.  Raises for a
    coordinate without mass; NotConverged where no motion is found, and where the varying stiffness excites itself.
    """
    mass = mass_matrix(masses)
    if np.linalg.eigvalsh(mass)[0] <= 0.0:
        raise TrochoidError("carried members: every coordinate needs a mass or a moment of inertia")
    frame = carried_frame(masses, frame_speed)
    found = respond(motion, mass, stiffness, speed, damping_ratio, frame if frame_speed else None, named)
    if stiffness.ndim == 3:
        fail_if_growing(
            mass,
            found.damper + frame.gyroscopic,
            stiffness + frame.centrifugal,
            speed,
            "the stiffness of the contacts, which varies over the turn,",
        )
    return _gathered(masses, found, stiffness, speed, frame_speed)


def _gathered(
    masses: Sequence[Mass], found: Response, stiffness: Array, speed: float, frame_speed: float
) -> Carried:
    """Say what the true motion's inertia makes of every mass, from its acceleration in fixed space."""
    velocity = rate(found.motion, speed)
    bent = rate(found.motion, speed, 2)
    swing = found.motion if frame_speed else 0.0 * found.motion
    forces, moments, powers = [], [], []
    for m in masses:
        fixed = (
            bent @ m.moves.T
            + 2.0 * frame_speed * velocity @ m.moves.T @ ACROSS.T
            - frame_speed**2 * swing @ m.moves.T
        )
        forces.append(-m.mass * fixed)
        moments.append(-m.inertia * (bent @ m.turns))
        powers.append(forces[-1] @ m.moves + moments[-1][:, None] * m.turns)
    y = found.correction
    springs = varied(stiffness, y) if stiffness.ndim == 3 else y @ stiffness.T
    return Carried(
        found,
        frozen(np.stack(forces, axis=1)),
        frozen(np.stack(moments, axis=1)),
        unmet(found.velocity, (*powers, -springs), found.loss),
    )


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
