"""Which stages each quantity needs, and what they cost before anything runs."""

from __future__ import annotations

from trochoid.clock import Clock
from trochoid.drives.planning import planned, with_casing, with_supports
from trochoid.drives.rv.design import design
from trochoid.drives.rv.stages import COARSEST, Stages
from trochoid.plan import Plan
from trochoid.scene.drive_rv import RvScene
from trochoid.scene.needs import NEEDS

_GEOMETRY = ("kinematics", "geometry")
_CONTACT = (*_GEOMETRY, "mesh", "teeth", "bodies", "contact")

STAGES_OF: dict[str, tuple[str, ...]] = {
    "ratio": ("kinematics",),
    "member_speeds": ("kinematics",),
    "profile": _GEOMETRY,
    "geometry_quality": _GEOMETRY,
    "contact_ratio": _GEOMETRY,
    "load_sharing": _CONTACT,
    "contact_force_max": _CONTACT,
    "contact_pressure_max": _CONTACT,
    "transmission_error": _CONTACT,
    "mesh_stiffness": (*_GEOMETRY, "teeth"),
    "torsional_stiffness": _CONTACT,
    "stiffness_breakdown": _CONTACT,
    "lost_motion": (*_CONTACT, "reversal"),
    "efficiency": (*_CONTACT, "losses"),
    "power_loss": (*_CONTACT, "losses"),
    "stress_max": (*_CONTACT, "stress"),
    "bearing_loads": _CONTACT,
    "bearing_stiffness": (*_CONTACT, "bearing"),
    "bearing_life": _CONTACT,
    "reactions": (*_CONTACT, "mass", "reactions"),
    "natural_frequencies": (*_CONTACT, "mass", "modes"),
    "vibration_velocity": (*_CONTACT, "mass", "reactions", "vibration"),
    "vibration_zone": (*_CONTACT, "mass", "reactions", "vibration"),
    "balance": (*_GEOMETRY, "mass"),
    "mass": (*_GEOMETRY, "mass"),
}

WHY = {
    "kinematics": "members, speeds, profiles",
    "geometry": "can it be made: undercut, walls, neighbours, assembly",
    "mass": "masses and inertias from exact outlines",
    "mesh": "second-order triangles, on two levels for the error",
    "teeth": "stiffness of sun and planet over a base pitch",
    "bodies": "factor of each distinct disc, its compliance at every facet",
    "contact": "all contacts together over a turn of the crankshafts, on both levels",
    "losses": "the running drive with friction, at a few angles",
    "stress": "von Mises field at one position, tension in the fillets of the teeth",
    "bearing": "stiffness of a turning-arm bearing under its load",
    "reactions": "bearing reactions over a turn of the crankshafts, rigid and elastic",
    "modes": "natural frequencies at every place of the turn",
    "vibration": "velocity of the casing on its mounts",
    "reversal": "twist under a small torque to either side, at a few angles",
}


def rolls(scene: RvScene) -> bool:
    """Whether rolling bearings of which no stiffness is given hold the crankshafts."""
    held = scene.drive.crankshaft.bearing_stiffness is None
    return held and scene.has("bearing_compliance") and scene.has("elastic_contact")


def why(scene: RvScene) -> dict[str, str]:
    """Return what the stages are for that exist with the scene's effects."""
    open_to = [name for name, needs in NEEDS["rv"].items() if all(map(scene.has, needs))]
    able = {stage for name in open_to for stage in STAGES_OF[name]}
    found, _ = with_casing(scene, {name: said for name, said in WHY.items() if name in able}, {})
    return with_supports(rolls(scene), found, {})[0]


def plan(scene: RvScene) -> Plan:
    """Return what a run would do; raises Infeasible with every reason when the drive cannot be built."""
    _, stages_of = with_supports(rolls(scene), *with_casing(scene, WHY, STAGES_OF))
    made = planned(scene, why(scene), stages_of, _seconds(scene), _model(scene), 300.0)
    if any(stage.needed and stage.name == "geometry" for stage in made.stages):
        Stages(scene, Clock()).feasible  # noqa: B018 - raises Infeasible with every reason
    return made


def _model(scene: RvScene) -> str:
    if not scene.has("elastic_contact"):
        return "closed forms"
    return scene.accuracy.model or "level0, or strips where that is not within the tolerance"


def _seconds(scene: RvScene) -> dict[str, float]:
    """Return what stages cost: stations of a disc, positions and contacts decide."""
    c, f = scene.drive.cycloid, scene.drive.first_stage
    facets = scene.accuracy.facets_per_lobe or 2 * COARSEST
    stations = facets * (c.lobes + f.cranks)
    contacts = c.discs * (c.pins + f.cranks * scene.drive.arm_bearing.rollers) / 136
    made = design(scene)
    positions = scene.ask.positions / abs(made.turning)
    slower = 1.5 if scene.accuracy.model == "strips" else 1.0
    return {
        "mesh": 1.5e-4 * stations + 0.15,
        "teeth": 8e-3 * (f.z_sun + f.z_planet) + 0.3,
        "bodies": len(made.hole_angles) * (4e-3 * stations + 0.5e-6 * stations**2),
        "contact": 1.25 * positions * slower * contacts**1.5 * 0.013,
        "losses": 2.5 * contacts,
        "reversal": 0.8 * contacts,
        "stress": 0.8 * c.discs + 0.3,
        "supports": 2.0 * contacts,
        "reactions": 0.3,
        "modes": 0.1,
        "vibration": 0.3,
    }
