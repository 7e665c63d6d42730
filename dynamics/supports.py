"""Springs that join members to the ground or to each other, and the forces that they pass."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, slots=True)
class Support:
    """A spring of `stiffness` (r, r) on the deflection `selection`·q (r,) of the coordinates q (n,).

    A bearing to the ground, or, with differences in `selection`, a spring between two members.
    """

    name: str
    selection: Array
    stiffness: Array


def assemble(supports: Sequence[Support], coordinates: int) -> Array:
    """Return the stiffness Σ Bᵀ k B (n, n) of all springs; zero where there are none."""
    matrix = np.zeros((coordinates, coordinates))
    for support in supports:
        matrix += support.selection.T @ support.stiffness @ support.selection
    return frozen(matrix)


def support_forces(support: Support, motion: Array) -> Array:
    """Return the forces (n_pos, r) that a motion (n_pos, n) makes the spring pass to what it stands on.

    Given `Response.spring_correction` it is the change of the force by elastic motion, damping included;
    its negative is the change of the reaction on the member.
    """
    return frozen(motion @ support.selection.T @ support.stiffness.T)


def shaft_bearing(
    name: str, z: float, stiffness: float | Array, columns: tuple[int, int, int, int], coordinates: int
) -> Support:
    """Return the radial bearing at `z` of a shaft with coordinates x, y, tilt_x, tilt_y in these columns.

    `stiffness` is radial, N/m, or (2, 2).  Deflection: (x + tilt_y z, y − tilt_x z).
    """
    selection = np.zeros((2, coordinates))
    x, y, tilt_x, tilt_y = columns
    selection[0, x] = selection[1, y] = 1.0
    selection[0, tilt_y], selection[1, tilt_x] = z, -z
    radial = np.asarray(stiffness, dtype=np.float64)
    matrix = radial * np.eye(2) if radial.ndim == 0 else radial
    return Support(name, frozen(selection), frozen(matrix))
