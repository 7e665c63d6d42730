"""The march of a driven wheel in time, with Coulomb friction that sticks and slips.

Where the braked member comes to a stop within a step, the step is cut there; it is let go at the end of a step.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.dynamics.indexing_parts import Grip, Output, Piece, State, Torque
from trochoid.dynamics.indexing_steps import runge_kutta
from trochoid.kinematics.types import Array

__all__ = ["Grip", "March", "Output", "State"]

STOPS = 5  # tries at the instant of a stop
GONE = 1e-5  # of its largest, at which a vibration has ended


@dataclass(frozen=True, slots=True)
class March:
    """The equations with the torque of contact or lock; `rest`: the base stands, and the march ends with the motion."""

    output: Output
    torque: Torque
    rest: bool = False

    def run(self, at: tuple[Array, Array, Array], h: float, y: State, grip: Grip) -> tuple[Array, Grip]:
        """Return the states (n, 6) at instants h apart; `at` are α, ψ', ψ'' at them and half-way between."""
        reach, base, drive = (x.tolist() for x in at)
        rows, size = [y], self._size(y)
        for i in range(0, len(reach) - 1, 2):
            j = i + 3
            piece = Piece(h, tuple(reach[i:j]), tuple(base[i:j]), tuple(drive[i:j]))
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
            pull = self._pull(new, piece.reach[2])
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
        pull = self._pull(y, first.reach[2])
        grip = Grip(math.copysign(1.0, pull), abs(pull) <= self.output.friction)
        return self._step(y, piece.part(part, 1.0), grip), grip

    def _pull(self, y: State, reach: float) -> float:
        """Torque (N·m) on the member that friction brakes."""
        if self.output.shaft > 0.0:
            return self.output.shaft * (y[2] + self.output.damping * y[3])
        return self.torque(y[0], y[1], reach)

    def _size(self, y: State) -> float:
        """Energy (J) of deviations in the dwell, the lock's included."""
        return self.output.energy(y, 0.0) + 0.5 * self.output.lock * y[0] ** 2

    def _step(self, y: State, piece: Piece, grip: Grip) -> State:
        return runge_kutta(self.output, self.torque, y, piece, grip)
