"""Each mesh of one planet by itself: its stiffness over a base pitch under an even share of the torque."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.drives.planetary.bodies import Level
from trochoid.drives.planetary.contact import Load, hands, wheel_pair
from trochoid.drives.planetary.design import Design
from trochoid.fem.gear_path import Mating, Path, base_pitch, solve_path


@dataclass(frozen=True, slots=True)
class Meshes:
    """Paths of sun and planet, and of planet and ring."""

    outer: Path
    inner: Path


def meshes(design: Design, level: Level, load: Load, positions: int) -> Meshes:
    """Solve both meshes at positions over a base pitch, centres held. Raises NotConverged."""
    return Meshes(*(solve_path(m, base_pitch(m, positions)) for m in matings(design, level, load)))


def matings(design: Design, level: Level, load: Load) -> tuple[Mating, Mating]:
    """Return both meshes of a planet under an even share of the torque."""
    d, hand = design.drive, hands(load)

    def mating(outer: bool, own: int) -> Mating:
        wheels = wheel_pair(level, outer)
        force = abs(load.sun) / (d.planets * level.wheels[0].flank.base_radius)
        return Mating(wheels, d.center_distance, force * wheels[1].flank.base_radius, own)

    return mating(True, hand[0]), mating(False, hand[1])
