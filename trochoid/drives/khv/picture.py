"""The drive drawn over the input angle with its contact forces, and the discs' fields, all in the fixed frame."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.design import Design, circle
from trochoid.drives.khv.stages import Stages
from trochoid.kinematics.types import Array, frozen
from trochoid.results.outcome import Arrow, Drawing, DrawingFrame, Field, FieldFrame, Line

FLANK_POINTS = 760
ROUND, LARGE = 48, 120  # points of a small and of a large circle
RING_PINS, OUTPUT_PINS, SHAFT, AXES = "ring pins", "output pins", "shaft and eccentrics", "axes and pitch circles"


@dataclass(frozen=True, slots=True)
class Place:
    """A member's frame in the fixed one: centre (2,) m and angle rad."""

    center: Array
    angle: float

    def put(self, xy: Array) -> Array:
        """Carry points (n, 2) of the member to the fixed frame."""
        return frozen(turned(xy, self.angle) + self.center)


@dataclass(frozen=True, slots=True)
class Pose:
    """All members at one input angle; discs, cages and eccentrics one each per disc."""

    ring: Place
    flange: Place
    shaft: Place
    discs: tuple[Place, ...]
    eccentrics: tuple[Place, ...]
    cages: tuple[Place, ...]


def turned(vectors: Array, angle: float) -> Array:
    """Turn plane vectors (..., 2) by an angle in rad."""
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(vectors @ np.array([[c, s], [-s, c]]))


def drawing(stages: Stages, frames: int = 36) -> Drawing:
    """Return at most `frames` pictures over one input turn.

    Once contacts are solved these are solved positions, with the forces on the discs as arrows; nothing is solved here.
    """
    design = stages.design
    if "contact" not in stages.__dict__:
        angles = np.linspace(0.0, 2 * np.pi, frames, endpoint=False)
        return Drawing(tuple(_frame(design, float(angle), ()) for angle in angles))
    solved = stages.contact.fine.angle[:-1]
    chosen = range(0, len(solved), -(-len(solved) // frames))
    return Drawing(tuple(_frame(design, float(solved[i]), tuple(_arrows(stages, i))) for i in chosen))


def _frame(design: Design, angle: float, arrows: tuple[Arrow, ...]) -> DrawingFrame:
    pose = _pose(design, angle)
    lines = (*_ring(design), *_discs(design, pose), *_pins(design, pose), *_inside(design, pose), *_axes(design))
    return DrawingFrame(f"{np.degrees(angle):.1f}°", lines, arrows)


def _pose(design: Design, angle: float) -> Pose:
    """Return the members on their ideal paths; elastic motion is too small to be seen."""
    crank, ring = angle * design.mesh_speed, ring_angle(design, angle)
    origin, lobes = np.zeros(2), design.flank.lobes
    cranks = [crank + disc.crank for disc in design.discs]
    centers = [design.flank.eccentricity * np.array([np.cos(a + ring), np.sin(a + ring)]) for a in cranks]
    spins = [ring + disc.lead - a / lobes for a, disc in zip(cranks, design.discs, strict=True)]
    return Pose(
        Place(origin, ring),
        Place(origin, ring - crank / lobes),
        Place(origin, angle),
        tuple(Place(center, spin) for center, spin in zip(centers, spins, strict=True)),
        tuple(Place(center, a + ring) for center, a in zip(centers, cranks, strict=True)),
        tuple(Place(center, design.cage_angle(crank) + ring) for center in centers),
    )
