"""Compliance tables of all teeth of a gear from the columns of one flank, by turning and mirroring."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from trochoid.fem.compliance import Compliance
from trochoid.fem.material import Plane
from trochoid.fem.surface import Surface, collocation, splined, without_kinks
from trochoid.fem.tangential import drag
from trochoid.geometry.gear_outline import Blank
from trochoid.kinematics.types import Array, frozen


def flank_blocks(raw: Array, teeth: int, count: int) -> tuple[Array, float]:
    """Return S (teeth, 2, n, n) of flanks on the one of tooth 0, the same seen from either side, and what differed.

    Block [d, 0] is of the flank of the same hand d teeth on, [d, 1] that of the other hand. By symmetry
    T[d, 0] = T[-d, 0]ᵀ and T[d, 1] = T[d, 1]ᵀ.
    """
    blocks = raw[: 2 * teeth * count, :count].reshape(teeth, 2, count, count)
    back = -np.arange(teeth) % teeth
    other = np.stack([blocks[back, 0], blocks[:, 1]], axis=1).swapaxes(-1, -2)
    return 0.5 * (blocks + other), float(np.abs(blocks - other).max() / np.ptp(blocks))


def all_teeth(blocks: Array) -> Array:
    """Return S (k, k) between all flanks: turned by teeth, and mirrored for forces on the other hand."""
    teeth, _, count, _ = blocks.shape
    apart = (np.arange(teeth)[:, None] - np.arange(teeth)) % teeth
    same, other = blocks[:, 0], blocks[:, 1]
    back = -apart % teeth
    # rows: tooth, hand, station; columns likewise
    table = np.empty((teeth, 2, count, teeth, 2, count))
    table[:, 0, :, :, 0] = same[apart].transpose(0, 2, 1, 3)
    table[:, 1, :, :, 0] = other[apart].transpose(0, 2, 1, 3)
    table[:, 0, :, :, 1] = other[back].transpose(0, 2, 1, 3)
    table[:, 1, :, :, 1] = same[back].transpose(0, 2, 1, 3)
    return table.reshape(2 * teeth * count, -1)


def with_rim(table: Array, raw: Array, teeth: int, count: int, rim: int) -> Array:
    """Return the table with the stations of the rim's edge added, `rim` per tooth."""
    first = len(table)
    size = first + teeth * rim
    full = np.empty((size, size))
    full[:first, :first] = table
    sector = np.arange(teeth)
    apart = (sector[:, None] - sector) % teeth
    from_flank = raw[first:, :count].reshape(teeth, rim, count)
    mirrored = from_flank[-sector % teeth, ::-1]
    on_rim = np.stack([from_flank[apart], mirrored[apart]], axis=2)  # sector, tooth, hand, rim, station
    lower = on_rim.transpose(0, 3, 1, 2, 4).reshape(teeth * rim, first)
    full[first:, :first], full[:first, first:] = lower, lower.T
    own = raw[first:, count:].reshape(teeth, rim, rim)
    own = 0.5 * (own + own[-sector % teeth].swapaxes(-1, -2))
    own = 0.5 * (own + own[-sector % teeth, ::-1, ::-1])
    full[first:, first:] = own[apart].transpose(0, 2, 1, 3).reshape(teeth * rim, -1)
    return full


def flank_surfaces(flank: Surface, teeth: int) -> list[Surface]:
    """Return the surfaces of all flanks, in the order of the table."""
    count = len(flank.positions)
    return [
        replace(flank, name=f"tooth{tooth}{'+-'[hand]}", first=(2 * tooth + hand) * count)
        for tooth in range(teeth)
        for hand in range(2)
    ]


def rim_surface(blank: Blank, plane: Plane, count: int, first: int) -> Surface:
    """Return the rim's edge with `count` stations per tooth, from the table's row `first` on."""
    radius, side = blank.rim_radius, -blank.tooth.gear.side
    stations = blank.tooth.gear.teeth * count
    angle = blank.tooth.pitch * (np.arange(stations) + 0.5) / count
    bend = side / radius
    return Surface("rim", frozen(radius * angle), 2 * np.pi * radius, first, drag(plane) * bend, side, bend)


def gear_compliance(
    table: Array, surfaces: Sequence[Surface], points: Array, kernel: float, rim: int
) -> Compliance:
    """Return the table splined along all surfaces; on flanks, one matrix serves all."""
    flank, first = surfaces[0], len(table)
    smooth, diagonal = table, np.diag(table).copy()
    if rim:
        first = surfaces[-1].first
        smooth = without_kinks(table, surfaces[-1:], points)
        smooth, diagonal = splined(smooth, table, surfaces[-1:])
    count = len(flank.positions)
    inverse = np.linalg.inv(collocation(flank))
    smooth = smooth.copy() if smooth is table else smooth
    size = len(smooth)
    smooth[:first] = (inverse @ smooth[:first].reshape(-1, count, size)).reshape(first, size)
    smooth[:, :first] = (smooth[:, :first].reshape(size, -1, count) @ inverse.T).reshape(size, first)
    diagonal[:first] = (diagonal[:first].reshape(-1, count) @ inverse.T).ravel()
    named = MappingProxyType({s.name: s for s in surfaces})
    for array in (smooth, diagonal, table):
        array.setflags(write=False)
    return Compliance(named, smooth, diagonal, table, kernel, 0.0)
