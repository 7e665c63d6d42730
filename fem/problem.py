"""The contact problem as data: n positions side by side, each with the same contacts.

Every array has the positions as its first axis, so that numpy works on all of them at once (see `rows`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.rows import Shared
from trochoid.kinematics.types import Array, BoolArray, IntArray


@dataclass(frozen=True, slots=True)
class Unit(Shared):
    """A positive definite matrix (m, m) that many blocks are multiples of.

    `windows` (m, m, m, m): at [i, j] the inverse on the rows i … j, zero elsewhere: what strips that touch side
    by side need.
    """

    matrix: Array
    windows: Array

    @staticmethod
    def of(matrix: Array) -> Unit:
        """Invert all windows of a matrix (m, m)."""
        count = len(matrix)
        place = np.arange(count)
        inside = (place >= place[:, None, None]) & (place <= place[:, None])  # first, last, row
        both = inside[..., :, None] & inside[..., None, :]
        return Unit(matrix, np.linalg.inv(np.where(both, matrix, np.eye(count))) * both)


@dataclass(frozen=True, slots=True)
class Alike:
    """Compliance blocks factor·unit: `factor` (n, c) in m/N."""

    unit: Unit
    factor: Array


@dataclass(frozen=True, slots=True)
class Group:
    """Contacts with equally many strips.

    Compliance `local` (n, c, m, m) in m/N or alike, `gap` (n, c, m) in m (inf: a strip that can never touch), `arms`
    (n, c, m, k), or (n, c, 1, k) when all strips of a contact have the same. Strip forces stay between `lower` and
    `upper` (n, c, m) in N, by default 0 and inf: at the lower one a strip may open, at the upper one close further.
    """

    local: Array | Alike
    gap: Array
    arms: Array
    lower: Array | None = None
    upper: Array | None = None

    @property
    def diagonal(self) -> Array:
        """Each strip's own compliance (n, c, m)."""
        if isinstance(self.local, Alike):
            return self.local.factor[..., None] * np.diag(self.local.unit.matrix)
        return np.asarray(np.einsum("...ii->...i", self.local))

    def pressed(self, force: Array) -> Array:
        """Return the openings (n, c, m) that forces on a contact's strips give each other."""
        if isinstance(self.local, Alike):
            return (force @ self.local.unit.matrix) * self.local.factor[..., None]
        return np.asarray(np.matmul(self.local, force[..., None])[..., 0])

    def closing(self, motion: Array) -> Array:
        """Return how much motions (n, k) close the strips, (n, c, m) or (n, c, 1)."""
        return np.asarray(np.matmul(self.arms, motion[:, None, :, None])[..., 0])

    def load(self, force: Array) -> Array:
        """Return the loads (n, k) of strip forces on the motions."""
        if self.arms.shape[2] == 1:
            force = force.sum(axis=2, keepdims=True)
        return np.asarray(np.einsum("ncmk,ncm->nk", self.arms, force))


@dataclass(frozen=True, slots=True)
class Problem:
    """Groups in order, `coupling` (n, C, C) between totals of all C contacts in m/N, `springs` (n, k, k) in N/m and
    `load` (n, k) on the motions.
    """

    groups: tuple[Group, ...]
    coupling: Array
    springs: Array
    load: Array


@dataclass(frozen=True, slots=True)
class Solution:
    """Strip forces per group (n, c, m) in N, `motion` (n, k), pivots and residuals (n,) relative to force and gap.

    `side` (n, c, m) says where each strip is: −1 at its lower force, 1 at its upper one, 0 between them (touching).
    `imbalance` is what Rᵀp + K a misses of F, `penetration` the deepest w on the wrong side of zero.
    """

    forces: tuple[Array, ...]
    motion: Array
    side: tuple[IntArray, ...]
    pivots: IntArray
    imbalance: Array
    penetration: Array

    @property
    def active(self) -> tuple[BoolArray, ...]:
        """Strips that touch, per group."""
        return tuple(s == 0 for s in self.side)
