"""Which stages each quantity needs, and what they cost."""

from __future__ import annotations

from fractions import Fraction

from trochoid.drives.planning import planned, with_casing
from trochoid.plan import Plan
from trochoid.scene.drive_precessional import PrecessionalScene

_BUILT = ("kinematics", "geometry")
_CONTACT = (*_BUILT, "mass", "elastic", "bodies", "contact")

STAGES_OF: dict[str, tuple[str, ...]] = {
    "ratio": ("kinematics",),
    "member_speeds": ("kinematics",),
    "profile": _BUILT,
    "geometry_quality": (*_BUILT, "penetration"),
    "contact_ratio": _BUILT,
    "load_sharing": _CONTACT,
    "contact_force_max": _CONTACT,
    "contact_pressure_max": _CONTACT,
    "transmission_error": _CONTACT,
    "mesh_stiffness": _CONTACT,
    "torsional_stiffness": _CONTACT,
    "lost_motion": (*_CONTACT, "lost motion"),
    "bearing_loads": _CONTACT,
    "bearing_stiffness": (*_BUILT, "mass", "elastic", "bearings"),
    "bearing_life": (*_BUILT, "mass", "elastic", "bearings"),
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
    "bearings": "rolling bearings under the loads of a period",
    "bodies": "toothed rim and rollers meshed and pressed, on two levels for the error",
    "contact": "all rollers and teeth together over a pitch, on both levels",
    "lost motion": "the output turned both ways under a small torque",
    "reactions": "reactions over a turn, rigid and as printed, elastic where joints yield",
    "modes": "natural frequencies, critical speeds, Campbell diagram",
    "vibration": "velocity of the casing on its mounts",
}


ELASTIC = ("bodies", "contact", "lost motion")


def _seats(scene: PrecessionalScene) -> float:
    """Return the seconds that flexible seats take."""
    d = scene.drive
    found = [d.bearing_a, d.bearing_b, d.bearing_c]
    return 0.8 * sum(1 for table in found if table is not None and table.seat is not None)


def plan(scene: PrecessionalScene) -> Plan:
    """Return what a run would do."""
    drive = scene.drive
    teeth, turns = drive.z_satellite, Fraction(drive.z_wheel, drive.z_satellite).denominator
    seconds = {
        "penetration": 0.02 + 6e-7 * teeth**2,
        "reactions": 0.02 + 1e-4 * turns,
        "vibration": 0.02 + 1.5e-3 * turns,
        "elastic": 0.1 + _seats(scene),
        "bearings": 0.2,
        "modes": 0.2,
    }
    rigid = () if scene.has("bearing_compliance") else ("elastic",)
    unheld = {name: ("mass",) if rigid and "contact" in stages else () for name, stages in STAGES_OF.items()}
    needed = {
        name: tuple(s for s in stages if s not in rigid and s not in unheld[name])
        for name, stages in STAGES_OF.items()
    }
    of_the_body = ("mass", *(("natural_frequencies",) if scene.has("casing_on_mounts") else ()))
    why, needed = with_casing(scene, WHY, needed, of_the_body)
    if not scene.has("elastic_contact"):
        return planned(
            scene, {name: said for name, said in why.items() if name not in ELASTIC}, needed, seconds
        )
    per = 0.02 if drive.teeth is None or drive.teeth.pins_on == "ring" else 0.04
    if scene.has("bearing_compliance"):  # bearings wear under the output torque, too
        needed["bearing_life"] = (*_CONTACT, "bearings")
    seconds |= {"bodies": 1.5, "contact": 2 * per * scene.ask.positions, "lost motion": 4 * per * 24}
    return planned(scene, why, needed, seconds, "slices", 400.0)
