"""Whether a sphere tooth can be made: range of nutation, undercut at and away from the contact, pins that overlap."""

from __future__ import annotations

import math
from dataclasses import replace

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.sphere_tooth_clearance import clear_pin_angle

AT_CUSPS = 1e-7  # of the nutation with cusps: nearer to it, curvature is a quotient of rounding errors


def largest_nutation(tooth: SphereTooth) -> float:
    """Nutation (rad) at which the pins reach the instantaneous axis, where their path gets cusps and then loops.

    Law of sines on the pitch cones: sin(α ∓ ϑ) = sin α · z_lobes/z_pins.  Where the pitch cone never grows as
    wide as the pins', the path reaches the pole of its own body at ϑ = α.
    """
    alpha = tooth.polar_angle
    other = math.sin(alpha) * tooth.lobes / tooth.pins
    return min(abs(alpha - math.asin(other)), alpha) if other < 1.0 else alpha


def nutation_limit(tooth: SphereTooth, steps: int = 24) -> float:
    """Nutation (rad) up to which a tooth that can be made still can with its pin: undercut, or cusps of the path.

    Undercut is looked for at `steps` nutations from the tooth's own to the cusps, the first is then bisected.
    """
    low, most = tooth.nutation, largest_nutation(tooth)
    for step in range(1, steps):
        high = tooth.nutation + (most - tooth.nutation) * step / steps
        if not _clears(tooth, high):
            return _bisected(tooth, low, high)
        low = high
    high = (1.0 - 10.0 * AT_CUSPS) * most
    return most if high <= low or _clears(tooth, high) else _bisected(tooth, low, high)


def _clears(tooth: SphereTooth, nutation: float) -> bool:
    return clear_pin_angle(replace(tooth, nutation=nutation)) > tooth.pin_angle


def _bisected(tooth: SphereTooth, low: float, high: float) -> float:
    """Largest nutation (rad) between one that leaves the flank uncut and one that does not."""
    while high - low > 1e-7 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _clears(tooth, middle) else (low, middle)
    return low


def overlap_angle(tooth: SphereTooth) -> float:
    """Pin angle (rad) at which neighbouring pins touch: sin r = sin α sin(π/z_pins)."""
    return math.asin(math.sin(tooth.polar_angle) * math.sin(math.pi / tooth.pins))


def check_sphere_tooth(tooth: SphereTooth) -> None:
    """Raise Infeasible with every reason why the flank cannot be made, and the nearest feasible values."""
    faults = sphere_tooth_faults(tooth)
    if faults:
        raise Infeasible("\n".join(faults))


def sphere_tooth_faults(tooth: SphereTooth) -> tuple[str, ...]:
    """Reasons why a flank cannot be made, one sentence each; empty when it can."""
    shape = _fail_if_no_pair(tooth) or _fail_if_looped(tooth)
    return shape or _fail_if_undercut(tooth) + _fail_if_pins_overlap(tooth)


def _fail_if_no_pair(tooth: SphereTooth) -> tuple[str, ...]:
    faults = []
    if min(tooth.pins, tooth.lobes) < 3:
        faults.append(f"pins = {tooth.pins}, lobes = {tooth.lobes}: at least 3 of each are needed")
    if not 0.0 < tooth.polar_angle <= 0.5 * math.pi:
        faults.append(
            f"polar_angle = {_degrees(tooth.polar_angle)}: it must be above 0° and at most 90°; a pin beyond 90° "
            f"is one at 180° less that angle about the axis turned round"
        )
    if not tooth.pin_angle > 0.0:
        faults.append(f"pin_angle = {_degrees(tooth.pin_angle)}: a positive angle is needed")
    if not tooth.nutation > 0.0:
        faults.append(f"nutation = {_degrees(tooth.nutation)}: a positive angle is needed")
    return tuple(faults)


def _fail_if_looped(tooth: SphereTooth) -> tuple[str, ...]:
    limit = largest_nutation(tooth)
    if tooth.nutation < (1.0 - AT_CUSPS) * limit:
        return ()
    return (
        f"nutation = {_degrees(tooth.nutation)}: out of range, the path of the pins has cusps, then loops; "
        f"the nearest feasible nutation is just below {_degrees(limit)}",
    )


def _fail_if_undercut(tooth: SphereTooth) -> tuple[str, ...]:
    limit = clear_pin_angle(tooth)
    if tooth.pin_angle < limit:
        return ()
    advice = []
    if limit > 1e-6 * overlap_angle(tooth):
        local = tooth.undercut_angle <= tooth.pin_angle
        what = "the flank is undercut" if local else "the flank is cut away by the pin at another crank angle"
        advice.append(f"a pin_angle just below {_degrees(limit)}")
    else:
        what = "the flank cannot be cut, for the path of the pin crosses itself"
    nutation = _nutation_without_undercut(tooth)
    if nutation > 0.0:
        advice.append(f"with this pin a nutation just below {_degrees(nutation)}")
    todo = ", or ".join(advice) or "a smaller pin_angle with a smaller nutation"
    return (f"pin_angle = {_degrees(tooth.pin_angle)}: {what}; feasible is {todo}",)


def _nutation_without_undercut(tooth: SphereTooth) -> float:
    """Largest nutation (rad) for which this pin does not cut the flank; 0 when none is found."""
    low = 1e-6 * tooth.nutation
    return _bisected(tooth, low, tooth.nutation) if _clears(tooth, low) else 0.0


def _fail_if_pins_overlap(tooth: SphereTooth) -> tuple[str, ...]:
    limit = overlap_angle(tooth)
    if tooth.pin_angle < limit:
        return ()
    return (
        f"pin_angle = {_degrees(tooth.pin_angle)}: neighbouring pins overlap; it must be less than "
        f"asin(sin(polar_angle)·sin(π/pins)) = {_degrees(limit)}",
    )


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.6g}°"
