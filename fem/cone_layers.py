"""Layers of a body of rays between two spheres: second-order elements in the distance ρ from the centre."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.sparse import csr_matrix

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, frozen

GRADING = 0.3  # size of the last layer at an end over that in the middle
_GAUSS = np.polynomial.legendre.leggauss(4)


@dataclass(frozen=True, eq=False, slots=True)
class Layers:
    """Layers between `breaks` (m+1,), m; nodes are the breaks and the middles, 2m+1 of them."""

    breaks: Array

    @property
    def nodes(self) -> Array:
        """Distances (2m+1,) of the nodes from the centre, m."""
        middles = 0.5 * (self.breaks[1:] + self.breaks[:-1])
        return np.insert(self.breaks, np.arange(1, len(self.breaks)), middles)

    @property
    def count(self) -> int:
        """Number of nodes."""
        return 2 * len(self.breaks) - 1


@dataclass(frozen=True, eq=False, slots=True)
class LayerMatrices:
    """∫ L_i L_j dρ, ∫ ρ L_i' L_j dρ and ∫ ρ² L_i' L_j' dρ (n, n), sparse."""

    plain: csr_matrix
    mixed: csr_matrix
    steep: csr_matrix


def layers(
    inner: float, outer: float, count: int, ends: Sequence[float] = (), grading: float = GRADING
) -> Layers:
    """Return about `count` layers from `inner` to `outer` (m), thinner towards both and towards `ends` between them.

    Raises Infeasible when these do not grow from inner to outer.
    """
    stops = np.unique([inner, *ends, outer])
    if not (0.0 < inner < outer and stops[0] == inner and stops[-1] == outer):
        raise Infeasible(
            f"layers between {inner:g} and {outer:g} m with ends at {list(ends)}: radii must be positive and the ends "
            "between them"
        )
    parts = []
    for low, high in pairwise(stops):
        number = max(2, round(count * (high - low) / (outer - inner)))
        parts.append(low + (high - low) * _graded(number, grading)[:-1])
    return Layers(frozen(np.append(np.concatenate(parts), outer)))


def _graded(count: int, grading: float) -> Array:
    """Return breaks (count+1,) of the unit interval whose steps fall from the middle to both ends."""
    place = np.abs(2.0 * (np.arange(count) + 0.5) / count - 1.0)
    size = grading ** (place**2)
    return np.concatenate([[0.0], np.cumsum(size) / size.sum()])


def matrices(radial: Layers) -> LayerMatrices:
    """Integrate the three one-dimensional matrices exactly."""
    low, high = radial.breaks[:-1], radial.breaks[1:]
    x, weight = 0.5 * (_GAUSS[0] + 1.0), 0.5 * _GAUSS[1]
    value = np.stack(
        [(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)]
    )  # inner, middle, outer; (3, q)
    slope = np.stack([4 * x - 3, 4 - 8 * x, 4 * x - 1])
    length = (high - low)[:, None, None]
    rho = low[:, None] + (high - low)[:, None] * x
    index = 2 * np.arange(len(low))[:, None] + np.arange(3)

    def assembled(element: Array) -> csr_matrix:
        rows, columns = np.repeat(index, 3, axis=1).ravel(), np.tile(index, (1, 3)).ravel()
        return csr_matrix((element.ravel(), (rows, columns)), shape=(radial.count, radial.count))

    plain = length * np.einsum("aq,bq,q->ab", value, value, weight)
    mixed = np.einsum("aq,bq,eq,q->eab", slope, value, rho, weight)
    steep = np.einsum("aq,bq,eq,q->eab", slope, slope, rho**2, weight) / length
    return LayerMatrices(assembled(plain), assembled(mixed), assembled(steep))


def integrals(radial: Layers) -> Array:
    """Return ∫ L_i dρ over each layer, (2m+1, m), m: what a load of one newton per metre gives the nodes."""
    length = np.diff(radial.breaks)
    found = np.zeros((radial.count, len(length)))
    number = np.arange(len(length))
    for node, share in ((0, 1 / 6), (1, 2 / 3), (2, 1 / 6)):
        found[2 * number + node, number] = share * length
    return found
