"""Why loaded contacts found no balance: more torque than the teeth hold, found by asking for less at the same place.

Under more and more torque the satellite gives way, teeth and bearings alike, until rollers stand so far up the flanks
that more rotation brings no more torque: there the stiffness at the output is nothing, and beyond it the teeth jump.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.teeth import largest_force
from trochoid.fem.cone_assembly import ConeContact
from trochoid.kinematics.errors import NotConverged

if TYPE_CHECKING:
    from trochoid.drives.precessional.contact import Series

LEAST = 1e-4  # of the torque: where not even that is carried, it is not the torque
TIMES = 1.1  # apart are the torques between which the limit is found
TILTED = (
    0.25  # of the nutation: from there on the bearings, not the teeth, are to blame, and that is warned of
)
SUNK = 0.25  # of the teeth's height: from there on the rollers' seats are to blame
BROAD = 0.1  # half width over radius: Hertz is wrong by about its square


def explained(
    design: Design, torque: float, crank: float, fault: NotConverged, solve: Callable[[float], ConeContact]
) -> NotConverged:
    """Return the fault in the scene's words; `solve(share)` solves the position under that share of the torque."""
    place = f"at input angle {math.degrees(crank):.4g}°"
    height, sag = _height(design), 1e3 * _sag(design, torque)
    if sag > SUNK * height:
        seat = design.scene.drive.rollers.seat_stiffness or 0.0
        return NotConverged(
            f"contacts {place}: {abs(torque):.4g} N*m at the output is more than the teeth hold: rollers would sink by "
            f"{sag:.3g} mm on their pins, and teeth are {height:.3g} mm high; give rollers.seat_stiffness = "
            f"{_up(1e-3 * seat * sag / (SUNK * height)):.6g} or more (given {1e-3 * seat:.6g}), or take less torque",
            fault.row,
        )
    share, found = limit(solve)
    if found is None:
        return NotConverged(f"contacts {place} under {torque:.4g} N*m at the output: {fault}", fault.row)
    lean = float(np.hypot(*found.motion[0, :2])) / design.nutation.angle
    cause = (
        f"bearings A and B let the satellite's axis lean by {math.degrees(lean * design.nutation.angle):.3g}° there; "
        "stiffen them, take"
        if lean > TILTED
        else f"rollers and teeth yield by the height of the teeth, {height:.3g} mm; take"
    )
    return NotConverged(
        f"contacts {place}: {abs(torque):.4g} N*m at the output is more than the teeth hold; from about "
        f"{share * abs(torque):.3g} N*m on they jump at a nutation of {math.degrees(design.nutation.angle):.4g}°: "
        f"{cause} less torque{_more(design, share)}",
        fault.row,
    )


def _more(design: Design, share: float) -> str:
    """Say what nutation holds the torque, where there is one."""
    from trochoid.kinematics.sphere_tooth_checks import largest_nutation

    least = design.nutation.angle / math.sqrt(share)
    if design.tooth is None or least >= largest_nutation(design.tooth):
        return ""
    return f", or nutation_angle = {math.degrees(least):.3g} or more (the limit grows with its square)"


def limit(solve: Callable[[float], ConeContact]) -> tuple[float, ConeContact | None]:
    """Return the largest share of the load that is carried, and its solution; None where LEAST is not."""
    low, high = LEAST, 1.0
    found = _tried(solve, low)
    if found is None:
        return 0.0, None
    while high > TIMES * low:
        middle = math.sqrt(low * high)
        better = _tried(solve, middle)
        low, high, found = (low, middle, found) if better is None else (middle, high, better)
    return low, found


def _tried(solve: Callable[[float], ConeContact], share: float) -> ConeContact | None:
    try:
        return solve(share)
    except NotConverged:
        return None


def doubts(series: Series, wedged: bool = False) -> Iterator[str]:
    """Yield what is assumed small and is not; where rollers are `wedged`, that is why contacts are broad."""
    if said := leaning(series):
        yield said
    broad = float(series.breadth.max())
    if broad > BROAD:
        cause, remedy = (
            (", where rollers wedge", "give them clearance")
            if wedged
            else (", near undercut", "a smaller pin_angle leaves a rounder flank")
        )
        yield (
            f"contacts are up to {200.0 * broad:.3g} % as wide as the radius of the flank there{cause}: Hertz "
            f"takes them as narrow, so their pressure is a guess; {remedy}"
        )


def leaning(series: Series) -> str:
    """Say that the satellite's axis leans so much that a linear hold of it is no more than a guess; "" if not."""
    lean = float(np.linalg.norm(np.cross(series.motion, series.axis), axis=1).max())
    angle = math.acos(float(series.axis[2]))
    if lean <= TILTED * angle:
        return ""
    return (
        f"under load the satellite's axis leans by {math.degrees(lean):.3g}° of {math.degrees(angle):.4g}° nutation: "
        "bearings are linear and loads keep their directions, which is too simple for that; stiffen bearings A and B, "
        "or take less torque"
    )


def _sag(design: Design, torque: float) -> float:
    """Return by how much, m, the most loaded roller gives way on its seat where all that have a lever share evenly."""
    seat = design.scene.drive.rollers.seat_stiffness
    if seat is None or not design.scene.has("pin_compliance"):
        return 0.0
    return largest_force(design, torque) / seat


def _up(value: float) -> float:
    """Round up to two digits, so that what is advised is enough."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return math.ceil(value / digit) * digit


def _height(design: Design) -> float:
    """Return the height of the teeth in mm, from the bottom of their spaces to their tips."""
    tooth = design.tooth
    if tooth is None:
        return math.nan
    polar = np.arccos(tooth.point(np.array([0.0, math.pi / tooth.lobes]))[:, 2])
    return 1e3 * design.tooth_radius * abs(float(polar[1] - polar[0]))
