"""Stress in an elastic half-plane from the tractions on its surface, by their Cauchy integrals.

With ζ = x + iz (x along the surface, z into the body) and a pressure p(s), let A = ∫ p/(ζ−s) ds and
D = ∫ p/(ζ−s)² ds = −A'; likewise for a shear traction q(s) along x. The integrals of Johnson, Contact
Mechanics (2.23), are then sums of their real and imaginary parts.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.types import Array

ComplexArray = npt.NDArray[np.complex128]


@dataclass(frozen=True, slots=True)
class Cauchy:
    """The integrals A and D (n,) of a traction, in Pa and Pa/m."""

    integral: ComplexArray
    slope: ComplexArray

    def __add__(self, other: Cauchy) -> Cauchy:
        """Return the integrals of the sum of two tractions."""
        return Cauchy(self.integral + other.integral, self.slope + other.slope)

    def scaled(self, factor: float) -> Cauchy:
        """Return the integrals of a multiple of the traction."""
        return Cauchy(factor * self.integral, factor * self.slope)


def below(position: Array) -> ComplexArray:
    """Return ζ (n,) of positions (n, 2) as x, z in m; points above the surface count as on it."""
    return np.asarray(position[:, 0] + 1j * (np.maximum(position[:, 1], 0.0) + 0.0))


def surface_stress(zeta: ComplexArray, pressure: Cauchy, shear: Cauchy) -> Array:
    """Return the stress (n, 3) σx, σz, τxz in Pa at ζ (n,) under a pressure and a shear traction along x.

    Tension is positive; τxz is the traction along x on a face whose normal points along z.
    """
    z, a, b = zeta.imag, pressure.integral, shear.integral
    total = a.imag - b.real
    difference = z * pressure.slope.real + b.real + z * shear.slope.imag
    tau = z * pressure.slope.imag + b.imag - z * shear.slope.real
    return np.asarray(np.stack([total - difference, total + difference, tau], axis=-1) / np.pi)


def ellipse(zeta: ComplexArray, half_width: float) -> Cauchy:
    """Return the integrals of a unit force spread over ±`half_width` (m) as half an ellipse (Hertz)."""
    root = np.sqrt(zeta - half_width) * np.sqrt(zeta + half_width)
    root = np.where(root == 0, 1e-150, root)  # at the edges: finite, and 0 once multiplied by the depth
    integral = 2 / (zeta + root)
    return Cauchy(integral, integral / root)
