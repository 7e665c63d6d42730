"""The mechanism as seen from the centre of the sphere along the wheel's axis, animated over a turn of the arm."""

from __future__ import annotations

import math

import numpy as np

from trochoid.drives.indexer.dataset import wheel_angle, within
from trochoid.drives.indexer.outline import flat, outline, to_wheel, turned
from trochoid.drives.indexer.stages import Stages
from trochoid.drives.paths import Path, framed
from trochoid.kinematics.readable import readable
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Arrow, Drawing

FRAMES, POINTS = 72, 361


def drawing(stages: Stages) -> Drawing:
    """Return wheel, pin and arm in true distance from the wheel's axis; the pin force where it is known."""
    design = stages.design
    made, radius = design.indexer, design.drive.sphere_radius
    t: Array = (
        np.linspace(0.0, 2.0 * math.pi, FRAMES + 1)[:-1] - made.half_turn
    )  # from the start of one index to the next
    psi = wheel_angle(made, t)
    shape = outline(design, stages.slots["indexer"])
    wheel = np.array([flat(turned(shape, float(x)), radius) for x in psi])
    way = flat(to_wheel(made.path.point(np.linspace(-math.pi, math.pi, POINTS)), made), radius)
    center = flat(to_wheel(made.path.point(t), made), radius)
    around = np.linspace(0.0, 2.0 * math.pi, 33)[:-1]
    circle = np.stack((np.cos(around), np.sin(around)), axis=-1)
    paths = [
        Path("wheel", wheel, "wheel", "body"),
        Path("pin path", way, "pin path", "center", closed=False),
        Path("arm", _arm(stages, t), "arm", "outline", closed=False),
        Path("pin", center[:, None] + design.drive.pin_radius * circle, "pin", "pin"),
        Path("wheel axis", 0.02 * radius * circle, "axes", "outline"),
    ]
    if design.drive.wheel.hub_radius > 0.0:
        hub = radius * math.asin(design.drive.wheel.hub_radius / radius)
        paths.insert(1, Path("hub", hub * circle, "hub", "outline"))
    return framed(t, paths, _forces(stages, t, center))


def _arm(stages: Stages, t: Array) -> Array:
    """Great circles from the drive's axis to the planet's and on to the pin (frames, points, 2)."""
    made, part = stages.design.indexer, np.linspace(0.0, 1.0, 16)
    path = made.path
    along = np.stack((np.sin(part * path.arm), np.zeros_like(part), np.cos(part * path.arm)), axis=-1)
    lines = []
    for phi in t:
        arm = turned(along, float(phi))
        pin = path.point(phi)
        lever = (1.0 - part)[1:, None] * arm[-1] + part[1:, None] * pin
        lines.append(np.concatenate((arm, lever / np.linalg.norm(lever, axis=-1, keepdims=True))))
    return flat(to_wheel(np.array(lines), made), stages.design.drive.sphere_radius)


def _forces(stages: Stages, t: Array, center: Array) -> list[tuple[Arrow, ...]]:
    if "forces" not in stages.clock.seconds:
        return [() for _ in t]
    found = stages.forces["indexer"]
    force = np.where(within(found.indexer, t), found.state(t).pin, 0.0)  # t < 2π − φ0
    distance = np.linalg.norm(center, axis=-1, keepdims=True)
    across = np.stack((-center[:, 1], center[:, 0]), axis=-1) / distance
    return [
        (Arrow(c, f * a, "pin force", f"{readable(abs(f), 4)} N"),)
        for c, f, a in zip(center, force, across, strict=True)
    ]
