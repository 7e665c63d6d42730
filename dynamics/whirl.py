"""Natural frequencies of a system with spinning members: whirl, its damping, and the Campbell diagram."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.dynamics.system import System
from trochoid.kinematics.types import Array, ComplexArray, frozen

ROUNDING = 1e-12  # of the stiffest frequency: what rounding leaves of a motion that has none
GROWS = 1e-6  # of a motion's own size: below it growth is rounding
NOISE = 1e-13  # of the terms of a modal stiffness: below it a mode is free
SOFT = 1e-8  # of the largest modal stiffness: below it modes are sought among themselves


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
    """Return the modes that oscillate; free and overdamped ones have no frequency and are left out.

    The states are the velocities of the modes at standstill and their displacements in units in which the springs' work
    is that of a mass: where nothing damps the matrix of rates is skew, and soft modes beside extremely stiff ones keep
    their digits.
    """
    m, k = np.asarray(system.mass), np.asarray(system.stiffness)
    squares, shapes = _graded(m, k)
    size = np.sqrt(np.abs(squares))
    held = squares != 0.0
    count, n = int(held.sum()), system.size
    if count == 0 and not system.velocity_matrix.any():
        return Whirl(np.zeros(0), np.zeros(0), np.zeros((n, 0), dtype=np.complex128))
    state = np.zeros((count + n, count + n))
    state[np.arange(count), count + np.flatnonzero(held)] = size[held]
    state[count + np.flatnonzero(held), np.arange(count)] = -np.sign(squares[held]) * size[held]
    state[count:, count:] = -shapes.T @ system.velocity_matrix @ shapes
    reach = float(np.abs(state).max())
    values, vectors = np.linalg.eig(state / reach)
    values *= reach
    kept = np.flatnonzero(values.imag > ROUNDING * reach)
    kept = kept[np.argsort(values[kept].imag, kind="stable")]
    chosen = values[kept]
    moved = shapes @ (vectors[count:, kept] / chosen)
    moved = moved / np.linalg.norm(moved, axis=0)
    grows = values.real[values.real > GROWS * np.abs(values) + ROUNDING * reach]
    fastest = float(grows.max(initial=0.0))
    return Whirl(frozen(chosen.imag / (2.0 * np.pi)), frozen(-chosen.real / np.abs(chosen)), moved, fastest)


def _graded(mass: Array, stiffness: Array) -> tuple[Array, Array]:
    """Return ω² (n,), exactly 0 for free modes, and mass-normalised shapes (n, n) of K v = ω² M v, K of either sign.

    Modes that are much softer than the stiffest are lost in its rounding; they are solved again in the space that they
    span, and so on.
    """
    size = 1.0 / np.sqrt(np.diag(mass))
    unit = np.linalg.cholesky(mass * np.outer(size, size))
    back = np.linalg.solve(unit, np.diag(size))
    level = back @ stiffness @ back.T
    level = 0.5 * (level + level.T)
    n = len(level)
    squares, shapes = np.zeros(n), np.eye(n)
    first = 0
    while first < n:
        own = shapes[:, first:]
        within = own.T @ level @ own
        noise = NOISE * n * np.abs(own.T) @ np.abs(level) @ np.abs(own)
        within = np.where(np.abs(within) > noise, within, 0.0)
        values, turned = np.linalg.eigh(0.5 * (within + within.T))
        order = np.argsort(-np.abs(values), kind="stable")
        shapes[:, first:] = own @ turned[:, order]
        squares[first:] = values[order]
        largest = float(np.abs(values).max())
        if largest == 0.0:
            break
        first += int((np.abs(values) > SOFT * largest).sum())
    return squares, back.T @ shapes


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
