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
    "reactions": (*_BUILT, "mass", "elastic", "reactions"),
    "balance": (*_BUILT, "mass"),
    "natural_frequencies": (*_BUILT, "mass", "elastic", "modes"),
    "vibration_velocity": (*_BUILT, "mass", "elastic", "vibration"),
    "vibration_zone": (*_BUILT, "mass", "elastic", "vibration"),
    "mass": _BUILT,
}

WHY = {
    "kinematics": "nutating pair, speeds, sphere tooth",
    "geometry": "can it be made: range of nutation, undercut, pins that overlap",
    "penetration": "no pin cuts into a flank at any crank angle, by brute force",
    "mass": "masses and places, static balance",
    "elastic": "bearings under their loads, steady motion of the members on them",
    "reactions": "reactions over a turn, rigid and as printed, elastic where joints yield",
    "modes": "natural frequencies, critical speeds, Campbell diagram",
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
        "elastic": 0.1,
        "modes": 0.2,
    }
    if scene.has("bearing_compliance"):
        return planned(scene, WHY, STAGES_OF, seconds)
    needed = {name: tuple(s for s in stages if s != "elastic") for name, stages in STAGES_OF.items()}
    return planned(scene, WHY, needed, seconds)
