"""Every reason why a planetary set cannot be built; none when it can."""

from __future__ import annotations

import math

from trochoid.drives.planetary.design import Design
from trochoid.geometry.planetary_check import planetary_faults
from trochoid.geometry.planetary_curves import members
from trochoid.kinematics.errors import Infeasible


def faults(design: Design) -> tuple[str, ...]:
    """Return one sentence per fault: what was given, the limit, the nearest feasible value."""
    found = planetary_faults(design.given, design.limits)
    if found:
        return found
    found = _root_rounding(design) + _bodies(design)
    try:
        members(design.given, design.rounding)
    except Infeasible as error:
        found += (str(error),)
    return found


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


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"
