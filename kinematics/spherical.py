"""Rotations, and motions of a body about a fixed point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.types import Array


def rotation(axis: int, angle: npt.ArrayLike) -> Array:
    """Rotation matrices (..., 3, 3) by `angle` (...), rad, about the axis 0, 1 or 2 of the frame."""
    angle = np.asarray(angle, dtype=np.float64)
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.zeros((*angle.shape, 3, 3))
    matrix[..., axis, axis] = 1.0
    matrix[..., i, i] = matrix[..., j, j] = c
    matrix[..., i, j], matrix[..., j, i] = -s, s
    return matrix


def turn(matrix: Array, vectors: npt.ArrayLike) -> Array:
    """Product of matrices (..., 3, 3) and vectors (..., 3), shape (..., 3)."""
    product: Array = np.einsum("...ij,...j->...i", matrix, np.asarray(vectors, dtype=np.float64))
    return product


def unit(vectors: Array) -> Array:
    """Vectors (..., 3) over their lengths."""
    scaled: Array = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return scaled


def angle_between(a: Array, b: Array) -> Array:
    """Angle (rad) between unit vectors (..., 3), to rounding for small angles and for those near π too."""
    angle: Array = 2.0 * np.arctan2(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1))
    return angle


@dataclass(frozen=True, eq=False, slots=True)
class SphericalMotion:
    """Pose of a body that turns about the origin, all in the fixed frame, over n positions.

    `rotation` (n, 3, 3) carries the body's frame to the fixed one; `velocity` (n, 3) is the angular velocity,
    rad/s, and `acceleration` (n, 3) the angular acceleration, rad/s².
    """

    rotation: Array
    velocity: Array
    acceleration: Array

    def to_fixed(self, points: npt.ArrayLike) -> Array:
        """Carry points of the body, (p, 3) or (n, p, 3), to the fixed frame, (n, p, 3)."""
        return np.asarray(points, dtype=np.float64) @ np.swapaxes(self.rotation, -1, -2)

    def to_member(self, points: npt.ArrayLike) -> Array:
        """Carry points of the fixed frame, (p, 3) or (n, p, 3), into the body's, (n, p, 3)."""
        return np.asarray(points, dtype=np.float64) @ self.rotation

    def point_velocity(self, points: npt.ArrayLike) -> Array:
        """Velocity ω × r (n, p, 3), fixed frame, of points of the body, in their unit per second."""
        carried = self.to_fixed(points)
        return np.cross(np.broadcast_to(self.velocity[:, None, :], carried.shape), carried)

    def point_acceleration(self, points: npt.ArrayLike) -> Array:
        """Acceleration ε × r + ω × (ω × r) (n, p, 3), fixed frame, of points of the body."""
        carried = self.to_fixed(points)
        spin, twist = (
            np.broadcast_to(vector[:, None, :], carried.shape)
            for vector in (self.velocity, self.acceleration)
        )
        return np.cross(twist, carried) + np.cross(spin, np.cross(spin, carried))

    def instantaneous_axis(self) -> Array:
        """Unit vectors (n, 3) along the angular velocity: the points of the body that stand still."""
        return unit(self.velocity)


def inverse(motion: SphericalMotion) -> SphericalMotion:
    """Motion of the fixed frame as the body sees it, in the body's frame: R' = Rᵀ, ω' = −Rᵀω, ε' = −Rᵀε."""
    back = np.swapaxes(motion.rotation, -1, -2)
    return SphericalMotion(back, -turn(back, motion.velocity), -turn(back, motion.acceleration))
