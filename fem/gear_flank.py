"""Flanks of involute teeth for contact: involute, tip rounding, relief, all in closed form.

Complex numbers are plane vectors. A flank of `hand` h (1: at positive polar angles from its space, −1: mirrored)
beside space n of a gear with centre c, frame angle θ, base radius r, side σ (−1: ring) has, at the radius of
curvature ρ,

    Ψ = θ + 2πn/z + h(β + σρ/r),   foot c + r e^{iΨ},   normal −ih e^{iΨ},   point = foot + σρ·normal.

Relief takes material off along the normal; its amounts are micrometres, so that its slope turns the normal by
thousandths: both are kept to first order. Arc length s = ρ²/(2r) counts from the base circle outwards, along e^{iΨ}:
towards the tip of external teeth, towards the root of a ring's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.geometry.gear_tooth import Tooth
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, ComplexArray, IntArray

LEAST = 1e-4  # of the base radius: the least radius of curvature; at the base circle itself there is none


@dataclass(frozen=True, slots=True)
class Relief:
    """Material taken off a flank from the radius of curvature `start` on, up to `amount` at `end`, all in m.

    `end` lies towards the tip or towards the root, and the relief goes on beyond it. `bent` is the share of the way
    over which it bends (1: a parabola); the rest is straight in ρ, that is in the roll angle.
    """

    start: float
    end: float
    amount: float
    bent: float = 1.0

    def __post_init__(self) -> None:
        """Refuse a relief without length or with a kink, whose contact would have no radius."""
        if self.start == self.end or not 0.0 < self.bent <= 1.0:
            raise Infeasible(
                f"relief from {1e3 * self.start:g} to {1e3 * self.end:g} mm, bent over a share of {self.bent:g}: both "
                "ends must differ, and the share must lie above 0 (0.1: nearly straight) and not above 1 (a parabola)"
            )

    def at(self, rho: Array) -> tuple[Array, Array, Array]:
        """Return amount in m, and its first and second derivative by ρ."""
        way, b = self.end - self.start, self.bent
        u = np.maximum((rho - self.start) / way, 0.0)
        bent = u < b
        scale = self.amount / (1.0 - 0.5 * b)
        value = np.where(bent, 0.5 * u * u / b, u - 0.5 * b)
        slope = np.where(bent, u / b, 1.0)
        bend = np.where(bent & (u > 0.0), 1.0 / b, 0.0)
        return scale * value, scale * slope / way, scale * bend / way**2


@dataclass(frozen=True, slots=True)
class Flank:
    """What contact needs of all flanks of a gear: lengths in m, `angle` β and `pitch` in rad.

    The involute runs from the radius of curvature `start` to `end`; there the rounding begins, with the radius
    `rounding`.
    """

    base_radius: float
    angle: float
    pitch: float
    side: float
    start: float
    end: float
    rounding: float
    reliefs: tuple[Relief, ...] = ()

    @staticmethod
    def of(tooth: Tooth, reliefs: tuple[Relief, ...] = ()) -> Flank:
        """Return the flanks of a gear with these teeth."""
        gear = tooth.gear
        return Flank(
            gear.base_radius,
            float(gear.base_angle),
            tooth.pitch,
            gear.side,
            tooth.cut.start,
            tooth.end,
            tooth.rounding,
            reliefs,
        )

    def relief(self, rho: Array) -> tuple[Array, Array, Array]:
        """Return the material taken off in m, its slope along the arc, and its bend in 1/m, at ρ."""
        total, first, second = np.zeros(rho.shape), np.zeros(rho.shape), np.zeros(rho.shape)
        for part in self.reliefs:
            value, by_rho, twice = part.at(rho)
            rate = self.base_radius / self.curved(rho)  # dρ/ds
            total, first = total + value, first + by_rho * rate
            second = second + (twice - by_rho / self.curved(rho)) * rate**2
        return total, first, second

    def curved(self, rho: Array) -> Array:
        """Return ρ, no less than what contact laws can live with."""
        return np.maximum(rho, LEAST * self.base_radius)

    def arc(self, rho: Array) -> Array:
        """Return the arc length s in m from the base circle."""
        return np.asarray(0.5 * np.maximum(rho, 0.0) ** 2 / self.base_radius)

    def beyond(self, rho: Array) -> Array:
        """Return the arc length in m by which ρ lies beyond the involute's end at the tip; negative on the flank."""
        return np.asarray(self.side * (self.arc(rho) - 0.5 * self.end**2 / self.base_radius))

    def below(self, arc: Array) -> Array:
        """Return how far arc lengths lie in the fillet, below the involute's start, in m; 0 on the flank."""
        return np.maximum(self.side * (0.5 * self.start**2 / self.base_radius - arc), 0.0)


