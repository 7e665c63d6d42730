"""Stations on a body's surfaces, and the cubic splines in arc length that read tables between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix
from scipy.sparse.linalg import splu

from trochoid.kinematics.types import Array, BoolArray, IntArray

FEW = 16  # places up to which single entries of a table are gathered; beyond, whole rows
TOGETHER = 2_000_000  # numbers of these rows at a time: some of the cache, little of the memory


@dataclass(frozen=True, slots=True)
class Stations:
    """Where a body may be pressed: mid nodes of facets.

    `nodes` (k,), outward unit normals (k, 2) of the true profile, the facet's `elements` (k,) and `facets`
    lengths (k,).
    """

    nodes: IntArray
    normals: Array
    elements: IntArray
    facets: Array


@dataclass(frozen=True, slots=True)
class Surface:
    """One surface of a body: arc-length positions of its stations, its length in m, the first station, and the
    kink's slope in 1/(Pa·m).

    `sense` is 1 where arc length grows along the tangent (the outward normal turned by +90°), −1 on a hole;
    `bend` the curvature in 1/m of a circle, 0 of any other curve. A surface is closed, or an open stretch with
    `ends` in m (the flank of a tooth), four stations at least; places beyond an end count as on it.
    """

    name: str
    positions: Array
    length: float
    first: int
    kink: float
    sense: float = 1.0
    bend: float = 0.0
    ends: tuple[float, float] | None = None


@dataclass(frozen=True, slots=True)
class Weights:
    """Non-zero cubic B-splines at n places: columns (n, 4) of the table, their values (n, 4); the surface's
    first station and its kink's slope (n,). All may have the same leading axes.
    """

    columns: IntArray
    values: Array
    surface: IntArray
    kink: Array

    @staticmethod
    def joined(parts: Sequence[Weights]) -> Weights:
        """Return the places of all parts, in order."""
        return Weights(
            np.concatenate([p.columns for p in parts], axis=-2),
            np.concatenate([p.values for p in parts], axis=-2),
            np.concatenate([p.surface for p in parts], axis=-1),
            np.concatenate([p.kink for p in parts], axis=-1),
        )


def surface_weights(surface: Surface, position: Array) -> Weights:
    """Return the spline weights at arc-length positions (n,), which may have leading axes."""
    count = len(surface.positions)
    knots = _knots(surface)
    if surface.ends is None:
        start = surface.positions[0]
        position = start + np.mod(position - start, surface.length)
        last = count + 2
    else:
        position, last = np.clip(position, *surface.ends), count - 1
    interval = np.clip(np.searchsorted(knots, position, side="right") - 1, 3, last)
    columns = interval[..., None] - 3 + np.arange(4)
    own, kink = np.full(position.shape, surface.first), np.full(position.shape, surface.kink)
    return Weights(surface.first + columns % count, _basis(knots, interval, position), own, kink)


def middles(surface: Surface) -> Array:
    """Return where each spline coefficient (k,) sits (Greville): weighted with the splines they give the place."""
    knots = _knots(surface)
    return np.asarray((knots[1:-5] + knots[2:-4] + knots[3:-3])[: len(surface.positions)] / 3)


def _knots(surface: Surface) -> Array:
    """Return the knots: periodic, or for an open surface without those at the stations next to its ends."""
    if surface.ends is not None:
        low, high = surface.ends
        return np.concatenate([np.full(4, low), surface.positions[2:-2], np.full(4, high)])
    turn = np.append(surface.positions, surface.positions[0] + surface.length)
    return np.concatenate([turn[-4:-1] - surface.length, turn, turn[1:4] + surface.length])


def _basis(knots: Array, interval: IntArray, position: Array) -> Array:
    """Return the four cubic B-splines that are not zero at each position (de Boor's recursion, vectorised)."""
    values = np.ones((*position.shape, 1))
    for degree in range(1, 4):
        new = np.zeros((*position.shape, degree + 1))
        for j in range(degree):
            right = knots[interval + j + 1]
            left = knots[interval + j + 1 - degree]
            part = values[..., j] / (right - left)
            new[..., j] += (right - position) * part
            new[..., j + 1] += (position - left) * part
        values = new
    return values


def collocation(surface: Surface) -> Array:
    """Return the splines (k, k) of a surface at its own stations: table = collocation @ coefficients."""
    count = len(surface.positions)
    weights = surface_weights(surface, surface.positions)
    matrix = np.zeros((count, count))
    np.add.at(matrix, (np.arange(count)[:, None], weights.columns - surface.first), weights.values)
    return matrix


def without_kinks(s: Array, surfaces: Sequence[Surface], points: Array) -> Array:
    """Return a table (k, k) at stations (k, 2) less the kinks at x = y that `kinks` puts back."""
    table = s.copy()
    for surface in surfaces:
        rows = surface_rows(surface)
        distance = np.linalg.norm(points[rows][:, None] - points[rows][None], axis=-1)
        table[rows, rows] -= surface.kink * distance
    return table


def kinks(place: Weights) -> Array:
    """Return the slopes (n, n) of the kinks between places: none between different surfaces."""
    return np.where(same_surface(place), place.kink[..., None, :], 0.0)


def same_surface(place: Weights) -> BoolArray:
    """Return which places (n, n) lie on the same surface."""
    return np.asarray(place.surface[..., :, None] == place.surface[..., None, :])


def surface_rows(surface: Surface) -> slice:
    """Return the rows of a table that belong to a surface."""
    return slice(surface.first, surface.first + len(surface.positions))


def splined(smooth: Array, s: Array, surfaces: Sequence[Surface]) -> tuple[Array, Array]:
    """Return the spline coefficients of a smooth table (k, k) and of the diagonal (k,) of s."""
    table, diagonal = smooth.copy(), np.diag(s).copy()
    for surface in surfaces:
        rows = surface_rows(surface)
        solve = splu(
            csc_matrix(collocation(surface))
        ).solve  # four entries a row: grows with the square of the table
        table[rows] = solve(table[rows])
        table[:, rows] = solve(np.ascontiguousarray(table[:, rows].T)).T
        diagonal[rows] = solve(diagonal[rows])
    return table, diagonal


def read_table(table: Array, place: Weights) -> Array:
    """Return a splined table (n, n) between places."""
    columns, values = place.columns, place.values
    count, reach = columns.shape[-2:]
    if count < FEW:
        gathered = table[columns[..., :, None, :, None], columns[..., None, :, None, :]]
        half = np.matmul(gathered, values[..., None, :, :, None])[..., 0]
        return np.asarray(np.einsum("...ija,...ia->...ij", half, values))
    flat, weights = columns.reshape(-1, count, reach), values.reshape(-1, count, reach)
    result = np.empty((len(flat), count, count))
    together = max(1, TOGETHER // (count * len(table)))  # positions whose rows are read side by side
    for start in range(0, len(flat), together):
        rows = slice(start, start + together)
        ends = np.arange(0, flat[rows].size + 1, reach)
        weighted = csr_matrix(
            (weights[rows].ravel(), flat[rows].ravel(), ends), shape=(len(ends) - 1, len(table))
        )
        half = (weighted @ table).reshape(-1, count, len(table))
        for i, part in enumerate(half, start=start):
            result[i] = np.einsum("jai,ja->ij", part.T[flat[i]], weights[i])
    return result.reshape(*columns.shape[:-1], count)


def read_diagonal(diagonal: Array, place: Weights) -> Array:
    """Return a splined diagonal (n,) at places."""
    return np.asarray(np.einsum("...ia,...ia->...i", diagonal[place.columns], place.values))


def set_diagonal(matrix: Array, value: Array | float) -> None:
    """Set the diagonal of (..., n, n) in place."""
    index = np.arange(matrix.shape[-1])
    matrix[..., index, index] = value
