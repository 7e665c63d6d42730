"""Answers from tooth numbers alone."""

from __future__ import annotations

from trochoid.drives.exact import RPM
from trochoid.drives.planetary.stages import Stages
from trochoid.results.outcome import Quantity


def ratio(s: Stages) -> Quantity:
    """Input speed over output speed, with sign."""
    d, found = s.scene.drive, s.speeds.ratio
    whole = "" if found.denominator == 1 else f" = {found}"
    note = f"{d.driving} turns for one turn of the {d.driven}{whole}, {d.fixed} fixed"
    return Quantity(float(found), "", 0.0, "exact", note=note)


def member_speeds(s: Stages) -> Quantity:
    """Absolute speeds of all members, and the planet's on its bearing."""
    speed = s.scene.operation.input_speed / RPM
    members = {name: float(value) * speed for name, value in s.speeds.members.items()}
    members["planet_on_carrier"] = float(s.speeds.relative("planet", "carrier")) * speed
    return Quantity(parts={name: Quantity(value, "rpm", 0.0, "exact") for name, value in members.items()})
