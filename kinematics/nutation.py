"""The satellite of a precessional (K-H-V) drive: spherical motion about the centre O, exactly.

The crank turns about k = (0, 0, 1) and carries the satellite's axis n, which stands ϑ, the nutation angle,
off k.  The satellite has z2 teeth and rolls on the fixed wheel with z1, so that with q = z1/z2 it turns by
−q about n for each turn of the crank:

    R = R_z(φ) R_y(ϑ) R_z(−q φ),   ω = ω_3 (k − q n),   ε = α_3 (k − q n) − q ω_3² k × n.

Sources §2 (1)–(3), (9); the paper's (2) prints the modulus of the relative speed, (9) carries its sign.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.spherical import SphericalMotion, rotation, turn
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, slots=True)
class Nutation:
    """A fixed wheel of `fixed_teeth` (z1), a satellite of `satellite_teeth` (z2), nutation `angle` (rad)."""

    fixed_teeth: int
    satellite_teeth: int
    angle: float

    def __post_init__(self) -> None:
        """Refuse a pair that does not turn its output, and an angle at which nothing nutates."""
        faults = nutation_faults(self.fixed_teeth, self.satellite_teeth, self.angle)
        if faults:
            raise Infeasible("\n".join(faults))

    @property
    def tooth_ratio(self) -> Fraction:
        """q = z1/z2: turns of the satellite about its axis per turn of the crank, seen from the crank, backwards."""
        return Fraction(self.fixed_teeth, self.satellite_teeth)

    @property
    def ratio(self) -> Fraction:
        """i = ω_3/ω_4 = 1/(1 − q), negative where the output turns against the input."""
        return 1 / (1 - self.tooth_ratio)

    @property
    def axis(self) -> Array:
        """The satellite's axis n in the frame of the crank, (3,)."""
        return np.array([math.sin(self.angle), 0.0, math.cos(self.angle)])

    @property
    def relative_velocity(self) -> Array:
        """k − q n: angular velocity of the satellite over the crank's, in the frame of the crank, (3,)."""
        return np.array([0.0, 0.0, 1.0]) - float(self.tooth_ratio) * self.axis

    @property
    def pitch_angle(self) -> float:
        """Polar angle (rad, 0…π) about k of the line on which satellite and fixed wheel roll.

        tan δ = q sin ϑ/|q cos ϑ − 1|, on the side of n for z1 > z2, and opposite for z1 < z2.
        """
        x, _, z = self.relative_velocity
        return math.atan2(abs(x), z if self.fixed_teeth < self.satellite_teeth else -z)

    @property
    def closing_turns(self) -> int:
        """Turns of the crank after which the satellite stands as at first."""
        return self.tooth_ratio.denominator


def nutation_faults(fixed_teeth: int, satellite_teeth: int, angle: float) -> tuple[str, ...]:
    """Reasons why such a motion makes no drive, one sentence each; empty when it does."""
    faults = []
    for name, teeth in (("fixed_teeth", fixed_teeth), ("satellite_teeth", satellite_teeth)):
        if teeth < 1:
            faults.append(f"{name} = {teeth}: at least one tooth is needed")
    if fixed_teeth == satellite_teeth:
        faults.append(
            f"{fixed_teeth} teeth on wheel and satellite alike: the output stands still; "
            f"take {fixed_teeth - 1} or {fixed_teeth + 1} on the satellite"
        )
    if not 0.0 < angle < 0.5 * math.pi:
        faults.append(
            f"nutation angle = {math.degrees(angle):.6g}°: it must be above 0° and below 90°; "
            f"drives are built with 1° to 8°"
        )
    return tuple(faults)


def satellite_motion(
    nutation: Nutation, crank_angle: npt.ArrayLike, speed: float = 1.0, acceleration: float = 0.0
) -> SphericalMotion:
    """Motion of the satellite over the crank angles (n,), rad, at the crank's speed ω_3 (rad/s) and α_3 (rad/s²)."""
    angle = np.atleast_1d(np.asarray(crank_angle, dtype=np.float64))
    q = float(nutation.tooth_ratio)
    crank = rotation(2, angle)
    pose = crank @ rotation(1, nutation.angle) @ rotation(2, -q * angle)
    along = nutation.relative_velocity
    change = acceleration * along - q * speed**2 * np.cross([0.0, 0.0, 1.0], nutation.axis)
    return SphericalMotion(frozen(pose), frozen(turn(crank, speed * along)), frozen(turn(crank, change)))


def output_angle(nutation: Nutation, crank_angle: npt.ArrayLike) -> Array:
    """Angle (rad) of the output shaft, which a constant-velocity joint holds to the satellite: (1 − q) φ."""
    angle = np.asarray(crank_angle, dtype=np.float64)
    return np.asarray(angle / float(nutation.ratio))
