"""Indexers for the tests, and their motion from rotation matrices, without the program's formulas."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import strategies as st

from trochoid.kinematics.indexer import Indexer
from trochoid.kinematics.indexer_synthesis import Task
from trochoid.kinematics.spherical_trochoid import SphericalTrochoid
from trochoid.kinematics.types import Array, ComplexArray

DEGREE = math.pi / 180.0


def turned(axis: int, angle: complex) -> ComplexArray:
    """Rotation matrix, for complex angles too."""
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3, dtype=np.complex128)
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    return matrix


def pin_at(path: SphericalTrochoid, phi: complex) -> ComplexArray:
    """P = R_z(φ) R_y(γ) R_z(θ) (sin β, 0, cos β)."""
    theta = path.phase + path.ratio * phi
    pin = np.array([math.sin(path.pin), 0.0, math.cos(path.pin)], dtype=np.complex128)
    return np.asarray(turned(2, phi) @ turned(1, path.arm) @ turned(2, theta) @ pin)


def speed_of_wheel(indexer: Indexer, phi: float) -> float:
    """Angular velocity ω = dψ/dφ by a complex step in tan ψ = P_y/P·w."""
    D, step = indexer.shaft_angle, 1e-40
    P = pin_at(indexer.path, phi + 1j * step)
    along = P[2] * math.sin(D) - P[0] * math.cos(D)
    return float(((P[1].imag * along.real - P[1].real * along.imag) / abs(along + 1j * P[1]) ** 2) / step)


def eighth_order(values: Array, step: float) -> float:
    """First derivative from nine equally spaced values."""
    weights = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0.0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
    return float(weights @ values / step)


def paths() -> st.SearchStrategy[SphericalTrochoid]:
    return st.builds(
        SphericalTrochoid,
        arm=st.floats(0.02, 3.1) | st.floats(-3.1, -0.02),
        pin=st.floats(0.0, 1.5),
        ratio=st.integers(2, 9).flatmap(lambda i: st.sampled_from([float(i), -float(i)])),
        phase=st.sampled_from([0.0, math.pi]),
    )


def indexers() -> st.SearchStrategy[Indexer]:
    """Any pin path before any wheel: not synthesised, so with hard shocks."""
    return st.builds(Indexer, paths(), st.floats(0.1, 3.0), st.floats(0.05, 3.0))


def tasks() -> st.SearchStrategy[Task]:
    return st.builds(Task, st.floats(0.1, 3.0), st.integers(2, 8), st.floats(0.15, 3.0))
