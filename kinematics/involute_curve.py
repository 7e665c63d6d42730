"""A whole gear as one exact Curve: root circle, fillet, involute and tip circle, mirrored and repeated.

The parameter counts teeth: a period is z, space n is centred at t = n and tooth n at t = n + ½.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute_cut import Cut
from trochoid.kinematics.types import Array, ComplexArray

Piece = tuple[ComplexArray, ComplexArray, Array, Array]  # point, outward normal, speed, curvature


@dataclass(frozen=True, slots=True)
class GearCurve:
    """Boundary of a gear cut to a tip circle (m), counter-clockwise; a ring's is that of a hole."""

    cut: Cut
    tip_radius: float
    knots: tuple[float, float, float] = (0.1, 0.22, 0.42)  # half a pitch: root, fillet, involute, tip

    def __post_init__(self) -> None:
        """Refuse a tip circle that does not cross the involute, and pointed teeth."""
        gear, tip = self.cut.gear, self.tip_radius
        low, high = gear.base_radius, math.hypot(gear.base_radius, self.cut.start)
        if gear.internal and not low < tip < high:
            raise Infeasible(f"ring tip radius {_mm(tip)}: it must lie between {_mm(low)} and {_mm(high)}")
        if not gear.internal and tip <= high:
            raise Infeasible(f"tip radius {_mm(tip)}: it must be above the end of the fillet, {_mm(high)}")
        if gear.thickness_at(tip) < 0.0:
            word = "larger" if gear.internal else "smaller"
            given = f"tip radius {_mm(tip)}: the teeth end in a point at {_mm(float(gear.point_radius))}"
            raise Infeasible(f"{given}; take a {word} tip circle")

    @property
    def period(self) -> float:
        """Number of teeth."""
        return float(self.cut.gear.teeth)

    @property
    def corners(self) -> Array:
        """Joints of the pieces in one period: there the curvature jumps, and at tips the tangent too."""
        half = np.array(self.knots)
        one = np.concatenate((half, 1.0 - half[::-1]))
        joints: Array = (np.arange(self.cut.gear.teeth)[:, None] + one).ravel()
        return joints

    def _evaluate(self, t: npt.ArrayLike) -> Piece:
        t = np.asarray(t, dtype=np.float64)
        tooth = np.round(t)
        within = t - tooth  # −½ … ½ about the middle of a space
        mirrored, u = within < 0.0, np.abs(within)
        at, normal, speed, bend = self._half(u)
        at, normal = (np.where(mirrored, z.conj(), z) for z in (at, normal))
        turn = np.exp(2j * math.pi * np.mod(tooth, self.period) / self.period)
        return turn * at, turn * normal, speed, bend

    def _half(self, u: Array) -> Piece:
        piece = np.searchsorted(self.knots, u, side="right")
        out = (np.empty(u.shape, complex), np.empty(u.shape, complex), np.empty(u.shape), np.empty(u.shape))
        low, high = (0.0, *self.knots), (*self.knots, 0.5)
        for k, part in enumerate((self._root, self._fillet, self._flank, self._tip)):
            here = piece == k
            if here.any():
                width = high[k] - low[k]
                values = part((u[here] - low[k]) / width)
                for array, value in zip(out, values, strict=True):
                    array[here] = value
                out[2][here] /= width
        return out

    def _arc(self, share: Array, radius: float, first: float, last: float) -> Piece:
        away = np.exp(1j * (first + (last - first) * share))
        side, one = self.cut.gear.side, np.ones(share.shape)
        return radius * away, side * away, radius * abs(last - first) * one, side / radius * one

    def _root(self, share: Array) -> Piece:
        return self._arc(share, self.cut.root_radius, 0.0, self.cut.fillet.root)

    def _tip(self, share: Array) -> Piece:
        gear = self.cut.gear
        return self._arc(
            share, self.tip_radius, float(gear.flank_angle(self.tip_radius)), math.pi / gear.teeth
        )

    def _fillet(self, share: Array) -> Piece:
        fillet = self.cut.fillet
        roll = fillet.root + (fillet.end - fillet.root) * share
        speed = fillet.speed(roll) * abs(fillet.end - fillet.root)
        return fillet.point(roll), fillet.normal(roll), speed, fillet.curvature(roll)

    def _flank(self, share: Array) -> Piece:
        gear = self.cut.gear
        low, high = self.cut.start, float(gear.curvature_radius(self.tip_radius))
        rho = low + (high - low) * share
        side, base = gear.side, gear.base_radius
        along = np.exp(1j * (float(gear.base_angle) + side * rho / base))
        speed = rho * abs(high - low) / base
        with np.errstate(divide="ignore"):
            return along * (base - 1j * side * rho), -1j * along, speed, side / rho

    def point(self, t: npt.ArrayLike) -> Array:
        """Position, m, shape (..., 2)."""
        return _plane(self._evaluate(t)[0])

    def normal(self, t: npt.ArrayLike) -> Array:
        """Unit normal out of the material."""
        return _plane(self._evaluate(t)[1])

    def tangent(self, t: npt.ArrayLike) -> Array:
        """Unit tangent, counter-clockwise."""
        return _plane(1j * self.cut.gear.side * self._evaluate(t)[1])

    def speed(self, t: npt.ArrayLike) -> Array:
        """|dr/dt|, m per tooth."""
        return self._evaluate(t)[2]

    def curvature(self, t: npt.ArrayLike) -> Array:
        """Signed curvature, 1/m, positive where the material is convex."""
        return self._evaluate(t)[3]


def _plane(z: ComplexArray) -> Array:
    return np.stack((z.real, z.imag), axis=-1)


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"
