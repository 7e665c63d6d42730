"""The members of a precessional drive as simple solids, and its natural modes as films."""

from __future__ import annotations

import numpy as np

from trochoid.drives.mode_film import MOST, Part, Swing, joined, mode_films, solid, tube
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.modes import NaturalModes
from trochoid.kinematics.types import Array, frozen
from trochoid.results.film import Film

RIDES = 0.2  # of the casing's largest displacement: with less against it members ride on it
SLIM = 0.12  # radius of shafts beside the reach of the drive, which no table says


def films(design: Design, found: NaturalModes) -> tuple[Film, ...]:
    """Return the first modes in which members move against the casing, as the turning input shaft sees them.

    Where these are few, the first of the casing on its mounts come besides; numbers are those among all modes.
    """
    parts = members(design, found)
    order = sorted(range(len(found.modes)), key=lambda i: (_rides(found, parts, i), i))[:MOST]
    swings = [
        Swing(i + 1, f"{mode.frequency:.5g} Hz, {mode.words}", found.motions[i])
        for i, mode in enumerate(found.modes)
        if i in order
    ]
    return mode_films(parts, swings, "seen from the input shaft")


def _rides(found: NaturalModes, parts: list[Part], mode: int) -> bool:
    """Whether all members ride on the casing, which alone moves."""
    if "casing" not in found.members:
        return False
    frame = parts[found.members.index("casing")]
    motion = found.motions[mode][found.members.index("casing")]
    most = np.abs(frame.moved(motion)).max()
    against = [
        part.moved(own) - Part("", part.points, part.cells, frame.center).moved(motion)
        for part, own in zip(parts, found.motions[mode], strict=True)
    ]
    return max(float(np.abs(each).max()) for each in against) < RIDES * float(most)


def members(design: Design, found: NaturalModes) -> list[Part]:
    """Return the members by name: satellite as a leaning ring on its axis, shafts with counterweight, casing."""
    drive, teeth = design.mechanism, design.teeth
    reach = drive.joint if teeth is None else teeth.outer_radius
    inner = 0.6 * reach if teeth is None else teeth.inner_radius
    slim, (s, c) = SLIM * reach, drive.tilt
    lean = np.array(
        [[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]]
    )  # takes z to the axis of the satellite, towards y
    low, high = min(drive.support, 0.0), max(drive.support, drive.joint)
    made = []
    for name, center in zip(found.members, found.centers, strict=True):
        axis = np.zeros(3)
        if name == "satellite":
            body = joined(
                name,
                [
                    tube("", (reach, inner), -0.5 * slim, 0.5 * slim, axis),
                    tube("", (inner, slim), -0.2 * slim, 0.2 * slim, axis),
                    solid("", slim, min(0.0, drive.joint), max(0.0, drive.joint), axis),
                ],
            )
            body = Part(name, frozen(body.points @ lean.T), body.cells, center)
        elif name == "input shaft":
            heavy = drive.counterweight
            crank = np.array([0.0, drive.joint * s, drive.joint * c])
            parts = [
                solid("", slim, min(low, crank[2]), high + slim, axis),
                solid("", 0.7 * slim, crank[2] - slim, crank[2] + slim, crank),
            ]
            if heavy.mass > 0.0:
                weight = np.array([0.0, -heavy.radius, heavy.z])
                parts.append(solid("", slim, heavy.z - 0.5 * slim, heavy.z + 0.5 * slim, weight))
            body = _about(name, joined(name, parts), center)
        elif name == "output shaft":
            body = _about(name, solid(name, slim, -1.2 * reach, -0.4 * reach, axis), center)
        else:
            ends, radii = (min(low, -reach), max(high, reach) + slim), (1.25 * reach, 1.15 * reach)
            hoops = [tube("", radii, z - 0.2 * slim, z + 0.2 * slim, axis) for z in ends]
            spots = (
                1.2 * reach * np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
            )
            posts = [solid("", 0.3 * slim, *ends, spot) for spot in spots]
            body = _about(name, joined(name, [*hoops, *posts]), center)  # a frame, to see what is in it
        made.append(body)
    return made


def _about(name: str, body: Part, center: Array) -> Part:
    return Part(name, body.points, body.cells, center)
