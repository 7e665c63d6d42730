"""Vibration velocity of the casing and the zone that a standard gives it."""

from __future__ import annotations

import numpy as np

from trochoid.drives.khv.design import Design
from trochoid.drives.khv.reactions import Reactions
from trochoid.drives.vibration import CasingVibration, shaken

__all__ = ["CasingVibration", "casing_vibration"]


def casing_vibration(design: Design, found: Reactions) -> CasingVibration:
    """Shake the casing on its mounts with the resultant of all forces on it; raises TrochoidError without a casing."""
    driven = "output" if design.drive.fixed == "ring" else "ring"
    speed = abs(float(design.speeds.members[driven])) * design.crank_speed
    base = design.crank_speed / (2 * np.pi)
    return shaken(design.scene, found.casing, found.casing_rigid, base, (design.crank_speed, speed))
