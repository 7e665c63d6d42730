"""What a slice of a line contact yields on its own: Hertz in plane strain, and less of it towards free ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.cone_slices import Slices
from trochoid.kinematics.types import Array

FAINT = 1e-9  # of the largest line load: laws are linearised there at the least


@dataclass(frozen=True, eq=False, slots=True)
class Side:
    """One body of a line contact in slices.

    `kernel` 2/(πE') in 1/Pa, `ends` where it ends (m from O), `blunt` (…, s) half width B of the load that its
    elements know, m; None for a body in closed form; then `added` (s,) is what ln(2/b) + ½ becomes once added to it.
    """

    kernel: float
    poissons_ratio: float
    ends: tuple[float, float]
    blunt: Array | None
    added: Array | float = 0.0


@dataclass(frozen=True, eq=False, slots=True)
class SliceLaw:
    """Approach of slices under their forces: Σ over bodies of kernel·(F/Δ)(ln(2/b) + ½ + added) + e F/Δ.

    `radius` (…, s) combined radius of curvature, m; b² = 2 Σkernel (F/Δ) radius.
    """

    slices: Slices
    sides: tuple[Side, ...]
    radius: Array

    @property
    def kernel(self) -> float:
        """Sum of 2/(πE') of both bodies."""
        return sum(side.kernel for side in self.sides)

    def half_width(self, force: Array) -> Array:
        """Return b (…, s) in m under forces (…, s) in N."""
        line = np.maximum(force, 0.0) / self.slices.length
        return np.asarray(np.sqrt(2.0 * self.kernel * self.radius * line))

    def pressure(self, force: Array) -> Array:
        """Return the largest pressure (…, s) in Pa: 2q/(πb)."""
        b, line = self.half_width(force), np.maximum(force, 0.0) / self.slices.length
        return np.divide(2.0 * line, np.pi * b, out=np.zeros_like(line), where=b > 0.0)

    def approach(self, force: Array) -> tuple[Array, Array]:
        """Return the approach (…, s) in m and its slope in m/N at positive forces; the end term's width is frozen."""
        b, length = self.half_width(force), self.slices.length
        logarithm = np.log(2.0 / b)
        still = sum(side.kernel * side.added + self._end(side, b) for side in self.sides)
        value = force / length * (self.kernel * (logarithm + 0.5) + still)
        return np.asarray(value), np.asarray((self.kernel * logarithm + still) / length)

    def _end(self, side: Side, b: Array) -> Array | float:
        """Return e (…, s): ν²/(1−ν²)·kernel·mean over the slice of ln(B/max(d, b)), if positive, of ends of the body.

        There is plane stress, not plane strain; the elements know it from the distance B on.
        """
        if side.blunt is None:
            return 0.0
        first, last = self.slices.inner[0], self.slices.outer[-1]
        total = np.zeros_like(b)
        if abs(first - side.ends[0]) < 1e-9 * last:
            total += _log_integral(self.slices.outer - first, b, side.blunt)
            total -= _log_integral(self.slices.inner - first, b, side.blunt)
        if abs(last - side.ends[1]) < 1e-9 * last:
            total += _log_integral(last - self.slices.inner, b, side.blunt)
            total -= _log_integral(last - self.slices.outer, b, side.blunt)
        nu2 = side.poissons_ratio**2
        return np.asarray(nu2 / (1.0 - nu2) * side.kernel * total / self.slices.length)


def _log_integral(distance: Array, b: Array, blunt: Array) -> Array:
    """Return the integral from 0 to `distance` of ln(B/max(d, b)) where that is positive."""
    b = np.clip(b, 1e-300, blunt)
    d = np.minimum(distance, blunt)
    flat = np.minimum(d, b) * np.log(blunt / b)
    rest = np.maximum(d, b)
    curved = rest * (np.log(blunt / rest) + 1.0) - b * (np.log(blunt / b) + 1.0)
    return np.asarray(flat + curved)
