"""The members of a K-H-V drive as simple solids, and its natural modes as films."""

from __future__ import annotations

import numpy as np

from trochoid.drives.disc_field import turned
from trochoid.drives.disc_pack import circle
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.modes import NaturalModes
from trochoid.drives.mode_film import (
    GLASS,
    Part,
    Swing,
    at_parameters,
    joined,
    mode_films,
    plate,
    solid,
    tube,
)
from trochoid.kinematics.types import ComplexArray
from trochoid.results.film import Film

MOTIONS = ("x", "y", "z", "tilt_x", "tilt_y", "rotation")


def films(design: Design, found: NaturalModes) -> tuple[Film, ...]:
    """Return the first modes as the turning eccentric sees them, at input angle 0."""
    parts = members(design)
    swings = [
        Swing(i + 1, f"{mode.frequency:.5g} Hz, {mode.words}", motion(design, found, i))
        for i, mode in enumerate(found.modes)
    ]
    return mode_films([part for _, part in parts], swings, "seen from the eccentric")


def motion(design: Design, found: NaturalModes, i: int) -> ComplexArray:
    """Return displacement and rotation (parts, 6) of all parts in a mode, the ring's, which rests, among them."""
    rows = np.zeros((len(design.discs) + 3, 6), dtype=np.complex128)
    for row, (member, _) in zip(rows, members(design), strict=True):
        for axis, way in enumerate(MOTIONS):
            name = f"{member}.{way}"
            if name in found.names:
                row[axis] = found.shapes[found.names.index(name), i]
    return rows


def members(design: Design) -> list[tuple[str, Part]]:
    """Return discs, input shaft with eccentrics, output flange with pins, and ring, by the names of their motions."""
    drive, axis = design.drive, np.zeros(3)
    half = 0.5 * drive.face_width
    middles = [
        np.array([*turned(np.array([design.flank.eccentricity, 0.0]), disc.crank), disc.z])
        for disc in design.discs
    ]
    line = design.flank.point(at_parameters(design.flank.period, design.flank.lobes))
    found = []
    for i, (disc, middle) in enumerate(zip(design.discs, middles, strict=True)):
        outline = turned(line, -disc.crank / design.flank.lobes) + middle[:2]
        found.append((f"disc{i}", plate(f"disc {i + 1}", outline, drive.bore_radius, disc.z, middle)))
    shaft, flange, pins = drive.input_shaft, drive.output_flange, drive.output_pins
    center = 0.5 * sum(shaft.bearing_positions)
    bodies = [solid("", shaft.radius, center - 0.5 * shaft.length, center + 0.5 * shaft.length, axis)]
    bodies += [solid("", design.race_radius, m[2] - half, m[2] + half, m) for m in middles]
    found.append(("shaft", joined("input shaft", bodies)))
    low, high = design.discs[0].z - half, design.discs[-1].z + half
    side = 1.0 if sum(flange.bearing_positions) >= 0.0 else -1.0
    start = (high if side > 0.0 else low) + side * half
    ends = sorted((start, start + side * flange.thickness))
    bodies = [tube("", (flange.outer_radius, shaft.radius), ends[0], ends[1], axis)]
    bodies += [
        solid("", pins.roller_radius, min(low, start), max(high, start), np.array([*place, 0.0]))
        for place in circle(pins.circle_radius, pins.count, pins.phase)
    ]
    found.append(("output", joined("output flange", bodies, GLASS)))
    bore = drive.pin_circle_radius + drive.pin_radius
    width = 0.5 * drive.ring.width
    found.append(("ring", tube("ring", (drive.ring.outer_radius, bore), -width, width, axis)))
    return found
