"""Reactions of rigid members on their exact paths (Newton–Euler) at constant speed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.dynamics.wrench import Wrench, balance_residual, wrench
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, slots=True)
class RotatingMass:
    """A `mass` (kg) that circles the z axis at `radius` (m) in plane `z` (m), `angle` ahead of the crank."""

    mass: float
    radius: float
    angle: float
    z: float


def inertia_forces(masses: Sequence[RotatingMass], crank_angle: Array, speed: float) -> Array:
    """Return d'Alembert's forces m r ω² (n_pos, n_mass, 2) along each mass's own radius.

    A disc that is carried round by an eccentric without turning about itself at a changing rate has exactly
    this and no inertia couple, since its spin is constant.
    """
    mass, radius, angle = (
        np.array([getattr(m, name) for m in masses]) for name in ("mass", "radius", "angle")
    )
    direction = np.asarray(crank_angle)[:, None] + angle
    size = mass * radius * speed**2
    return frozen(np.stack([size * np.cos(direction), size * np.sin(direction)], axis=-1))


def inertia_wrench(masses: Sequence[RotatingMass], crank_angle: Array, speed: float) -> Wrench:
    """Return the resultant of the inertia forces about the origin.

    For equal masses at 180° the force vanishes and the couple m e ω² (z₂ − z₁) stays.
    """
    points = np.array([[0.0, 0.0, mass.z] for mass in masses])
    return wrench(points, inertia_forces(masses, crank_angle, speed))


def support_reactions(z_supports: Array, loads: Array, z_loads: Array, couples: Array | None = None) -> Array:
    """Return the reactions (n_pos, 2, 2) of the two bearings of a shaft on it, by statics.

    `z_supports` (2,); `loads` (n_pos, n_load, 2) on the shaft at `z_loads` (n_load,), inertia forces among
    them; `couples` (n_pos, 2), moments about x and y that act on the shaft besides.  Raises for coinciding
    supports.
    """
    supports = np.asarray(z_supports, dtype=np.float64)
    if supports.shape != (2,):
        raise TrochoidError(
            f"a rigid shaft is statically determinate on two bearings, given {supports.size}; "
            f"use elastic reactions"
        )
    span = float(supports[1] - supports[0])
    if abs(span) <= 1e-9 * float(np.abs(supports).max(initial=0.0)) or span == 0.0:
        raise TrochoidError(
            f"two bearings at the same position z = {supports[0]:.6g} m cannot hold a shaft; move them apart"
        )
    arms = np.asarray(z_loads, dtype=np.float64) - supports[0]
    moment = np.einsum("pli,l->pi", loads, arms)
    if couples is not None:
        moment = moment + np.stack([couples[:, 1], -couples[:, 0]], axis=-1)
    far = -moment / span
    near = -loads.sum(axis=1) - far
    return frozen(np.stack([near, far], axis=1))


def shaft_residual(z_supports: Array, reactions: Array, loads: Array, z_loads: Array) -> float:
    """Return the relative residual of force and moment balance of a shaft, from its given reactions."""
    return balance_residual([_shaft_wrench(z_supports, reactions), _shaft_wrench(z_loads, loads)])


def _shaft_wrench(z: Array, forces: Array) -> Wrench:
    axial = np.asarray(z, dtype=np.float64)
    return wrench(np.stack([np.zeros_like(axial), np.zeros_like(axial), axial], axis=-1), forces)