@dataclass(frozen=True, slots=True)
class Posed:
    """Flanks in place: centre c (n, 1), and `phase` θ + 2πn/z (n, c) in rad of each contact's flank, `hand` ±1."""

    flank: Flank
    center: ComplexArray
    phase: Array
    hand: int

    @staticmethod
    def at(flank: Flank, pose: tuple[Array, Array], number: IntArray, hand: int) -> Posed:
        """Return the flanks beside the spaces `number` (n, c) of a member at centre (n, 2) and angle (n,)."""
        center, angle = pose
        return Posed(
            flank,
            (center[..., 0] + 1j * center[..., 1])[..., None],
            np.remainder(angle[..., None] + flank.pitch * number + math.pi, 2.0 * math.pi) - math.pi,
            hand,
        )

    def wide(self) -> Posed:
        """Return the same for several points of each contact, (n, c, 1)."""
        return Posed(self.flank, self.center[..., None], self.phase[..., None], self.hand)

    def rho(self, direction: Array) -> Array:
        """Return the radius of curvature in m of the flank whose foot lies in a direction Ψ (rad)."""
        f = self.flank
        turn = self.hand * (direction - self.phase) - f.angle
        return f.side * f.base_radius * (np.mod(turn + math.pi, 2.0 * math.pi) - math.pi)

    def direction(self, rho: Array) -> Array:
        """Return Ψ in rad at the radius of curvature ρ."""
        f = self.flank
        return np.asarray(self.phase + self.hand * (f.angle + f.side * rho / f.base_radius))

    def point(self, rho: Array) -> tuple[ComplexArray, ComplexArray]:
        """Return point in m and normal out of the material, with relief."""
        f = self.flank
        foot = np.exp(1j * self.direction(rho))
        normal = -1j * self.hand * foot
        point = self.center + f.base_radius * foot + f.side * rho * normal
        if not f.reliefs:
            return point, normal
        off, slope, _ = f.relief(rho)
        return point - off * normal, _unit(normal + slope * foot)

    def edge(self) -> ComplexArray:
        """Return the centre of the tip rounding."""
        f = self.flank
        point, normal = self.point(np.full(self.phase.shape, f.end))
        return point - f.rounding * normal

    def seen(self, point: ComplexArray) -> tuple[Array, Array, ComplexArray]:
        """Return how far points lie outside the flank in m, the ρ of their foot there, and the normal at it.

        Every normal of an involute touches its base circle, so the foot follows from a tangent.
        """
        f = self.flank
        reach = point - self.center
        tangent = np.sqrt(np.maximum(np.abs(reach) ** 2 - f.base_radius**2, 0.0))
        direction = np.angle(reach) + self.hand * f.side * np.arctan2(tangent, f.base_radius)
        rho = self.rho(direction)
        foot = np.exp(1j * direction)
        normal = -1j * self.hand * foot
        distance = f.side * (tangent - rho)
        if not f.reliefs:
            return distance, rho, normal
        off, slope, _ = f.relief(rho)
        return distance + off, rho, _unit(normal + slope * foot)


def _unit(vector: ComplexArray) -> ComplexArray:
    return np.asarray(vector / np.abs(vector))
