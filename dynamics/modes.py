"""Undamped modes of a mass and a stiffness matrix, free rigid-body modes included."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, ComplexArray, frozen


@dataclass(frozen=True, slots=True)
class Modes:
    """Angular frequencies (n,), rad/s, rising, exactly 0 for free modes; mass-normalised `shapes` (n, n)."""

    angular_frequencies: Array
    shapes: Array

    @property
    def hertz(self) -> Array:
        """Natural frequencies (n,), Hz."""
        return frozen(self.angular_frequencies / (2.0 * np.pi))


@dataclass(frozen=True, slots=True)
class FrequencyResponse:
    """Frequency response of the modes at the harmonics `order` (nh,) in rad/s."""

    modes: Modes
    order: Array
    damping_ratio: float

    def denominator(self) -> ComplexArray:
        """Return ω_i² − Ω² + 2iζ ω_i Ω (nh, n)."""
        natural, driving = self.modes.angular_frequencies[None, :], self.order[:, None]
        values = natural**2 - driving**2 + 2j * self.damping_ratio * natural * driving
        return np.asarray(values, dtype=np.complex128)

    def spring_factor(self) -> ComplexArray:
        """Return 1 + iΩ·2ζ/ω_i (nh, n): spring and damper force over spring force; 1 for free modes."""
        natural = self.modes.angular_frequencies
        delay = np.divide(2.0 * self.damping_ratio, natural, out=np.zeros_like(natural), where=natural > 0.0)
        return np.asarray(1.0 + 1j * self.order[:, None] * delay, dtype=np.complex128)


def natural_modes(mass: Array, stiffness: Array) -> Modes:
    """Solve K v = ω² M v; raises when M is not positive definite or K is not positive semi-definite.

    Coordinates are scaled by their masses first, so that metres and radians, grams and tonnes may stand
    side by side. A mode is free when its stiffness vᵀKv is lost in the rounding of the terms it is summed
    from.
    """
    from scipy.linalg import eigh

    m, k = _symmetric("mass", mass), _symmetric("stiffness", stiffness)
    if m.shape != k.shape:
        raise TrochoidError(f"mass {m.shape} and stiffness {k.shape} must be on the same coordinates")
    inverse = 1.0 / np.sqrt(_fail_unless_positive(m))
    scale = np.outer(inverse, inverse)
    if np.linalg.eigvalsh(m * scale).min() <= 1e-12:
        raise TrochoidError("the mass matrix is not positive definite; check masses and their couplings")
    _, vectors = eigh(k * scale, m * scale)
    shapes = inverse[:, None] * np.asarray(vectors)
    squares = np.einsum("in,ij,jn->n", shapes, k, shapes)
    noise = 1e-13 * len(m) * np.einsum("in,ij,jn->n", np.abs(shapes), np.abs(k), np.abs(shapes))
    if (squares < -1e3 * noise).any():
        worst = int(np.argmax(np.abs(shapes[:, np.argmin(squares)]) / inverse))
        raise TrochoidError(
            f"the stiffness matrix is not positive semi-definite (coordinate {worst} dominates the unstable "
            f"mode); check the signs of the springs"
        )
    angular = np.sqrt(np.where(squares > noise, squares, 0.0))
    order = np.argsort(angular, kind="stable")
    return Modes(frozen(angular[order]), frozen(shapes[:, order]))


def _symmetric(name: str, matrix: Array) -> Array:
    values = np.asarray(matrix, dtype=np.float64)
    if values.ndim != 2 or values.shape[0] != values.shape[1] or not np.isfinite(values).all():
        raise TrochoidError(f"the {name} matrix must be square and finite, given shape {values.shape}")
    diagonal = np.sqrt(np.abs(np.diag(values)))
    if (np.abs(values - values.T) > 1e-6 * np.outer(diagonal, diagonal) + 1e-12 * np.abs(values).max()).any():
        raise TrochoidError(f"the {name} matrix is not symmetric; reaction must equal action")
    return np.asarray(0.5 * (values + values.T))


def _fail_unless_positive(mass: Array) -> Array:
    diagonal = np.diag(mass)
    if (diagonal <= 0.0).any():
        bad = int(np.argmin(diagonal))
        raise TrochoidError(
            f"coordinate {bad} has mass {diagonal[bad]:.3g}; every elastic coordinate needs a positive mass "
            f"or inertia"
        )
    return diagonal
