"""Ball bearing at speed: centrifugal force presses the balls outward, so that their two contact angles differ.

Each ball's centre has two coordinates of its own in the meridian plane.  They minimise the energy of its two
contacts less the work of the centrifugal force; the energy left is convex in the ring's displacement, and the
stiffness follows by static condensation.  The gyroscopic moment of the balls is not in the model.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.rolling import RollingState, element_angles
from trochoid.fem.rolling_ball import BallBearing, gathered, spring
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, BoolArray


@dataclass(frozen=True, slots=True)
class SpinningBallBearing:
    """A ball bearing whose balls are pressed outward by `centrifugal` N each."""

    bearing: BallBearing
    centrifugal: float

    @property
    def lever(self) -> float:
        """Return that of the bearing, m."""
        return self.bearing.lever

    @property
    def play(self) -> float:
        """Return that of the bearing, m, and what the outer contacts yield to the centrifugal force."""
        return self.bearing.play + float((self.centrifugal / self.bearing.constants[1]) ** (2.0 / 3.0))

    @property
    def bend(self) -> float:
        """Return that of the bearing, m."""
        return self.bearing.bend

    def deflection(self, force: float) -> float:
        """Return that of the bearing, m."""
        return self.bearing.deflection(force)

    def respond(self, displacement: Array, turn: float) -> RollingState:
        """Return the state with every ball in equilibrium; raises NotConverged, naming the ball."""
        b = self.bearing
        if self.centrifugal == 0.0:
            return b.respond(displacement, turn)
        angles = element_angles(b.balls, turn)
        arms = b.arms(angles)
        vector, deflection = b.stretch(np.einsum("nai,...i->...na", arms, displacement))
        flat = _settled(self, vector.reshape(-1, 2), deflection.reshape(-1))
        shape = deflection.shape
        loads = (flat.inner_load.reshape(shape), flat.outer_load.reshape(shape))
        contact = (flat.inner_angle.reshape(shape), flat.outer_angle.reshape(shape))
        inner, total = flat.inner_stiffness, flat.inner_stiffness + flat.outer_stiffness
        left = (inner - inner @ np.linalg.solve(total, inner)).reshape(*shape, 2, 2)
        energy = flat.energy.reshape(shape).sum(axis=-1)
        force = flat.inner_force.reshape(*shape, 2)
        return gathered(displacement, angles, arms, loads, contact, force, left, energy)

    def overreached(self, state: RollingState) -> BoolArray:
        """Return where (…,) a loaded ball has left the side of the groove that is meant to carry."""
        return self.bearing.overreached(state)

    def refusal(self, load: Array, free: BoolArray) -> str:
        """Say why no displacement passes the load, or nothing."""
        return self.bearing.refusal(load, free)


def spinning(bearing: BallBearing, inner_speed: float, outer_speed: float = 0.0) -> SpinningBallBearing:
    """Return the bearing with its rings turning at speeds in rad/s; the balls' density is that of `bearing.ball`.

    F_c = m D_pw/2 ω², ω = ½(ω_i(1−γ) + ω_e(1+γ)) of pure rolling at the nominal contact angle (Harris, 8).
    """
    orbit = 0.5 * (inner_speed * (1.0 - bearing.gamma) + outer_speed * (1.0 + bearing.gamma))
    mass = bearing.ball.density * np.pi / 6.0 * bearing.ball_diameter**3
    return SpinningBallBearing(bearing, float(mass * 0.5 * bearing.pitch_diameter * orbit**2))


@dataclass(frozen=True, slots=True)
class _Balls:
    """Many balls at given places of their centres (k, 2) from the outer groove's centre of curvature."""

    inner_force: Array
    inner_load: Array
    inner_angle: Array
    inner_stiffness: Array
    outer_load: Array
    outer_angle: Array
    outer_stiffness: Array
    rest: Array
    energy: Array


def _at(spinning: SpinningBallBearing, vector: Array, center: Array) -> _Balls:
    """Return forces, stiffnesses and energy with ball centres at `center` (k, 2)."""
    b = spinning.bearing
    parts = []
    for constant, radius, reach in (
        (b.constants[0], b.inner_groove_radius, vector - center),
        (b.constants[1], b.outer_groove_radius, center),
    ):
        pressed = np.maximum(np.hypot(reach[:, 0], reach[:, 1]) - (radius - 0.5 * b.ball_diameter), 0.0)
        root = np.sqrt(pressed)
        load = constant * pressed * root
        force, hessian = spring(reach, load, 1.5 * constant * root)
        angle = np.where(load > 0.0, np.arctan2(reach[:, 1], reach[:, 0]), 0.0)
        parts.append((force, load, angle, hessian, 0.4 * load * pressed))
    (fi, qi, ai, hi, ei), (fo, qo, ao, ho, eo) = parts
    push = np.array([spinning.centrifugal, 0.0])
    return _Balls(fi, qi, ai, hi, qo, ao, ho, fo - fi - push, ei + eo - center @ push)


def _settled(spinning: SpinningBallBearing, vector: Array, deflection: Array) -> _Balls:
    """Return all balls in equilibrium: damped Newton on a convex energy, each ball on its own."""
    b = spinning.bearing
    seat = b.outer_groove_radius - 0.5 * b.ball_diameter
    sunk = (spinning.centrifugal / b.constants[1]) ** (2.0 / 3.0)
    length = np.hypot(vector[:, 0], vector[:, 1])
    share = (b.constants[2] / b.constants[1]) ** (2.0 / 3.0)
    held = vector / length[:, None] * (seat + share * np.maximum(deflection, 0.0))[:, None]
    center = np.where(deflection[:, None] > 0.0, held, np.array([seat + sunk, 0.0]))
    state = _at(spinning, vector, center)
    for _ in range(100):
        slope = (
            1.5 * b.constants[1] ** (2.0 / 3.0) * np.cbrt(np.maximum(state.outer_load, spinning.centrifugal))
        )
        noise = 8.0 * np.finfo(float).eps * length * slope
        left = np.hypot(state.rest[:, 0], state.rest[:, 1])
        open_balls = left > 1e-13 * (state.outer_load + spinning.centrifugal) + noise
        if not open_balls.any():
            return state
        total = state.inner_stiffness + state.outer_stiffness
        floor = 1e-12 * slope[:, None, None] * np.eye(2)
        step = -np.linalg.solve(total + floor, state.rest[..., None])[..., 0]
        step[~open_balls] = 0.0
        center, state = _search(spinning, vector, center, state, step)
    worst = int(np.argmax(left))
    raise NotConverged(
        f"ball bearing at speed: ball {worst % b.balls} is out of balance by {left[worst]:.3g} N under "
        f"{spinning.centrifugal:.6g} N of centrifugal force after 100 iterations; lower the speed or the displacement"
    )


def _search(
    spinning: SpinningBallBearing, vector: Array, center: Array, state: _Balls, step: Array
) -> tuple[Array, _Balls]:
    """Return centres and state along the steps, each halved until its slope no longer points uphill steeply."""
    part = np.ones(len(step))
    start = (state.rest * step).sum(axis=1)
    for _ in range(40):
        trial = center + part[:, None] * step
        tried = _at(spinning, vector, trial)
        slope = (tried.rest * step).sum(axis=1)
        steep = slope > 0.5 * np.abs(start)
        if not steep.any():
            break
        part = np.where(steep, 0.5 * part, part)
    return trial, tried
