"""Bodies of an indexer in space, each in the pose of its frame: slotted wheel, pin, planet, arm and shafts.

Wheel and pin are the scene's; planet, arm and shafts are there to see what moves, and bear no load.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from trochoid.drives.indexer.design import Design
from trochoid.drives.indexer.outline import flat, outline, to_space, turned
from trochoid.drives.indexer.wheel import hub_angle
from trochoid.drives.solids import Solid, frustum, joined, revolved, rod, tube
from trochoid.geometry.triangulate import triangulate
from trochoid.kinematics.indexer_slot import Slot
from trochoid.kinematics.types import Array

HUB_POINTS, GROWTH, LAYERS = 48, 0.5, 4
SHAFT, ARM = 0.12, 0.05  # radii in those of the sphere
PLANET = 0.12  # thickness of the planet in radii of the sphere


def wheel(design: Design, slot: Slot) -> Solid:
    """Return the slotted wheel, its axis along z and the slot of the pin towards x.

    Slots have parallel walls for cylinders and barrels, and walls of rays for cones.
    """
    drive = design.drive
    radii = drive.sphere_radius + drive.wheel.thickness * (np.arange(LAYERS + 1) / LAYERS - 0.5)
    same = drive.pin.shape == "cone"
    shapes = [outline(_at(design, drive.sphere_radius if same else float(r)), slot) for r in radii]
    hub = hub_angle(design)
    loops = [flat(shapes[LAYERS // 2], 1.0)]
    around = 2.0 * math.pi * np.arange(HUB_POINTS) / HUB_POINTS
    circle = np.stack((np.cos(around), np.sin(around)), axis=-1)
    if hub > 0.0:
        loops.append(hub * circle)
    edges = loops[0]
    clockwise = (
        float(np.sum(edges[:, 0] * np.roll(edges[:, 1], -1) - edges[:, 1] * np.roll(edges[:, 0], -1))) < 0.0
    )
    order = np.arange(len(edges))[::-1] if clockwise else np.arange(len(edges))
    loops[0] = edges[order]
    plane, triangles = triangulate(loops, GROWTH)
    rim, n = len(edges), len(plane)
    layers = []
    for radius, shape in zip(radii, shapes, strict=True):
        directions = _raised(plane)
        directions[:rim] = shape[order]
        layers.append(radius * directions)
    ring = np.arange(rim)
    sides = [ring] if hub == 0.0 else [ring, rim + np.arange(HUB_POINTS)[::-1]]
    walls = []
    for layer in range(LAYERS):
        for loop in sides:
            low, on = loop + layer * n, np.roll(loop, -1) + layer * n
            walls += [np.stack([low, on, on + n]), np.stack([low, on + n, low + n])]
    cells = np.concatenate([triangles[[0, 2, 1]], triangles + LAYERS * n, *walls], axis=1)
    used, index = np.unique(cells, return_inverse=True)
    return Solid(np.concatenate(layers)[used], index.reshape(cells.shape))


def hub(design: Design) -> Solid:
    """Return hub and output shaft about z, as the wheel's frame has them."""
    drive, angle = design.drive, hub_angle(design)
    radius = drive.wheel.hub_radius or SHAFT * drive.sphere_radius
    inner, outer = (drive.sphere_radius + side * 0.5 * drive.wheel.thickness for side in (-1.0, 1.0))
    low, high = inner * math.cos(angle), 1.45 * drive.sphere_radius
    thin = min(radius, SHAFT * drive.sphere_radius)
    step = outer * math.cos(angle) + 0.05 * drive.sphere_radius
    profile = ((0.0, low), (radius, low), (radius, step), (thin, step), (thin, high), (0.0, high))
    return revolved(profile, np.array([0.0, 0.0, 1.0]))


def on_wheel(design: Design, solid: Solid, psi: float) -> Solid:
    """Return a solid of the wheel's frame in space with the wheel at ψ; that frame is a mirror image of space's."""
    return Solid(to_space(turned(solid.points, psi), design.indexer), solid.cells[[0, 2, 1]])


def pin(design: Design, direction: Array) -> Solid:
    """Return the pin along a unit vector (3,), from where it is held to the outside of the wheel."""
    drive = design.drive
    outer = drive.sphere_radius + 0.5 * drive.wheel.thickness
    root = drive.sphere_radius - 0.5 * drive.wheel.thickness - drive.pin.overhang
    radius = drive.pin_radius
    along = np.linspace(root, outer, 13)
    if drive.pin.shape == "cone":
        wide = radius * along / drive.sphere_radius
    elif drive.pin.shape == "barrel" and drive.pin.crown_radius is not None:
        off = np.minimum(np.abs(along - drive.sphere_radius), drive.pin.crown_radius)
        sag = drive.pin.crown_radius - np.sqrt(drive.pin.crown_radius**2 - off**2)
        wide = np.maximum(radius - sag, 0.3 * radius)
    else:
        wide = np.full(along.shape, radius)
    profile = [(0.0, root), *zip(wide.tolist(), along.tolist(), strict=True), (0.0, outer)]
    return revolved(profile, direction)


def planet(design: Design, axis: Array) -> Solid | None:
    """Return the planet about its axis (3,), wide enough to hold the pin; None where that is no flat body."""
    path, drive = design.indexer.path, design.drive
    angle = max(path.planet_cone, path.pin + 1.6 * design.pin_angle)
    root = drive.sphere_radius - 0.5 * drive.wheel.thickness - drive.pin.overhang
    if angle > 1.3:
        return None
    return frustum(axis, angle, root - PLANET * drive.sphere_radius, root, 96)


def arm(design: Design, angle: float) -> Solid:
    """Return drive shaft and arm at a drive angle: from the shaft's axis along a circle to the planet's."""
    path, radius = design.indexer.path, design.drive.sphere_radius
    drive = design.drive
    root = radius - 0.5 * drive.wheel.thickness - drive.pin.overhang
    reach = 0.8 * (root - PLANET * radius)
    part = np.linspace(0.0, path.arm, 17)
    points = reach * np.stack((np.sin(part), np.zeros_like(part), np.cos(part)), axis=-1)
    points = turned(points, angle)
    end = points[-1] * (root - 0.5 * PLANET * radius) / reach
    shaft = rod(np.array([0.0, 0.0, -0.35 * radius]), points[0], SHAFT * radius)
    return joined([shaft, tube(points, ARM * radius), rod(points[-1], end, ARM * radius)])


def _at(design: Design, radius: float) -> Design:
    """Return the design as seen on another sphere: what has a length there is an angle of its own."""
    length = design.drive.wheel.slot_length
    wheel_ = design.drive.wheel
    if length is not None:
        wheel_ = wheel_.model_copy(update={"slot_length": length * radius / design.drive.sphere_radius})
    return replace(design, drive=design.drive.model_copy(update={"sphere_radius": radius, "wheel": wheel_}))


def _raised(plane: Array) -> Array:
    """Return unit vectors (n, 3) of true distances from the wheel's axis (n, 2), rad."""
    distance = np.hypot(plane[:, 0], plane[:, 1])
    scale = np.sinc(distance / math.pi)
    return np.column_stack([plane * scale[:, None], np.cos(distance)])
