"""Contacts as narrow strips on a flank, with Hertz's pressure across them, and what the flank of a rim does there."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.fem.cone_flank import Flank
from trochoid.fem.cone_layers import Layers
from trochoid.fem.cone_rim import Rim
from trochoid.fem.cone_slices import Slices
from trochoid.kinematics.spherical import rotation
from trochoid.kinematics.types import Array, IntArray

ACROSS = np.sin(0.5 * math.pi * np.linspace(-1.0, 1.0, 17))  # closer where the pressure falls to nothing
ELLIPSE = 32  # points of a circle


@dataclass(frozen=True, eq=False, slots=True)
class Strips:
    """Strips of C contacts in triangles `cells` (3, m): `points` (k, 3) m, `from_middle` (k, 3) the nodes' way from the
    contact's middle line, `pressure` (k,) Pa, `contact` (k,) and `distance` (k,) from O, m.
    """

    points: Array
    from_middle: Array
    pressure: Array
    contact: IntArray
    distance: Array
    cells: IntArray


def strips(slices: Slices, middle: Array, aside: Array, force: Array, pressure: Array) -> Strips:
    """Return the strips of pressed line contacts with `force` and largest `pressure` (C, s) on slices.

    `middle` (C, s+1, 3) m are the contacts' middle lines at the slices' ends, `aside` (C, 3) unit vectors across them
    in the flank.  Line load q and b²/q, which hardly changes along a contact, are continued from slices to their ends,
    so that the pressure over a strip adds up to its contact's force.
    """
    breaks = np.append(slices.inner, slices.outer[-1])
    load = force / slices.length
    half = np.divide(2.0 * load, math.pi * pressure, out=np.zeros_like(load), where=pressure > 0.0)
    wide = np.divide(half**2, load, out=np.zeros_like(load), where=load > 0.0)
    wide = np.where(load > 0.0, wide, wide.max(axis=1, keepdims=True))
    q, broad = _between(load), _between(wide)
    b = np.sqrt(q * broad)
    peak = np.divide(2.0 * q, math.pi * b, out=np.zeros_like(q), where=b > 0.0)
    off = (b[..., None] * ACROSS)[..., None] * aside[:, None, None, :]
    shape = off.shape[:3]
    under = np.broadcast_to(
        ((q[:, 1:] > 0.0) | (q[:, :-1] > 0.0))[..., None], (*force.shape, len(ACROSS) - 1)
    )
    nodes = np.arange(math.prod(shape)).reshape(shape)
    a, c = nodes[:, :-1, :-1][under], nodes[:, 1:, 1:][under]
    one, other = nodes[:, :-1, 1:][under], nodes[:, 1:, :-1][under]
    cells = np.concatenate([np.stack([a, c, one]), np.stack([a, other, c])], axis=1)
    used, index = np.unique(cells, return_inverse=True)
    contact, row, column = np.unravel_index(used, shape)
    shift = off[contact, row, column]
    return Strips(
        middle[contact, row] + shift,
        shift,
        peak[contact, row] * np.sqrt(np.maximum(1.0 - ACROSS[column] ** 2, 0.0)),
        contact,
        breaks[row],
        index.reshape(cells.shape),
    )


def cone_strips(slices: Slices, point: Array, normal: Array, force: Array, pressure: Array) -> Strips:
    """Return the strips of contacts along rays: unit vectors `point` and `normal` (C, 3) of the flank."""
    breaks = np.append(slices.inner, slices.outer[-1])
    return strips(slices, breaks[:, None] * point[:, None, :], np.cross(normal, point), force, pressure)


def ellipse(middle: Array, axes: Array, pressure: float) -> Strips:
    """Return one point contact: its `middle` (3,), half axes as vectors (2, 3), m, and Hertz's largest pressure.

    The first axis is its middle line.
    """
    rings = np.sin(0.5 * math.pi * np.linspace(0.0, 1.0, 9))[1:]
    angle = 2.0 * math.pi * np.arange(ELLIPSE) / ELLIPSE
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    flat = np.concatenate([np.zeros((1, 2)), (rings[:, None, None] * circle).reshape(-1, 2)])
    i = np.arange(ELLIPSE)
    on = (i + 1) % ELLIPSE
    cells = [np.stack([np.zeros_like(i), 1 + i, 1 + on])]
    for ring in range(len(rings) - 1):
        low, high = 1 + ring * ELLIPSE, 1 + (ring + 1) * ELLIPSE
        cells += [np.stack([low + i, high + i, high + on]), np.stack([low + i, high + on, low + on])]
    off = flat @ axes
    value = pressure * np.sqrt(np.maximum(1.0 - np.sum(flat**2, axis=-1), 0.0))
    distance = np.linalg.norm(middle + off, axis=-1)
    return Strips(
        middle + off,
        flat[:, 1:] * axes[1],
        value,
        np.zeros(len(off), dtype=np.intp),
        distance,
        np.concatenate(cells, axis=1),
    )


def flank_displacement(rim: Rim, moved: Array, place: Array, distance: Array) -> Array:
    """Return the displacement (k, 3), m, of the flank at arc lengths `place` (k,), rad, and distances (k,) from O, m.

    `moved` (teeth, n, layer nodes, 3) as `displacements` yields it; the result is in the rim's frame.
    """
    side, teeth = rim.side, len(moved)
    tooth = np.floor(place / side.length).astype(np.intp)
    local = side_displacement(
        side, rim.body.radial, moved, tooth % teeth, place - tooth * side.length, distance
    )
    return np.asarray(np.einsum("kij,kj->ki", rotation(2, tooth * rim.shape.pitch), local))


def side_displacement(
    side: Flank, radial: Layers, moved: Array, which: IntArray, place: Array, distance: Array
) -> Array:
    """Return the displacement (k, 3), m, of bodies `which` (k,) of `moved` (bodies, n, layer nodes, 3) on a side.

    `place` (k,) are arc lengths, rad, along one side, `distance` (k,) those from O, m.
    """
    facet = np.clip(np.searchsorted(side.ends, place, side="right") - 1, 0, len(side.ends) - 2)
    x = (place - side.ends[facet]) / (side.ends[facet + 1] - side.ends[facet])
    across = _quadratic(x)[[0, 2, 1]]  # start, end, middle
    layer = np.clip(np.searchsorted(radial.breaks, distance, side="right") - 1, 0, len(radial.breaks) - 2)
    low, high = radial.breaks[layer], radial.breaks[layer + 1]
    along = _quadratic((distance - low) / (high - low))
    nodes, rays = side.edge[:, facet], 2 * layer + np.arange(3)[:, None]
    corner = moved[which, nodes[:, None], rays[None, :]]  # (3, 3, k, 3)
    return np.asarray(np.einsum("ak,rk,arki->ki", across, along, corner))


def _quadratic(x: Array) -> Array:
    """Return the shape functions (3, k) of start, middle and end."""
    return np.stack([(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)])


def _between(values: Array) -> Array:
    """Return values (C, s+1) at the ends of slices: the mean of both beside it."""
    ends = np.concatenate([values[:, :1], values, values[:, -1:]], axis=1)
    return np.asarray(0.5 * (ends[:, 1:] + ends[:, :-1]))
