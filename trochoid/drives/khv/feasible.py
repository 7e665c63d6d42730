"""Every reason why a K-H-V drive cannot be built; none when it can."""

from __future__ import annotations

from trochoid.drives.khv.design import Design
from trochoid.geometry.check import bearing_faults, disc_faults, output_pin_faults, stack_faults
from trochoid.kinematics.meshing import cycloid_faults, flank_faults


def faults(design: Design) -> tuple[str, ...]:
    """Return one sentence per fault: what was given, the limit, the nearest feasible value."""
    found = cycloid_faults(design.flank)
    if found:  # without a profile nothing else has a meaning
        return found
    ground = design.flank.modified(design.modification)
    found = tuple(f"modified flank: {fault}" for fault in flank_faults(ground))
    d = design.drive
    for angle in design.hole_angles:
        found += disc_faults(
            design.flank,
            d.bore_radius,
            d.output_pins.count,
            d.output_pins.circle_radius,
            design.hole_radius,
            angle,
        )
    found += output_pin_faults(design.hole_radius, d.output_pins.roller_radius, d.eccentricity)
    found += stack_faults([disc.z for disc in design.discs], d.face_width)
    found += bearing_faults(d.bore_radius, d.eccentric_bearing.rollers, d.eccentric_bearing.roller_radius)
    found += _rollers(design) + _shaft(design) + _ring(design) + _bearings(design)
    return tuple(dict.fromkeys(found))


def _bearings(design: Design) -> tuple[str, ...]:
    """The rolling bearings of shaft and flange."""
    tables = {
        "input_shaft.bearing": design.drive.input_shaft.bearing,
        "output_flange.bearing": design.drive.output_flange.bearing,
    }
    if not design.scene.has("bearing_compliance") or not any(tables.values()):
        return ()
    from trochoid.drives.rolling import faults as rolling_faults

    return rolling_faults(tables)


def _rollers(design: Design) -> tuple[str, ...]:
    length, width = design.drive.eccentric_bearing.roller_length, design.drive.face_width
    if length <= width:
        return ()
    return (
        f"eccentric_bearing.roller_length = {_mm(length)}: rollers touch the disc over its face width only; "
        f"it must be at most face_width = {_mm(width)}",
    )


def _shaft(design: Design) -> tuple[str, ...]:
    shaft, race = design.drive.input_shaft, design.race_radius
    limit = race - design.flank.eccentricity
    if shaft.radius <= limit:
        return ()
    return (
        f"input_shaft.radius = {_mm(shaft.radius)}: the shaft sticks out of its eccentrics; "
        f"it must be at most raceway radius less eccentricity = {_mm(limit)}",
    )


def _ring(design: Design) -> tuple[str, ...]:
    d = design.drive
    limit = d.pin_circle_radius + d.pin_radius
    if d.ring.outer_radius > limit:
        return ()
    return (
        f"ring.outer_radius = {_mm(d.ring.outer_radius)}: it must enclose the pins, more than {_mm(limit)}",
    )


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"
