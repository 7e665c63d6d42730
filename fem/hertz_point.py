"""Hertz point contact of two elastic bodies, exactly: contact ellipse, approach and pressure by elliptic integrals."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.fem.material import Material
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array

EXACT = math.pi * math.sqrt(2.0) / 3.0  # of c in Q = c δ^(3/2), from Hertz
ISO16281 = 1.48  # the same factor as ISO/TS 16281 rounds it
LONGEST = 1e8  # ratio of the ellipse's axes above which the contact is a line


@dataclass(frozen=True, slots=True)
class PointContact:
    """An elliptical Hertz contact: what its shape is, before any load.

    `modulus` E* in Pa, 1/E* = Σ(1−ν²)/E; `curvature_sum` Σρ in 1/m; `ratio` χ ≥ 1 of the ellipse's semi-axes;
    `first` and `second`: the complete elliptic integrals K and E of modulus k² = 1 − 1/χ².
    """

    modulus: float
    curvature_sum: float
    ratio: float
    first: float
    second: float

    def softness(self, factor: float = EXACT) -> float:
        """Return s (m/N^(2/3)) of the approach δ = s Q^(2/3); softnesses of contacts in series add up.

        ISO/TS 16281: c = 1.48·E/(1−ν²)·[K (Σρ/(χ² E))^(1/3)]^(−3/2) and s = c^(−2/3); `factor` stands for 1.48.
        """
        shape = self.first * (self.curvature_sum / (self.ratio**2 * self.second)) ** (1.0 / 3.0)
        return float(shape / (2.0 * self.modulus * factor) ** (2.0 / 3.0))

    def semi_axes(self, load: Array) -> tuple[Array, Array]:
        """Return the larger and the smaller semi-axis (…,) in m under loads (…,) in N."""
        size = np.cbrt(1.5 * np.maximum(load, 0.0) / (self.curvature_sum * self.modulus))
        long = size * (2.0 * self.ratio**2 * self.second / math.pi) ** (1.0 / 3.0)
        return long, long / self.ratio

    def pressure(self, load: Array) -> Array:
        """Return the largest pressure (…,) in Pa under loads (…,) in N: 3Q/(2πab)."""
        unit_long, unit_short = self.semi_axes(np.ones(()))
        peak: Array = 1.5 * np.cbrt(np.maximum(load, 0.0)) / (math.pi * unit_long * unit_short)
        return peak

    def load_at(self, pressure: float) -> float:
        """Return the load in N under which the largest pressure is `pressure`, Pa."""
        return float((pressure / self.pressure(np.ones(()))) ** 3)


def point_contact(curvatures: tuple[float, float], modulus: float) -> PointContact:
    """Return the contact of two bodies whose relative curvatures in the two principal planes are `curvatures`, 1/m.

    A relative curvature is the sum of both bodies' curvatures, hollow ones negative.  Raises Infeasible where
    the bodies conform: then the contact is no Hertz contact.
    """
    low, high = sorted(curvatures)
    if not (math.isfinite(high) and low > 0.0 and modulus > 0.0):
        raise Infeasible(
            f"Hertz point contact: relative curvatures and modulus must be positive and finite, given "
            f"{curvatures} 1/m and {modulus} Pa; a groove's radius must exceed the ball's"
        )
    ratio = _ratio((high - low) / (high + low))
    first, defect = _elliptic(ratio)
    return PointContact(modulus, high + low, ratio, first, first * (1.0 - defect))


def contact_modulus(one: Material, other: Material) -> float:
    """Return E* in Pa of a pair: 1/E* = (1−ν₁²)/E₁ + (1−ν₂²)/E₂."""
    return 1.0 / sum((1.0 - m.poissons_ratio**2) / m.youngs_modulus for m in (one, other))


def _elliptic(ratio: float) -> tuple[float, float]:
    """Return K and 1 − E/K for k² = 1 − 1/χ², by the arithmetic-geometric mean, without cancellation near χ = 1."""
    a, b = 1.0, 1.0 / ratio
    total, weight = 0.5 * (1.0 - b) * (1.0 + b), 0.5
    for _ in range(12):
        gap = 0.5 * (a - b)
        a, b = 0.5 * (a + b), math.sqrt(a * b)
        weight *= 2.0
        total += weight * gap * gap
        if gap < 1e-12 * a:
            break
    return math.pi / (2.0 * a), total


def _difference(ratio: float) -> float:
    """Return the relative curvature difference F(ρ) that an ellipse of this ratio has (ISO/TS 16281, Hertz)."""
    _, defect = _elliptic(ratio)
    return 1.0 - 2.0 * defect / ((1.0 - defect) * (ratio - 1.0) * (ratio + 1.0))


def _ratio(difference: float) -> float:
    """Return χ ≥ 1 of a relative curvature difference: bisection in ln χ, down to rounding."""
    low, high = 0.0, math.log(LONGEST)
    if difference >= _difference(LONGEST):
        raise Infeasible(
            f"Hertz point contact: relative curvature difference {difference:.16g} is that of a line contact; "
            f"make the curvatures less different"
        )
    for _ in range(60):
        middle = 0.5 * (low + high)
        if middle > 0.0 and _difference(math.exp(middle)) > difference:
            high = middle
        else:
            low = middle
    return math.exp(0.5 * (low + high)) if difference > 0.0 else 1.0
