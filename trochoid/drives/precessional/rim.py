"""The rim and the rollers of a scene by their sizes, and every reason why they cannot be built."""

from __future__ import annotations

import math

from trochoid.drives.precessional.design import Design
from trochoid.geometry.sphere_rim import RimShape
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.scene.drive_precessional import Teeth

DEPTH = 2.5  # heights of a tooth: how far below its spaces the rim is held where the scene does not say
MOST = 400  # rollers: half of them press, and a square of their slices takes 0.5 GB
LEAST_DEPTH = 0.25  # of a pitch: and no less than that, for teeth of small nutation are flat


def toothed(design: Design) -> tuple[SphereTooth, Teeth]:
    """Return the tooth of a scene that has one, and its table; raises Infeasible otherwise."""
    if design.tooth is None or design.teeth is None:
        raise Infeasible("elastic contact needs teeth: the table [drive.teeth]")
    return design.tooth, design.teeth


def rim_shape(design: Design) -> RimShape:
    """Return the cut of the rim with the unit sphere; raises Infeasible for hub and tips that cut the flanks."""
    (tooth, _), given = toothed(design), design.scene.drive.rim
    polar = [math.acos(float(tooth.point(p)[2])) for p in (0.0, math.pi / tooth.lobes)]
    low, high = min(polar), max(polar)
    deep = max(DEPTH * (high - low), LEAST_DEPTH * 2.0 * math.pi * math.sin(low) / tooth.lobes)
    hub = min(high + deep, 0.5 * (high + math.pi)) if tooth.hole else max(low - deep, 0.5 * low)
    try:
        return RimShape(tooth, hub if given.hub_angle is None else given.hub_angle, given.tip_angle)
    except Infeasible as fault:
        raise Infeasible(f"drive.rim: {fault}") from None


def reach(design: Design) -> tuple[float, float] | None:
    """Return where rollers begin and end, m from O, None where they are as long as the teeth; raises Infeasible."""
    rollers = design.scene.drive.rollers
    return _within(design, "rollers", rollers.inner_radius, rollers.outer_radius, "")


def web(design: Design) -> tuple[float, float] | None:
    """Return where the web that holds the rim begins and ends, m from O, None for all of it; raises Infeasible."""
    rim = design.scene.drive.rim
    return _within(design, "rim", rim.web_inner_radius, rim.web_outer_radius, "web_")


def _within(
    design: Design, table: str, inner: float | None, outer: float | None, name: str
) -> tuple[float, float] | None:
    _, teeth = toothed(design)
    low, high = teeth.inner_radius, teeth.outer_radius
    first, last = low if inner is None else inner, high if outer is None else outer
    if not low <= first < last <= high:
        raise Infeasible(
            f"drive.{table}: {name}inner_radius to {name}outer_radius = {1e3 * first:g} to {1e3 * last:g} mm; the "
            f"teeth lie from {1e3 * low:g} to {1e3 * high:g} mm: take a part of that"
        )
    return None if (first, last) == (low, high) else (first, last)


def rim_faults(design: Design) -> tuple[str, ...]:
    """Return one sentence per fault: what was given, the limit, what to take."""
    if design.tooth is None:
        return ()
    found = []
    if design.tooth.pins > MOST:
        found.append(
            f"z_wheel = {design.nutation.fixed_teeth}: elastic contact holds what each slice of {design.tooth.pins} "
            f"rollers does to each other; memory lasts for {MOST}: take fewer teeth, or leave out the effect "
            '"elastic_contact"'
        )
    for make in (rim_shape, reach, web):
        try:
            make(design)
        except Infeasible as fault:
            found.append(str(fault))
    rollers, angle = design.scene.drive.rollers, design.tooth.pin_angle
    if play(design) >= 0.5 * angle:
        most = 1e3 * 0.5 * angle * design.tooth_radius
        found.append(
            f"drive.rollers: clearance = {1e3 * rollers.clearance:.6g} mm leaves less than half of a pin; take less "
            f"than {most:.4g} mm"
        )
    elif rollers.bore_angle is not None and not rollers.bore_angle < angle - play(design):
        found.append(
            f"drive.rollers: bore_angle = {math.degrees(rollers.bore_angle):.6g}°: it must be less than the half angle "
            f"of a roller, {math.degrees(angle - play(design)):.6g}°"
        )
    return tuple(found)


def play(design: Design) -> float:
    """Angle (rad) by which rollers are thinner than the flanks are cut for; 0 without the effect "clearance"."""
    rollers = design.scene.drive.rollers
    return rollers.clearance / design.tooth_radius if design.scene.has("clearance") else 0.0


def lean(design: Design) -> tuple[float, float]:
    """Tilt and skew (rad) of the rollers' axes; none without the effect "clearance"."""
    rollers = design.scene.drive.rollers
    return (rollers.tilt, rollers.skew) if design.scene.has("clearance") else (0.0, 0.0)


def crowning(design: Design) -> float:
    """Depth (m) of the crown at the ends of a roller; 0 without the effect "clearance"."""
    return design.scene.drive.rollers.crown if design.scene.has("clearance") else 0.0
