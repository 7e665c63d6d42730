"""The boundary of a gear body: one tooth exact to its rounded edges, the others cut off where their involutes end.

Elastic bodies need one fine tooth; by symmetry it stands for all. The parameter is that of `GearCurve`: space n is
centred at t = n, tooth n at t = n + ½; tooth 0 is the fine one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from trochoid.geometry.gear_tooth import Tooth
from trochoid.kinematics.involute_curve import GearCurve
from trochoid.kinematics.types import Array, ComplexArray

ROUND, LAND = 0.42, 0.46  # where rounding and land begin, in half a pitch; a full rounding has no land


@dataclass(frozen=True)
class GearBoundary:
    """Boundary of a gear, counter-clockwise; a ring's is that of a hole."""

    tooth: Tooth

    @cached_property
    def plain(self) -> GearCurve:
        """All teeth cut off where their involutes end."""
        return GearCurve(self.tooth.cut, self.tooth.end_radius)

    @property
    def period(self) -> float:
        """Number of teeth."""
        return self.plain.period

    @property
    def corners(self) -> Array:
        """Joints of the pieces; at the tips of the plain teeth the tangent jumps."""
        fine = [] if self.tooth.full else [LAND, 1.0 - LAND]
        return np.sort(np.concatenate((self.plain.corners, fine)))

    def _tip(self, t: Array) -> tuple[ComplexArray, ComplexArray, Array, Array]:
        """Point, normal, speed, curvature on the fine tip, t in 0.42 … 0.58."""
        u = np.minimum(t, 1.0 - t)
        point, normal, speed, bend = self._half_tip(u)
        mirrored, turn = t > 0.5, np.exp(1j * self.tooth.pitch)
        return (
            np.where(mirrored, turn * point.conj(), point),
            np.where(mirrored, turn * normal.conj(), normal),
            speed,
            bend,
        )

    def _half_tip(self, u: Array) -> tuple[ComplexArray, ComplexArray, Array, Array]:
        tooth, gear = self.tooth, self.tooth.gear
        side, base, r = gear.side, gear.base_radius, tooth.rounding
        center = tooth.center
        last = 0.5 if tooth.full else LAND
        first = float(gear.base_angle) + side * tooth.end / base - 0.5 * math.pi
        top = float(np.angle(center)) - (0.0 if side > 0 else math.pi)
        share = np.clip((u - ROUND) / (last - ROUND), 0.0, 1.0)
        normal = np.exp(1j * (first + (top - first) * share))
        point = center + r * normal
        speed = np.full(u.shape, r * abs(top - first) / (last - ROUND))
        bend = np.full(u.shape, 1.0 / r)
        if not tooth.full:
            land = u > LAND
            start = float(np.angle(center))
            away = np.exp(1j * (start + (0.5 * tooth.pitch - start) * (u - LAND) / (0.5 - LAND)))
            point = np.where(land, tooth.tip_radius * away, point)
            normal = np.where(land, side * away, normal)
            length = tooth.tip_radius * (0.5 * tooth.pitch - start) / (0.5 - LAND)
            speed, bend = np.where(land, length, speed), np.where(land, side / tooth.tip_radius, bend)
        return point, normal, speed, bend

    def _fine(self, t: npt.ArrayLike) -> tuple[Array, npt.NDArray[np.bool_]]:
        """Parameters within the first period, and which of them are on the fine tip."""
        t = np.mod(np.asarray(t, dtype=np.float64), self.period)
        return t, (t > ROUND) & (t < 1.0 - ROUND)

    def point(self, t: npt.ArrayLike) -> Array:
        """Position, m, shape (..., 2)."""
        within, fine = self._fine(t)
        return np.where(fine[..., None], _plane(self._tip(within)[0]), self.plain.point(t))

    def normal(self, t: npt.ArrayLike) -> Array:
        """Unit normal out of the material."""
        within, fine = self._fine(t)
        return np.where(fine[..., None], _plane(self._tip(within)[1]), self.plain.normal(t))

    def tangent(self, t: npt.ArrayLike) -> Array:
        """Unit tangent, counter-clockwise."""
        n = self.tooth.gear.side * self.normal(t)
        return np.stack((-n[..., 1], n[..., 0]), axis=-1)

    def speed(self, t: npt.ArrayLike) -> Array:
        """|dr/dt|, m per tooth."""
        within, fine = self._fine(t)
        return np.where(fine, self._tip(within)[2], self.plain.speed(t))

    def curvature(self, t: npt.ArrayLike) -> Array:
        """Signed curvature, 1/m, positive where the material is convex."""
        within, fine = self._fine(t)
        return np.where(fine, self._tip(within)[3], self.plain.curvature(t))

    def parameter(self, rho: npt.ArrayLike) -> Array:
        """Parameter t of the flank of space 0 at positive polar angles, at the radius of curvature `rho` (m)."""
        low, high = self.plain.knots[1], self.plain.knots[2]
        start, end = self.tooth.cut.start, self.tooth.end
        return np.asarray(low + (high - low) * (np.asarray(rho) - start) / (end - start))

    def rho(self, t: npt.ArrayLike) -> Array:
        """Radius of curvature (m) of that flank at the parameter t."""
        low, high = self.plain.knots[1], self.plain.knots[2]
        start, end = self.tooth.cut.start, self.tooth.end
        return np.asarray(start + (end - start) * (np.asarray(t) - low) / (high - low))


def _plane(z: ComplexArray) -> Array:
    return np.stack((z.real, z.imag), axis=-1)
