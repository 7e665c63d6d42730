"""Which stages each quantity needs, and what they cost."""

from __future__ import annotations

from fractions import Fraction

from trochoid.drives.planning import planned
from trochoid.plan import Plan
from trochoid.scene.drive_precessional import PrecessionalScene

_BUILT = ("kinematics", "geometry")

STAGES_OF: dict[str, tuple[str, ...]] = {
    "ratio": ("kinematics",),
    "member_speeds": ("kinematics",),
    "profile": _BUILT,
    "geometry_quality": (*_BUILT, "penetration"),
    "contact_ratio": _BUILT,
    "reactions": (*_BUILT, "mass", "reactions"),
    "balance": (*_BUILT, "mass"),
    "vibration_velocity": (*_BUILT, "mass", "vibration"),
    "vibration_zone": (*_BUILT, "mass", "vibration"),
    "mass": _BUILT,
}

WHY = {
    "kinematics": "nutating pair, speeds, sphere tooth",
    "geometry": "can it be made: range of nutation, undercut, pins that overlap",
    "penetration": "no pin cuts into a flank at any crank angle, by brute force",
    "mass": "masses and places, static balance",
    "reactions": "reactions over a turn, rigid and as printed",
    "vibration": "velocity of the casing on its mounts",
}


def plan(scene: PrecessionalScene) -> Plan:
    """Return what a run would do."""
    drive = scene.drive
    teeth, turns = drive.z_satellite, Fraction(drive.z_wheel, drive.z_satellite).denominator
    seconds = {
        "penetration": 0.02 + 6e-7 * teeth**2,
        "reactions": 0.02 + 1e-4 * turns,
        "vibration": 0.02 + 1.5e-3 * turns,
    }
    return planned(scene, WHY, STAGES_OF, seconds)
