"""Indexer scenes for the tests."""

from __future__ import annotations

from trochoid.run import Run
from trochoid.scene import read
from trochoid.scene.overrides import Override

TEXT = """
[drive]
type = "indexer"
ratio = 4
train = "hypo"
swing_angle = 90
axis_angle = 90
{free}

[operation]
input_speed = "10 rad/s"
output_torque = 2

[[effects]]
type = "inertia"

[ask]
quantities = ["ratio"]
positions = 12
"""


def run_of(free: str = "relative_turning_time = 0.2902", *overrides: str | Override) -> Run:
    """Return a run of the orthogonal 90° task with another k, ρ or place, and with overrides."""
    return Run(read(TEXT.format(free=free), overrides))
