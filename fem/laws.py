"""Local laws: how much two surfaces approach each other under the total force of one contact.

A law gives the approach and its derivative for all contacts of a family at once; the smooth deformation of
the bodies is not in it (the coupling has it). Each law is monotone and concave in the force.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from trochoid.kinematics.types import Array


class Law(Protocol):
    """Approach (c,) in m and its derivative (c,) in m/N at forces (c,) in N."""

    def approach(self, force: Array) -> tuple[Array, Array]:
        """Return approach and derivative."""
        ...


@dataclass(frozen=True, slots=True)
class LinearSpring:
    """A spring of constant stiffness in N/m: the classical calculation with a rigid disc."""

    stiffness: float

    def approach(self, force: Array) -> tuple[Array, Array]:
        """Return F/k."""
        return force / self.stiffness, np.full_like(force, 1 / self.stiffness)


@dataclass(frozen=True, slots=True)
class HertzLine:
    """Hertz line contact seen from its own half-width a: h = A F (ln(2/a) + ½), with a² = 2 A F R.

    `kernel` (c,) is A, the sum of 2/(πE') of both bodies over the face width, in m/N; `radius` (c,) the
    combined radius of curvature of both surfaces, in m.
    """

    kernel: Array
    radius: Array

    def half_width(self, force: Array) -> Array:
        """Return a (c,) in m: a² = 4FR/(πE*b) and A = 2/(πE*b)."""
        return np.sqrt(2 * self.kernel * self.radius * np.maximum(force, 0.0))

    def reach(self, force: Array) -> Array:
        """Return how far from the contact point the surfaces touch, a (c,) in m."""
        return self.half_width(force)

    def peak(self, force: Array) -> Array:
        """Return the largest pressure times the face width, 2F/(πa) (c,) in N/m."""
        half = self.half_width(force)
        return np.divide(2 * force, np.pi * half, out=np.zeros_like(force), where=half > 0)

    def approach(self, force: Array) -> tuple[Array, Array]:
        """Return h and dh/dF = A ln(2/a)."""
        a = self.half_width(force)
        logarithm = np.log(2 / a)
        return self.kernel * force * (logarithm + 0.5), self.kernel * logarithm


@dataclass(frozen=True, slots=True)
class PowerLaw:
    """F = c δ^n: the line contact of ISO/TS 16281 has n = 10/9 and c for roller and both raceways together."""

    constant: float
    exponent: float

    def approach(self, force: Array) -> tuple[Array, Array]:
        """Return (F/c)^(1/n) and its derivative."""
        delta = (force / self.constant) ** (1 / self.exponent)
        return delta, delta / (self.exponent * force)
