"""From the blunt line load that the elements know to a sharp one: what slices feel of each other nearby.

A line load q of half width w on a half-space moves its own line by (A/2) ∫ q(y')/√((y − y')² + (c w)²) dy', with
A = 2/(πE') and c = exp(−¼)/2 for the mean distance across half an ellipse.  An even, endless load gives A q ln(1/w) +
const., as in the plane; near the end of a load, and between slices no longer than it is wide, it is less.
A body that ends where the load ends acts like one with the load's mirror image beside it.

So from what the elements say of their slices that integral for their own B is taken out; the rest is smooth along the
rays, and interpolated to the contact's slices; and the integral for a sharp load is put in.
"""

from __future__ import annotations

import math

import numpy as np

from trochoid.fem.cone_slices import Slices, interpolation
from trochoid.kinematics.types import Array

ACROSS = 0.5 * math.exp(-0.25)
SHARP = (
    0.02  # of the blunt width: a line beside its slices; from it to the contact's own width only ln b changes
)
SLENDER = 0.25  # of the shortest slice, at the most


def sharpened(
    own: Array, half_width: Array, layers: Slices, fine: Slices, ends: tuple[float, float], kernel: float
) -> Array:
    """Return S (…, k, f, f) in m/N of `own` (…, k, s, s), what stations do to themselves under loads on `layers`.

    S lacks kernel·(ln(2/b) + ¼)/Δ of each fine slice on itself, whatever its b.  `half_width` (k,) is B/ρ in rad,
    `ends` are where the body ends, m.
    """
    turn = interpolation(layers, fine)
    smooth = own - line_load(half_width, layers, ends, kernel)
    sharp = np.minimum(SHARP * half_width, SLENDER * float(fine.length.min()) / fine.middle[-1])
    s = turn @ smooth @ turn.T + line_load(sharp, fine, ends, kernel)
    number = np.arange(len(fine.middle))
    s[..., number, number] -= kernel * (np.log(2.0 / (sharp[:, None] * fine.middle)) + 0.25) / fine.length
    return np.asarray(s)


def line_load(half_width: Array, slices: Slices, ends: tuple[float, float], kernel: float) -> Array:
    """Return the half-space's compliance (k, s, s) in m/N between slices of a line load of width w = ρ·`half_width`."""
    first, last = slices.inner[0], slices.outer[-1]
    width = ACROSS * half_width[:, None, None] * np.sqrt(slices.middle[:, None] * slices.middle)
    total = _double(slices, slices.inner, slices.outer, width)
    for load_end, body_end in ((first, ends[0]), (last, ends[1])):
        if abs(load_end - body_end) < 1e-9 * last:
            total += _double(slices, 2.0 * body_end - slices.outer, 2.0 * body_end - slices.inner, width)
    return np.asarray(0.5 * kernel * total / (slices.length[:, None] * slices.length))


def _double(slices: Slices, low: Array, high: Array, width: Array) -> Array:
    """Return ∫∫ dy dy'/√((y − y')² + w²) over each slice and each interval low … high."""

    def twice(t: Array) -> Array:
        return np.asarray(t * np.arcsinh(t / width) - np.hypot(t, width))

    a, b = slices.inner[:, None], slices.outer[:, None]
    return twice(b - low) - twice(a - low) - twice(b - high) + twice(a - high)
