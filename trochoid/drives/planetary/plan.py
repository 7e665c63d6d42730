"""Which stages each quantity needs, and what they cost before anything runs."""

from __future__ import annotations

from trochoid.drives.planning import planned, with_casing, with_supports
from trochoid.plan import Plan
from trochoid.scene.drive_planetary import PlanetaryScene

_GEOMETRY = ("geometry",)
_FORCES = ("kinematics", "geometry", "forces")
_MASS = ("geometry", "profiles", "mass")

_CONTACT = ("kinematics", "geometry", "profiles", "forces", "bodies", "contact")
_DYNAMICS = (*_CONTACT, "mass", "dynamics")

STAGES_OF: dict[str, tuple[str, ...]] = {
    "ratio": ("kinematics",),
    "member_speeds": ("kinematics",),
    "profile": ("geometry", "profiles"),
    "geometry_quality": _GEOMETRY,
    "blocking_contour": ("geometry", "blocking"),
    "contact_ratio": _GEOMETRY,
    "load_sharing": _CONTACT,
    "contact_force_max": _CONTACT,
    "contact_pressure_max": _CONTACT,
    "stress_max": (*_CONTACT, "stress"),
    "transmission_error": _CONTACT,
    "mesh_stiffness": (*_CONTACT, "meshes"),
    "torsional_stiffness": _CONTACT,
    "reactions": _FORCES,
    "bearing_loads": _FORCES,
    "bearing_stiffness": _CONTACT,
    "bearing_life": _CONTACT,
    "natural_frequencies": (*_DYNAMICS, "modes"),
    "vibration_velocity": (*_DYNAMICS, "reactions", "vibration"),
    "vibration_zone": (*_DYNAMICS, "reactions", "vibration"),
    "mass": _MASS,
}

WHY = {
    "kinematics": "speeds of all members from one constraint matrix",
    "geometry": "can it be made and assembled: 23 conditions, coaxiality, neighbours",
    "profiles": "exact teeth as rack and shaper leave them",
    "blocking": "which shifts are possible, and the best that stay coaxial",
    "mass": "masses and inertias from exact outlines",
    "forces": "equilibrium of rigid members",
    "bodies": "sun, planet and ring meshed and pressed, on two levels for the error",
    "contact": "all pairs of teeth of all planets together over a pitch, on both levels",
    "meshes": "stiffness of each mesh by itself",
    "stress": "tension in the fillets of the loaded teeth",
    "face": "load over the face width of both meshes, in slices",
    "dynamics": "stiffness of all meshes on all members, on both levels",
    "reactions": "forces of the moving set over a pitch",
    "modes": "natural frequencies, Campbell diagram",
    "vibration": "velocity of the casing on its mounts",
}

MOVING = ("dynamics", "reactions", "modes", "vibration")
ELASTIC = ("bodies", "contact", "meshes", "stress", "face", *MOVING)
POSITION = {"level0": 4e-3, "strips": 7e-3}  # seconds for one planet


def rolls(scene: PlanetaryScene) -> bool:
    """Whether a rolling bearing holds each planet."""
    return scene.has("bearing_compliance") and scene.drive.planet.bearing is not None


def plan(scene: PlanetaryScene) -> Plan:
    """Return what a run would do."""
    d, positions = scene.drive, scene.ask.positions
    heavy = _MASS if scene.has("inertia") else ()  # a planet's mass presses on its bearing
    stages = {name: needed + heavy if "forces" in needed else needed for name, needed in STAGES_OF.items()}
    elastic = scene.has("elastic_contact")
    if elastic:
        stages["bearing_loads"] = (*_CONTACT, *heavy)
        if d.lead is not None:
            stages["load_sharing"] = (*_CONTACT, *heavy, "face")
        if scene.has("inertia"):
            stages["reactions"] = (*_DYNAMICS, "reactions")
    why = WHY if elastic else {name: said for name, said in WHY.items() if name not in ELASTIC}
    why, stages = with_supports(rolls(scene), *with_casing(scene, why, stages))
    model = scene.accuracy.model or "strips"
    seconds = {
        "blocking": 0.4,
        "mass": 0.02,
        "bodies": 0.3 + 0.02 * (d.z_sun + d.z_planet + d.z_ring),
        "contact": 2 * positions * d.planets * POSITION[model],
        "meshes": 4 * positions * 1e-3,
        "stress": 0.5 + 3e-3 * positions * d.planets,
        "face": 0.0 if d.lead is None else 0.15 * d.lead.slices,
        "supports": 0.3 if d.planet.bearing is None or d.planet.bearing.seat is None else 1.0,
        "dynamics": 2 * positions * d.planets * POSITION[model],
        "reactions": 0.1,
        "modes": 0.05,
        "vibration": 0.05,
    }
    named = scene.accuracy.model or "level0, or strips where that is not within the tolerance"
    return planned(
        scene, why, stages, seconds, named if elastic else "closed forms", 300.0 if elastic else 100.0
    )
