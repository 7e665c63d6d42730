"""Small motions seen from a frame that turns evenly: what a member's inertia does there.

In a frame that turns with Ω = `frame`, displacements u of the centre of mass and small rotations θ obey

    m (ü + 2 Ω × u̇ + Ω × (Ω × u)) = force          J θ̈ + (J Ω̂ + Ω̂ J − Ĥ) θ̇ + (Ω̂ J Ω̂ − Ω̂ Ĥ) θ = moment

with H = J ω of the steady motion and Ω̂ the matrix of Ω ×.  J must not change in this frame: the member is round
about the axis of its spin relative to the frame, or has none.  The part of Ω̂ Ĥ that is not symmetric belongs to
the moment Ω × H of the steady motion: with that of the steady loads, which turn with the member, it sums to
nothing.  Both are left out, as is all else that steady loads add to a stiffness.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.dynamics.members import Member
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, eq=False, slots=True)
class Turning:
    """Matrices (n, n) of members in a turning frame: `mass` M, skew `gyroscopic` G, `centrifugal` K, symmetric.

    `rate` (n, n) is Ω × of displacements and rotations: a velocity in the fixed frame is ẏ + rate y.
    """

    mass: Array
    gyroscopic: Array
    centrifugal: Array
    rate: Array


def hat(vector: Array) -> Array:
    """Return the matrix (3, 3) of `vector` ×."""
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def turning(members: tuple[Member, ...], frame: Array) -> Turning:
    """Return the matrices of `members`, whose spin is their angular velocity ω, in the frame that turns with `frame`.

    Six coordinates each, as in `members`.  Raises TrochoidError for a mass or inertia that is not positive, and for
    a member whose inertia changes in the frame.
    """
    count = 6 * len(members)
    mass, gyroscopic, centrifugal, rate = np.zeros((4, count, count))
    omega = hat(frame)
    for i, member in enumerate(members):
        _fail_unless_constant(member, frame)
        at, turn = slice(6 * i, 6 * i + 3), slice(6 * i + 3, 6 * i + 6)
        inertia = np.asarray(member.inertia, dtype=np.float64)
        momentum = hat(inertia @ np.asarray(member.spin))
        mass[at, at] = member.mass * np.eye(3)
        mass[turn, turn] = inertia
        gyroscopic[at, at] = 2.0 * member.mass * omega
        gyroscopic[turn, turn] = inertia @ omega + omega @ inertia - momentum
        centrifugal[at, at] = member.mass * omega @ omega
        centrifugal[turn, turn] = _symmetric(omega @ inertia @ omega - omega @ momentum)
        rate[at, at] = rate[turn, turn] = omega
    return Turning(frozen(mass), frozen(gyroscopic), frozen(centrifugal), frozen(rate))


def standing(mass: Array, frame: Array) -> Turning:
    """Return a body (6, 6) that does not turn, seen from the frame: its mean over a turn, `mass` about the axis."""
    rate = np.kron(np.eye(2), hat(frame))
    mean = mean_over_turn(mass)
    return Turning(mean, frozen(2.0 * mean @ rate), frozen(mean @ rate @ rate), frozen(rate))


def mean_over_turn(matrix: Array) -> Array:
    """Return the mean of a matrix (6, 6) of the fixed frame, as a frame sees it that turns about z once."""
    angles = 2.0 * np.pi * np.arange(8) / 8.0
    c, s, zero, one = np.cos(angles), np.sin(angles), np.zeros(8), np.ones(8)
    turned = np.stack([np.stack(row, -1) for row in ((c, -s, zero), (s, c, zero), (zero, zero, one))], -2)
    both = np.zeros((8, 6, 6))
    both[:, :3, :3] = both[:, 3:, 3:] = turned
    return frozen(np.mean(np.swapaxes(both, 1, 2) @ matrix @ both, axis=0))


def _symmetric(matrix: Array) -> Array:
    return np.asarray(0.5 * (matrix + matrix.T))


def _fail_unless_constant(member: Member, frame: Array) -> None:
    inertia = np.asarray(member.inertia, dtype=np.float64)
    principal = np.linalg.eigvalsh(inertia)
    if not (member.mass > 0.0 and principal[0] > 0.0):
        raise TrochoidError(
            f"{member.name}: mass and principal moments of inertia about its centre must be above 0, given "
            f"{member.mass:g} kg, {', '.join(f'{j:.6g}' for j in principal)} kg·m²"
        )
    spin = np.asarray(member.spin) - frame
    size = float(np.linalg.norm(spin))
    if size > 0.0:
        turned = hat(spin / size)
        if np.abs(turned @ inertia - inertia @ turned).max() > 1e-6 * principal[2]:
            raise TrochoidError(
                f"{member.name} spins in the turning frame and is not round about that axis: take its mean"
            )
