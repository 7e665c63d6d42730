"""Scenes of RV drives for tests: the shipped example with other values, and its discs on a coarse mesh."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np

from trochoid.drives.rv.bodies import Level, build_level, meshes
from trochoid.drives.rv.design import Design, design
from trochoid.drives.rv.series import Series, solve_series, turn_angles
from trochoid.results import Quantity
from trochoid.run import Run
from trochoid.scene import load
from trochoid.scene.drive_rv import RvScene
from trochoid.scene.needs import EFFECTS_OF

EXAMPLE = Path(__file__).parents[2] / "examples" / "rv.toml"
TEETH = 135e6  # N/m, one mesh of the example
NO_PLAY = (
    "drive.cycloid.modification.equidistant=0",
    "drive.arm_bearing.clearance=0",
    "drive.first_stage.backlash=0",
)
THREE_CRANKS = ("drive.first_stage.cranks=3", "drive.carrier.pillars.radius=10")


def listed(effects: Sequence[str]) -> str:
    """Return the override that lists these effects."""
    return "effects=[" + ", ".join(f'{{type="{name}"}}' for name in effects) + "]"


def without(*effects: str) -> tuple[str, ...]:
    """Return all effects but these."""
    return tuple(name for name in EFFECTS_OF["rv"] if name not in effects)


def scene(*overrides: str, effects: Sequence[str] = EFFECTS_OF["rv"]) -> RvScene:
    """Return the example with other values."""
    if tuple(effects) == EFFECTS_OF["rv"]:
        return load(EXAMPLE, overrides)
    return load(EXAMPLE, (listed(effects), 'ask.quantities=["ratio"]', *overrides))


def drive(*overrides: str, effects: Sequence[str] = EFFECTS_OF["rv"]) -> Design:
    """Return the example's drive with other values."""
    return design(scene(*overrides, effects=effects))


@lru_cache(maxsize=1)
def whole() -> Run:
    """Return a run of the example on a coarse mesh with few positions, asked for everything; its stages are kept."""
    few = ("accuracy.facets_per_lobe=6", "ask.positions=2", "accuracy.model=level0")
    return Run(scene(*few, "ask.stress_position=200"))


_LEVELS: dict[Hashable, Level] = {}


def level_of(made: Design, facets: int = 6) -> Level:
    """Return the discs on a coarse mesh, made once for all drives with the same discs."""
    holes = tuple((made.holes(i), made.windows(i)) for i in range(len(made.hole_angles)))
    c = made.drive.cycloid
    key = (made.flank, holes, c.bore_radius, c.face_width, made.drive.plane, facets)
    if key not in _LEVELS:
        _LEVELS[key] = build_level(made, facets, meshes(made, facets), TEETH)
    return _LEVELS[key]


def turn(made: Design, positions: int = 8, rung: str = "level0", facets: int = 6) -> Series:
    """Return contacts at a few positions over a turn of the crankshafts, its end left out."""
    angle = np.linspace(0.0, turn_angles(made, 1)[-1], positions, endpoint=False)
    return solve_series(made, rung, level_of(made, facets), angle)


def part(quantity: Quantity, *parts: str) -> float:
    """Return a number out of the parts of a quantity."""
    found = quantity
    for name in parts:
        assert found.parts is not None
        inner = found.parts[name]
        found = inner if isinstance(inner, Quantity) else Quantity(parts=inner)
    assert isinstance(found.value, float)
    return found.value
