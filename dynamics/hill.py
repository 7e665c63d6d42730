"""Steady motion of a linear system whose stiffness varies with the period of its load (Hill's equations).

    M ÿ + V ẏ + K(t) y = f(t)          V = C + G, K and f sampled at n equal instants of the period

Harmonics that K couples are solved together, directly: no iteration, so that a strong variation is as good as a weak
one.  Whether the motion is also stable, `growth` tells.
"""

from __future__ import annotations

import numpy as np

from trochoid.dynamics.spectrum import harmonics, synthesize
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, ComplexArray

COUPLED = 30  # harmonics that the variation couples; higher ones see the mean stiffness
UNKNOWNS = 3000  # complex ones that are solved together at most


def coupled(positions: int, coordinates: int) -> int:
    """Return the highest harmonic that the variation of the stiffness couples."""
    return max(1, min((positions - 1) // 2, COUPLED, (UNKNOWNS // max(coordinates, 1) - 1) // 2))


def lowered(record: Array, highest: int) -> Array:
    """Return the part of a record (n, …) up to a harmonic, its mean with it."""
    lines = harmonics(record)
    lines[highest + 1 :] = 0.0
    return synthesize(lines, len(record))


def rate(record: Array, speed: float, times: int = 1) -> Array:
    """Return the derivative in time (n, …) of a record of one period 2π/`speed`, once or more `times`."""
    lines = harmonics(record)
    order = (1j * speed * np.arange(len(lines))) ** times
    return synthesize(order.reshape(-1, *(1,) * (record.ndim - 1)) * lines, len(record))


def varied(stiffness: Array, motion: Array) -> Array:
    """Return the force K(t) y (n, r) as it stands in the equations, of a stiffness (n, r, k) and a motion (n, k)."""
    highest = coupled(len(motion), motion.shape[1])
    mean = stiffness.mean(axis=0)
    change = np.einsum("nrk,nk->nr", stiffness - mean, lowered(motion, highest))
    return np.asarray(motion @ mean.T + lowered(change, highest))


def steady(mass: Array, velocity: Array, stiffness: Array, force: Array, speed: float) -> Array:
    """Return y (n, k) under `force` (n, k); `mass`, `velocity` (k, k), `stiffness` (n, k, k), `speed` rad/s.

    A coordinate that neither a stiffness nor a load ever holds stays where it is.  Raises TrochoidError for a speed
    that is not above 0, fewer than 3 positions, and where the equations are singular.
    """
    if not (np.isfinite(speed) and speed > 0.0):
        raise TrochoidError(f"dynamics needs a speed above 0, given {speed} rad/s")
    held = np.abs(stiffness).max(axis=(0, 2)) > 0.0
    answer = np.zeros_like(force)
    if not held.any():
        return answer
    square = np.ix_(held, held)
    size = 1.0 / np.sqrt(np.diag(mass)[held])
    scale = np.outer(size, size)
    m, v = mass[square] * scale, velocity[square] * scale
    k = stiffness[:, held][:, :, held] * scale
    lines = harmonics(force[:, held] * size)
    highest, count = coupled(len(force), len(size)), len(size)
    moved = np.zeros_like(lines)
    moved[: highest + 1] = _low(m, v, k, lines[: highest + 1], speed)
    omega = (speed * np.arange(highest + 1, len(lines)))[:, None, None]
    if len(omega):
        dynamic = k.mean(axis=0) + 1j * omega * v - omega**2 * m
        moved[highest + 1 :] = np.linalg.solve(dynamic, lines[highest + 1 :, :, None])[:, :, 0]
    if not np.isfinite(moved).all() or moved.shape[1] != count:
        raise TrochoidError("no steady motion: the equations are singular; raise operation.damping_ratio")
    answer[:, held] = synthesize(moved, len(force)) * size
    return answer


def _low(mass: Array, velocity: Array, stiffness: Array, lines: ComplexArray, speed: float) -> ComplexArray:
    """Solve the harmonics −H…H together; `lines` (H + 1, k) are peak amplitudes, the answer likewise."""
    positions, count, highest = len(stiffness), len(mass), len(lines) - 1
    order = np.arange(-highest, highest + 1)
    spectrum = np.fft.fft(stiffness, axis=0) / positions
    matrix = spectrum[(order[:, None] - order) % positions].transpose(0, 2, 1, 3)
    matrix = matrix.reshape(len(order) * count, -1)
    for i, h in enumerate(order):
        at = slice(i * count, (i + 1) * count)
        matrix[at, at] += 1j * h * speed * velocity - (h * speed) ** 2 * mass
    both = np.concatenate([0.5 * np.conj(lines[:0:-1]), lines[:1], 0.5 * lines[1:]])
    try:
        found = np.linalg.solve(matrix, both.ravel()).reshape(both.shape)
    except np.linalg.LinAlgError:
        raise TrochoidError(
            "no steady motion: the equations are singular; raise operation.damping_ratio or change the speed"
        ) from None
    return np.asarray(np.concatenate([found[highest : highest + 1], 2.0 * found[highest + 1 :]]))


def growth(mass: Array, velocity: Array, stiffness: Array, speed: float) -> float:
    """Return by how much the fastest free motion grows over a period (Floquet): above 1 the steady one is unstable.

    States are carried from instant to instant by the exact solution of a constant stiffness, which errs with the
    square of the step.
    """
    from scipy.linalg import expm

    size = 1.0 / np.sqrt(np.diag(mass))
    scale = np.outer(size, size)
    n, step = len(mass), 2.0 * np.pi / speed / len(stiffness)
    inverse = np.linalg.inv(mass * scale)
    each = np.zeros((len(stiffness), 2 * n, 2 * n))
    each[:, :n, n:] = step * np.eye(n)
    each[:, n:, n:] = -step * inverse @ (velocity * scale)
    middle = 0.5 * (stiffness + np.roll(stiffness, -1, axis=0))
    each[:, n:, :n] = -step * inverse @ (middle * scale)
    # positions and velocities in units in which a step is of size one
    reach = np.sqrt(max(float(np.abs(each[:, n:, :n]).max()) / step, 1.0))
    each[:, :n, n:] *= reach
    each[:, n:, :n] /= reach
    carried = np.eye(2 * n)
    for matrix in expm(each):
        carried = matrix @ carried
    return float(np.abs(np.linalg.eigvals(carried)).max())
