"""Displacement of all elements of a slotted wheel under a contact anywhere along the pressed wall of a slot."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from trochoid.fem.cone_body import product
from trochoid.fem.cone_flank import load_at
from trochoid.fem.cone_layers import integrals
from trochoid.fem.cone_slices import Slices, between, interpolation
from trochoid.fem.slot_wall import WallBody
from trochoid.kinematics.types import Array


def wall_loads(made: WallBody, slices: Slices | None, reach: Sequence[float], force: Array) -> Array:
    """Return nodal forces (dofs, n), N, of contacts at angles `reach` (n,) with `force` (n, f) N on slices.

    They stand for narrow contacts over as much as elements are wide.  None for slices: point contacts in the middle.
    """
    body, side = made.body, made.side
    layers = between(body.radial.breaks)
    if slices is None:
        middle = 0.5 * (layers.inner[0] + layers.outer[-1])
        share = np.zeros((1, len(layers.middle)))
        share[0, np.abs(layers.middle - middle) <= np.abs(layers.middle - middle).min() + 1e-12] = 1.0
        layered = force @ (share / share.sum())
    else:
        layered = force @ interpolation(layers, slices)
    weights = integrals(body.radial)
    unit = weights / weights.sum(axis=0)
    found = np.empty((body.size, len(reach)))
    for i, center in enumerate(wall_places(made, np.asarray(reach)).tolist()):
        facet = int(np.abs(side.centers - center).argmin())
        half = min(float(side.half_width[facet]), center, side.length - center)
        found[:, i] = product(load_at(side, center, half), unit) @ layered[i]
    return found


def wall_places(made: WallBody, reach: Array) -> Array:
    """Return the arc lengths (n,), rad, along the wall of angles (n,) from the wheel's axis along the slot."""
    along = (reach - made.wheel.bottom) * np.sin(made.wheel.wall.radius)
    return np.asarray(np.clip(along, made.side.centers[0], made.side.centers[-1]))


def wall_displacement(made: WallBody, loads: Array) -> Array:
    """Return the displacements (n, nodes, layer nodes, 3), m, of the wheel, held at its hub, under loads (dofs, n)."""
    body = made.body
    moved = np.zeros(loads.shape)
    moved[~body.held] = made.solve(loads[~body.held])
    shape = (len(body.mesh.points), 3, body.radial.count, loads.shape[1])
    return np.ascontiguousarray(moved.reshape(shape).transpose(3, 0, 2, 1))
