"""Cycloid disc: the equidistant of an epitrochoid that pins on a circle generate, exactly.

Complex numbers stand for plane vectors.  With θ = z_c t (the crank angle from the pin that touches at t),
K = e z_p/R and S = |1 − K exp(iθ)|, the pin centre runs in the disc frame along

    P(t) = R exp(it) − e exp(i z_p t),   P'(t) = i R exp(it) (1 − K exp(iθ)),

with the normal N(t) = exp(it) (1 − K exp(iθ))/S, and the flank is P − r N (sources §3).  t = 0 is the bottom
of a valley, on the disc's x axis; t = π/z_c is a crest.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.curve import foot_point
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, ComplexArray


@dataclass(frozen=True, slots=True)
class Modification:
    """Deviation of the ground flank: equidistant Δr and radial ΔR in m, rotation δ in rad.

    Δr enlarges the grinding pin, ΔR its circle; δ turns the two flanks of a tooth towards each other.
    """

    equidistant: float = 0.0
    radial: float = 0.0
    rotation: float = 0.0


@dataclass(frozen=True, slots=True)
class Cycloid:
    """Flank of a disc with pins − 1 lobes in its own frame, lengths in m; a Curve round the whole disc."""

    pins: int
    lobes: int
    pin_circle_radius: float
    pin_radius: float
    eccentricity: float

    def __post_init__(self) -> None:
        """Refuse tooth differences that the equations do not hold for."""
        if self.lobes != self.pins - 1:
            raise Infeasible(
                f"{self.lobes} lobes on {self.pins} pins: this profile has one lobe less than pins; "
                f"take lobes = {self.pins - 1} or pins = {self.lobes + 1}"
            )

    @property
    def period(self) -> float:
        """2π; one lobe takes 2π/lobes."""
        return 2.0 * math.pi

    @property
    def ratio(self) -> int:
        """Number of crank turns per (opposite) turn of the disc when the ring is fixed."""
        return self.lobes

    @property
    def trochoid_ratio(self) -> float:
        """K = e z_p/R, the pitch radius of the pins over their circle; below 1."""
        return self.eccentricity * self.pins / self.pin_circle_radius

    @property
    def undercut_radius(self) -> float:
        """Pin radius (m) at which the flank begins to be undercut, sources §3."""
        K, z = self.trochoid_ratio, self.pins
        if (2 * z - 1) * K >= z - 2:
            return self.pin_circle_radius * math.sqrt(27.0 * (z - 1) * max(0.0, 1.0 - K * K) / (z + 1) ** 3)
        return self.pin_circle_radius * (1.0 + K) ** 2 / (1.0 + z * K)

    def _arm(self, t: npt.ArrayLike) -> tuple[ComplexArray, Array, Array]:
        """Return 1 − K exp(iθ), its modulus S and sin²(θ/2), without cancellation near θ = 0."""
        theta = self.lobes * np.asarray(t, dtype=np.float64)
        K = self.trochoid_ratio
        half = np.sin(0.5 * theta) ** 2
        arm = (1.0 - K) + 2.0 * K * half - 1j * K * np.sin(theta)
        return arm, np.sqrt((1.0 - K) ** 2 + 4.0 * K * half), half

    def _normal(self, t: npt.ArrayLike) -> ComplexArray:
        arm, S, _ = self._arm(t)
        normal: ComplexArray = _unit(t) * arm / S
        return normal

    def center_path(self, t: npt.ArrayLike) -> Array:
        """Pin centre in the disc frame, m, shape (..., 2)."""
        return _plane(self._center(t))

    def _center(self, t: npt.ArrayLike) -> ComplexArray:
        t = np.asarray(t, dtype=np.float64)
        return self.pin_circle_radius * _unit(t) - self.eccentricity * _unit(self.pins * t)

    def center_path_curvature(self, t: npt.ArrayLike) -> Array:
        """κ0 = (1 + z_p K² − (z_p+1) K cos θ)/(R S³), 1/m, sources §3."""
        _, S, half = self._arm(t)
        K, z = self.trochoid_ratio, self.pins
        top = (1.0 - K) * (1.0 - z * K) + 2.0 * (z + 1) * K * half
        curvature: Array = top / (self.pin_circle_radius * S**3)
        return curvature

    def point(self, t: npt.ArrayLike) -> Array:
        """Point of the flank, m."""
        return _plane(self._center(t) - self.pin_radius * self._normal(t))

    def normal(self, t: npt.ArrayLike) -> Array:
        """Unit normal from the disc into the pin."""
        return _plane(self._normal(t))

    def tangent(self, t: npt.ArrayLike) -> Array:
        """Unit tangent, counter-clockwise."""
        return _plane(1j * self._normal(t))

    def speed(self, t: npt.ArrayLike) -> Array:
        """|dr/dt| = R S (1 − r κ0), m; negative where the flank is undercut."""
        _, S, _ = self._arm(t)
        speed: Array = self.pin_circle_radius * S * (1.0 - self.pin_radius * self.center_path_curvature(t))
        return speed

    def curvature(self, t: npt.ArrayLike) -> Array:
        """κ0/(1 − r κ0), 1/m, positive on the convex crest."""
        bend = self.center_path_curvature(t)
        curvature: Array = bend / (1.0 - self.pin_radius * bend)
        return curvature

    def lever(self, t: npt.ArrayLike) -> Array:
        """Arm r × n = −e z_c sin θ/S (m) of the outward normal about the disc centre.

        A pin force F ≥ 0, which acts along −n, turns the disc with the torque −F·lever.
        """
        arm, S, _ = self._arm(t)
        lever: Array = arm.imag * (self.eccentricity * self.lobes / self.trochoid_ratio) / S
        return lever

    def pressure_angle(self, t: npt.ArrayLike) -> Array:
        """Angle (rad, 0…π/2) between the flank normal and the tangent of the pin circle at the pin centre.

        atan((1 − K cos θ)/(K |sin θ|)); its least value is acos K, at cos θ = K.
        """
        arm, _, _ = self._arm(t)
        angle: Array = np.arctan2(arm.real, np.abs(arm.imag))
        return angle

    def contact_parameter(self, pin: npt.ArrayLike, crank_angle: npt.ArrayLike) -> Array:
        """Flank parameter that touches `pin` at the crank angle (rad, from pin 0 in the ring's frame).

        Holds for the disc rotation ψ = −φ/z_c; the disc centre is at e(cos φ, sin φ).
        """
        angle = np.asarray(crank_angle, dtype=np.float64)
        parameter: Array = angle / self.lobes + 2.0 * math.pi * np.asarray(pin) / self.pins
        return parameter

    def modified(self, modification: Modification) -> Cycloid:
        """Return the flank ground with r + Δr and R + ΔR; the rotation δ is no part of it (see `gap`)."""
        return replace(
            self,
            pin_radius=self.pin_radius + modification.equidistant,
            pin_circle_radius=self.pin_circle_radius + modification.radial,
        )


def _unit(angle: npt.ArrayLike) -> ComplexArray:
    return np.asarray(np.exp(1j * np.asarray(angle, dtype=np.float64)), dtype=np.complex128)


def _plane(z: ComplexArray) -> Array:
    return np.stack((z.real, z.imag), axis=-1)


def gap(
    cycloid: Cycloid, modification: Modification, pin_centers: npt.ArrayLike, t0: npt.ArrayLike
) -> tuple[Array, Array]:
    """Exact gap (m) between pins at `pin_centers` (..., 2) in the disc frame and the modified flank.

    Returns gaps and flank parameters, both (...).  `t0` (...) starts the search.  With a rotation δ a tooth
    is what both turned flanks leave, so the larger of the two distances counts.  Raises NotConverged.
    """
    ground = cycloid.modified(modification)
    centers = np.asarray(pin_centers, dtype=np.float64)
    if modification.rotation == 0.0:
        t, distance = _from_flank(ground, centers, t0)
        return distance - cycloid.pin_radius, t
    turn = modification.rotation
    t_a, one = _from_flank(ground, _turned(centers, turn), t0)
    t_b, other = _from_flank(ground, _turned(centers, -turn), t0)
    first = one >= other if turn > 0.0 else one <= other
    return np.where(first, one, other) - cycloid.pin_radius, np.where(first, t_a, t_b)


def _from_flank(ground: Cycloid, centers: Array, t0: npt.ArrayLike) -> tuple[Array, Array]:
    """Foot parameters and signed distances (m) of pin centres from a flank.

    Pin centres lie close to the path that generates the flank, and have the same foot on both: Newton on the
    path needs two exponentials a step. What is farther away than its curvature goes to the general search.
    """
    z = centers[..., 0] + 1j * centers[..., 1]
    start = np.array(np.broadcast_to(np.asarray(t0, dtype=np.float64), z.shape))
    t, near = start, np.ones(z.shape, dtype=bool)
    R, e, pins = ground.pin_circle_radius, ground.eccentricity, ground.pins
    settled = False
    for _ in range(12):
        a, b = R * np.exp(1j * t), e * np.exp(1j * pins * t)
        offset, slope = z - (a - b), 1j * (a - pins * b)
        bend = np.abs(slope) ** 2 + (offset * (a - pins**2 * b).conj()).real
        near &= bend > 0.5 * np.abs(slope) ** 2
        step = np.where(near, (offset * slope.conj()).real / np.where(near, bend, 1.0), 0.0)
        t = t + step
        settled = bool(np.abs(step).max(initial=0.0) < 1e-10)  # what is left is its square
        if settled:
            break
    near &= settled
    foot = z - (R * np.exp(1j * t) - e * np.exp(1j * pins * t))
    distance = (foot * ground._normal(t).conj()).real + ground.pin_radius
    if not near.all():
        t[~near], distance[~near] = foot_point(ground, centers[~near], start[~near])
    return t, distance


def gap_first_order(cycloid: Cycloid, modification: Modification, t: npt.ArrayLike) -> Array:
    """Gap Δr − ΔR(1 − K cos θ)/S + |lever| δ (m) at the flank parameters t, sources §3."""
    arm, S, _ = cycloid._arm(t)
    ground: Array = modification.equidistant - modification.radial * arm.real / S
    turned: Array = np.abs(cycloid.lever(t)) * modification.rotation
    return ground + turned


def _turned(points: Array, angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    turned: Array = points @ np.array([[c, s], [-s, c]])
    return turned
