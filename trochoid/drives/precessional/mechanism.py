"""Masses and places of a precessional K-H-V drive, in the frame of its input shaft: z along it, y towards A."""

from __future__ import annotations

import math
from dataclasses import dataclass

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.nutation import Nutation


@dataclass(frozen=True, slots=True)
class Satellite:
    """`mass` kg with its centre on OA, `offset` (l2) m from O; principal `inertia` (x, y, z) about O, kg·m².

    z is OA; x and y lie in the frame's x and y at φ = 0.
    """

    mass: float
    offset: float
    inertia: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class InputShaft:
    """`mass` kg with its centre `offset` (y3) m off the axis, towards A; `product` I_yz = +∫yz dm about O, kg·m²."""

    mass: float
    offset: float
    product: float = 0.0


@dataclass(frozen=True, slots=True)
class Counterweight:
    """`mass` kg at `radius` m opposite to A, at `z` m from O; `product` I_yz = +∫yz dm about its own centre."""

    mass: float
    radius: float
    z: float
    product: float = 0.0


@dataclass(frozen=True, slots=True)
class PrecessionalDrive:
    """Masses and places, from O, m: `joint` OA of the spherical bearing A along n, `support` OB of B along z.

    `mesh_radius` is the distance from O at which the teeth touch; infinite lets them act as a pure couple.
    """

    nutation: Nutation
    satellite: Satellite
    shaft: InputShaft
    counterweight: Counterweight
    joint: float
    support: float
    mesh_radius: float = math.inf

    def __post_init__(self) -> None:
        """Refuse what no body can be."""
        faults = drive_faults(self)
        if faults:
            raise TrochoidError("\n".join(faults))

    @property
    def tooth_ratio(self) -> float:
        """q = z1/z2."""
        return float(self.nutation.tooth_ratio)

    @property
    def tilt(self) -> tuple[float, float]:
        """s = sin θ and c = cos θ."""
        return math.sin(self.nutation.angle), math.cos(self.nutation.angle)

    @property
    def reaction_period(self) -> float:
        """Angle (rad) of the input shaft after which all reactions repeat in its frame: π z2/z1."""
        return math.pi / self.tooth_ratio


def drive_faults(drive: PrecessionalDrive) -> tuple[str, ...]:
    """Reasons why masses and places describe no drive, one sentence each."""
    faults = []
    if not drive.joint > 0.0 or not drive.mesh_radius > 0.0:
        faults.append(
            f"joint OA = {drive.joint} m, mesh_radius = {drive.mesh_radius} m: both must be above 0"
        )
    masses = {
        "satellite": drive.satellite.mass,
        "shaft": drive.shaft.mass,
        "counterweight": drive.counterweight.mass,
    }
    for name, mass in masses.items():
        if not mass >= 0.0:
            faults.append(f"{name}.mass = {mass} kg: it cannot be negative")
    one, two, three = sorted(drive.satellite.inertia)
    if not (one >= 0.0 and one + two >= three * (1.0 - 1e-12)):
        faults.append(
            f"satellite.inertia = {drive.satellite.inertia} kg·m²: no body has these; none may be negative or above "
            f"the sum of the other two, {one + two:.6g}"
        )
    return tuple(faults)


def mass_moments(drive: PrecessionalDrive) -> tuple[float, float, float]:
    """m2 l2 s and m3 y3, towards A, and m5 r5, away from it, kg·m."""
    weight = drive.counterweight
    return (
        drive.satellite.mass * drive.satellite.offset * drive.tilt[0],
        drive.shaft.mass * drive.shaft.offset,
        weight.mass * weight.radius,
    )
