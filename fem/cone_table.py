"""Compliance between slices of contacts anywhere on a rim, without what a narrow contact adds on itself.

The elements know a contact as a half ellipse of half width B.  That is sharpened first (see `cone_sharp`).  Seen by
a load of half width b itself, half of an elastic space in plane strain yields (2/(πE'))(ln(2/b) + ¼) per unit line
load; this is taken out of the diagonal of each slice.  What is left, S, is smooth along the flank and knows no width.
Contacts bring (2/(πE'))(ln(2/b) + ½) of their own b back (see `cone_law`).

Between stations S is interpolated in arc length by cubics through four of them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.cone_body import ConeBody
from trochoid.fem.cone_flank import Flank
from trochoid.fem.cone_ring import Coupling
from trochoid.fem.cone_sharp import sharpened
from trochoid.fem.cone_slices import Slices, between, finer, interpolation, lagrange
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, IntArray


@dataclass(frozen=True, eq=False, slots=True)
class Weights:
    """Cubic interpolation at places (…): `tooth` and `station` (…, 4) and their `value` (…, 4)."""

    tooth: IntArray
    station: IntArray
    value: Array


@dataclass(frozen=True, eq=False, slots=True)
class RimCompliance:
    """What contacts on a rim do to each other.

    `table` (pairs, k, s, k, s) in m/N between unit forces on layers, of which `finer` (f, s) makes slices; `own`
    (teeth that differ, k, f, f) that of a station on itself without the plane-strain term; `mean` (pairs, k, k) the
    table for even forces.  `layers` are those that contacts cover, `slices` their parts.  `kernel` 2/(πE') of the body
    in 1/Pa, `half_width` (k,) of the loads and `length` of a tooth's flank in rad.
    `ends` (2,): where the body ends, m: free of stress; `split` stations lie before the cut crest of a tooth, if any.
    """

    table: Array
    own: Array
    mean: Array
    coupling: Coupling
    centers: Array
    half_width: Array
    length: float
    layers: Slices
    slices: Slices
    finer: Array
    kernel: float
    poissons_ratio: float
    ends: tuple[float, float]
    split: int | None = None

    @property
    def closed(self) -> bool:
        """Whether the last tooth is the first one's neighbour."""
        return self.coupling.closed

    def weights(self, place: Array) -> Weights:
        """Return the interpolation at arc lengths `place` (…), rad, from the start of tooth 0."""
        count, teeth = len(self.centers), self.coupling.teeth
        if not self.closed and (place.min() < 0.0 or place.max() > teeth * self.length):
            raise TrochoidError(
                f"contacts at {place.min() / self.length:.4g} to {place.max() / self.length:.4g} teeth: the row has "
                f"{teeth} teeth"
            )
        turn = np.floor(place / self.length)
        below = (
            np.searchsorted(self.centers, place - turn * self.length) - 2
        )  # second of four lies before the place
        number = below + (count * turn).astype(np.intp)
        if self.split is not None:  # the four lie on the same side of every cut crest
            crest = self.centers[self.split - 1 : self.split + 1].mean() + self.length * turn
            first = count * (turn - (place < crest)).astype(np.intp) + self.split
            number = np.clip(number, first, first + count - 4)
        if not self.closed:
            number = np.clip(number, 0, count * teeth - 4)
        index = number[..., None] + np.arange(4)
        tooth, station = np.divmod(index, count)
        at = self.centers[station] + self.length * tooth
        value = lagrange(at, place)
        return Weights(tooth % teeth, station, value)

    def spread(self, place: Weights) -> Array:
        """Return the mean compliance (…, C, C) in m/N between contacts at places (…, C); own ones are zero."""
        pair = self.coupling.pair[place.tooth[..., :, :, None, None], place.tooth[..., None, None, :, :]]
        rows, columns = place.station[..., :, :, None, None], place.station[..., None, None, :, :]
        found = np.einsum(
            "...iajb,...ia,...jb->...ij", self.mean[pair, rows, columns], place.value, place.value
        )
        number = np.arange(found.shape[-1])
        found[..., number, number] = 0.0
        return np.asarray(found)

    def between(self, place: Weights) -> Array:
        """Return the compliance (C, f, C, f) in m/N between slices of contacts at places (C,); own blocks are zero."""
        pair = self.coupling.pair[place.tooth[:, :, None, None], place.tooth]
        rows, columns = place.station[:, :, None, None], np.broadcast_to(place.station, pair.shape)
        weight = place.value[:, :, None, None] * place.value
        count, layers = len(place.value), self.table.shape[2]
        found = np.zeros((count, layers, count, layers))
        apart = ~np.eye(count, dtype=bool)
        one, other = np.nonzero(apart)
        for a in range(4):
            for b in range(4):
                p, k, m = (
                    pair[one, a, other, b],
                    np.broadcast_to(rows, pair.shape)[one, a, other, b],
                    columns[one, a, other, b],
                )
                found[one, :, other, :] += weight[one, a, other, b][:, None, None] * self.table[p, k, :, m, :]
        return np.asarray(np.einsum("fs,asbt,gt->afbg", self.finer, found, self.finer, optimize=True))

    def on_itself(self, place: Weights) -> Array:
        """Return S (…, f, f) in m/N of contacts at places (…) on themselves."""
        own = self.own[place.tooth % len(self.own), place.station]
        return np.asarray(np.einsum("...a,...ast->...st", place.value, own))

    def blunt(self, place: Weights) -> Array:
        """Return the half width (…) in rad of the loads at places (…)."""
        return np.asarray(np.sum(place.value * self.half_width[place.station], axis=-1))


def rim_compliance(
    body: ConeBody, side: Flank, coupling: Coupling, slices: IntArray, parts: int = 1, spot: float = 0.0
) -> RimCompliance:
    """Return the compliance of a rim; `slices` are the layers that contacts cover, each in so many `parts`.

    About the middle of their reach parts are no longer than `spot` (m), where it is not 0.
    """
    first, last = int(slices[0]), int(slices[-1])
    coarse = between(body.radial.breaks[first : last + 2])
    fine = finer(coarse, parts, spot)
    k, s = coupling.stations, coupling.slices
    table = coupling.table.reshape(len(coupling.table), k, s, k, s)
    share = coarse.length / coarse.length.sum()
    kernel = body.material.plane("strain").kernel
    number = np.arange(k)
    alone = np.unique(np.diag(coupling.pair)) if coupling.closed else np.diag(coupling.pair)
    own = np.stack([table[pair][number, :, number] for pair in alone])
    ends = float(body.radial.breaks[0]), float(body.radial.breaks[-1])
    return RimCompliance(
        table,
        sharpened(own, side.half_width, coarse, fine, ends, kernel),
        np.einsum("pksmt,s,t->pkm", table, share, share, optimize=True),
        coupling,
        side.centers,
        side.half_width,
        side.length,
        coarse,
        fine,
        interpolation(coarse, fine),
        kernel,
        body.material.poissons_ratio,
        ends,
        None if side.edges is None else int((side.centers < side.edges[0]).sum()),
    )
