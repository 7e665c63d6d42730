"""Joints that do not give way: the motions that they leave, and the forces that they pass."""

from __future__ import annotations

import numpy as np

from trochoid.kinematics.types import Array, ComplexArray, frozen

RANK = 1e-9


def free_motions(rows: Array, mass: Array) -> Array:
    """Return a basis (n, k) of the motions (n,) with rows (r, n) · motion = 0, each of unit size weighted by `mass`.

    `mass` (n, n) tells metres and radians, grams and tonnes apart; only its diagonal counts.
    """
    size = _sizes(mass)
    if not len(rows):
        return frozen(np.diag(size))
    scaled = rows * size
    scaled = scaled / np.linalg.norm(scaled, axis=1, keepdims=True)
    _, values, right = np.linalg.svd(scaled)
    rank = int((values > RANK).sum())
    return frozen(size[:, None] * right[rank:].T)


def constraint_forces(rows: Array, mass: Array, missing: ComplexArray) -> ComplexArray:
    """Return the forces (r, m) along `rows` (r, n) that sum to the loads `missing` (n, m), by least squares."""
    size = _sizes(mass)
    scaled = (rows * size).T
    weight = np.linalg.norm(scaled, axis=0)
    found = np.linalg.lstsq(scaled / weight, missing * size[:, None], rcond=None)[0]
    return np.asarray(found / weight[:, None], dtype=np.complex128)


def _sizes(mass: Array) -> Array:
    diagonal = np.diag(mass)
    return np.asarray(1.0 / np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0)))
