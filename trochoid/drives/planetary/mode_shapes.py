"""The members of a planetary set as simple solids, and its natural modes as films."""

from __future__ import annotations

import numpy as np

from trochoid.drives.disc_field import turned
from trochoid.drives.mode_film import Part, Swing, joined, mode_films, plate, solid, tube
from trochoid.drives.planetary.design import Design
from trochoid.drives.planetary.modes import SetModes
from trochoid.drives.planetary.moving import MAIN, Moving
from trochoid.geometry.planetary_curves import Members, poses
from trochoid.kinematics.involute_curve import GearCurve
from trochoid.kinematics.types import Array, ComplexArray
from trochoid.results.film import Film

OF_TOOTH, FEW, MANY = (
    (0.1, 0.42, 0.58, 0.9),
    (0.0, 0.5),
    24,
)  # places on a tooth; of wheels with so many teeth


def films(design: Design, curves: Members, set_: Moving, found: SetModes) -> tuple[Film, ...]:
    """Return the first modes as the carrier sees them, at input angle 0."""
    swings = [
        Swing(i + 1, f"{mode.frequency:.5g} Hz, {mode.words}", motion(set_, found.shapes[:, i]))
        for i, mode in enumerate(found.modes)
    ]
    return mode_films(members(design, curves), swings, "seen from the carrier")


def motion(set_: Moving, shape: ComplexArray) -> ComplexArray:
    """Return displacement and rotation (members, 6) of sun, ring, carrier and planets in a shape (k,) of a mode."""
    moved = (set_.free @ shape).reshape(-1, 3)
    rows = np.zeros((len(moved), 6), dtype=np.complex128)
    rows[:, [0, 1, 5]] = moved
    return rows


def members(design: Design, curves: Members) -> list[Part]:
    """Return sun, ring, carrier and planets, in the order of the motions: wheels flat, with their teeth."""
    at, axis = poses(design.given, 0.0), np.zeros(3)
    sun_bore, bore, outside = design.bores
    width, d = design.drive.face_width, design.drive
    places = [np.array([x, y, 0.0]) for x, y in at.center]
    high, low = 0.75 * width, 0.5 * width
    reach = d.center_distance + bore
    inside = max(d.center_distance - bore, 0.2 * reach)
    cheek = tube("", (reach, inside), -high, -low, axis)  # the upper one would hide the wheels
    pins = [solid("", 0.7 * bore, -high, high, place) for place in places]
    main = {
        "sun": plate("sun", turned(_teeth(curves.sun), float(at.sun)), sun_bore, 0.0, axis),
        "ring": plate("ring", turned(_teeth(curves.ring), float(at.ring)), outside, 0.0, axis),
        "carrier": joined("carrier", [cheek, *pins]),
    }
    planets = [
        plate(f"planet {i + 1}", turned(_teeth(curves.planet), float(turn)) + place[:2], bore, 0.0, place)
        for i, (place, turn) in enumerate(zip(places, at.planet, strict=True))
    ]
    return [*(main[name] for name in MAIN), *planets]


def _teeth(curve: GearCurve) -> Array:
    """Return a coarse outline (n, 2) of a whole gear."""
    teeth = int(curve.period)
    tooth = np.array(OF_TOOTH if teeth <= MANY else FEW)
    return curve.point((np.arange(teeth)[:, None] + tooth).ravel())
