"""What is driven, a piece of its course, and what friction does: the parts of the equations of a driven wheel.

States are d, d', e, e', the work of the pin and what is lost; friction acts on the wheel, or on the load behind a
shaft.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

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

    @property
    def shaft_frequency(self) -> float:
        """Angular frequency (rad/s) of wheel and load on the shaft alone; 0 without one."""
        if self.shaft == 0.0:
            return 0.0
        return math.sqrt(self.shaft / self.inertia + self.shaft / self.load)

    def energy(self, y: State, base: float) -> float:
        """Energy (J) of both masses and the shaft, ψ' being `base`."""
        speed = base - y[1]
        return 0.5 * (self.inertia * speed**2 + self.load * (speed - y[3]) ** 2 + self.shaft * y[2] ** 2)


@dataclass(frozen=True, slots=True)
class Piece:
    """A piece `length` (s) long: α (rad) from the wheel's axis to the pin, ψ', ψ'' at its start, middle and end."""

    length: float
    reach: Three
    base: Three
    drive: Three

    def part(self, low: float, high: float) -> Piece:
        """Return a part of the piece, by the parabolas through its values."""
        return Piece(
            (high - low) * self.length,
            _between(self.reach, low, high),
            _between(self.base, low, high),
            _between(self.drive, low, high),
        )


@dataclass(frozen=True, slots=True)
class Grip:
    """What friction does: it holds the output (`held`), or brakes it against `sign`; 0 where there is none."""

    sign: float
    held: bool


def _between(x: Three, low: float, high: float) -> Three:
    """Values at the ends and the middle of a part of a piece, by the parabola through those of the piece."""

    def at(t: float) -> float:
        return x[0] * (2.0 * t - 1.0) * (t - 1.0) + 4.0 * x[1] * t * (1.0 - t) + x[2] * t * (2.0 * t - 1.0)

    return at(low), at(0.5 * (low + high)), at(high)
