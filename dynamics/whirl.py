"""Natural frequencies of a system with spinning members: whirl, its damping, and the Campbell diagram."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.dynamics.system import System
from trochoid.kinematics.types import Array, ComplexArray, frozen

FREE = 1e-6  # of the stiffest frequency: below it a mode is free and its frequency rounding


@dataclass(frozen=True, eq=False, slots=True)
class Whirl:
    """Modes at one speed, by rising frequency: `frequency` (k,) Hz, damping `ratio` (k,), complex `shapes` (n, k).

    `growth` (1/s) is the fastest at which any motion grows, oscillating or not; 0 where none does.
    """

    frequency: Array
    ratio: Array
    shapes: ComplexArray
    growth: float = 0.0

    def direction(self, x: int, y: int) -> Array:
        """Sense (k,) in which the coordinates x, y circle: 1 with the x to y turn, −1 against it, 0 on a line."""
        turning = np.imag(np.conj(self.shapes[x]) * self.shapes[y])
        size = np.abs(self.shapes[x]) ** 2 + np.abs(self.shapes[y]) ** 2
        flat = np.abs(turning) <= 1e-6 * np.where(size > 0.0, size, 1.0)
        return np.where(flat, 0.0, -np.sign(turning))


def whirl(system: System) -> Whirl:
    """Return the modes that oscillate; free and overdamped ones have no frequency and are left out."""
    size = 1.0 / np.sqrt(np.diag(system.mass))
    scale = np.outer(size, size)
    m, c, k = system.mass * scale, system.velocity_matrix * scale, system.stiffness * scale
    n = system.size
    reach = float(np.sqrt(np.abs(np.linalg.solve(m, k)).max()))
    if reach == 0.0:
        return Whirl(np.zeros(0), np.zeros(0), np.zeros((n, 0), dtype=np.complex128))
    state = np.zeros((2 * n, 2 * n))  # time in units of 1/reach
    state[:n, n:] = np.eye(n)
    state[n:, :n] = -np.linalg.solve(m, k) / reach**2
    state[n:, n:] = -np.linalg.solve(m, c) / reach
    values, vectors = np.linalg.eig(state)
    values *= reach
    kept = np.flatnonzero(values.imag > FREE * reach)
    kept = kept[np.argsort(values[kept].imag, kind="stable")]
    chosen = values[kept]
    shapes = size[:, None] * vectors[:n, kept]
    shapes = shapes / np.linalg.norm(shapes, axis=0)
    fastest = float(values.real.max(initial=0.0))
    growth = fastest if fastest > FREE * reach else 0.0
    return Whirl(frozen(chosen.imag / (2.0 * np.pi)), frozen(-chosen.real / np.abs(chosen)), shapes, growth)


def campbell(system_at: Callable[[float], System], speeds: Iterable[float]) -> tuple[Whirl, ...]:
    """Return the modes at every speed (rad/s) of the system that has its spins there."""
    return tuple(whirl(system_at(speed)) for speed in speeds)


def critical_speeds(speeds: Array, found: Sequence[Whirl], order: float = 1.0) -> Array:
    """Return the speeds (rad/s) at which `order` times the speed meets a natural frequency.

    Frequencies are joined between neighbouring speeds by their rank.
    """
    count = min(len(each.frequency) for each in found)
    frequencies = 2.0 * np.pi * np.array([each.frequency[:count] for each in found])
    ahead = order * np.asarray(speeds)[:, None] - frequencies
    row, rank = np.nonzero(ahead[:-1] * ahead[1:] <= 0.0)
    low, high = ahead[row, rank], ahead[row + 1, rank]
    share = np.divide(low, low - high, out=np.zeros_like(low), where=low != high)
    return np.unique(speeds[row] + share * (speeds[row + 1] - speeds[row]))
