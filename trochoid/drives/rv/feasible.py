"""Every reason why an RV drive cannot be built; none when it can."""

from __future__ import annotations

import math

from trochoid.drives.rv.design import Design
from trochoid.drives.rv.first_stage import Stage, first_stage
from trochoid.geometry.check import bearing_faults, disc_faults, root_radius, stack_faults, window_faults
from trochoid.geometry.planetary_quality import Condition, Limits, outer_conditions
from trochoid.kinematics.assembly import coaxial, cranks_assemble, neighbors_clear
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute_pair import mesh
from trochoid.kinematics.meshing import cycloid_faults, flank_faults
from trochoid.scene.drive_rv import FirstStage

LIMITS = Limits(tip_thickness=0.0, contact_ratio=1.0)


def faults(design: Design) -> tuple[str, ...]:
    """Return one sentence per fault: what was given, the limit, the nearest feasible value."""
    table, profile = design.drive.first_stage, cycloid_faults(design.flank)
    stage = stage_reasons(table)
    reached = not _unreachable(table)
    placed = _placed(design) if reached and not profile else ()
    found = profile + stage
    if not profile:  # without profiles nothing else has a meaning
        ground = design.flank.modified(design.modification)
        found += tuple(f"modified flank: {fault}" for fault in flank_faults(ground))
        found += placed + (_around(design) if reached else ())
        found += _bearing(design) + _crankshaft(design) + _ring(design) + _rolling(design)
    if stage or (placed and design.first.arm >= root_radius(design.flank)):
        found += _advice(design, bool(profile))
    return tuple(dict.fromkeys(found))


def stage_reasons(table: FirstStage) -> tuple[str, ...]:
    """What is wrong with the involute stage: assembly, undercut, pointed tips, interference, coaxiality, neighbours."""
    checks = [cranks_assemble(table.z_sun, table.z_planet, table.cranks, advise=False)]
    try:
        stage = first_stage(table)
    except Infeasible as fault:
        return (*(check.fault for check in checks if check.fault), f"first_stage: {fault}")
    checks.append(neighbors_clear("planets", table.cranks, stage.arm, stage.tips[1], advise=False))
    if table.center_distance is not None:
        tight = mesh(stage.pair.first, stage.pair.second)
        checks.append(coaxial(tight, table.center_distance, 1e-3 * table.module, advise=False))
    failed = [c for c in conditions(stage) if c.required and not c.fulfilled]
    return (
        *(check.fault for check in checks if check.fault),
        *(f"first_stage: {_sentence(c)}" for c in failed),
    )


def _unreachable(table: FirstStage) -> bool:
    try:
        first_stage(table)
    except Infeasible:
        return True
    return False


def _advice(design: Design, without_discs: bool) -> tuple[str, ...]:
    """What near it can be built as a whole."""
    from trochoid.drives.rv.advice import advice
    from trochoid.drives.rv.design import design as made

    def also(table: FirstStage) -> tuple[str, ...]:
        if without_discs:
            return ()
        scene = design.scene
        drive = scene.drive.model_copy(update={"first_stage": table})
        changed = made(scene.model_copy(update={"drive": drive}))
        return _placed(changed) + _around(changed)

    room = (0.0, math.inf) if without_discs else _room(design)
    return advice(design.drive.first_stage, LIMITS, stage_reasons, also, room)


def _room(design: Design) -> tuple[float, float]:
    """Between what radii (m) the crank holes find material of the discs."""
    hole = design.drive.arm_bearing.hole_radius
    return design.drive.cycloid.bore_radius + hole, root_radius(design.flank) - hole


def conditions(stage: Stage) -> tuple[Condition, ...]:
    """Return the conditions of sun and planet with their margins."""
    return outer_conditions(stage.pair, stage.tips, LIMITS)


def _sentence(c: Condition) -> str:
    if c.unit == "m":
        return f"{c.name}: {_mm(float(c.value))} must be {c.relation} {_mm(float(c.limit))}"
    return f"{c.name}: {float(c.value):.5g} must be {c.relation} {float(c.limit):.5g}"


def _placed(design: Design) -> tuple[str, ...]:
    """Return what is wrong with the discs' holes, which stand on the centre distance, and their widths."""
    c, found = design.drive.cycloid, tuple[str, ...]()
    for body in range(len(design.hole_angles)):
        holes = design.holes(body)
        sizes = holes.circle_radius, holes.radius, holes.angle0
        broken = disc_faults(design.flank, c.bore_radius, holes.count, *sizes)
        found += tuple(f"crank holes (arm_bearing.hole_radius, on the centre distance): {x}" for x in broken)
        if not broken:
            found += window_faults(design.flank, c.bore_radius, holes, design.windows(body))
    return found + stack_faults([disc.z for disc in design.discs], c.face_width)


def _rolling(design: Design) -> tuple[str, ...]:
    """The rolling bearings of the crankshafts."""
    table = design.drive.crankshaft.bearing
    if table is None or not design.scene.has("bearing_compliance"):
        return ()
    from trochoid.drives.rolling import faults as rolling_faults

    return rolling_faults({"crankshaft.bearing": table})


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


def _around(design: Design) -> tuple[str, ...]:
    """Return what is wrong with the carrier, whose plates hold crankshafts and pillars."""
    carrier, shafts = design.drive.carrier, design.first.arm + design.drive.crankshaft.radius
    pillars = carrier.pillars
    limit = max(shafts, 0.0 if pillars is None else pillars.circle_radius + pillars.radius)
    if carrier.outer_radius >= limit * (1.0 - 1e-12):
        return ()
    what = "crankshafts" if limit == shafts else "pillars"
    return (
        f"carrier.outer_radius = {_mm(carrier.outer_radius)}: the {what} stick out of the carrier; it must be at least "
        f"{_mm(limit)}",
    )


def _ring(design: Design) -> tuple[str, ...]:
    ring, c, found = design.drive.ring, design.drive.cycloid, []
    limit = c.pin_circle_radius + c.pin_radius
    if ring.outer_radius <= limit:
        found.append(
            f"ring.outer_radius = {_mm(ring.outer_radius)}: it must enclose the pins, more than {_mm(limit)}"
        )
    if ring.width < design.pack_width * (1.0 - 1e-12):
        found.append(
            f"ring.width = {_mm(ring.width)}: the pins are as long as the ring and must reach all discs; it must be at "
            f"least the width of the pack, {_mm(design.pack_width)}"
        )
    return tuple(found)


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"
