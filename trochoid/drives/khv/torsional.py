"""Torsional vibration of the driven member: its inertia on the drive's stiffness, excited by the transmission error.

The input turns evenly.  With x the lag of the driven member behind its ideal angle (rad), T the load torque (N·m),

    J ẍ + c ẋ + k(φ) [x − e(φ)]_g = T,     e = x_s − T/k less its mean,  [x]_g: what x is beyond ±g,

x_s(φ) and k(φ) are lag and tangent stiffness of all contacts at rest under T.  Solved is for what x is beyond
r(φ) = T/k + e + g, which it is at rest: with z = x − r, as far as contacts press,

    J z̈ + c ż + k z = −J r̈ − c ṙ,

so that a creeping drive carries T at every angle, however few the harmonics.  Which of it is in the equations the
scene's effects say: without "time_varying_stiffness" k is its mean, without "backlash" the contacts pull, too.  A
single coordinate: discs turn with the driven member, all else follows at once.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.design import Design
from trochoid.drives.khv.mass import Masses
from trochoid.drives.khv.series import Series
from trochoid.dynamics.floquet import along, growth
from trochoid.dynamics.harmonic_balance import Periodic, steady
from trochoid.dynamics.local_law import Law, Local, gap
from trochoid.dynamics.sweep import sweep
from trochoid.dynamics.system import System
from trochoid.kinematics.errors import NotConverged, TrochoidError
from trochoid.kinematics.types import Array, ComplexArray, frozen

VARYING, BACKLASH = "time_varying_stiffness", "backlash"
SLOWEST, FASTEST, SPEEDS = 0.2, 2.0, 73  # of the speed of operation
INSTANTS, EVERY = 160, 3  # over a turn, and which of the speeds: for the growth of small motions
FINE = 16  # instants per harmonic: T/k has more harmonics than k
STABLE = 1e-6  # how far a multiplier may be above 1 by rounding


@dataclass(frozen=True, eq=False, slots=True)
class Pendulum:
    """The driven member on the drive: `inertia` J kg·m², `damping` c, `torque` T; over n input angles of a turn
    `stiffness` k (n,) N·m/rad and `error` e (n,) rad; half the play `half_gap` g, rad.
    """

    inertia: float
    damping: float
    torque: float
    stiffness: Array
    error: Array
    half_gap: float

    @property
    def mean_stiffness(self) -> float:
        """Mean of k, N·m/rad."""
        return float(self.stiffness.mean())

    @property
    def natural_frequency(self) -> float:
        """√(k/J)/2π with the mean stiffness, Hz."""
        return float(np.sqrt(self.mean_stiffness / self.inertia)) / (2.0 * np.pi)

    @property
    def system(self) -> System:
        """Inertia and damping; the stiffness is in the local law."""
        one = np.ones((1, 1))
        return System(frozen(self.inertia * one), frozen(self.damping * one), frozen(0.0 * one))

    @property
    def windup(self) -> float:
        """T/k̄ + g, rad: the unknown of the balance is z beyond it, which is x itself for an even k without error."""
        return self.torque / self.mean_stiffness + self.half_gap

    @property
    def local(self) -> Local:
        """The drive's torque over z + T/k̄ + g and input angle."""
        return Local("drive", np.ones(1), law(self), self.mean_stiffness, self.half_gap)

    @property
    def harmonics(self) -> int:
        """The highest order of the input speed that the angles resolve."""
        return (len(self.error) - 1) // 2

    def at_rest(self, phase: Array) -> Array:
        """Return r (n,), the lag under the torque of a drive that creeps, at input angles."""
        k, e = _joined(self, phase)
        return np.asarray(self.torque / k + e + self.half_gap)

    def lag(self, motion: Periodic) -> Array:
        """Return x (n,) over `motion.phase`."""
        return np.asarray(motion.deflection[:, 0] - self.windup + self.at_rest(motion.phase))

    def loads(self, speed: float) -> ComplexArray:
        """Return the load torque, which does not vary, and what inertia and damping of r ask for."""
        count = FINE * self.harmonics
        lines = np.fft.rfft(self.at_rest(2.0 * np.pi * np.arange(count) / count))[: self.harmonics + 1]
        omega = speed * np.arange(self.harmonics + 1)
        found = (self.inertia * omega**2 - 1j * self.damping * omega) * lines * (2.0 / count)
        found[0] = self.torque
        return np.asarray(found[:, None], dtype=np.complex128)


@dataclass(frozen=True, eq=False, slots=True)
class Torsional:
    """Steady motion at the speed of operation, and over `speeds` (p,), rad/s, swept up and down: peak to peak (p,),
    rad, of z, what it is beyond that at creeping speed.  `growth` (q,) of a small motion over a turn at `tried` (q,),
    rad/s, the speed of operation the first: above 1 it excites itself.
    """

    pendulum: Pendulum
    motion: Periodic
    speeds: Array
    up: Array
    down: Array
    tried: Array
    growth: Array

    @property
    def swing(self) -> float:
        """Peak to peak of the lag x, rad."""
        return float(np.ptp(self.pendulum.lag(self.motion)))

    @property
    def torques(self) -> tuple[float, float]:
        """Least and largest torque in the drive over the turn, N·m."""
        return float(self.motion.force.min()), float(self.motion.force.max())

    @property
    def jumps(self) -> Array:
        """Speeds (j,) at which both sweeps differ: there are two motions."""
        return np.asarray(
            self.speeds[np.abs(self.up - self.down) > 1e-3 * (np.abs(self.up) + np.abs(self.down))]
        )

    @property
    def unstable(self) -> Array:
        """Speeds (j,) at which the varying stiffness excites itself."""
        return np.asarray(self.tried[self.growth > 1.0 + STABLE])


