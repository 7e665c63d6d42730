"""The members of an RV drive as simple solids, and its natural modes as films."""

from __future__ import annotations

import numpy as np

from trochoid.drives.disc_field import turned
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
from trochoid.drives.rv.carried import carried_masses
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.mass import Masses
from trochoid.drives.rv.modes import NaturalModes
from trochoid.drives.rv.series import Series
from trochoid.dynamics.carried import Mass
from trochoid.kinematics.types import Array, ComplexArray, frozen
from trochoid.results.film import Film


def films(design: Design, series: Series, masses: Masses, found: NaturalModes) -> tuple[Film, ...]:
    """Return the first modes as the carrier sees them, at input angle 0."""
    parts = carried_masses(design, series.motions, masses)
    swings = [
        Swing(i + 1, f"{mode.frequency:.5g} Hz, {mode.words}", motion(design, parts, found.shapes[:, i]))
        for i, mode in enumerate(found.modes)
    ]
    return mode_films(members(design, parts), swings, "seen from the carrier")


def motion(design: Design, parts: tuple[Mass, ...], shape: ComplexArray) -> ComplexArray:
    """Return displacement and rotation (bodies, 6) of all bodies, as `members` has them, in a shape (k,) of a mode."""

    def of(part: Mass) -> ComplexArray:
        x, y = part.moves @ shape
        return np.array([x, y, 0.0, 0.0, 0.0, part.turns @ shape])

    discs, cranks, sun, carrier = _told_apart(design, parts)
    rows = [of(part) for part in discs]
    for crank in cranks:
        rows += [_beam(crank, shape), of(crank[-1])]
    rows += [of(sun), of(carrier), np.zeros(6, dtype=np.complex128)]
    return np.array(rows)


def _beam(crank: tuple[Mass, ...], shape: ComplexArray) -> ComplexArray:
    """Return the rigid motion of a crankshaft's middle that is nearest to that of its places, by least squares."""
    z = np.array([part.place[2] for part in crank])
    moved = np.array([part.moves @ shape for part in crank])
    line = np.linalg.lstsq(
        np.stack([np.ones_like(z), z - z.mean()], axis=1).astype(complex), moved, rcond=None
    )[0]
    (x, y), (slope_x, slope_y) = line
    return np.array([x, y, 0.0, -slope_y, slope_x, np.mean([part.turns @ shape for part in crank])])


def _told_apart(
    design: Design, parts: tuple[Mass, ...]
) -> tuple[tuple[Mass, ...], list[tuple[Mass, ...]], Mass, Mass]:
    """Return the masses of discs, of each crankshaft (its planet the last), of the sun, and of carrier or ring."""
    discs, cranks = len(design.discs), len(design.crank_places)
    places = (len(parts) - discs - 2) // cranks
    each = [parts[discs + j * places : discs + (j + 1) * places] for j in range(cranks)]
    return parts[:discs], each, parts[-2], parts[-1]


def members(design: Design, parts: tuple[Mass, ...]) -> list[Part]:
    """Return discs, each crankshaft and its planet, sun, carrier and ring; of the last two, one rests."""
    c, shaft, gears = design.drive.cycloid, design.drive.crankshaft, design.drive.first_stage
    half, axis = 0.5 * c.face_width, np.zeros(3)
    line = design.flank.point(at_parameters(design.flank.period, design.flank.lobes))
    found = []
    for i, disc in enumerate(design.discs):
        middle = np.array([*design.eccentric(i, np.zeros(1))[0], disc.z])
        outline = turned(line, -disc.crank / design.flank.lobes) + middle[:2]
        found.append(
            plate(f"disc {i + 1}", outline, max(c.bore_radius, 0.1 * c.pin_circle_radius), disc.z, middle)
        )
    ends = (*shaft.bearing_positions, shaft.planet_position)
    tips = design.first.tips
    high = shaft.planet_position + 0.5 * gears.face_width
    low = high - gears.face_width
    _, cranks, _, _ = _told_apart(design, parts)
    for j, place in enumerate(design.crank_places):
        middle = np.array([*place, np.mean([part.place[2] for part in cranks[j]])])
        bodies = [solid("", shaft.radius, min(ends), max(ends), middle)]
        for i, disc in enumerate(design.discs):
            at = place + design.eccentric(i, np.zeros(1))[0]
            bodies.append(
                solid("", design.race_radius, disc.z - half, disc.z + half, np.array([*at, disc.z]))
            )
        found.append(joined(f"crankshaft {j + 1}", bodies))
        wheel = np.array([*place, shaft.planet_position])
        found.append(tube(f"planet {j + 1}", (float(tips[1]), shaft.radius), low, high, wheel))
    found.append(solid("sun", float(tips[0]), low, high, np.array([0.0, 0.0, shaft.planet_position])))
    carrier = _carrier(design, axis)
    width, bore = 0.5 * design.drive.ring.width, c.pin_circle_radius + c.pin_radius
    ring = tube("ring", (design.drive.ring.outer_radius, bore), -width, width, axis)
    return [*found, *((ring, carrier) if design.driven == "ring" else (carrier, ring))]


def _carrier(design: Design, axis: Array) -> Part:
    """Return both plates of the carrier as flat rings with what joins them."""
    table, pack = design.drive.carrier, 0.5 * design.pack_width
    inner = 0.35 * table.outer_radius
    ends = [(-pack - table.thickness, -pack), (pack, pack + table.thickness)]
    plates = [tube("", (table.outer_radius, inner), low, high, axis) for low, high in ends]
    if table.pillars is not None:
        count = design.drive.first_stage.cranks
        angle = np.pi / count + 2.0 * np.pi * np.arange(count) / count
        spots = table.pillars.circle_radius * np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], axis=-1)
        plates += [solid("", table.pillars.radius, -pack, pack, frozen(spot)) for spot in spots]
    return joined("carrier", plates, GLASS)
