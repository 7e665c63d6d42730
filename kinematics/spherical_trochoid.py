"""Spherical epi- and hypotrochoid: the path of a pin on a bevel planet, with all its derivatives.

The arm turns by φ about the z axis and carries the planet's axis at the angle γ; on the arm the planet turns by
θ = θ0 + m φ, m = s i (sources §5).  The pin's axis is at the angle β off the planet's:

    P(φ) = R_z(φ) R_y(γ) R_z(θ) (sin β, 0, cos β),

    P_x + i P_y = exp(iφ) (sin γ cos β + sin β (cos²(γ/2) exp(iθ) − sin²(γ/2) exp(−iθ))),
    P_z         = cos γ cos β − sin γ sin β cos θ,

so each derivative is a sum of five harmonics.  With β = 0 the pin runs on a circle: a crank.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array

Kind = Literal["epi", "hypo"]
CUSP = 1e-9  # speed (rad per rad) below which the pin is taken to stand


def pin_derivatives(
    arm: npt.ArrayLike,
    pin: npt.ArrayLike,
    ratio: npt.ArrayLike,
    phase: npt.ArrayLike,
    angle: npt.ArrayLike,
    order: int,
) -> Array:
    """Pin and its derivatives over φ up to `order`, shape (order + 1, ..., 3); γ, β, m, θ0 and φ broadcast."""
    g, b, m, phi = (np.asarray(x, dtype=np.float64) for x in (arm, pin, ratio, angle))
    theta = np.asarray(phase) + m * phi
    turn, spin = np.exp(1j * phi), np.exp(1j * theta)
    crank = np.sin(g) * np.cos(b) * turn
    with_spin = np.sin(b) * np.cos(0.5 * g) ** 2 * (turn * spin)
    against = -np.sin(b) * np.sin(0.5 * g) ** 2 * (turn * spin.conj())
    height = -np.sin(g) * np.sin(b) * spin
    found = np.empty((order + 1, *np.broadcast_shapes(crank.shape, height.shape), 3))
    for n in range(order + 1):
        plane = (1j**n) * (crank + (1.0 + m) ** n * with_spin + (1.0 - m) ** n * against)
        found[n, ..., 0], found[n, ..., 1] = plane.real, plane.imag
        found[n, ..., 2] = ((1j * m) ** n * height).real
    found[0, ..., 2] += np.cos(g) * np.cos(b)
    return found


@dataclass(frozen=True, slots=True)
class SphericalTrochoid:
    """Pin path on the unit sphere, a SphericalCurve over the arm's angle φ; angles in rad.

    `arm` is γ in (−π, π), negative where the arm points to −x at φ = 0; `pin` is β in [0, π/2), `ratio` m = s·i,
    positive for an epitrochoid, and `phase` θ0, 0 or π.  Raises Infeasible.
    """

    arm: float
    pin: float
    ratio: float
    phase: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no planet on an arm."""
        if not 0.0 < abs(self.arm) < math.pi:
            raise Infeasible(
                f"arm angle {math.degrees(self.arm):g}°: the planet's axis must not lie along the drive's; "
                "take more than 0° and less than 180°"
            )
        if not 0.0 <= self.pin < 0.5 * math.pi:
            raise Infeasible(
                f"pin angle {math.degrees(self.pin):g}° off the planet's axis; take 0° to below 90° "
                "(beyond it, measure from the other end of the axis)"
            )
        if not abs(self.ratio) > 1.0:
            raise Infeasible(
                f"planet ratio {abs(self.ratio):g}: the central wheel must be the larger; take more than 1"
            )

    @property
    def kind(self) -> Kind:
        """Whether planet and arm turn alike (epi) or against each other (hypo)."""
        return "epi" if self.ratio > 0.0 else "hypo"

    @property
    def period(self) -> float:
        """Arm angle after which the pin is back: 2π where i is whole."""
        return 2.0 * math.pi * Fraction(self.ratio).limit_denominator(1000).denominator

    @property
    def planet_cone(self) -> float:
        """Half angle δ_s of the planet's pitch cone, tan δ_s = sin γ/(i + s cos γ)."""
        s = math.copysign(1.0, self.ratio)
        return math.atan2(math.sin(abs(self.arm)), abs(self.ratio) + s * math.cos(self.arm))

    @property
    def central_cone(self) -> float:
        """Half angle δ_c = γ − s δ_s of the central wheel's pitch cone; beyond π/2 its teeth look inwards."""
        return abs(self.arm) - math.copysign(1.0, self.ratio) * self.planet_cone

    @property
    def pin_ratio(self) -> float:
        """ρ = tan β/tan δ_s; at 1 the pin is on the pitch cone and its path has cusps."""
        return math.tan(self.pin) / math.tan(self.planet_cone)

    def derivatives(self, t: npt.ArrayLike, order: int) -> Array:
        """Pin and its derivatives over φ up to `order`, shape (order + 1, ..., 3)."""
        return pin_derivatives(self.arm, self.pin, self.ratio, self.phase, t, order)

    def point(self, t: npt.ArrayLike) -> Array:
        """Unit vector to the pin."""
        point: Array = self.derivatives(t, 0)[0]
        return point

    def speed(self, t: npt.ArrayLike) -> Array:
        """|dP/dφ|, rad; zero in a cusp."""
        speed: Array = np.linalg.norm(self.derivatives(t, 1)[1], axis=-1)
        return speed

    def tangent(self, t: npt.ArrayLike) -> Array:
        """Unit tangent in the direction of growing φ; in a cusp the one with which the pin leaves it."""
        _, first, second = self.derivatives(t, 2)
        stands = np.linalg.norm(first, axis=-1, keepdims=True) < CUSP
        along = np.where(stands, second, first)
        tangent: Array = along / np.linalg.norm(along, axis=-1, keepdims=True)
        return tangent

    def normal(self, t: npt.ArrayLike) -> Array:
        """Unit normal to the right of the path."""
        return np.cross(self.tangent(t), self.point(t))

    def curvature(self, t: npt.ArrayLike) -> Array:
        """Geodesic curvature det(P, P', P'')/|P'|³, 1/rad, positive to the left; not finite in a cusp."""
        with np.errstate(divide="ignore", invalid="ignore"):
            curvature: Array = bending(self.derivatives(t, 2)) / self.speed(t) ** 3
        return curvature


def bending(derivatives: Array) -> Array:
    """det(P, P', P'') of pins and two derivatives (3, ..., 3): its zeros are the inflections of the path."""
    point, first, second = derivatives
    bent: Array = np.sum(point * np.cross(first, second), axis=-1)
    return bent
