"""Every reason why a planetary set cannot be built; none when it can."""

from __future__ import annotations

import math
from dataclasses import replace

from trochoid.drives.planetary.design import Design
from trochoid.geometry.planetary_check import planetary_faults
from trochoid.geometry.planetary_curves import members
from trochoid.kinematics.errors import Infeasible


def faults(design: Design) -> tuple[str, ...]:
    """Return one sentence per fault: what was given, the limit, and what near it can be built."""
    found = planetary_faults(
        design.given, design.limits, lambda near: _around_teeth(replace(design, given=near))
    )
    return found or _around_teeth(design)


def _around_teeth(design: Design) -> tuple[str, ...]:
    """Return what is wrong with what the teeth are cut with and stand on."""
    found = _root_rounding(design) + _bodies(design) + _floating(design) + _bearing(design)
    try:
        curves = members(design.given, design.rounding)
        if design.scene.has("elastic_contact") and not found:
            from trochoid.drives.planetary.blanks import blanks

            blanks(design, curves)
    except Infeasible as error:
        found += (str(error),)
    return found + _measured(design)


def _measured(design: Design) -> tuple[str, ...]:
    """Spans and sizes over rollers are asked for with the profile, and not every roller rests on the flanks."""
    if "profile" not in design.scene.ask.quantities:
        return ()
    from trochoid.geometry.planetary_table import table

    try:
        table(design.geometry, design.roller)
    except Infeasible as error:
        return (f"sizes to measure (roller_diameter = {_mm(design.roller)}): {error}",)
    return ()


def _root_rounding(design: Design) -> tuple[str, ...]:
    """The quality conditions count on a rack that is straight up to h_a*."""
    d = design.drive
    limit = d.root_clearance / (1.0 - math.sin(d.pressure_angle))
    if design.rounding <= limit + 1e-3:  # 0.38 is the usual rounding of 0.37996
        return ()
    return (
        f"root_rounding = {design.rounding:g}: the rack's flank would end before its addendum; it must be at most "
        f"root_clearance/(1 - sin pressure_angle) = {limit:.4g}",
    )


def _bodies(design: Design) -> tuple[str, ...]:
    roots, (sun, planet, ring) = design.geometry.roots, design.bores
    found = tuple(
        f"{name}.bore_radius = {_mm(bore)}: nothing is left below the teeth; it must be less than the root radius "
        f"{_mm(float(root))}"
        for name, bore, root in (("sun", sun, roots[0]), ("planet", planet, roots[1]))
        if bore >= root
    )
    if ring > roots[2]:
        return found
    return (
        *found,
        f"ring.outer_radius = {_mm(ring)}: nothing is left above the teeth; it must be more than the root radius "
        f"{_mm(float(roots[2]))}",
    )


def _bearing(design: Design) -> tuple[str, ...]:
    """The rolling bearing of the planets."""
    table = design.drive.planet.bearing
    if table is None or not design.scene.has("bearing_compliance"):
        return ()
    from trochoid.drives.rolling import faults as rolling_faults

    return rolling_faults({"planet.bearing": table})


def _floating(design: Design) -> tuple[str, ...]:
    """Three planets centre what floats between them; one or two do not."""
    d = design.drive
    if d.planets >= 3 or not design.scene.has("bearing_compliance"):
        return ()
    members = {"sun": d.sun.bearing_stiffness, "carrier": d.carrier.bearing_stiffness}
    if d.ring.held == "evenly":
        members["ring"] = d.ring.bearing_stiffness
    loose = [name for name, stiffness in members.items() if stiffness == 0.0]
    planets = "1 planet" if d.planets == 1 else f"{d.planets} planets"
    return tuple(
        f"{name}.bearing_stiffness = 0: {planets} cannot centre a {name} that floats; take 3 or more, or a stiffness "
        "above 0"
        for name in loose
    )


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"
