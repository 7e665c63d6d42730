"""Bodies of a precessional drive that a film shows as they are placed: shaft, hub, rollers and what holds them.

Rollers and the places of the joints are the scene's; the thickness of shafts and of the member that holds the rollers
follows from bearings and rollers, or from the teeth, and bears no load.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from trochoid.drives.precessional.contact import Series
from trochoid.drives.precessional.dataset_contact import passage
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.rim import play, reach, rim_shape, toothed
from trochoid.drives.solids import Solid, frustum, joined, revolved, rod
from trochoid.kinematics.spherical import rotation, turn
from trochoid.kinematics.types import Array

Z = np.array([0.0, 0.0, 1.0])
WALL = 0.12  # of the teeth's distance from O: thickness of what holds the rollers


def pin_axes(design: Design) -> Array:
    """Return the rollers' axes (pins, 3) in the frame of their member."""
    tooth, _ = toothed(design)
    angle = 2.0 * math.pi * np.arange(tooth.pins) / tooth.pins
    s, c = math.sin(tooth.polar_angle), math.cos(tooth.polar_angle)
    return np.stack((s * np.cos(angle), s * np.sin(angle), np.full(tooth.pins, c)), axis=-1)


def roller(design: Design, axis: Array) -> Solid:
    """Return a roller about `axis` (3,), without its crown."""
    tooth, teeth = toothed(design)
    inner, outer = reach(design) or (teeth.inner_radius, teeth.outer_radius)
    return frustum(axis, tooth.pin_angle - play(design), inner, outer)


def holder(design: Design) -> Solid:
    """Return a ring beyond the rollers' outer ends, about its member's axis."""
    tooth, teeth = toothed(design)
    outer = teeth.outer_radius * 1.02
    low, high = (tooth.polar_angle + side * tooth.pin_angle for side in (-1.0, 1.0))
    far = outer + WALL * design.tooth_radius
    corners = ((outer, high), (far, high), (far, low), (outer, low))
    return revolved([(r * math.sin(a), r * math.cos(a)) for r, a in corners], Z, 96)


def hub(design: Design) -> Solid | None:
    """Return the satellite between its bearing A and the cone that holds its rim; None where that is not inside."""
    tooth, teeth = toothed(design)
    if tooth.pins_on != "ring" or tooth.hole:
        return None
    polar, place = rim_shape(design).hub, design.scene.drive.satellite.bearing_distance
    seat, half = _seat(design), 0.5 * (teeth.outer_radius - teeth.inner_radius) * math.cos(polar)
    s, c = math.sin(polar), math.cos(polar)
    if not 1.1 * seat < teeth.inner_radius * s:
        return None
    return revolved(
        (
            (seat, place - half),
            (teeth.inner_radius * s, teeth.inner_radius * c),
            (teeth.outer_radius * s, teeth.outer_radius * c),
            (seat, place + half),
        ),
        Z,
        96,
    )


def input_shaft(design: Design) -> Solid:
    """Return shaft and crank in the frame of the crank: a journal at A along the satellite's axis, and one at B."""
    drive, n = design.scene.drive, design.nutation.axis
    at_a, at_b = drive.satellite.bearing_distance, drive.input_shaft.bearing_distance
    thin = 0.5 * (drive.bearing_a.bore if drive.bearing_a and drive.bearing_a.bore else 0.4 * at_a)
    thick = 0.5 * (drive.bearing_b.bore if drive.bearing_b and drive.bearing_b.bore else 0.5 * at_a)
    way = 1.0 if at_b > at_a else -1.0
    root = at_a + way * 1.3 * thin
    cheek = max(1.25 * thick, thin + root * abs(n[0]))
    end = at_b + way * 1.5 * thick
    return joined(
        [
            rod((at_a - way * 1.3 * thin) * n, (root + way * 0.2 * thin) * n, thin),
            rod(root * n[2] * Z, (root * n[2] + way * 0.7 * thin) * Z, cheek),
            rod((root * n[2] + way * 0.5 * thin) * Z, end * Z, thick),
        ]
    )


def _seat(design: Design) -> float:
    """Return the radius, m, of the satellite's bore."""
    bearing, place = design.scene.drive.bearing_a, design.scene.drive.satellite.bearing_distance
    return 0.5 * bearing.outside if bearing and bearing.outside else 0.35 * place


def rolled(design: Design, series: Series, crank: Array) -> Array:
    """Return how far (frames, pins), rad, rollers have turned on their pins since crank angle 0.

    They roll on the flank without sliding, loaded or not.
    """
    tooth, _ = toothed(design)
    pins, relative = tooth.pins, design.nutation.relative_velocity
    flank = relative if tooth.pins_on == "ring" else -relative
    at = series.crank
    to_crank = rotation(2, -at)
    if tooth.pins_on == "satellite":
        to_crank = rotation(1, design.nutation.angle) @ rotation(2, -float(tooth.pair.tooth_ratio) * at)
    lever = np.cross(turn(to_crank[:, None], pin_axes(design)), series.point)
    speed = np.sum(np.cross(flank, series.point) * lever, axis=-1) / np.sum(lever**2, axis=-1)
    rate = passage(speed)
    pitch = 2.0 * math.pi / design.nutation.fixed_teeth
    step = pitch / len(at)
    angle = np.concatenate([[0.0], np.cumsum(0.5 * (rate + np.roll(rate, -1))) * step])

    def since(x: Array) -> Array:
        turns = np.floor(x / (pins * pitch))
        rest = x - turns * pins * pitch
        return np.asarray(turns * angle[-1] + np.interp(rest, step * np.arange(len(angle)), angle))

    late = np.asarray(pitch * np.arange(pins), dtype=np.float64)
    return np.asarray(since(crank[:, None] - late) - since(-late))


def rollers_turned(design: Design, angle: Array) -> Iterator[Solid]:
    """Yield the rollers, each turned on its pin by `angle` (pins,), rad, in the frame of their member."""
    made = roller(design, np.array([0.0, 0.0, 1.0]))
    tooth, _ = toothed(design)
    for k, spun in enumerate(angle):
        azimuth = 2.0 * math.pi * k / tooth.pins
        yield made.turned(rotation(2, azimuth) @ rotation(1, tooth.polar_angle) @ rotation(2, float(spun)))
