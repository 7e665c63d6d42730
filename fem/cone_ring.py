"""All teeth of a rim from one: a full rim by its cyclic symmetry, or a few teeth in a row.

Every tooth is the same superelement.  On a full rim of z teeth the displacements of the cuts split into harmonics
u_m = u exp(iθm), θ = 2πh/z, each with the small matrix S_LL + S_RR + S_LR exp(iθ) + S_RL exp(−iθ).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from trochoid.fem.cone_sector import Sector
from trochoid.kinematics.types import Array, IntArray


@dataclass(frozen=True, eq=False, slots=True)
class Coupling:
    """Compliance between all stations of all teeth.

    `table` (pairs, k·s, k·s) in m/N of unit forces on slices; row `pair`[m, l] is tooth m's displacement under
    tooth l's forces.  `teeth` in all, `closed` when the last is the first one's neighbour.
    """

    table: Array
    pair: IntArray
    stations: int
    slices: int
    closed: bool

    @property
    def teeth(self) -> int:
        """Number of teeth."""
        return len(self.pair)


def full_rim(sector: Sector, teeth: int) -> Coupling:
    """Return the coupling of a closed rim of `teeth` sectors."""
    t = len(sector.stiffness) // 2
    left, right = slice(0, t), slice(t, 2 * t)
    k, pull = sector.stiffness, sector.pull
    sums = np.zeros((teeth, len(pull), len(pull)))
    for h in range(teeth // 2 + 1):
        turn = np.exp(2j * np.pi * h / teeth)
        matrix = k[left, left] + k[right, right] + k[left, right] * turn + k[right, left] * turn.conjugate()
        load = (pull[:, left] + pull[:, right] * turn).conj()  # force on the cuts under loads of this phase
        answer = load.conj() @ cho_solve(cho_factor(matrix), load.T)
        weight = (1.0 if 2 * h in (0, teeth) else 2.0) / teeth
        for m in range(teeth):
            angle = 2 * np.pi * h * m / teeth
            sums[m] += weight * (answer.real * np.cos(angle) - answer.imag * np.sin(angle))
    sums[0] += sector.own
    number = np.arange(teeth)
    return _merged(sector, sums, np.asarray((number[:, None] - number) % teeth), closed=True)


def row_of_teeth(sector: Sector, teeth: int) -> Coupling:
    """Return the coupling of `teeth` sectors side by side, with free ends."""
    t, count = len(sector.stiffness) // 2, len(sector.pull)
    matrix = np.zeros(((teeth + 1) * t,) * 2)
    load = np.zeros((teeth * count, (teeth + 1) * t))
    for m in range(teeth):
        cuts = slice(m * t, (m + 2) * t)
        matrix[cuts, cuts] += sector.stiffness
        load[m * count : (m + 1) * count, cuts] = sector.pull
    whole = (load @ cho_solve(cho_factor(matrix), load.T)).reshape(teeth, count, teeth, count)
    table = np.ascontiguousarray(whole.transpose(0, 2, 1, 3)).reshape(-1, count, count)
    pair = np.arange(teeth**2).reshape(teeth, teeth)
    table[np.diag(pair)] += sector.own
    return _merged(sector, table, pair, closed=False)


def _merged(sector: Sector, table: Array, pair: IntArray, closed: bool) -> Coupling:
    """Add up the parts of loads that reach over the end of a sector into the next."""
    loads = sector.loads
    stations, slices, teeth = int(loads.station.max()) + 1, len(loads.slices), len(pair)
    parts = len(loads.station)
    raw = table.reshape(len(table), parts, slices, parts, slices)
    merged = np.zeros((len(table), stations, slices, stations, slices))
    first = {int(pair[m, n]): (m, n) for m in range(teeth) for n in range(teeth)}
    for i, (a, x) in enumerate(zip(loads.station, loads.shift, strict=True)):
        for j, (b, y) in enumerate(zip(loads.station, loads.shift, strict=True)):
            for number, (m, n) in first.items():
                p, q = m + int(x), n + int(y)
                if closed:
                    p, q = p % teeth, q % teeth
                if 0 <= p < teeth and 0 <= q < teeth:
                    merged[number, a, :, b] += raw[pair[p, q], i, :, j]
    return Coupling(merged.reshape(len(table), stations * slices, -1), pair, stations, slices, closed)