def pendulum(design: Design, series: Series, masses: Masses, damping: float) -> Pendulum:
    """Read the driven member's equation off the contacts over a turn; raises TrochoidError for a drive that is free."""
    torque = design.scene.operation.output_torque
    share = 1.0 / design.leverage
    stiffness = series.torsional_stiffness[:-1] / share**2
    if not torque > 0.0 or not (stiffness > 0.0).all():
        raise TrochoidError(
            "torsional vibration is about a loaded drive: give operation.output_torque above 0, enough for the drive "
            "to resist at every input angle"
        )
    lag = share * series.twist[:-1]
    unloaded = lag - torque / stiffness
    inertia = driven_inertia(design, masses)
    mean = float(stiffness.mean())
    varies = design.scene.has(VARYING)
    error = (
        lag - lag.mean() - (torque / stiffness - np.mean(torque / stiffness)) if varies else lag - lag.mean()
    )
    return Pendulum(
        inertia,
        2.0 * damping * float(np.sqrt(mean * inertia)),
        torque,
        frozen(stiffness if varies else np.full_like(stiffness, mean)),
        frozen(error),
        max(float(unloaded.mean()), 0.0) if design.scene.has(BACKLASH) else 0.0,
    )


def driven_inertia(design: Design, masses: Masses) -> float:
    """Return the inertia (kg·m²) of what turns with the driven member: flange, pins and discs, or the ring."""
    d = design.drive
    if d.fixed == "ring":
        pins = d.output_pins
        own = masses.flange.axial_inertia + pins.count * masses.output_pin.mass * pins.circle_radius**2
        return own + len(design.discs) * masses.disc.axial_inertia
    return masses.ring.axial_inertia + d.pins * masses.ring_pin.mass * d.pin_circle_radius**2


def law(made: Pendulum) -> Law:
    """Return the drive's torque k [x − e]_g over z + T/k̄ + g."""
    beyond = gap(1.0, made.half_gap)

    def torque(lag: Array, phase: Array) -> tuple[Array, Array]:
        k = _joined(made, phase)[0]
        pressed, slope = beyond(lag - made.windup + made.torque / k + made.half_gap, phase)
        return k * pressed, k * slope

    return torque


def _joined(made: Pendulum, phase: Array) -> tuple[Array, Array]:
    """Return k and e at input angles: their harmonics join them between the angles of the contacts."""
    order = np.arange(made.harmonics + 1)

    def lines(samples: Array) -> ComplexArray:
        found = np.asarray(np.fft.rfft(samples)[: len(order)] * (2.0 / len(samples)), dtype=np.complex128)
        found[0] *= 0.5
        return found

    both = np.stack([lines(made.stiffness), lines(made.error)], axis=1)
    k, e = (np.exp(1j * np.multiply.outer(phase, order)) @ both).real.T
    return k, e


def _restless(made: Pendulum, where: str) -> str:
    """Say why there may be no steady motion, and what to try."""
    wound, said = made.torque / made.mean_stiffness, f"no steady motion was found {where}"
    if wound < made.half_gap:
        return (
            f"{said}: operation.output_torque = {made.torque:g} N*m winds the drive up by {wound:.2g} rad, its "
            f"backlash is {2.0 * made.half_gap:.2g} rad, so that it rattles; give a larger torque (both are alike at "
            f'{2.0 * made.half_gap * made.mean_stiffness:.3g} N*m), or take the effect "{BACKLASH}" away'
        )
    return f"{said}; give more operation.damping_ratio, more ask.positions or another operation.input_speed"


def torsional(made: Pendulum, speed: float) -> Torsional:
    """Solve for the motion at `speed` (rad/s) and sweep past it; raises NotConverged where no motion is found."""
    speeds = speed * np.linspace(SLOWEST, FASTEST, SPEEDS)
    try:
        motion = steady(made.system, (made.local,), made.loads(speed), speed)
    except NotConverged as fault:
        raise NotConverged(_restless(made, f"at {speed:.6g} rad/s")) from fault
    try:
        if made.half_gap == 0.0:  # linear: one motion at any speed
            up = tuple(steady(made.system, (made.local,), made.loads(float(s)), float(s)) for s in speeds)
        else:
            up = sweep(made.system, (made.local,), made.loads, speeds)
    except NotConverged as fault:
        raise NotConverged(_restless(made, f"from {speeds[0]:.6g} to {speeds[-1]:.6g} rad/s")) from fault
    down = up
    if made.half_gap > 0.0 and any(each.force.min() <= 0.0 for each in up):
        with suppress(NotConverged):
            down = sweep(made.system, (made.local,), made.loads, speeds[::-1])[::-1]
    tried = (motion, *up[::EVERY]) if np.ptp(made.stiffness) > 0.0 else ()
    return Torsional(
        made,
        motion,
        frozen(speeds),
        frozen([np.ptp(each.deflection) for each in up]),
        frozen([np.ptp(each.deflection) for each in down]),
        frozen([each.speed for each in tried]),
        frozen([_growth(made, each) for each in tried]),
    )


def _closed(values: Array) -> Array:
    return np.append(values, values[0])


def _growth(made: Pendulum, motion: Periodic) -> float:
    """Return by what a small motion beside the steady one is multiplied in a turn, at most."""
    phase = 2.0 * np.pi * np.arange(INSTANTS) / INSTANTS
    deflection = np.interp(phase, np.append(motion.phase, 2.0 * np.pi), _closed(motion.deflection[:, 0]))
    slopes = law(made)(deflection, phase)[1]
    return growth(*along(made.system, (made.local,), slopes[:, None]), motion.speed)
