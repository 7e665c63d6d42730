"""Indexing mechanism on the sphere: a pin on a spherical trochoid turns a slotted wheel, and lets it rest.

The wheel's axis is o = (sin D, 0, cos D), its slots are great circles through o.  With ζ = P·w + i P_y,
w = (−cos D, 0, sin D), the slot that holds the pin stands at ψ = arg ζ (sources §5), so that

    ψ' = Im ζ'/ζ,   ψ'' = Im(ζ''/ζ − (ζ'/ζ)²),   ψ''' = Im(ζ'''/ζ − 3 ζ'ζ''/ζ² + 2 (ζ'/ζ)³)

are exact.  One index lasts from φ = −φ0 to φ0; φ = 0 is its middle, about which the motion is symmetric.
Derivatives are per rad of the drive: times the drive's speed to the power of their order they are per second.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.spherical_trochoid import SphericalTrochoid
from trochoid.kinematics.types import Array


@dataclass(frozen=True, eq=False, slots=True)
class WheelMotion:
    """Motion of the wheel at drive angles (...): `angle` ψ (rad), `velocity` ω = dψ/dφ, `acceleration` ε, `jerk`."""

    angle: Array
    velocity: Array
    acceleration: Array
    jerk: Array

    @property
    def power(self) -> Array:
        """N = ω ε, the power that a unit moment of inertia takes."""
        power: Array = self.velocity * self.acceleration
        return power


@dataclass(frozen=True, slots=True)
class Indexer:
    """A pin path, the angle D between the shafts and half the drive angle of an index φ0, rad.  Raises Infeasible."""

    path: SphericalTrochoid
    shaft_angle: float
    half_turn: float

    def __post_init__(self) -> None:
        """Refuse angles at which there is no wheel or no index."""
        if not 0.0 < self.shaft_angle < math.pi:
            raise Infeasible(
                f"shaft angle {math.degrees(self.shaft_angle):g}°: the shafts must cross; take 0° to 180°, "
                "both excluded"
            )
        if not 0.0 < self.half_turn < math.pi:
            raise Infeasible(
                f"an index of {math.degrees(2 * self.half_turn):g}° of the drive; take more than 0° and less than "
                "360°, that it may dwell"
            )

    @property
    def duration(self) -> float:
        """k = φ0/π, the share of a turn of the drive in which the wheel moves."""
        return self.half_turn / math.pi

    @property
    def swing(self) -> float:
        """ψ_Σ, the angle (rad) by which the wheel turns in one index."""
        return 2.0 * abs(float(motion(self, self.half_turn).angle))

    @property
    def sense(self) -> int:
        """+1 where ψ grows over an index: the wheel turns about −o as the drive about z; −1 where about o."""
        return 1 if float(motion(self, self.half_turn).angle) >= 0.0 else -1

    @property
    def axis(self) -> Array:
        """The wheel's axis o (3,)."""
        return np.array([math.sin(self.shaft_angle), 0.0, math.cos(self.shaft_angle)])

    def reach(self, t: npt.ArrayLike) -> Array:
        """Angle (rad) between the pin and the wheel's axis; at ±φ0 the radius of the wheel's rim."""
        zeta = in_wheel(self.path.derivatives(t, 0), self.shaft_angle)[0]
        reach: Array = np.arctan2(np.abs(zeta), self.path.point(t) @ self.axis)
        return reach


def in_wheel(derivatives: Array, shaft_angle: npt.ArrayLike) -> npt.NDArray[np.complex128]:
    """ζ = P·w + i P_y of pins and their derivatives (n, ..., 3), shape (n, ...)."""
    D = np.asarray(shaft_angle)
    along = np.sin(D) * derivatives[..., 2] - np.cos(D) * derivatives[..., 0]
    return np.asarray(along + 1j * derivatives[..., 1])


def motion(indexer: Indexer, t: npt.ArrayLike) -> WheelMotion:
    """Exact motion of the wheel at the drive angles t (...), rad from the middle of the index."""
    zeta = in_wheel(indexer.path.derivatives(t, 3), indexer.shaft_angle)
    a, b, c = zeta[1:] / zeta[0]
    return WheelMotion(np.angle(zeta[0]), a.imag, (b - a**2).imag, (c - 3.0 * a * b + 2.0 * a**3).imag)


def shock(indexer: Indexer) -> float:
    """ω (per unit drive speed) at which the index starts: a hard shock unless it is zero to rounding."""
    return float(motion(indexer, -indexer.half_turn).velocity) * indexer.sense
