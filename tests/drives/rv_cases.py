"""Scenes of RV drives for tests: the shipped example with other values."""

from __future__ import annotations

from pathlib import Path

from trochoid.drives.rv.design import Design, design
from trochoid.results import Quantity
from trochoid.scene import load
from trochoid.scene.drive_rv import RvScene

EXAMPLE = Path(__file__).parents[2] / "examples" / "rv.toml"


def scene(*overrides: str) -> RvScene:
    """Return the example with other values."""
    return load(EXAMPLE, overrides)


def drive(*overrides: str) -> Design:
    """Return the example's drive with other values."""
    return design(scene(*overrides))


def part(quantity: Quantity, *parts: str) -> float:
    """Return a number out of the parts of a quantity."""
    found = quantity
    for name in parts:
        assert found.parts is not None
        inner = found.parts[name]
        found = inner if isinstance(inner, Quantity) else Quantity(parts=inner)
    assert isinstance(found.value, float)
    return found.value
