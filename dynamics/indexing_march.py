"""The march of a driven wheel in time: Runge and Kutta's fourth order, Coulomb friction that sticks and slips.

States are d, d', e, e', the work of the pin and what is lost; friction acts on the wheel, or on the load behind a
shaft.  Where the braked member comes to a stop within a step, the step is cut there; it is let go at the end of a step.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from trochoid.kinematics.types import Array

STOPS = 5  # tries at the instant of a stop
GONE = 1e-5  # of its largest, at which a vibration has ended

Torque: TypeAlias = Callable[[float, float, float], float]
State: TypeAlias = tuple[float, float, float, float, float, float]
Three: TypeAlias = tuple[float, float, float]
Rates: TypeAlias = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Output:
    """What is driven: `inertia` of the wheel (kg·m²), `friction` M_f (N·m), and behind a shaft of `shaft` stiffness
    (N·m/rad, 0: none) the inertia `load`; `lock` (N·m/rad) holds the wheel in the dwell; β = `damping` (s).
    """

    inertia: float
    friction: float
    lock: float
    damping: float = 0.0
    shaft: float = 0.0
    load: float = 0.0

    @property
    def frequencies(self) -> tuple[float, ...]:
        """Natural angular frequencies (rad/s) in the dwell, without damping and friction, lowest first."""
        return self.frequencies_at(self.lock)

    def frequencies_at(self, stiffness: float) -> tuple[float, ...]:
        """Return natural angular frequencies (rad/s) with another stiffness (N·m/rad) between base and wheel."""
        if self.shaft == 0.0:
            return (math.sqrt(stiffness / self.inertia),)
        a = (stiffness + self.shaft) / self.inertia + self.shaft / self.load
        b = stiffness * self.shaft / (self.inertia * self.load)
        high = 0.5 * (a + math.sqrt(max(a * a - 4.0 * b, 0.0)))
        return math.sqrt(b / high), math.sqrt(high)

    def energy(self, y: State, base: float) -> float:
        """Energy (J) of both masses and the shaft, ψ' being `base`."""
        speed = base - y[1]
        return 0.5 * (self.inertia * speed**2 + self.load * (speed - y[3]) ** 2 + self.shaft * y[2] ** 2)


@dataclass(frozen=True, slots=True)
class Piece:
    """Lever, ψ' and ψ'' at the start, the middle and the end of a piece `length` (s) long."""

    length: float
    lever: Three
    base: Three
    drive: Three

    def part(self, low: float, high: float) -> Piece:
        """Return a part of the piece, by the parabolas through its values."""
        return Piece(
            (high - low) * self.length,
            _between(self.lever, low, high),
            _between(self.base, low, high),
            _between(self.drive, low, high),
        )


@dataclass(frozen=True, slots=True)
class Grip:
    """What friction does: it holds the output (`held`), or brakes it against `sign`; 0 where there is none."""

    sign: float
    held: bool


