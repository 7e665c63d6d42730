"""Tangential compliance of a body's surfaces, beside the normal one of `compliance`.

With the outward normal n and the tangent t = n turned by +90°, normal forces press along −n and tangential
ones pull along t; displacements are measured likewise. Of a tangential force,

    C_tt(x, y) = −2/(πE')·ln|x−y| + S_tt(x, y),   C_nt(x, y) = (κ−1)/(8G)·sgn(s) + 2/(πE')·k s ln|s| + …,

where s is the arc from y to x along t: ahead of a tangential force the surface sinks in (Johnson, Contact
Mechanics, 2.24), and on a surface of curvature k the normal turns away from the logarithm. S_tt has the kink
k(κ−1)/(8G)·|x−y| that S_nn has. The jump is taken out of the table as a sawtooth in arc length, round the
whole loop; at x = y C_nt is the mean of both sides. The term with k is taken out of circles only, where it is
known everywhere. C_tn is the transpose of C_nt (Betti).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.fem.material import Plane
from trochoid.fem.surface import (
    Surface,
    Weights,
    kinks,
    middles,
    read_diagonal,
    read_table,
    same_surface,
    set_diagonal,
    splined,
    surface_rows,
    without_kinks,
)
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, slots=True)
class Tangential:
    """Tables (k, k) of a body's surfaces pressed tangentially, 1/Pa.

    `mixed` and `along` are the spline coefficients of what is smooth in C_nt and S_tt, `mixed_diagonal` and
    `along_diagonal` (k,) those at x = y; `mixed_stations` and `along_stations` (k, k) C_nt and S_tt at
    stations. `middle` (k,) is where each coefficient sits on its surface of `length` (k,), in m, `jump` (k,)
    and `bend` (k,) in 1/Pa the sawtooth and the s·ln|s| taken out. `asymmetry` is how far the columns are from
    reciprocal, over the range of their table: a measure of the mesh.
    """

    mixed: Array
    mixed_diagonal: Array
    along: Array
    along_diagonal: Array
    mixed_stations: Array
    along_stations: Array
    middle: Array
    length: Array
    jump: Array
    bend: Array
    asymmetry: float


def tangents(normals: Array) -> Array:
    """Return the tangents (k, 2) of outward normals (k, 2)."""
    return np.stack([-normals[..., 1], normals[..., 0]], axis=-1)


def drag(plane: Plane) -> float:
    """Return (κ−1)/(8G) in 1/Pa: how far a point force drags the surface across itself, to either side."""
    return (plane.kolosov - 1) / (8 * plane.shear)


def round_tangential(plane: Plane, radius: float) -> float:
    """Return S_tt(x, x) in 1/Pa of a circular disc against its mean motion, as `tangential_tables` would (a roller).

    In closed form: 2/(πE')·(ln R − 3/4) + (31 − 3κ)/(48πG); the torque is balanced by rotational inertia.
    """
    rest = (31 - 3 * plane.kolosov) / (48 * np.pi * plane.shear)
    return float(plane.kernel * (np.log(radius) - 0.75) + rest)


def tangential_tables(
    plane: Plane, surfaces: Sequence[Surface], points: Array, mixed: Array, turned: Array, along: Array
) -> Tangential:
    """Make tables of columns (k, k) at stations `points` (k, 2): C_nt, C_tn and S_tt."""
    nt, tt = 0.5 * (mixed + turned.T), 0.5 * (along + along.T)
    asymmetry = max(np.abs(mixed - turned.T).max() / np.ptp(nt), np.abs(along - along.T).max() / np.ptp(tt))
    count = len(points)
    middle, length, jump, bend = (np.zeros(count) for _ in range(4))
    smooth = nt.copy()
    for surface in surfaces:
        rows = surface_rows(surface)
        middle[rows], length[rows] = middles(surface), surface.length
        jump[rows] = drag(plane) * surface.sense
        bend[rows] = plane.kernel * surface.bend * surface.length / (2 * np.pi) * surface.sense
        distance = np.linalg.norm(points[rows][:, None] - points[rows][None], axis=-1)
        turn = (surface.positions[:, None] - surface.positions) / surface.length
        smooth[rows, rows] -= _singular(turn, distance, jump[rows], bend[rows])
    mixed_table, mixed_diagonal = splined(smooth, nt, surfaces)
    along_table, along_diagonal = splined(without_kinks(tt, surfaces, points), tt, surfaces)
    coefficients = frozen(mixed_table), frozen(mixed_diagonal), frozen(along_table), frozen(along_diagonal)
    places = frozen(middle), frozen(length), frozen(jump), frozen(bend)
    return Tangential(*coefficients, frozen(nt), frozen(tt), *places, float(asymmetry))


def blocks(tables: Tangential, place: Weights, distance: Array) -> tuple[Array, Array]:
    """Return C_nt and S_tt (n, n) between places `distance` (n, n) apart."""
    first = place.columns[..., 0]
    length = tables.length[first]
    steps = np.diff(tables.middle[place.columns], axis=-1)
    steps = np.cumsum(np.mod(steps, length[..., None]), axis=-1)
    at = tables.middle[first] + np.einsum("...a,...a->...", place.values[..., 1:], steps)
    turn = (at[..., :, None] - at[..., None, :]) / length[..., None, :]
    singular = _singular(turn, distance, tables.jump[first], tables.bend[first])
    mixed = read_table(tables.mixed, place) + np.where(same_surface(place), singular, 0.0)
    set_diagonal(mixed, read_diagonal(tables.mixed_diagonal, place))
    along = read_table(tables.along, place) + kinks(place) * distance
    set_diagonal(along, read_diagonal(tables.along_diagonal, place))
    return mixed, along


def _singular(turn: Array, distance: Array, jump: Array, bend: Array) -> Array:
    """Return what is not smooth in C_nt (n, n); `turn` (n, n) is the arc from y to x as a share of the loop."""
    chord = np.where(distance > 0, distance, 1.0)
    saw = np.where(distance > 0, 1 - 2 * np.mod(turn, 1.0), 0.0)
    bent = bend[..., None, :] * np.sin(2 * np.pi * turn) * np.log(chord)
    return np.asarray(jump[..., None, :] * saw + bent)
