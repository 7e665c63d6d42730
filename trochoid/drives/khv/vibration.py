"""Vibration velocity of the casing and the zone that a standard gives it."""

from __future__ import annotations

import numpy as np

from trochoid.drives.casing import Shaken
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.reactions import Reactions, on_casing
from trochoid.drives.vibration import RIGID, CasingVibration, Load, shaken

__all__ = ["CasingVibration", "casing_vibration"]


def casing_vibration(design: Design, found: Reactions, casing: Shaken) -> CasingVibration:
    """Shake the casing on its mounts with all forces on it."""
    driven = "output" if design.drive.fixed == "ring" else "ring"
    speed = abs(float(design.speeds.members[driven])) * design.crank_speed
    base = design.crank_speed / (2 * np.pi)
    loads = {
        "elastic": Load(found.casing, lambda: on_casing(design, found, "elastic")),
        RIGID: Load(found.casing_rigid, lambda: on_casing(design, found, "rigid")),
    }
    return shaken(design.scene, casing, loads, base, (design.crank_speed, speed))
