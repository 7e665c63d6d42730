"""Balance of a precessional drive in closed form: static, dynamic, what remains; how far the printed model is off."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from trochoid.drives.precessional.mechanism import PrecessionalDrive, mass_moments
from trochoid.drives.precessional.reactions import Model
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Line:
    """A line of the inertia couple in the fixed frame: `order` over the shaft's speed, `couple` (N·m), peak.

    `axis` is "rotating" for a couple that turns across z, forwards (order > 0) or backwards (< 0), and "z" for
    one that swings about z.
    """

    order: Fraction
    couple: float
    axis: str


def static_moment(drive: PrecessionalDrive) -> float:
    """m5 r5 (kg·m) with which the sum of inertia forces vanishes: m2 l2 s + m3 y3, sources §2."""
    satellite, shaft, _ = mass_moments(drive)
    return satellite + shaft


def statically_balanced(drive: PrecessionalDrive) -> PrecessionalDrive:
    """Return the drive with the counterweight's radius set for static balance; raises without a counterweight."""
    weight = drive.counterweight
    if not weight.mass > 0.0:
        raise TrochoidError(
            "counterweight.mass = 0: nothing can be balanced with it; give it a mass above 0 kg"
        )
    return replace(drive, counterweight=replace(weight, radius=static_moment(drive) / weight.mass))


def mean_product(drive: PrecessionalDrive, model: Model = "exact") -> float:
    """Mean couple of the satellite about −x over ω_3²: s[c(I_m − I_z) + q I_z], printed s q I_m; kg·m²."""
    (s, c), q = drive.tilt, drive.tooth_ratio
    x, y, z = drive.satellite.inertia
    mean = 0.5 * (x + y)
    return s * q * mean if model == "printed" else s * (c * (mean - z) + q * z)


def balance_plane(drive: PrecessionalDrive, model: Model = "exact") -> float:
    """H (m): where the counterweight must stand from O so that the mean couple vanishes too (dynamic balance)."""
    *_, weight = mass_moments(drive)
    if weight == 0.0:
        raise TrochoidError(
            f"counterweight of {drive.counterweight.mass} kg at {drive.counterweight.radius} m: it has no moment, so "
            f"no plane of balance; give mass and radius above 0"
        )
    return (drive.shaft.product + mean_product(drive, model) + drive.counterweight.product) / weight


def remaining_couple(drive: PrecessionalDrive, speed: float) -> float:
    """Amplitude ω_3² s|I_x − I_y|/2·|2q − c| (N·m) about x3 of the couple that no counterweight can balance."""
    (s, c), q = drive.tilt, drive.tooth_ratio
    x, y, _ = drive.satellite.inertia
    return speed**2 * s * 0.5 * abs(x - y) * abs(2.0 * q - c)


def couple_lines(drive: PrecessionalDrive, speed: float) -> tuple[Line, ...]:
    """Lines of the exact inertia couple about O in the fixed frame: ω_3, ω_3(2q − 1), weak ω_3(2q + 1), and 2q about z.

    With A and B the amplitudes about x3 and y3 of what swings with 2f in the shaft's frame, the two side lines
    are (A ± B)/2: s|I_x − I_y|(1 ± c)(2q ∓ 1)/4.
    """
    (s, c), q = drive.tilt, drive.tooth_ratio
    ratio = drive.nutation.tooth_ratio
    x, y, _ = drive.satellite.inertia
    *_, weight = mass_moments(drive)
    products = drive.shaft.product + drive.counterweight.product - weight * drive.counterweight.z
    mean = abs(products + mean_product(drive))
    size = speed**2 * s * abs(x - y)
    return (
        Line(Fraction(1), speed**2 * mean, "rotating"),
        Line(1 - 2 * ratio, 0.25 * size * (1.0 + c) * abs(2.0 * q - 1.0), "rotating"),
        Line(1 + 2 * ratio, 0.25 * size * (1.0 - c) * (2.0 * q + 1.0), "rotating"),
        Line(2 * ratio, size * q * s, "z"),
    )


def model_difference(drive: PrecessionalDrive, crank: npt.ArrayLike, speed: float) -> dict[str, Array]:
    """What the printed model leaves out, exact − printed (n,), sources §2; the other components are exact as printed.

    ΔY_A = ω_3² s(c − q)[I_z − I_y cos²f − I_x sin²f]/(OA·c), ΔY_O = −ΔY_A, ΔY_B = ΔY_A and
    ΔM_Bx = ΔY_A (OB − OA·c).  X_O lacks the tooth force besides.
    """
    (s, c), q = drive.tilt, drive.tooth_ratio
    x, y, z = drive.satellite.inertia
    f = -q * np.asarray(crank, dtype=np.float64)
    bracket = z - y * np.cos(f) ** 2 - x * np.sin(f) ** 2
    change: Array = speed**2 * s * (c - q) * bracket / (drive.joint * c)
    return {"Y_A": change, "Y_O": -change, "Y_B": change, "M_Bx": change * (drive.support - drive.joint * c)}


def rocking_velocity(
    drive: PrecessionalDrive, speed: float, inertia: float, lever: float, model: Model = "exact"
) -> float:
    """Main line (m/s rms) of a free casing under static balance: m5 r5 ω_3|z5 − H|·d_z/(√2 J), sources §2."""
    *_, weight = mass_moments(drive)
    off = drive.counterweight.z - balance_plane(drive, model)
    return weight * speed * abs(off) * lever / (math.sqrt(2.0) * inertia)
