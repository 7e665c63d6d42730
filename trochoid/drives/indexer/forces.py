"""Forces of a rigid indexer: the pin in its slot without friction, arm and planet without mass.

The wheel takes M = J ε + M_f; the pin pushes along the slot's normal n with F = M/(R sin α), α from the wheel's axis
to the pin. On the planet the teeth, a force G along the arm's circle at the point c where the pitch cones touch,
keep the balance about its axis a, and what is left about the drive's axis is the input torque:

    G (c × e)·a = F (P × n)·a,   M_in = R (F (P × n) − G (c × e))·z.

With M_in ω_1 = M ω the energy must be the same: that is a check, as M_in is found from forces alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.indexer import Indexer, motion
from trochoid.kinematics.indexer_slot import slot_normal
from trochoid.kinematics.types import Array

COARSE, FINE = 721, 41  # samples of an index, and of each of the ever smaller pieces about its largest value


@dataclass(frozen=True, slots=True)
class Load:
    """Speed of the arm (rad/s), moment of inertia of the wheel (kg·m²), friction torque (N·m), sphere radius (m)."""

    speed: float
    inertia: float
    friction: float
    radius: float


@dataclass(frozen=True, eq=False, slots=True)
class State:
    """Forces at the drive angles (n,) of an index: torque on the wheel, pin force, tooth force, input torque.

    `wheel_moment` and `arm_moment` tilt wheel and arm in their bearings about the centre of the sphere; `arm_force`
    is what the planet's bearing puts on the arm, `power` what goes into the arm.  As vectors (n, 6) of force (N) and
    moment about the centre (N·m): `on_arm` what planet and teeth put on the arm, `on_wheel` what the pin puts on the
    wheel, `on_fixed` what the planet's teeth put on the bevel wheel that stands still.
    """

    torque: Array
    pin: Array
    tooth: Array
    input_torque: Array
    wheel_moment: Array
    arm_force: Array
    arm_moment: Array
    power: Array
    on_arm: Array
    on_wheel: Array
    on_fixed: Array


@dataclass(frozen=True, eq=False, slots=True)
class Forces:
    """A loaded mechanism; `state` gives its forces at any angles of the index."""

    indexer: Indexer
    load: Load

    def state(self, t: Array) -> State:
        """Return forces at the drive angles t (n,) from the middle of the index, |t| ≤ φ0."""
        return _state(self.indexer, self.load, t)

    def under(self, t: Array, pin: Array) -> State:
        """Return forces at the drive angles t (n,) under pin forces (n,) in N, whatever makes them."""
        torque = pin * self.load.radius * np.sin(self.indexer.reach(t))
        return _loaded(self.indexer, self.load, t, torque, pin)

    def largest(self, value: Callable[[State], Array]) -> tuple[float, float]:
        """Return the value with the largest size over an index, and its drive angle (rad)."""
        half = self.indexer.half_turn
        close = half * np.geomspace(1e-6, 1e-2, 40)
        t = np.unique(np.concatenate((np.linspace(-half, half, COARSE), close, -close)))
        for _ in range(5):
            found = value(self.state(t))
            i = int(np.abs(found).argmax())
            best, at = float(found[i]), float(t[i])
            t = np.linspace(t[max(i - 1, 0)], t[min(i + 1, len(t) - 1)], FINE)
        return best, at

    def residual(self) -> float:
        """Largest difference of input power and output power with the kinetic energy's change, to the largest power."""
        t = np.linspace(-self.indexer.half_turn, self.indexer.half_turn, 361)
        at, speed = motion(self.indexer, t), self.load.speed
        omega = at.velocity * speed
        kinetic = self.load.inertia * omega * at.acceleration * speed**2
        lost = self.load.friction * np.abs(omega)
        power = self.state(t).power
        size = float(np.maximum(np.abs(kinetic), lost).max())
        return float(np.abs(power - lost - kinetic).max()) / size if size > 0.0 else 0.0


def forces(indexer: Indexer, load: Load) -> Forces:
    """Return the forces of a mechanism under a load."""
    return Forces(indexer, load)


def _state(indexer: Indexer, load: Load, t: Array) -> State:
    at = motion(indexer, t)
    torque = load.inertia * load.speed**2 * at.acceleration + indexer.sense * load.friction
    return _loaded(indexer, load, t, torque, torque / (load.radius * np.sin(indexer.reach(t))))


def _loaded(indexer: Indexer, load: Load, t: Array, torque: Array, pin: Array) -> State:
    path, radius = indexer.path, load.radius
    point, normal = path.point(t), slot_normal(indexer, t)
    reach = indexer.reach(t)
    axis, touch, along = _arm_frame(indexer, t)
    by_pin, by_tooth = np.cross(point, normal), np.cross(touch, along)
    # a pin on the planet's axis needs no teeth: a Geneva wheel's crank
    lever = np.sum(by_tooth * axis, axis=-1)
    tooth = pin * np.sum(by_pin * axis, axis=-1) / lever if path.pin > 0.0 else np.zeros_like(pin)
    moment = -radius * (pin[:, None] * by_pin - tooth[:, None] * by_tooth)  # of pin and teeth on the planet
    input_torque = -moment[:, 2]
    force = tooth[:, None] * along - pin[:, None] * normal
    on_wheel = np.concatenate([pin[:, None] * normal, radius * pin[:, None] * by_pin], axis=-1)
    return State(
        torque=torque,
        pin=pin,
        tooth=tooth,
        input_torque=input_torque,
        wheel_moment=np.abs(pin) * radius * np.abs(np.cos(reach)),
        arm_force=np.linalg.norm(force, axis=-1),
        arm_moment=np.hypot(moment[:, 0], moment[:, 1]),
        power=input_torque * load.speed,
        on_arm=np.concatenate([force, moment], axis=-1),
        on_wheel=on_wheel,
        on_fixed=-tooth[:, None] * np.concatenate([along, radius * by_tooth], axis=-1),
    )


def _arm_frame(indexer: Indexer, t: Array) -> tuple[Array, Array, Array]:
    """Unit vectors (n, 3) along the planet's axis, to the pitch point, and along the arm's motion."""
    path = indexer.path
    c, s, zero = np.cos(t), np.sin(t), np.zeros_like(t)
    pitch = math.copysign(path.central_cone, path.arm)

    def on_arm(angle: float) -> Array:
        return np.stack((math.sin(angle) * c, math.sin(angle) * s, math.cos(angle) + zero), axis=-1)

    return on_arm(path.arm), on_arm(pitch), np.stack((-s, c, zero), axis=-1)