@dataclass(frozen=True, slots=True)
class March:
    """The equations with the torque of contact or lock; `rest`: the base stands, and the march ends with the motion."""

    output: Output
    torque: Torque
    rest: bool = False

    def run(self, at: tuple[Array, Array, Array], h: float, y: State, grip: Grip) -> tuple[Array, Grip]:
        """Return the states (n, 6) at instants h apart; `at` are lever, ψ', ψ'' at them and half-way between."""
        lever, base, drive = (x.tolist() for x in at)
        rows, size = [y], self._size(y)
        for i in range(0, len(lever) - 1, 2):
            j = i + 3
            piece = Piece(h, tuple(lever[i:j]), tuple(base[i:j]), tuple(drive[i:j]))
            y, grip = self._advance(y, piece, grip)
            rows.append(y)
            if self.rest and ((grip.held and self.output.shaft == 0.0) or self._size(y) <= GONE**2 * size):
                break
        return np.array(rows), grip

    def begin(self, y: State, base: float, held: bool) -> Grip:
        """Return what friction does at the start."""
        if self.output.friction == 0.0 or held:
            return Grip(0.0, held and self.output.friction > 0.0)
        return Grip(math.copysign(1.0, base - y[1] - y[3]), False)

    def _advance(self, y: State, piece: Piece, grip: Grip) -> tuple[State, Grip]:
        new = self._step(y, piece, grip)
        if grip.held:
            pull = self._pull(new, piece.lever[2])
            return new, Grip(math.copysign(1.0, pull), False) if abs(pull) > self.output.friction else grip
        after = piece.base[2] - new[1] - new[3]
        if grip.sign * after >= 0.0:
            return new, grip
        return self._stopped(y, piece, self._stop(y, piece, grip, after), grip)

    def _stop(self, y: State, piece: Piece, grip: Grip, after: float) -> float:
        """Part of the piece after which the output stands still, by false position."""
        before = piece.base[0] - y[1] - y[3]
        if grip.sign * before <= 0.0:
            return 0.0
        low, high, part = (0.0, before), (1.0, after), 1.0
        for _ in range(STOPS):
            part = low[0] + (high[0] - low[0]) * low[1] / (low[1] - high[1])
            cut = piece.part(0.0, part)
            new = self._step(y, cut, grip)
            speed = cut.base[2] - new[1] - new[3]
            if grip.sign * speed > 0.0:
                low = part, speed
            elif speed != 0.0:
                high = part, speed
            else:
                break
        return part

    def _stopped(self, y: State, piece: Piece, part: float, grip: Grip) -> tuple[State, Grip]:
        """Go to where the output stands still, then on as friction holds it or lets it go back."""
        first = piece.part(0.0, part)
        d, p, e, g, work, loss = self._step(y, first, grip)
        still = first.base[2]
        y = (d, p, e, still - p, work, loss) if self.output.shaft > 0.0 else (d, still, e, g, work, loss)
        pull = self._pull(y, first.lever[2])
        grip = Grip(math.copysign(1.0, pull), abs(pull) <= self.output.friction)
        return self._step(y, piece.part(part, 1.0), grip), grip

    def _pull(self, y: State, lever: float) -> float:
        """Torque (N·m) on the member that friction brakes."""
        if self.output.shaft > 0.0:
            return self.output.shaft * (y[2] + self.output.damping * y[3])
        return self.torque(y[0], y[1], lever)

    def _size(self, y: State) -> float:
        """Energy (J) of deviations in the dwell, the lock's included."""
        return self.output.energy(y, 0.0) + 0.5 * self.output.lock * y[0] ** 2

    def _rates(self, d: float, p: float, e: float, g: float, at: Three, grip: Grip) -> Rates:
        """Return d'', e'', and the powers of the pin and of what is lost; `at`: lever, ψ', ψ''."""
        out, (s, v, a) = self.output, at
        tau = self.torque(d, p, s)
        brake = 0.0 if grip.held else grip.sign * out.friction
        if out.shaft == 0.0:
            gained = 0.0 if grip.held else (tau - brake) / out.inertia
            return a - gained, 0.0, tau * (v - p), brake * (v - p)
        back = out.shaft * (e + out.damping * g)
        a1 = (tau - back) / out.inertia
        a2 = 0.0 if grip.held else (back - brake) / out.load
        return a - a1, a1 - a2, tau * (v - p), out.shaft * out.damping * g * g + brake * (v - p - g)

    def _step(self, y: State, piece: Piece, grip: Grip) -> State:
        d, p, e, g, work, loss = y
        h = piece.length
        half, sixth = 0.5 * h, h / 6.0
        start, middle, end = zip(piece.lever, piece.base, piece.drive, strict=True)
        p1, g1, w1, l1 = self._rates(d, p, e, g, start, grip)
        pb, gb = p + half * p1, g + half * g1
        p2, g2, w2, l2 = self._rates(d + half * p, pb, e + half * g, gb, middle, grip)
        pc, gc = p + half * p2, g + half * g2
        p3, g3, w3, l3 = self._rates(d + half * pb, pc, e + half * gb, gc, middle, grip)
        pd, gd = p + h * p3, g + h * g3
        p4, g4, w4, l4 = self._rates(d + h * pc, pd, e + h * gc, gd, end, grip)
        return (
            d + sixth * (p + 2.0 * (pb + pc) + pd),
            p + sixth * (p1 + 2.0 * (p2 + p3) + p4),
            e + sixth * (g + 2.0 * (gb + gc) + gd),
            g + sixth * (g1 + 2.0 * (g2 + g3) + g4),
            work + sixth * (w1 + 2.0 * (w2 + w3) + w4),
            loss + sixth * (l1 + 2.0 * (l2 + l3) + l4),
        )


def _between(x: Three, low: float, high: float) -> Three:
    """Values at the ends and the middle of a part of a piece, by the parabola through those of the piece."""

    def at(t: float) -> float:
        return x[0] * (2.0 * t - 1.0) * (t - 1.0) + 4.0 * x[1] * t * (1.0 - t) + x[2] * t * (2.0 * t - 1.0)

    return at(low), at(0.5 * (low + high)), at(high)
