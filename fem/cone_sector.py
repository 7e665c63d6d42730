"""One tooth of a rim as a superelement between the two cuts beside it.

The cuts are the same, turned by a pitch.  Along them displacements are smooth in ρ: polynomials there stand for the
layers' nodes (rigid motions are among them), which leaves few unknowns for the rim as a whole (see `cone_ring`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import block_diag, csc_matrix, hstack, identity, kron

from trochoid.fem.cone_body import ConeBody, factored, product, read
from trochoid.fem.cone_flank import Flank, load_at
from trochoid.fem.cone_layers import integrals
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.spherical import rotation
from trochoid.kinematics.types import Array, IntArray

DEGREE = 4  # of the polynomials in ρ along a cut: 2e-5 in shares and motions, 1e-2 in S beside the cut itself


@dataclass(frozen=True, eq=False, slots=True)
class Loads:
    """Loads on one sector: those of stations that reach over its ends are cut in two.

    `plane` (3n, r); load i belongs to `station` (r,) of the tooth that is `shift` (r,) pitches before this one.
    `slices` (s,) are the layers that a roller covers, `radial` (layer nodes, s) what a unit force on each gives.
    """

    plane: csc_matrix
    station: IntArray
    shift: IntArray
    slices: IntArray
    radial: Array


@dataclass(frozen=True, eq=False, slots=True)
class Sector:
    """A tooth without its inside: r loads times s slices, t displacements of each cut.

    `own` (rs, rs) in m/N with both cuts held; `stiffness` (2t, 2t) of the left cut's displacements, then the right
    one's; `pull` (rs, 2t): what the loads do to them.
    """

    loads: Loads
    own: Array
    stiffness: Array
    pull: Array


def station_loads(side: Flank, body: ConeBody, reach: tuple[float, float] | None = None) -> Loads:
    """Return the loads of all stations on the slices (layers) between the distances `reach` (m).

    Raises TrochoidError when the reach does not begin and end between layers.
    """
    slices = covered(body, reach)
    columns, station, shift = [], [], []
    for number, (center, half) in enumerate(zip(side.centers, side.half_width, strict=True)):
        for turn in (-1, 0, 1):
            column = load_at(side, center - turn * side.length, half)
            if column.nnz:
                columns.append(column)
                station.append(number)
                shift.append(turn)
    weights = integrals(body.radial)[:, slices]
    unit = weights / weights.sum(axis=0)
    return Loads(hstack(columns, format="csc"), np.array(station), np.array(shift), slices, unit)


def covered(body: ConeBody, reach: tuple[float, float] | None) -> IntArray:
    """Return the layers between two distances (m) from the centre."""
    breaks = body.radial.breaks
    if reach is None:
        return np.arange(len(breaks) - 1)
    ends = [int(np.argmin(np.abs(breaks - r))) for r in reach]
    if ends[0] >= ends[1] or any(abs(breaks[e] - r) > 1e-9 * r for e, r in zip(ends, reach, strict=True)):
        raise TrochoidError(
            f"a roller from {reach[0]:g} to {reach[1]:g} m does not end between layers; make the layers with "
            "these two among their ends"
        )
    return np.arange(ends[0], ends[1])


def condense(
    body: ConeBody, loads: Loads, pitch: float, degree: int = DEGREE, solver: str | None = None
) -> Sector:
    """Eliminate the inside of a sector whose right cut is its left one turned by `pitch` (rad) about z."""
    left, right = cut_displacements(body, pitch, degree)
    on_cut = np.zeros(body.size, dtype=bool)
    on_cut[body.dofs(np.concatenate([body.mesh.nodes(n) for n in ("left", "right")])).ravel()] = True
    trace = hstack([left, right], format="csc")
    inside = ~on_cut & ~body.held
    solve = factored(body, inside, solver)
    force = product(loads.plane, loads.radial)
    across = (body.stiffness @ trace).tocsc()
    inner = np.flatnonzero(inside)
    every = hstack([across[inner], force[inner]], format="csc")
    whole, _ = read(solve, every, csc_matrix((len(inner), 0)))
    t = trace.shape[1]
    stiffness = (trace.T @ across).toarray() - whole[:t, :t]
    pull = (force.T @ trace).toarray() - whole[t:, :t]
    return Sector(loads, whole[t:, t:], 0.5 * (stiffness + stiffness.T), pull)


def cut_displacements(body: ConeBody, pitch: float, degree: int) -> tuple[csc_matrix, csc_matrix]:
    """Return the displacements (all, t) that the left cut may take, and those of the right one, turned by `pitch`."""
    return _cut(body, "left", np.eye(3), degree), _cut(body, "right", rotation(2, pitch), degree)


def _cut(body: ConeBody, name: str, turned: Array, degree: int) -> csc_matrix:
    """Return the displacements (all, t) that a cut may take: per node polynomials in ρ, per direction turned by it."""
    nodes, rho = body.mesh.nodes(name), body.radial.nodes
    x = 2.0 * (rho - rho[0]) / (rho[-1] - rho[0]) - 1.0
    count = body.radial.count
    smooth = csc_matrix(np.polynomial.legendre.legvander(x, min(degree, count - 1)))
    parts = []
    for node in nodes:
        held = body.held[body.dofs(np.array([node]))[0, 0]]
        basis = smooth if not held.any() else identity(count, format="csc")[:, np.flatnonzero(~held)]
        parts.append(kron(csc_matrix(turned), basis, format="csc"))
    local = block_diag(parts, format="coo")
    rows = body.dofs(nodes).ravel()[local.row]
    return csc_matrix((local.data, (rows, local.col)), shape=(body.size, local.shape[1]))
