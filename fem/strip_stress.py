"""Stress below a contact that is resolved by strips, in closed form.

The tractions are half an ellipse with the strips' force, centre and width, and overlapping triangles, one per
strip, for what the strips differ from it. The strips' forces are kept exactly, and the stress is bounded and
continuous up to the surface. Constant strips would leave jumps of a quarter of the peak pressure at
the edge of a contact, and infinite stress under shear; triangles alone, which flatten the steep edge, a seventh.
"""

from __future__ import annotations

import numpy as np

from trochoid.fem.half_plane import Cauchy, ComplexArray, below, ellipse, surface_stress
from trochoid.kinematics.types import Array

FAR = 8.0  # in half spans of the strips: beyond, moments stand for them
MOMENTS = 15  # FAR^-MOMENTS is 3e-14


def strip_stress(position: Array, offset: Array, pressed: Array, sheared: Array) -> Array:
    """Return the stress (n, 3) σx, σz, τxz in Pa at `position` (n, 2): x along the surface, z into the body, in m.

    Strips of equal width at `offset` (m,) along the surface, m ≥ 2, in m, carry the line loads `pressed` (m,) into
    the body and `sheared` (m,) along x, in N/m.
    """
    zeta, width = below(position), float(offset[-1] - offset[0]) / (len(offset) - 1)
    load = float(pressed.sum())
    if load <= 0.0:
        return np.zeros((len(position), 3))
    centre, half = _spread(offset, pressed, width)
    inside = load * _ellipse_shares((offset - centre) / half, width / half)
    smooth, factor = ellipse(zeta - centre, half), float(sheared.sum()) / load
    rest = np.stack([pressed - inside, sheared - factor * inside], axis=-1) / width
    pressure, shear = triangles(zeta, offset, rest)
    return surface_stress(zeta, smooth.scaled(load) + pressure, smooth.scaled(factor * load) + shear)


def triangles(zeta: ComplexArray, offset: Array, peaks: Array) -> tuple[Cauchy, ...]:
    """Return the Cauchy integrals at ζ (n,) of overlapping triangles with these `peaks` (m, k) in Pa, for each column.

    The tractions are linear between the strips' centres `offset` (m,) and end one strip beyond the outer ones.
    """
    width = (offset[-1] - offset[0]) / (len(offset) - 1)
    middle = 0.5 * (offset[0] + offset[-1])
    span = 0.5 * (offset[-1] - offset[0]) + width
    corner = np.concatenate([[-span], offset - middle, [span]]) / span
    bend = np.diff(np.pad(peaks, ((2, 2), (0, 0))), 2, axis=0) * (
        span / width
    )  # of the slope, at the corners
    place = (zeta - middle) / span
    integral = np.empty((len(zeta), peaks.shape[1]), dtype=complex)
    slope = np.empty_like(integral)
    near = np.abs(place) < FAR
    for where, how in ((near, _at_corners), (~near, _by_moments)):
        integral[where], slope[where] = how(place[where], corner, bend)
    return tuple(Cauchy(a, d / span) for a, d in zip(integral.T, slope.T, strict=True))


def _at_corners(place: ComplexArray, corner: Array, bend: Array) -> tuple[ComplexArray, ComplexArray]:
    """Sum over the corners: A'' of a linear traction is the sum of its bends over ζ − s."""
    reach = place[:, None] - corner
    logarithm = np.log(np.where(reach == 0, 1e-150, reach))
    return np.asarray((reach * logarithm) @ bend), np.asarray(-(logarithm @ bend))


def _by_moments(place: ComplexArray, corner: Array, bend: Array) -> tuple[ComplexArray, ComplexArray]:
    """Sum M_j/ζ^(j+1), with the moments M_j = ∫ p s^j ds."""
    j = np.arange(MOMENTS)
    moment = (corner ** (j[:, None] + 2)) @ bend / ((j + 1) * (j + 2))[:, None]
    power = place[:, None] ** -(j + 1.0)
    return power @ moment, (power / place[:, None] * (j + 1)) @ moment


def _spread(offset: Array, pressed: Array, width: float) -> tuple[float, float]:
    """Return centre and half width of half an ellipse with the strips' mean and variance, kept on what they cover."""
    load = pressed.sum()
    centre = float(pressed @ offset / load)
    variance = float(pressed @ (offset - centre) ** 2 / load)
    covered = offset[pressed > 0]
    room = min(centre - covered[0], covered[-1] - centre) + 0.5 * width
    return centre, float(np.clip(2 * np.sqrt(variance), 0.5 * width, max(room, 0.5 * width)))


def _ellipse_shares(place: Array, width: float) -> Array:
    """Return the shares (m,) of half an ellipse over ±1 on strips at `place` (m,)."""
    ends = np.clip(np.append(place - 0.5 * width, place[-1] + 0.5 * width), -1.0, 1.0)
    return np.diff((ends * np.sqrt(1 - ends**2) + np.arcsin(ends)) / np.pi)
