"""Stiffness-aware reactions of a precessional drive: what the inertia of yielding members adds to the rigid ones.

In the frame of the input shaft the joints A, B, O, C, the teeth and the mean inertia of all members stand still, so
that the small motion y about the steady nutation obeys equations with constant coefficients,

    M ÿ + (G + C) ẏ + (K + K_c + C Ω̂) y = f(φ),     f: d'Alembert's loads of the rigid motion,

with gyroscopic and centrifugal terms (dynamics.turning) and modal damping C of velocities in the fixed frame.
f is the exact one: its lines are those of the rigid reactions, 0 and 2 z1/z2.  K → ∞ gives the rigid reactions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.members import Bodies, loads
from trochoid.drives.precessional.reactions import Reactions, tooth_couple
from trochoid.dynamics.constraint import constraint_forces, free_motions
from trochoid.dynamics.modes import natural_modes
from trochoid.dynamics.spectrum import harmonics
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, ComplexArray, frozen

SAMPLES, LINES = 16, 3  # of one period of the loads, which have the lines 0 and 1 alone
BALANCED = 1e-8


@dataclass(frozen=True, eq=False, slots=True)
class Elastic:
    """Steady motion of yielding members, as lines 0 … 2 of 2 z1/z2 times the shaft's speed.

    Peak values in the frame of the shaft: `motion` (3, n); `forces` by name of a joint (3, 6), on the satellite at A
    and O, on the shaft at B, on the output shaft at C; "teeth" and "motor" (3, 1); `inertia` (3, 6), force and moment
    about O, what the motion adds to d'Alembert's loads.  `power` put in by loads and turning joints and `loss` in
    damping, W; `unbalanced`: what is left of all loads, relative.
    """

    drive: PrecessionalDrive
    speed: float
    motion: ComplexArray
    forces: dict[str, ComplexArray]
    inertia: ComplexArray
    power: float
    loss: float
    unbalanced: float

    def at(self, lines: ComplexArray, crank: Array) -> Array:
        """Return values (p, k) at shaft angles (p,) of lines (3, k)."""
        phase = np.exp(2j * self.drive.tooth_ratio * np.multiply.outer(crank, np.arange(LINES)))
        return np.asarray((phase @ lines).real)

    def reactions(self, crank: npt.ArrayLike) -> Reactions:
        """Return the reactions at shaft angles (p,) as the rigid models have them."""
        angle = np.atleast_1d(np.asarray(crank, dtype=np.float64))
        found = {name: self.at(lines, angle) for name, lines in self.forces.items()}
        push = found["teeth"][:, 0] / self.drive.mesh_radius
        along = np.stack((push, 0.0 * push, 0.0 * push), axis=-1)
        o = found["O"][:, :3]
        return Reactions(
            drive=self.drive,
            crank=frozen(angle),
            speed=self.speed,
            model="elastic",
            joint_a=frozen(found["A"][:, :3]),
            joint_o=frozen(o),
            support=frozen(found["B"][:, :3]),
            support_moment=frozen(found["B"][:, 3:]),
            torque=frozen(found["motor"][:, 0]),
            mesh=frozen(along),
            mesh_couple=frozen(found["teeth"] * tooth_couple(self.drive)),
            output=frozen(found["C"][:, :3] if "C" in found else o),
        )

    def displacement(self, name: str, made: Bodies, crank: Array) -> Array:
        """Return how far (p, 6) the second member of a joint moves past the first, m and rad."""
        return self.at(self.motion @ made.links[name].selection.T, crank)


def respond(drive: PrecessionalDrive, made: Bodies, speed: float, damping: float) -> Elastic:
    """Solve for the steady motion; `damping` is the ratio of every mode at standstill.

    Raises Infeasible where nothing balances the loads.
    """
    basis = free_motions(made.rows, made.matrices.mass)
    steps = drive.reaction_period * np.arange(SAMPLES) / SAMPLES
    lines = harmonics(loads(drive, made.members, steps, speed))[:LINES]
    turning, rate = made.matrices, 2.0 * drive.tooth_ratio * speed
    mass, gyro, held = (
        basis.T @ m @ basis for m in (turning.mass, turning.gyroscopic, made.springs + turning.centrifugal)
    )
    spring = basis.T @ made.springs @ basis
    frame = np.linalg.solve(mass, basis.T @ turning.mass @ turning.rate @ basis) if basis.size else mass
    delay, damper = _damping(mass, spring, damping)
    free = np.zeros((LINES, basis.shape[1]), dtype=np.complex128)
    for h, line in enumerate(lines):
        if not basis.size or not line.any():
            continue
        omega = h * rate
        dynamic = -(omega**2) * mass + 1j * omega * (gyro + damper) + held + damper @ frame
        free[h] = np.linalg.solve(dynamic, basis.T @ line)
    order = rate * np.arange(LINES)[:, None]
    speeds = 1j * order * free
    fixed = speeds + free @ frame.T  # velocities in the fixed frame
    stretched = (free + fixed @ delay.T) @ basis.T
    motion = free @ basis.T
    inertia = -(
        -(order**2) * motion @ turning.mass.T
        + 1j * order * motion @ turning.gyroscopic.T
        + motion @ turning.centrifugal.T
    )
    forces, left = _forces(made, lines + inertia, stretched)
    weight = np.array([1.0, *(LINES - 1) * [0.5]])

    def mean(one: ComplexArray, other: ComplexArray) -> float:
        return float(weight @ np.real(np.conj(one) * other).sum(axis=1))

    drag = fixed @ damper.T
    return Elastic(
        drive,
        speed,
        motion,
        forces,
        _resultant(made, inertia),
        mean(speeds, lines @ basis) + mean(free @ frame.T, drag),
        mean(fixed, drag),
        left,
    )


def _damping(mass: Array, spring: Array, ratio: float) -> tuple[Array, Array]:
    """Return T and C = K T, by which every mode of the springs alone has the `ratio`; free ones are not damped."""
    if not mass.size:
        return mass, mass
    modes = natural_modes(mass, spring)
    angular, weighted = modes.angular_frequencies, modes.shapes.T @ mass
    gain = np.divide(2.0 * ratio, angular, out=np.zeros_like(angular), where=angular > 0.0)
    return modes.shapes @ (gain[:, None] * weighted), weighted.T @ (
        (2.0 * ratio * angular)[:, None] * weighted
    )


def _forces(
    made: Bodies, loads_: ComplexArray, stretched: ComplexArray
) -> tuple[dict[str, ComplexArray], float]:
    """Return the forces of all joints, teeth and motor, and what they leave of the loads, relative."""
    found = {
        name: -(stretched @ link.selection.T) @ link.joint.stiffness.T for name, link in made.links.items()
    }
    carried = -(stretched @ made.springs.T)
    missing = -(loads_ + carried).T
    rigid = constraint_forces(made.rows, made.matrices.mass, missing)
    size = 1.0 / np.sqrt(np.diag(made.matrices.mass))
    rest = np.abs((made.rows.T @ rigid - missing) * size[:, None]).max()
    gross = max(np.abs(loads_ * size).max(), np.abs(carried * size).max(), 1e-300)
    if rest > BALANCED * gross:
        raise Infeasible(
            f"elastic reactions: the joints leave {rest / gross:.1e} of the loads unbalanced; check stiffnesses "
            "and masses that are many orders apart"
        )
    for (name, motion), line in zip(made.labels, rigid, strict=True):
        if name in found:
            found[name][:, motion] += line
        else:
            found[name] = np.asarray(line[:, None])
    return found, float(rest / gross)


def _resultant(made: Bodies, inertia: ComplexArray) -> ComplexArray:
    """Return force and moment about O (3, 6) of loads on the members (3, n)."""
    whole = np.zeros((len(inertia), 6), dtype=np.complex128)
    for i, member in enumerate(made.members):
        force, moment = inertia[:, 6 * i : 6 * i + 3], inertia[:, 6 * i + 3 : 6 * i + 6]
        whole[:, :3] += force
        whole[:, 3:] += moment + np.cross(member.center, force)
    return whole
