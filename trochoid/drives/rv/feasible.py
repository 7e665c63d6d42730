"""Every reason why an RV drive cannot be built; none when it can."""

from __future__ import annotations

import math

from trochoid.drives.rv.design import Design
from trochoid.drives.rv.first_stage import Stage
from trochoid.geometry.check import bearing_faults, disc_faults, stack_faults, window_faults
from trochoid.geometry.planetary_quality import Condition, Limits, outer_conditions
from trochoid.kinematics.assembly import coaxial, cranks_assemble, neighbors_clear
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute_pair import mesh, mesh_at
from trochoid.kinematics.meshing import cycloid_faults, flank_faults

LIMITS = Limits(tip_thickness=0.0, contact_ratio=1.0)
GRID = 0.001  # of the shifts that are tried for advice


def faults(design: Design) -> tuple[str, ...]:
    """Return one sentence per fault: what was given, the limit, the nearest feasible value."""
    found = cycloid_faults(design.flank)
    table = design.drive.first_stage
    found += tuple(
        check.fault for check in (cranks_assemble(table.z_sun, table.z_planet, table.cranks),) if check.fault
    )
    try:
        stage = design.first
    except Infeasible as fault:
        return (*found, f"first_stage: {fault}")
    if found:  # without profiles nothing else has a meaning
        return (*found, *stage_faults(design, stage))
    ground = design.flank.modified(design.modification)
    found += tuple(f"modified flank: {fault}" for fault in flank_faults(ground))
    found += stage_faults(design, stage)
    found += _disc(design) + _bearing(design) + _crankshaft(design) + _ring(design)
    return tuple(dict.fromkeys(found))


def stage_faults(design: Design, stage: Stage) -> tuple[str, ...]:
    """Return what is wrong with the involute stage: undercut, pointed tips, interference, coaxiality, neighbours."""
    table, pair = design.drive.first_stage, stage.pair
    checks = [neighbors_clear("planets", table.cranks, stage.arm, stage.tips[1])]
    if table.center_distance is not None:
        tight = mesh(pair.first, pair.second)
        checks.append(coaxial(tight, table.center_distance, 1e-3 * table.module))
    found = tuple(check.fault for check in checks if check.fault)
    failed = [c for c in conditions(stage) if c.required and not c.fulfilled]
    if not failed:
        return found
    near = _nearest(stage)
    advice = "no shift at this centre distance fulfils all conditions; take other teeth"
    if near is not None:
        advice = f"the nearest feasible shifts are x_sun = {near[0]:.4g}, x_planet = {near[1]:.4g}"
    return found + tuple(f"first_stage: {_sentence(c)}; {advice}" for c in failed)


def conditions(stage: Stage) -> tuple[Condition, ...]:
    """Return the conditions of sun and planet with their margins."""
    return outer_conditions(stage.pair, stage.tips, LIMITS)


def _nearest(stage: Stage) -> tuple[float, float] | None:
    """Return the shifts nearest to the given ones that fulfil all conditions at the same centre distance and play."""
    from dataclasses import replace

    pair = stage.pair
    x1, x2 = float(pair.first.shift), float(pair.second.shift)
    steps = range(1, math.ceil(2.0 / GRID))
    for step in (sign * GRID * k for k in steps for sign in (1.0, -1.0)):
        one, two = replace(pair.first, shift=x1 + step), replace(pair.second, shift=x2 - step)
        tips = stage.tips[0] + one.module * step, stage.tips[1] - one.module * step
        if min(tips[0] - one.base_radius, tips[1] - two.base_radius) <= 0.0:
            continue
        moved = Stage(mesh_at(one, two, stage.arm), tips, stage.backlash)
        if all(c.fulfilled for c in conditions(moved) if c.required):
            return x1 + step, x2 - step
    return None


def _sentence(c: Condition) -> str:
    if c.unit == "m":
        return f"{c.name}: {_mm(float(c.value))} must be {c.relation} {_mm(float(c.limit))}"
    return f"{c.name}: {float(c.value):.5g} must be {c.relation} {float(c.limit):.5g}"


def _disc(design: Design) -> tuple[str, ...]:
    c, found = design.drive.cycloid, tuple[str, ...]()
    for body in range(len(design.hole_angles)):
        holes = design.holes(body)
        sizes = holes.circle_radius, holes.radius, holes.angle0
        broken = disc_faults(design.flank, c.bore_radius, holes.count, *sizes)
        found += tuple(f"crank holes (arm_bearing.hole_radius, on the centre distance): {x}" for x in broken)
        if not broken:
            found += window_faults(design.flank, c.bore_radius, holes, design.windows(body))
    return found + stack_faults([disc.z for disc in design.discs], c.face_width)


def _bearing(design: Design) -> tuple[str, ...]:
    bearing, width = design.drive.arm_bearing, design.drive.cycloid.face_width
    found = bearing_faults(bearing.hole_radius, bearing.rollers, bearing.roller_radius)
    if bearing.roller_length > width:
        found += (
            f"arm_bearing.roller_length = {_mm(bearing.roller_length)}: rollers touch the disc over its face width "
            f"only; it must be at most cycloid.face_width = {_mm(width)}",
        )
    return found


def _crankshaft(design: Design) -> tuple[str, ...]:
    shaft, found = design.drive.crankshaft, []
    limit = design.race_radius - design.flank.eccentricity
    if shaft.radius > limit:
        found.append(
            f"crankshaft.radius = {_mm(shaft.radius)}: the shaft sticks out of its eccentrics; it must be at most "
            f"raceway radius less eccentricity = {_mm(limit)}"
        )
    half = 0.5 * design.pack_width
    low, high = shaft.bearing_positions
    if low > -half or high < half:
        found.append(
            f"crankshaft.bearing_positions = {1e3 * low:.6g}, {1e3 * high:.6g} mm: the bearings stand in the carrier "
            f"on both sides of the discs, at {_mm(-half)} or below and {_mm(half)} or above"
        )
    least = half + 0.5 * design.drive.first_stage.face_width
    if abs(shaft.planet_position) < least * (1.0 - 1e-12):
        found.append(
            f"crankshaft.planet_position = {_mm(shaft.planet_position)}: the planets cut into the discs; it must be at "
            f"least half the pack and half of their own width away from 0, {_mm(least)}"
        )
    return tuple(found)


def _ring(design: Design) -> tuple[str, ...]:
    ring, c = design.drive.ring, design.drive.cycloid
    limit = c.pin_circle_radius + c.pin_radius
    if ring.outer_radius > limit:
        return ()
    return (
        f"ring.outer_radius = {_mm(ring.outer_radius)}: it must enclose the pins, more than {_mm(limit)}",
    )


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"
