"""Line contact beside a rounded edge: Hertz's parabola, cut off where one surface ends (the tip of a tooth).

The parabola's vertex lies x inside the edge (negative: beyond it, where the surface would have to go on). Under the
load the surfaces touch from the edge to b inside it, with a² = 2AFR of the uncut contact:

    a² = ¾ b² − x b,   p ~ sqrt((b − s)/s)·(s + b/2 − x)   at s from the edge,
    h = A F (ln(4/b) + w − v/2) + x²/(2R),   dh/dF = A ln(4/b),   w = b (b/2 − x)/a²,   v = b²/(4a²),

the last term for x > 0 only: then gaps count from the vertex, else from the edge. From x = a on it is Hertz's
contact. Beyond the edge and under little load the contact sits on the rounding alone: Hertz's again, with the radius
r. Both leave out what the other has, and are too soft; e^{−h/(AF)} of both are added as squares (strips on the exact
profile: 0.1 % of a tooth pair's deflection, 0.5 % with the stiffer one alone). Singular integrals as in Johnson,
Contact Mechanics, 2.7. The peak at the edge is limited by its rounding r: with d the pressed part of the rounding,
d³ = (¾π r sqrt(b)(b/2 − x)/R)², p = 1.20 E* d/(π r) (a half-plane, flat then round).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.fem.laws import HertzLine
from trochoid.kinematics.types import Array

FAINT = 1e-200  # N: no contact; logarithms of nothing are not taken
PEAK = 1.1997  # largest of sqrt(X) + ½(1 − X) ln((1 + sqrt X)/(1 − sqrt X)), X = 0 … 1


@dataclass(frozen=True, slots=True)
class EdgeLine:
    """Contacts beside edges: `kernel` A (c,) in m/N, uncut combined `radius` (c,), distance `inside` (c,) of the vertex
    from the edge, `rounding` (c,) of the edge, in m.
    """

    kernel: Array
    radius: Array
    inside: Array
    rounding: Array

    @property
    def _uncut(self) -> HertzLine:
        return HertzLine(self.kernel, self.radius)

    @property
    def _round(self) -> HertzLine:
        return HertzLine(self.kernel, self.rounding)

    def half_width(self, force: Array) -> Array:
        """Return half of what touches (c,) in m."""
        cut = 0.5 * _span(self._uncut.half_width(force), self.inside)
        return np.where(self.inside < 0.0, np.maximum(cut, self._round.half_width(force)), cut)

    def reach(self, force: Array) -> Array:
        """Return how far from the contact point the surfaces touch at the most (c,), in m."""
        half = self._uncut.half_width(force)
        cut = _span(half, self.inside) - np.clip(self.inside, 0.0, half)
        # where both share the load, they touch farther than either alone
        return np.where(self.inside < 0.0, cut + 2.0 * self._round.half_width(force), cut)

    def approach(self, force: Array) -> tuple[Array, Array]:
        """Return h and dh/dF (c,)."""
        force = np.maximum(force, FAINT)
        (cut, slope), (whole, other) = self._cut(force), self._round.approach(force)
        unit = self.kernel * force
        first, second = cut / unit, whole / unit
        both = np.logaddexp(-2.0 * first, -2.0 * second)
        share = np.exp(-2.0 * first - both)
        rate = share * (slope / self.kernel - first) + (1.0 - share) * (other / self.kernel - second)
        on_round = self.inside < 0.0
        joined = -0.5 * both
        return np.where(on_round, unit * joined, cut), np.where(
            on_round, self.kernel * (joined + rate), slope
        )

    def peak(self, force: Array) -> Array:
        """Return the largest pressure times the face width (c,) in N/m."""
        half = self._uncut.half_width(np.maximum(force, FAINT))
        span, x = _span(half, self.inside), np.minimum(self.inside, half)
        # at the vertex, or where there is none left, of half an ellipse over what touches
        middle = np.divide(4.0 * force, math.pi * span, out=np.zeros_like(force), where=span > 0.0)
        steep = np.sqrt(span) * np.maximum(0.5 * span - x, 0.0) / self.radius
        pressed = np.cbrt(0.75 * math.pi * self.rounding * steep) ** 2
        cut = np.maximum(middle, PEAK * 2.0 / (math.pi**2 * self.kernel) * pressed / self.rounding)
        return np.asarray(np.where(self.inside < 0.0, np.minimum(cut, self._round.peak(force)), cut))

    def _cut(self, force: Array) -> tuple[Array, Array]:
        half = self._uncut.half_width(force)
        span = _span(half, self.inside)
        shares = _shares(half, span, self.inside)
        vertex = (np.clip(self.inside, 0.0, half) / half) ** 2
        slope = np.log(4.0 / span)
        return self.kernel * force * (slope + shares[0] - 0.5 * shares[1] + vertex), self.kernel * slope


def _span(half: Array, inside: Array) -> Array:
    """Return b (c,), how far from the edge the surfaces touch; 2a of uncut contacts."""
    x = np.minimum(inside, half)
    # the root of ¾b² − xb = a², written so that it does not cancel far beyond the edge
    root = np.sqrt(x * x + 3.0 * half * half)
    return np.asarray(
        np.where(x >= 0.0, 2.0 / 3.0 * (x + root), 2.0 * half * half / np.maximum(root - x, FAINT))
    )


def _shares(half: Array, span: Array, inside: Array) -> tuple[Array, Array]:
    """Return w and v (c,), the shares of the load under both terms of the pressure."""
    x = np.minimum(inside, half)
    return span * (0.5 * span - x) / half**2, 0.25 * (span / half) ** 2


def centroid(half: float, inside: Array) -> Array:
    """Return how far from the edge the pressure's centroid lies (c,) in m; uncut contacts have it at the vertex."""
    uncut = np.full(inside.shape, half)
    span = _span(uncut, inside)
    share, rest = _shares(uncut, span, inside)
    return np.asarray(np.where(inside >= half, inside, span * (0.25 * share + 0.5 * rest)))
