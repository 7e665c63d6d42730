"""Sphere tooth: the equidistant of a spherical trochoid that pins of a nutating pair generate, exactly.

In the frame of the crank arm, with a = (sin ϑ, 0, cos ϑ) the satellite's axis, ν = z1/z2 and t the crank
angle, a pin of angular radius r has its axis at u and turns relative to the flank with W (sources §5):

    pins on the ring       u = R_z(−t)(sin α, 0, cos α),          W = −e_z + ν a,   carried by R_z(νt) R_y(−ϑ)
    pins on the satellite  u = R_y(ϑ) R_z(−νt)(sin α, 0, cos α),  W = e_z − ν a,    carried by R_z(t)

and the flank is f = cos r·u + σ sin r·N with N = (W − (W·u)u)/|W×u|, on the side σ = ±1 of the pins.  With
w = W·u both geodesic curvatures of the pin path are κ = (−w³ + B w + C|W|²)/|W×u|³, for which the extremes
are roots of a quadratic.  The solid flank is the cone of rays through the centre over this curve.

The parameter p is the azimuth of the flank's body, as with the plane cycloid: t = D z2 p, D = z_pins − z_lobes.
At p = 0 the pin path is nearest to the pole for pins on the ring, and farthest for pins on the satellite.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.nutation import Nutation
from trochoid.kinematics.relative_motion import MeetingAxes
from trochoid.kinematics.spherical import rotation, turn
from trochoid.kinematics.types import Array

Carrier = Literal["ring", "satellite"]


@dataclass(frozen=True, slots=True)
class SphereTooth:
    """Flank with `lobes` teeth for `pins` on a cone; angles in rad; a SphericalCurve round the whole member.

    The pins' axes stand `polar_angle` (α) off the axis of the member `pins_on`, their cones have the half angle
    `pin_angle` (r); `nutation` is ϑ, `side` σ.  σ·(pins − lobes) = 1 has its material about its own pole, as a
    disc inside the pins; −1 has it outside.
    """

    pins: int
    lobes: int
    polar_angle: float
    pin_angle: float
    nutation: float
    side: int = 1
    pins_on: Carrier = "ring"

    def __post_init__(self) -> None:
        """Refuse tooth differences and sides that the equations do not hold for."""
        if abs(self.pins - self.lobes) != 1:
            raise Infeasible(
                f"{self.lobes} lobes for {self.pins} pins: this flank has one lobe more or less than pins; "
                f"take lobes = {self.pins - 1} or {self.pins + 1}"
            )
        if self.side not in (1, -1) or self.pins_on not in ("ring", "satellite"):
            raise Infeasible(
                f"side = {self.side}, pins_on = {self.pins_on!r}: side is 1 or −1, pins are on the ring or the "
                f"satellite"
            )

    @property
    def period(self) -> float:
        """2π; one lobe takes 2π/lobes."""
        return 2.0 * math.pi

    @property
    def difference(self) -> int:
        """D = pins − lobes, +1 or −1: the direction in which the contact runs round with the crank."""
        return self.pins - self.lobes

    @property
    def hole(self) -> bool:
        """Whether the material lies outside the closed flank."""
        return self.side * self.difference < 0

    @property
    def fixed_teeth(self) -> int:
        """z1, of the ring."""
        return self.pins if self.pins_on == "ring" else self.lobes

    @property
    def satellite_teeth(self) -> int:
        """z2, of the satellite."""
        return self.lobes if self.pins_on == "ring" else self.pins

    @property
    def pair(self) -> Nutation:
        """The nutating pair that this flank belongs to."""
        return Nutation(self.fixed_teeth, self.satellite_teeth, self.nutation)

    @property
    def relative_motion(self) -> MeetingAxes:
        """The pins' member as the flank's sees it, over the crank angle, for `envelope`."""
        nu = self._nu
        if self.pins_on == "ring":
            return MeetingAxes(-self.nutation, nu, -1.0)
        return MeetingAxes(self.nutation, 1.0, -nu)

    @property
    def _nu(self) -> float:
        return self.fixed_teeth / self.satellite_teeth

    def crank_angle(self, p: npt.ArrayLike) -> Array:
        """Crank angle t = D z2 p (rad) at which pin 0 touches at the flank parameter p."""
        angle: Array = self.difference * self.satellite_teeth * np.asarray(p, dtype=np.float64)
        return angle

    def contact_parameter(self, pin: npt.ArrayLike, crank_angle: npt.ArrayLike) -> Array:
        """Flank parameter that touches `pin` at the crank angle (rad)."""
        angle = self.difference * np.asarray(crank_angle, dtype=np.float64) / self.satellite_teeth
        parameter: Array = angle + 2.0 * math.pi * np.asarray(pin) / self.pins
        return parameter

    def _rotation_velocity(self) -> Array:
        """W (3,) of the pins relative to the flank, per unit of crank speed, in the frame of the arm."""
        relative = self.pair.relative_velocity
        return -relative if self.pins_on == "ring" else relative

    def _pin(self, t: Array) -> Array:
        """Axis u (..., 3) of pin 0 in the frame of the arm."""
        on_ring = self.pins_on == "ring"
        turned = t if on_ring else self._nu * t
        sine, level = math.sin(self.polar_angle), np.full(np.shape(t), math.cos(self.polar_angle))
        u = np.stack([sine * np.cos(turned), -sine * np.sin(turned), level], axis=-1)
        return u if on_ring else np.asarray(u @ rotation(1, self.nutation).T)

    def _carried(self, t: Array, vectors: Array) -> Array:
        """Vectors (..., 3) from the frame of the arm to that of the flank's body."""
        if self.pins_on == "ring":
            t, vectors = self._nu * t, vectors @ rotation(1, self.nutation)
        c, s = np.cos(t), np.sin(t)
        x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
        return np.stack([c * x - s * y, s * x + c * y, np.broadcast_to(z, np.shape(c * x))], axis=-1)

    def _across(self, u: Array) -> tuple[Array, Array]:
        """W×u (..., 3) and its length."""
        x, y, z = self._rotation_velocity()
        across = u @ np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
        return across, np.sqrt(np.sum(across * across, axis=-1))

    def _trihedron(self, p: npt.ArrayLike) -> tuple[Array, Array, Array, Array]:
        """Pin axis u, N and the path's tangent for growing t, (..., 3) in the flank's frame, and |W×u|."""
        t = self.crank_angle(p)
        u, W = self._pin(t), self._rotation_velocity()
        across, size = self._across(u)
        normal = (W - (u @ W)[..., None] * u) / size[..., None]
        tangent = across / size[..., None]
        u, normal, tangent = self._carried(t, np.stack([u, normal, tangent]))
        return u, normal, tangent, size

    def path_frame(self, p: npt.ArrayLike) -> tuple[Array, Array, Array]:
        """Pin axis, N and the path's unit tangent for growing p, (..., 3) in the flank's frame."""
        u, N, tangent, _ = self._trihedron(p)
        return u, N, self.difference * tangent

    def center_path(self, p: npt.ArrayLike) -> Array:
        """Axis of the pin in the frame of the flank, unit vectors (..., 3)."""
        t = self.crank_angle(p)
        return self._carried(t, self._pin(t))

    def carrier_axis(self, crank_angle: npt.ArrayLike) -> Array:
        """Axis of the member with the pins in the frame of the flank, unit vectors (..., 3), at crank angles (...)."""
        t = np.asarray(crank_angle, dtype=np.float64)
        axis = np.array([0.0, 0.0, 1.0])
        if self.pins_on == "satellite":
            axis = turn(rotation(1, self.nutation), axis)
        return self._carried(t, axis)

    def path_speed(self, p: npt.ArrayLike) -> Array:
        """|du/dp| = z2 |W×u| of the pin's axis along its path, rad."""
        speed: Array = self.satellite_teeth * self._across(self._pin(self.crank_angle(p)))[1]
        return speed

    def center_path_curvature(self, p: npt.ArrayLike) -> Array:
        """Geodesic curvature κ of the pin path, positive towards N, sources §5."""
        u, W = self._pin(self.crank_angle(p)), self._rotation_velocity()
        bend: Array = path_curvature(u @ W, *self._coefficients()) / self._across(u)[1] ** 3
        return bend

    def _coefficients(self) -> tuple[float, float, float]:
        """B, C and |W|² of κ: the sources' two forms with a·u or e_z·u, whichever varies, written in w."""
        W = self._rotation_velocity()
        square = float(W @ W)
        if self.pins_on == "ring":
            return square - float(W[2]), math.cos(self.polar_angle), square
        along = self._nu * float(W @ self.pair.axis)
        return square - along, self._nu * math.cos(self.polar_angle), square

    def _reach(self) -> tuple[float, float]:
        """Range of w = W·u along the path; its ends are valley and crest."""
        W = self._rotation_velocity()
        half = math.pi if self.pins_on == "ring" else math.pi / self._nu
        ends = [float(self._pin(np.asarray(t)) @ W) for t in (0.0, half)]
        return min(ends), max(ends)

    @property
    def steepest_curvature(self) -> float:
        """Largest σκ of the pin path, from the quadratic w²(2B − 3|W|²) + 3C|W|² w + B|W|² = 0 and both ends."""
        B, C, square = self._coefficients()
        low, high = self._reach()
        roots = np.roots([2.0 * B - 3.0 * square, 3.0 * C * square, B * square])
        inside = [float(x.real) for x in roots if abs(x.imag) < 1e-9 * abs(x) and low < x.real < high]
        w = np.array([low, high, *inside])
        return float(np.max(self.side * path_curvature(w, B, C, square) / (square - w**2) ** 1.5))

    @property
    def undercut_angle(self) -> float:
        """Pin angle (rad, below π) at which the flank begins to be undercut: cot r = max σκ; local."""
        return math.atan2(1.0, self.steepest_curvature)

    def point(self, p: npt.ArrayLike) -> Array:
        """Point of the flank, unit vectors (..., 3)."""
        u, N, _, _ = self._trihedron(p)
        flank: Array = math.cos(self.pin_angle) * u + self.side * math.sin(self.pin_angle) * N
        return flank

    def normal(self, p: npt.ArrayLike) -> Array:
        """Unit normal from the flank into the pin, in the tangent plane of the sphere."""
        u, N, _, _ = self._trihedron(p)
        normal: Array = math.sin(self.pin_angle) * u - self.side * math.cos(self.pin_angle) * N
        return normal

    def tangent(self, p: npt.ArrayLike) -> Array:
        """Unit tangent in the direction of growing p, counter-clockwise about the pole."""
        return self.difference * self._trihedron(p)[2]

    def speed(self, p: npt.ArrayLike) -> Array:
        """|df/dp| = z2 |W×u| (cos r − σκ sin r), rad; negative where the flank is undercut."""
        shrink = math.cos(self.pin_angle) - self.side * self.center_path_curvature(p) * math.sin(
            self.pin_angle
        )
        speed: Array = self.path_speed(p) * shrink
        return speed

    def curvature(self, p: npt.ArrayLike) -> Array:
        """Geodesic curvature (σκ cos r + sin r)/(cos r − σκ sin r) of the flank, positive where it is convex."""
        c, s = math.cos(self.pin_angle), math.sin(self.pin_angle)
        bend = self.side * self.center_path_curvature(p)
        curvature: Array = (bend * c + s) / (c - bend * s)
        return curvature

    def lever(self, p: npt.ArrayLike) -> Array:
        """Moment arm (f × n)·e_z of the outward normal about the axis of the flank's body, per unit radius.

        A pin force F ≥ 0, which acts along −n at the distance ρ from the centre, turns the body with −F ρ·lever.
        """
        arm: Array = self.side * self._trihedron(p)[2][..., 2]
        return arm


def path_curvature(w: npt.ArrayLike, B: float, C: float, square: float) -> Array:
    """κ |W×u|³ = −w³ + B w + C |W|² of a pin path, w = W·u."""
    w = np.asarray(w, dtype=np.float64)
    top: Array = -(w**3) + B * w + C * square
    return top
