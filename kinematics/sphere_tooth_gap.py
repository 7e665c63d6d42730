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
from trochoid.kinematics.spherical import rotation, turn
from trochoid.kinematics.types import Array

REFINED = 3  # Newton steps from a foot point that is right to rounding of the parameter


def opened(tooth: SphereTooth, start: Array, moved: Array, foot: Array) -> tuple[Array, Array]:
    """Return the foot's parameter (...) and the angle d (...), rad, positive away from the flank.

    `moved` (..., 3) is the displacement of unit vectors from `center_path(start)`, `start` (...) their parameters and
    `foot` (...) those of the flank's nearest points, near enough for Newton's method (`spherical_curve.foot_point`).
    """
    step = foot - start
    for _ in range(REFINED):
        away, angle = _off(tooth, start, step, moved)
        slope = tooth.path_speed(start + step) * (
            1.0 + tooth.side * tooth.center_path_curvature(start + step) * np.sin(angle)
        )
        along = np.sum(away * tooth.tangent(start + step), axis=-1)
        change = np.divide(along, slope, out=np.zeros_like(along), where=slope > 0.0)
        step = step + np.clip(change, -1e-3, 1e-3)
    return start + step, _off(tooth, start, step, moved)[1]


def _off(tooth: SphereTooth, start: Array, step: Array, moved: Array) -> tuple[Array, Array]:
    """Return δ + c(p₀) − c(p) (..., 3) and the angle d (...)."""
    away = moved - path_step(tooth, start, step)
    parameter, r = start + step, tooth.pin_angle
    across = math.cos(r) * tooth.normal(parameter) - math.sin(r) * tooth.point(parameter)
    return away, np.asarray(np.arcsin(np.clip(np.sum(away * across, axis=-1), -1.0, 1.0)))


def path_step(tooth: SphereTooth, start: Array, step: Array) -> Array:
    """Return c(p₀ + s) − c(p₀) (..., 3) of the pin's axis in the flank's frame, to rounding of s (...)."""
    nu = tooth.fixed_teeth / tooth.satellite_teeth
    outer, tilt, inner = (nu, -tooth.nutation, -1.0) if tooth.pins_on == "ring" else (1.0, tooth.nutation, -nu)
    t, d = tooth.crank_angle(start), tooth.crank_angle(step)
    axis = np.array([math.sin(tooth.polar_angle), 0.0, math.cos(tooth.polar_angle)])
    before = turn(rotation(2, inner * t), axis)
    first = _turned_on(inner * d, before)
    middle = rotation(1, tilt)
    change = _turned_on(outer * d, turn(middle, before + first)) + turn(middle, first)
    return turn(rotation(2, outer * t), change)


def _turned_on(angle: Array, vectors: Array) -> Array:
    """Return (R_z(angle) − 1) v (..., 3), to rounding of the angle (...)."""
    x, y = vectors[..., 0], vectors[..., 1]
    fall, sine = -2.0 * np.sin(0.5 * angle) ** 2, np.sin(angle)
    return np.stack([fall * x - sine * y, sine * x + fall * y, 0.0 * x], axis=-1)
