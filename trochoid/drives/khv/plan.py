"""Which stages each quantity needs, and what they cost before anything runs."""

from __future__ import annotations

from trochoid.drives.planning import casing_cost, with_casing, with_supports
from trochoid.plan import Plan, PlannedStage
from trochoid.scene.drive_khv import KhvScene
from trochoid.scene.effects import AnyEffect, Friction

_CONTACT = ("kinematics", "geometry", "mesh", "bodies", "contact")

STAGES_OF: dict[str, tuple[str, ...]] = {
    "ratio": ("kinematics",),
    "member_speeds": ("kinematics",),
    "profile": ("kinematics", "geometry"),
    "geometry_quality": ("kinematics", "geometry"),
    "contact_ratio": ("kinematics", "geometry"),
    "load_sharing": _CONTACT,
    "contact_force_max": _CONTACT,
    "contact_pressure_max": _CONTACT,
    "stress_max": (*_CONTACT, "stress"),
    "transmission_error": _CONTACT,
    "torsional_stiffness": _CONTACT,
    "lost_motion": (*_CONTACT, "torsion"),
    "backlash": (*_CONTACT, "torsion"),
    "torsion_curve": (*_CONTACT, "torsion"),
    "efficiency": (*_CONTACT, "losses"),
    "power_loss": (*_CONTACT, "losses"),
    "bearing_loads": _CONTACT,
    "bearing_stiffness": (*_CONTACT, "bearing"),
    "bearing_life": _CONTACT,
    "reactions": (*_CONTACT, "mass", "reactions"),
    "balance": ("kinematics", "geometry", "mass"),
    "natural_frequencies": (*_CONTACT, "mass", "modes"),
    "torsional_vibration": (*_CONTACT, "mass", "torsional"),
    "vibration_velocity": (*_CONTACT, "mass", "reactions", "vibration"),
    "vibration_zone": (*_CONTACT, "mass", "reactions", "vibration"),
    "mass": ("kinematics", "geometry", "mass"),
}

WHY = {
    "kinematics": "members, speeds, profile",
    "geometry": "can it be made: undercut, walls, collisions",
    "mass": "masses and inertias from exact outlines",
    "mesh": "second-order triangles, on two levels for the error",
    "bodies": "factor of each distinct disc, its compliance at every facet",
    "contact": "all contacts together at every position, on both levels",
    "torsion": "torque-twist loop at held input, at a few angles",
    "losses": "the running drive with friction",
    "stress": "von Mises field at one position",
    "bearing": "stiffness of the eccentric bearing under its load",
    "reactions": "bearing reactions over a turn, rigid and elastic",
    "modes": "natural frequencies, Campbell diagram",
    "torsional": "torsional vibration by harmonic balance, and over the speed",
    "vibration": "velocity of the casing on its mounts",
}

POSITION = {
    "springs": 2e-3,
    "level0": 6.5e-3,
    "strips": 9e-3,
}  # seconds for 20 pins, 8 holes, 16 rollers and two discs


def rolls(scene: KhvScene) -> bool:
    """Whether rolling bearings hold shaft or flange."""
    tables = (scene.drive.input_shaft.bearing, scene.drive.output_flange.bearing)
    return scene.has("bearing_compliance") and tables != (None, None)


def seats(scene: KhvScene) -> int:
    """Return how many of their tables have a flexible seat."""
    tables = (scene.drive.input_shaft.bearing, scene.drive.output_flange.bearing)
    return sum(1 for table in tables if table is not None and table.seat is not None)


def plan(scene: KhvScene, rung: str, facets: int) -> Plan:
    """Return what a run would do; `facets` per lobe of the coarser of the two levels it would start with."""
    why, stages_of = with_supports(rolls(scene), *with_casing(scene, WHY, STAGES_OF, ("mass",)))
    needed = {stage for name in scene.ask.quantities for stage in stages_of[name]}
    if rung == "springs":
        needed -= {"mesh", "bodies"}
    d = scene.drive
    stations = facets * (d.lobes + 0.6 * d.output_pins.count + 2) * (1 if rung != "springs" else 0)
    contacts = d.discs * (d.pins + d.output_pins.count + d.eccentric_bearing.rollers) / 88
    positions = scene.ask.positions + 1
    rubs = scene.friction is not None and {"torsion", "losses"} & needed
    seconds = {
        "mesh": 1e-4 * stations + 0.15,
        "bodies": (11e-3 if rubs else 6e-3) * stations + 1.2e-6 * stations**2,
        "contact": 2 * positions * contacts * POSITION[rung],
        "torsion": contacts * (3.0 if scene.friction is not None else 0.5),
        "losses": contacts * 0.7,
        "stress": 0.35 * d.discs,
        "supports": 0.7 + 0.5 * seats(scene),
        "reactions": 0.1,
        "modes": 0.05,
        "torsional": 2.0,
        "vibration": 0.02,
    }
    casing_seconds, casing_memory = casing_cost(scene)
    seconds |= casing_seconds
    memory = casing_memory | {"bodies": 120 + 4e-4 * stations**2, "contact": 150 + 4e-4 * stations**2}
    stages = tuple(
        PlannedStage(name, said, seconds.get(name, 0.01), memory.get(name, 100.0), name in needed)
        for name, said in why.items()
    )
    return Plan(stages, tuple(map(_named, scene.effects)), scene.ask.quantities, rung)


def _named(effect: AnyEffect) -> str:
    """Return an effect as the plan shows it, its coefficients with it."""
    if not isinstance(effect, Friction):
        return effect.type
    return f"{effect.type} (ring_pins {effect.ring_pins:g}, output_pins {effect.output_pins:g})"
