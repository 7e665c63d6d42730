"""How far a displaced pin stands off its flank, to rounding of the displacement.

The flank is the equidistant of the path c(p) of the pin's axis.  So an axis moved by δ from c(p₀) opens the gap by
its signed distance d from that path, whose foot c(p) is the flank's own:

    (δ + c(p₀) − c(p))·τ(p) = 0,   sin d = (δ + c(p₀) − c(p))·M(p),

M across the path, away from the flank.  Both differences are products of small numbers, and nothing cancels.
"""

from __future__ import annotations

import math

import numpy as np

from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.spherical import rotation
from trochoid.kinematics.spherical_curve import foot_point
from trochoid.kinematics.types import Array, BoolArray

REFINED = 2  # Newton steps from a foot point that is right to rounding of the parameter
QUICK = 6  # Newton steps from where an axis was before it moved, before a foot point is sought with more care
FAR = 0.02  # of a lobe's share of the round: the longest of these steps
NEAR = 1e-8  # of that share: after a step so short the next would be rounding


def gap_of(tooth: SphereTooth, start: Array, moved: Array) -> tuple[Array, Array]:
    """Return the parameter (...) of the flank's nearest points and the angle d (...), rad, positive away from it.

    `moved` (..., 3) is the displacement of unit vectors from `center_path(start)`, `start` (...) their parameters.
    Raises NotConverged where there is no nearest point.
    """
    step, sure = np.zeros_like(start), np.zeros(start.shape, dtype=bool)
    longest = FAR * 2.0 * math.pi / tooth.lobes
    for _ in range(QUICK):
        change, good = _newton(tooth, start, step, moved)
        step = step + np.clip(change, -longest, longest)
        sure = good & (np.abs(change) < NEAR * longest)
        if sure.all():
            return start + step, _off(tooth, start, step, moved)[1]
    foot = start + step
    axis = tooth.center_path(start) + moved
    foot[~sure] = foot_point(tooth, axis[~sure], start[~sure])[0]
    return opened(tooth, start, moved, foot)


def opened(tooth: SphereTooth, start: Array, moved: Array, foot: Array) -> tuple[Array, Array]:
    """Return the foot's parameter (...) and the angle d (...), rad, as `gap_of` does.

    `foot` (...) are the flank's nearest points, near enough for Newton's method (`spherical_curve.foot_point`).
    """
    step = foot - start
    for _ in range(REFINED):
        step = step + np.clip(_newton(tooth, start, step, moved)[0], -1e-3, 1e-3)
    return start + step, _off(tooth, start, step, moved)[1]


def _newton(tooth: SphereTooth, start: Array, step: Array, moved: Array) -> tuple[Array, BoolArray]:
    """Return what Newton's method adds to the steps (...), 0 where the distance is no least one, and where it is."""
    away, angle, tangent = _off(tooth, start, step, moved)
    parameter = start + step
    slope = tooth.path_speed(parameter) * (
        1.0 + tooth.side * tooth.center_path_curvature(parameter) * np.sin(angle)
    )
    along, least = np.sum(away * tangent, axis=-1), slope > 0.0
    return np.divide(along, slope, out=np.zeros_like(along), where=least), least


def _off(tooth: SphereTooth, start: Array, step: Array, moved: Array) -> tuple[Array, Array, Array]:
    """Return δ + c(p₀) − c(p) (..., 3), the angle d (...) and the path's tangent (..., 3)."""
    away = moved - path_step(tooth, start, step)
    _, across, tangent = tooth.path_frame(start + step)
    sine = -tooth.side * np.sum(away * across, axis=-1)
    return away, np.asarray(np.arcsin(np.clip(sine, -1.0, 1.0))), tangent


def path_step(tooth: SphereTooth, start: Array, step: Array) -> Array:
    """Return c(p₀ + s) − c(p₀) (..., 3) of the pin's axis in the flank's frame, to rounding of s (...)."""
    nu = tooth.fixed_teeth / tooth.satellite_teeth
    outer, tilt, inner = (
        (nu, -tooth.nutation, -1.0) if tooth.pins_on == "ring" else (1.0, tooth.nutation, -nu)
    )
    t, d = tooth.crank_angle(start), tooth.crank_angle(step)
    axis = np.array([math.sin(tooth.polar_angle), 0.0, math.cos(tooth.polar_angle)])
    before = _about_z(inner * t, np.broadcast_to(axis, (*t.shape, 3)))
    first = _turned_on(inner * d, before)
    middle = rotation(1, tilt).T
    change = _turned_on(outer * d, (before + first) @ middle) + first @ middle
    return _about_z(outer * t, change)


def _about_z(angle: Array, vectors: Array) -> Array:
    """Return R_z(angle) v (..., 3)."""
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * x - s * y, s * x + c * y, z], axis=-1)


def _turned_on(angle: Array, vectors: Array) -> Array:
    """Return (R_z(angle) − 1) v (..., 3), to rounding of the angle (...)."""
    x, y = vectors[..., 0], vectors[..., 1]
    fall, sine = -2.0 * np.sin(0.5 * angle) ** 2, np.sin(angle)
    return np.stack([fall * x - sine * y, sine * x + fall * y, 0.0 * x], axis=-1)
