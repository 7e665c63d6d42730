"""What a designer asks first of a cycloid pair: can it be made, how many pins carry, how steeply."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import Infeasible


@dataclass(frozen=True, slots=True)
class ContactRatio:
    """Pins that carry load on a rigid, unmodified pair, and pressure angles (rad) of the mesh.

    Least and most leave out isolated instants.  The mean pressure angle is weighted with the pin force of
    the equal-spring load sharing; the largest is always π/2, where a pin enters or leaves without load.
    """

    mean: float
    least: int
    most: int
    pressure_angle_min: float
    pressure_angle_mean: float


def contact_ratio(cycloid: Cycloid) -> ContactRatio:
    """Pins in mesh and pressure angles; half the pins carry because z_p − z_c = 1 (sources §3)."""
    x, w = np.polynomial.legendre.leggauss(200)
    t = 0.5 * math.pi * (1.0 + x) / cycloid.lobes  # valley to crest: one flank
    force = w * np.abs(cycloid.lever(t))
    mean = float(force @ cycloid.pressure_angle(t) / force.sum())
    pins = cycloid.pins
    return ContactRatio(0.5 * pins, pins // 2, (pins + 1) // 2, math.acos(cycloid.trochoid_ratio), mean)


def check_cycloid(cycloid: Cycloid) -> None:
    """Raise Infeasible with every reason why the pair cannot be made, and the nearest feasible values."""
    faults = cycloid_faults(cycloid)
    if faults:
        raise Infeasible("\n".join(faults))


def cycloid_faults(cycloid: Cycloid) -> tuple[str, ...]:
    """Reasons why a cycloid pair cannot be made, one sentence each; empty when it can."""
    shape = _fail_if_not_a_pair(cycloid) or _fail_if_looped(cycloid)
    return shape or _fail_if_undercut(cycloid) + _fail_if_pins_overlap(cycloid)


def flank_faults(cycloid: Cycloid) -> tuple[str, ...]:
    """Reasons why a flank cannot be ground, whatever stands beside it; empty when it can."""
    return _fail_if_not_a_pair(cycloid) or _fail_if_looped(cycloid) or _fail_if_undercut(cycloid)


def _fail_if_not_a_pair(c: Cycloid) -> tuple[str, ...]:
    faults = []
    if c.pins < 4:
        faults.append(f"pins = {c.pins}: at least 4 pins are needed to hold the disc")
    for name in ("pin_circle_radius", "pin_radius", "eccentricity"):
        value = getattr(c, name)
        if not (value > 0.0 and math.isfinite(value)):
            faults.append(f"{name} = {value} m: a positive length is needed")
    return tuple(faults)


def _fail_if_looped(c: Cycloid) -> tuple[str, ...]:
    if c.trochoid_ratio < 1.0:
        return ()
    return (
        f"eccentricity = {_mm(c.eccentricity)}: it must be less than pin_circle_radius/pins = "
        f"{_mm(c.pin_circle_radius / c.pins)}, else the pin path has loops (K = {c.trochoid_ratio:.4g} ≥ 1)",
    )


def _fail_if_undercut(c: Cycloid) -> tuple[str, ...]:
    limit = c.undercut_radius
    if c.pin_radius < limit:
        return ()
    advice = f"the nearest feasible pin_radius is just below {_mm(limit)}"
    eccentricity = _eccentricity_without_undercut(c)
    if eccentricity > 0.0:
        advice += f", or with this pin an eccentricity just below {_mm(eccentricity)}"
    return (f"pin_radius = {_mm(c.pin_radius)}: the flank is undercut; {advice}",)


def _eccentricity_without_undercut(c: Cycloid) -> float:
    """Largest eccentricity (m) for which this pin does not undercut; 0 when none is found."""
    low, high = 0.0, c.eccentricity
    if replace(c, eccentricity=1e-9 * high).undercut_radius <= c.pin_radius:
        return 0.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        fits = replace(c, eccentricity=middle).undercut_radius > c.pin_radius
        low, high = (middle, high) if fits else (low, middle)
    return low


def _fail_if_pins_overlap(c: Cycloid) -> tuple[str, ...]:
    limit = c.pin_circle_radius * math.sin(math.pi / c.pins)
    if c.pin_radius < limit:
        return ()
    return (
        f"pin_radius = {_mm(c.pin_radius)}: neighbouring pins overlap; it must be less than "
        f"pin_circle_radius·sin(π/pins) = {_mm(limit)}",
    )


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"
