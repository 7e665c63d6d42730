"""Displacement of all elements of a closed rim under given contact forces, from the tooth that was condensed.

The inside of a tooth was eliminated (see `cone_sector`); here it is found again: first the cuts of all teeth, by the
rim's harmonics, then the inside of each tooth between its two cuts.  Forces stand where the table of compliances has
them: on the stations beside each contact, over `half_width` of these.  A contact is far narrower, so that what the
flank yields within that half width of a contact is too little here; elsewhere it is what the contacts feel.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.sparse import csc_matrix, hstack

from trochoid.fem.cone_body import factored, product
from trochoid.fem.cone_rim import Rim
from trochoid.fem.cone_sector import cut_displacements
from trochoid.fem.linear_solver import Solve
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, IntArray


@dataclass(frozen=True, eq=False, slots=True)
class RimField:
    """A rim whose elements can be moved: `trace` (all, 2t) of both cuts, their force `across` (inside, 2t) on the
    inside, loads `force` (inside, r·s), degrees of freedom `inside` and their factor.
    """

    rim: Rim
    trace: csc_matrix
    across: csc_matrix
    force: csc_matrix
    inside: IntArray
    solve: Solve

    @property
    def teeth(self) -> int:
        """Number of teeth."""
        return self.rim.compliance.coupling.teeth


def rim_field(rim: Rim, solver: str | None = None) -> RimField:
    """Factor one tooth again.  Raises TrochoidError for a row of teeth, whose last is not the first one's neighbour."""
    if not rim.compliance.closed:
        raise TrochoidError("the displacement of a row of teeth is not recovered; take a closed rim")
    body, loads = rim.body, rim.sector.loads
    trace = hstack(cut_displacements(body, rim.shape.pitch, rim.degree), format="csc")
    nodes = np.concatenate([body.mesh.nodes(name) for name in ("left", "right")])
    free = ~body.held
    free[body.dofs(nodes).ravel()] = False
    inside = np.flatnonzero(free)
    across = csc_matrix((body.stiffness @ trace).tocsr()[inside])
    force = csc_matrix(product(loads.plane, loads.radial).tocsr()[inside])
    return RimField(rim, trace, across, force, inside, factored(body, free, solver))


def station_forces(rim: Rim, place: Array, force: Array) -> Array:
    """Return forces (teeth, stations, layers), N, that stand for contacts at `place` (C,), rad, with `force` (C, s)."""
    compliance = rim.compliance
    at = compliance.weights(place)
    layered = force @ compliance.finer
    found = np.zeros((compliance.coupling.teeth, len(compliance.centers), layered.shape[1]))
    np.add.at(found, (at.tooth, at.station), at.value[..., None] * layered[:, None, :])
    return found


def displacements(field: RimField, forces: Array) -> Iterator[Array]:
    """Yield the displacements (teeth, n, layer nodes, 3), m, under forces (p, teeth, stations, layers) of p positions.

    Each tooth's are in the frame of tooth 0: the rim's, turned back by its pitches.
    """
    body = field.rim.body
    for one in forces:
        parts = _on_sectors(field, one)
        cuts = _cuts(field, parts)
        both = np.concatenate([cuts, np.roll(cuts, -1, axis=0)], axis=1)
        inner = field.solve(np.asarray((field.force @ parts.T) - field.across @ both.T))
        moved = np.asarray(field.trace @ both.T)
        moved[field.inside] = inner
        shape = (len(body.mesh.points), 3, body.radial.count, len(one))
        yield np.ascontiguousarray(moved.reshape(shape).transpose(3, 0, 2, 1))


def _on_sectors(field: RimField, one: Array) -> Array:
    """Return the forces (teeth, r·s) of the parts of loads on each sector; those over its end are its neighbour's."""
    loads = field.rim.sector.loads
    number = np.arange(len(one))[:, None]
    parts = one[(number - loads.shift) % len(one), loads.station]
    return np.asarray(parts.reshape(len(one), -1))


def _cuts(field: RimField, parts: Array) -> Array:
    """Return the displacements (teeth, t) of the cuts on the left of each tooth, harmonic by harmonic."""
    sector, teeth = field.rim.sector, len(parts)
    t = len(sector.stiffness) // 2
    left, right, k = slice(0, t), slice(t, 2 * t), sector.stiffness
    pulled = parts @ sector.pull
    load = np.fft.rfft(pulled[:, left] + np.roll(pulled[:, right], 1, axis=0), axis=0)
    for h in range(len(load)):
        turn = np.exp(2j * np.pi * h / teeth)
        matrix = k[left, left] + k[right, right] + k[left, right] * turn + k[right, left] * turn.conjugate()
        load[h] = cho_solve(cho_factor(matrix), load[h])
    return np.asarray(np.fft.irfft(load, teeth, axis=0))
