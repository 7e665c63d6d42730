"""Steady motion of a linear system whose stiffness varies with the period of its load (Hill's equations).

    M ÿ + V ẏ + K(t) y = f(t)          V = C + G, K and f sampled at n equal instants of the period

Harmonics that K couples are solved together: by iteration (GMRES) about the mean stiffness, and directly where that
does not settle, so that a strong variation is as good as a weak one.  Harmonics above `coupled` see the mean stiffness.
Whether the motion is also stable, `floquet` tells.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.dynamics.spectrum import harmonics, highest_harmonic, synthesize
from trochoid.kinematics.errors import NotConverged, TrochoidError
from trochoid.kinematics.types import Array, ComplexArray

COUPLED = 60  # harmonics that the variation couples: 1500 Hz at 1500 rpm
UNKNOWNS = 3000  # that are solved together at most
STEPS, TIGHT, SETTLED = 100, 1e-13, 1e-9  # of the iteration; of the loads: sought, and accepted
NOISE = 1e-13  # of the terms of a stiffness, which is rounding
FLAT, HEARD = 1e-8, 1e-13  # of (hω)²: dynamic stiffness of a resonance; of the loads: what does not excite it


def coupled(positions: int, coordinates: int) -> int:
    """Return the highest harmonic that the variation of the stiffness couples."""
    most = (UNKNOWNS // max(coordinates, 1) - 1) // 2
    return max(1, min(highest_harmonic(positions), COUPLED, most))


def rate(record: Array, speed: float, times: int = 1) -> Array:
    """Return the derivative in time (n, …) of a record of one period 2π/`speed`, once or more `times`."""
    lines = harmonics(record)
    order = (1j * speed * np.arange(len(lines))) ** times
    return synthesize(order.reshape(-1, *(1,) * (record.ndim - 1)) * lines, len(record))


def lowered(record: Array, highest: int) -> Array:
    """Return the part of a record (n, …) up to a harmonic, its mean with it."""
    lines = harmonics(record)
    lines[highest + 1 :] = 0.0
    return synthesize(lines, len(record))


def varied(stiffness: Array, motion: Array) -> Array:
    """Return the force K(t) y as it stands in the equations, of a stiffness (n, r, k) and a motion (n, k)."""
    highest = coupled(len(motion), motion.shape[1])
    mean = stiffness.mean(axis=0)
    change = np.einsum("nrk,nk->nr", stiffness - mean, lowered(motion, highest))
    return np.asarray(motion @ mean.T + lowered(change, highest))


def steady(mass: Array, velocity: Array, stiffness: Array, force: Array, speed: float) -> Array:
    """Return y (n, k) under `force` (n, k); `mass`, `velocity` (k, k), `stiffness` (n, k, k), `speed` rad/s.

    What no stiffness ever holds does not leave its place on average.  Raises TrochoidError for a speed that is not
    above 0, fewer than 3 positions, and a resonance without damping; NotConverged where the varying stiffness leaves no
    steady motion.
    """
    if not (np.isfinite(speed) and speed > 0.0):
        raise TrochoidError(f"dynamics needs a speed above 0, given {speed} rad/s")
    size = 1.0 / np.sqrt(np.diag(mass))
    scale = np.outer(size, size)
    lines = harmonics(force * size)
    if not lines.any():
        return np.zeros_like(force)
    made = _System(mass * scale, velocity * scale, stiffness * scale, speed)
    if made.constant:
        return np.asarray(synthesize(_apart(made, lines), len(force)) * size)
    low = coupled(len(force), len(size))
    found = np.zeros_like(lines)
    found[: low + 1] = _together(made, lines[: low + 1])
    if low + 1 < len(lines):
        found[low + 1 :] = _apart(made, lines, low + 1)
    return np.asarray(synthesize(found, len(force)) * size)


@dataclass(frozen=True, eq=False, slots=True)
class _System:
    """Matrices on coordinates that are scaled by their masses; `stiffness` (n, k, k)."""

    mass: Array
    velocity: Array
    stiffness: Array
    speed: float

    @property
    def constant(self) -> bool:
        return bool((self.stiffness == self.stiffness[0]).all())

    @property
    def mean(self) -> Array:
        return np.asarray(self.stiffness[0] if self.constant else self.stiffness.mean(axis=0))

    def dynamic(self, highest: int) -> ComplexArray:
        """Return the dynamic stiffness (highest + 1, k, k) of the mean at harmonics 0 …, free modes held."""
        omega = (self.speed * np.arange(highest + 1))[:, None, None]
        made = np.asarray(self.mean - omega**2 * self.mass + 1j * omega * self.velocity, dtype=np.complex128)
        made[0] += self.held()
        return made

    def held(self) -> Array:
        """Return a stiffness (k, k) of the mean motion of what nothing holds, as large as others are."""
        mean = self.mean
        shapes = np.linalg.eigh(0.5 * (mean + mean.T))[1]
        terms = np.einsum("in,ij,jn->n", np.abs(shapes), np.abs(mean), np.abs(shapes))
        left = np.abs(np.einsum("in,ij,jn->n", shapes, mean, shapes))
        free = shapes[:, left <= NOISE * len(mean) * terms]
        return np.asarray(max(float(np.abs(mean).max()), self.speed**2) * free @ free.T)

    def applied(self, lines: ComplexArray, held: Array) -> ComplexArray:
        """Return the loads that a motion needs, by harmonics (h + 1, k) of both."""
        omega = (self.speed * np.arange(len(lines)))[:, None]
        moved = synthesize(lines, len(self.stiffness))
        made = harmonics(np.einsum("nij,nj->ni", self.stiffness, moved))[: len(lines)]
        made += 1j * omega * (lines @ self.velocity.T) - omega**2 * (lines @ self.mass.T)
        made[0] += lines[0] @ held.T
        return made


def _apart(made: _System, lines: ComplexArray, first: int = 0) -> ComplexArray:
    """Solve each harmonic from `first` on by itself, with the mean stiffness.

    Resonances that no load meets answer nothing.
    """
    left, values, right = np.linalg.svd(made.dynamic(len(lines) - 1)[first:])
    flat = values <= FLAT * ((made.speed * np.arange(first, len(lines))) ** 2)[:, None]
    felt = np.einsum("hij,hi->hj", np.conj(left), lines[first:])
    hit = flat & (np.abs(felt) > HEARD * np.abs(lines).max())
    if hit.any():
        line = first + int(np.nonzero(hit)[0][0])
        raise TrochoidError(
            f"no steady motion: harmonic {line} ({line * made.speed / 2 / np.pi:.6g} Hz) coincides with a natural "
            "frequency and there is no damping: the motion grows for ever; give operation.damping_ratio > 0 or change "
            "the speed"
        )
    gain = np.where(flat, 0.0, 1.0 / np.where(flat, 1.0, values))
    return np.asarray(np.einsum("hji,hj->hi", np.conj(right), gain * felt), dtype=np.complex128)


def _together(made: _System, lines: ComplexArray) -> ComplexArray:
    """Solve the harmonics of `lines` (h + 1, k) together."""
    from scipy.sparse.linalg import LinearOperator, gmres

    held, count, size = made.held(), lines.shape[1], float(np.abs(lines).max())
    if size == 0.0:
        return np.zeros_like(lines)
    right = _packed(lines / size)
    answers = np.linalg.pinv(made.dynamic(len(lines) - 1), rcond=1e-15)

    def near(flat: Array) -> ComplexArray:
        return np.asarray(np.einsum("hij,hj->hi", answers, _unpacked(flat, count)))

    def loads(flat: Array) -> Array:
        return _packed(made.applied(near(flat), held))

    operator = LinearOperator((right.size, right.size), matvec=loads, dtype=np.float64)
    given, _ = gmres(operator, right, rtol=TIGHT, restart=STEPS, maxiter=1)
    found = near(given)
    if not _meets(
        made, found, held, right
    ):  # contacts that come and go: too far from the mean for an iteration
        found = _unpacked(_directly(made, right, held), count)
        if not _meets(made, found, held, right):
            raise NotConverged(
                "no steady motion was found with the stiffness of every position: the equations are all but singular; "
                "raise operation.damping_ratio, change the speed, or ask for fewer positions"
            )
    return np.asarray(size * found)


def _meets(made: _System, lines: ComplexArray, held: Array, right: Array) -> bool:
    """Whether the loads of a motion are those that are given, to SETTLED."""
    if not np.isfinite(lines).all():
        return False
    return bool(np.abs(_packed(made.applied(lines, held)) - right).max() <= SETTLED)


def _directly(made: _System, right: Array, held: Array) -> Array:
    """Solve the harmonics together as one real system, packed like `right`."""
    count, n = len(made.mass), len(made.stiffness)
    low = (len(right) // count - 1) // 2
    phase = 2.0 * np.pi * np.outer(np.arange(n), np.arange(1, low + 1)) / n
    # the real part of harmonics c: Re c cos − Im c sin
    waves = np.concatenate([np.ones((n, 1)), np.cos(phase), -np.sin(phase)], axis=1)
    share = np.full(2 * low + 1, 2.0 / n)
    share[0] = 1.0 / n
    pairs = (share[:, None] * waves.T)[:, None, :] * waves.T[None]
    size = len(waves.T)
    matrix = (pairs.reshape(size * size, n) @ made.stiffness.reshape(n, -1)).reshape(size, size, count, count)
    omega = made.speed * np.arange(1, low + 1)
    real, imaginary = np.arange(1, low + 1), np.arange(low + 1, 2 * low + 1)
    matrix[real, real] -= omega[:, None, None] ** 2 * made.mass
    matrix[imaginary, imaginary] -= omega[:, None, None] ** 2 * made.mass
    matrix[real, imaginary] -= omega[:, None, None] * made.velocity
    matrix[imaginary, real] += omega[:, None, None] * made.velocity
    matrix[0, 0] += held
    try:
        return np.asarray(np.linalg.solve(matrix.transpose(0, 2, 1, 3).reshape(size * count, -1), right))
    except np.linalg.LinAlgError:
        return np.full_like(right, np.nan)


def _packed(lines: ComplexArray) -> Array:
    """Return harmonics (nh + 1, k) as real numbers; the mean has no imaginary part."""
    return np.concatenate([lines[0].real, lines[1:].real.ravel(), lines[1:].imag.ravel()])


def _unpacked(flat: Array, count: int) -> ComplexArray:
    mean, rest = flat[:count], flat[count:].reshape(2, -1, count)
    return np.concatenate([mean[None].astype(np.complex128), rest[0] + 1j * rest[1]])
