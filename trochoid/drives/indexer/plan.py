"""Which stages each quantity needs, and what they cost before anything runs."""

from __future__ import annotations

from trochoid.clock import Clock
from trochoid.drives.indexer.stages import Stages
from trochoid.drives.planning import planned, with_casing
from trochoid.plan import Plan
from trochoid.scene.drive_indexer import IndexerScene

_GEOMETRY = ("synthesis", "geometry")
_FORCES = (*_GEOMETRY, "mass", "forces")
_CONTACT = (*_FORCES, "bodies", "contact")
_MARCH = (*_CONTACT, "march")

STAGES_OF: dict[str, tuple[str, ...]] = {
    "ratio": ("synthesis",),
    "member_speeds": ("synthesis", "motion"),
    "indexing_motion": ("synthesis", "motion"),
    "solutions": ("synthesis",),
    "profile": _GEOMETRY,
    "geometry_quality": ("synthesis", "motion", "geometry"),
    "contact_force_max": _FORCES,
    "contact_pressure_max": _CONTACT,
    "mesh_stiffness": _CONTACT,
    "torsional_stiffness": _CONTACT,
    "dynamic_factor": _MARCH,
    "residual_vibration": _MARCH,
    "natural_frequencies": (*_CONTACT, "modes"),
    "reactions": (*_FORCES, "reactions"),
    "vibration_velocity": (*_FORCES, "vibration"),
    "vibration_zone": (*_FORCES, "vibration"),
    "mass": (*_GEOMETRY, "mass"),
}

WHY = {
    "synthesis": "all pin paths without hard shock, and the one chosen",
    "motion": "peaks and constants of the wheel's motion, beside a Geneva wheel's",
    "geometry": "can it be made: length of slots, walls, hub",
    "mass": "mass and inertia of the wheel",
    "forces": "pin force, mesh force and input torque over an index",
    "bodies": "slotted wheel and pin as finite elements: meshed, factored, pressed along a slot",
    "contact": "pin and wall of the slot as elastic bodies: pressure and stiffness over an index",
    "march": "the elastic wheel over an index and its dwell, marched in steps of its shortest period",
    "reactions": "loads on teeth, bearings and input over a turn, by model",
    "modes": "natural frequencies of the output at frozen positions",
    "vibration": "velocity of the casing on its mounts over a turn of the arm",
}


def plan(scene: IndexerScene) -> Plan:
    """Return what a run would do; raises Infeasible when no pin path serves or the wheel cannot be built."""
    meshed = scene.has("elastic_contact") and scene.accuracy.model != "rigid_wheel"
    elastic = ", half-spaces and a march in time" if scene.has("elastic_contact") else ""
    if meshed:
        elastic = ", finite elements of wheel and pin, a march in time"
    bodies = 4.0 if meshed else 0.0
    stages_of = dict(STAGES_OF)
    if scene.has("elastic_contact") and scene.has("inertia"):
        stages_of["reactions"] = (*_MARCH, "reactions")
        for name in ("vibration_velocity", "vibration_zone"):
            stages_of[name] = (*_MARCH, "vibration")
    why, stages_of = with_casing(scene, WHY, stages_of)
    made = planned(
        scene,
        why,
        stages_of,
        {"synthesis": 0.03, "bodies": bodies, "contact": 0.7, "march": 2.5, "vibration": 0.3},
        f"closed forms{elastic}",
    )
    stages = Stages(scene, Clock())
    stages.design  # noqa: B018 - raises Infeasible with what binds and the nearest swing
    if any(stage.needed and stage.name == "geometry" for stage in made.stages):
        stages.feasible  # noqa: B018 - raises Infeasible with every reason
    return made
