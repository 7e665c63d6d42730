"""Relative motions of two members that turn at constant rates: about parallel axes, on a rack, about a centre.

Each answers to `envelope.RelativeMotion`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.spherical import rotation, turn
from trochoid.kinematics.types import Array, ComplexArray


@dataclass(frozen=True, slots=True)
class ParallelAxes:
    """The curve turns at `second` about its own axis, which stands `distance` (m) off the body's, at `first`.

    z_body = exp(i·first·φ)(distance + exp(i·second·φ) z).  Pins on the ring of a cycloid drive, seen by a disc
    with z_c lobes: first = z_p/z_c, distance = −e, second = −1, φ the crank angle.
    """

    distance: float
    first: float
    second: float

    def carry(self, points: Array, phi: npt.ArrayLike) -> Array:
        """Points (..., 2) in the frame of the body, m."""
        return _vector(
            _turning(self.first, phi) * (self.distance + _turning(self.second, phi) * _complex(points))
        )

    def direct(self, vectors: Array, phi: npt.ArrayLike) -> Array:
        """Directions (..., 2) in the frame of the body."""
        return _vector(_turning(self.first + self.second, phi) * _complex(vectors))

    def velocity(self, points: Array, phi: npt.ArrayLike) -> Array:
        """Velocity (..., 2) relative to the body, m per rad, in the frame of the curve."""
        turning = (self.first + self.second) * _complex(points)
        return _vector(1j * (turning + self.first * self.distance * _turning(-self.second, phi)))

    def spin(self, vectors: Array, phi: npt.ArrayLike) -> Array:
        """Rate (..., 2) of turning directions, per rad."""
        return _vector(1j * (self.first + self.second) * _complex(vectors))


@dataclass(frozen=True, slots=True)
class RackMotion:
    """A rack, whose pitch line is x = `radius` (m) and moves along y, on a gear with that pitch radius.

    z_body = exp(−iφ)(z + i·radius·φ), φ the angle of the gear.
    """

    radius: float

    def carry(self, points: Array, phi: npt.ArrayLike) -> Array:
        """Points (..., 2) in the frame of the gear, m."""
        return _vector(_turning(-1.0, phi) * (_complex(points) + 1j * self.radius * np.asarray(phi)))

    def direct(self, vectors: Array, phi: npt.ArrayLike) -> Array:
        """Directions (..., 2) in the frame of the gear."""
        return _vector(_turning(-1.0, phi) * _complex(vectors))

    def velocity(self, points: Array, phi: npt.ArrayLike) -> Array:
        """Velocity (..., 2) relative to the gear, m per rad, in the frame of the rack."""
        return _vector(1j * (self.radius - _complex(points)) + self.radius * np.asarray(phi))

    def spin(self, vectors: Array, phi: npt.ArrayLike) -> Array:
        """Rate (..., 2) of turning directions, per rad."""
        return _vector(-1j * _complex(vectors) * np.ones(np.shape(phi)))


@dataclass(frozen=True, slots=True)
class MeetingAxes:
    """The curve turns at `second` about its axis z, which stands `angle` (rad) off the body's axis z, at `first`.

    c_body = R_z(first·φ) R_y(angle) R_z(second·φ) c.  Pins on the ring of a nutating pair, seen by the
    satellite: first = ν = z1/z2, angle = −ϑ, second = −1; pins on the satellite, seen by the ring: first = 1,
    angle = ϑ, second = −ν (sources §5).
    """

    angle: float
    first: float
    second: float

    def _matrix(self, phi: npt.ArrayLike) -> Array:
        phi = np.asarray(phi, dtype=np.float64)
        matrix: Array = (
            rotation(2, self.first * phi) @ rotation(1, self.angle) @ rotation(2, self.second * phi)
        )
        return matrix

    def angular_velocity(self, phi: npt.ArrayLike) -> Array:
        """W (..., 3) of the curve relative to the body, per unit φ, in the frame of the curve."""
        turned = -self.second * np.asarray(phi, dtype=np.float64)
        s, c = math.sin(self.angle), math.cos(self.angle)
        axis = np.stack((-s * np.cos(turned), -s * np.sin(turned), np.full(turned.shape, c)), axis=-1)
        along: Array = self.first * axis
        return along + self.second * np.array([0.0, 0.0, 1.0])

    def carry(self, points: Array, phi: npt.ArrayLike) -> Array:
        """Points (..., 3) in the frame of the body."""
        return turn(self._matrix(phi), points)

    def direct(self, vectors: Array, phi: npt.ArrayLike) -> Array:
        """Directions (..., 3) in the frame of the body."""
        return turn(self._matrix(phi), vectors)

    def velocity(self, points: Array, phi: npt.ArrayLike) -> Array:
        """Velocity W × c (..., 3) relative to the body, per rad, in the frame of the curve."""
        return np.cross(self.angular_velocity(phi), points)

    def spin(self, vectors: Array, phi: npt.ArrayLike) -> Array:
        """Rate W × vector (..., 3) of turning directions, per rad."""
        return np.cross(self.angular_velocity(phi), vectors)


def _turning(rate: float, phi: npt.ArrayLike) -> ComplexArray:
    return np.asarray(np.exp(1j * rate * np.asarray(phi, dtype=np.float64)), dtype=np.complex128)


def _complex(points: Array) -> ComplexArray:
    return np.asarray(points[..., 0] + 1j * points[..., 1], dtype=np.complex128)


def _vector(z: ComplexArray) -> Array:
    return np.stack((z.real, z.imag), axis=-1)
