"""The words at the head of the report: what drive this is, its main data, and what its numbers leave out."""

from __future__ import annotations

from trochoid.drives.exact import RPM, millimetres
from trochoid.drives.planetary.stages import Stages
from trochoid.results.outcome import Quantity
from trochoid.scene.drive_planetary import PlanetaryScene

ABSENT_EFFECTS = {
    "elastic_contact": (
        "Teeth and bodies are rigid: there is no load sharing between pairs of teeth, no mesh stiffness, no pressure, "
        "and the first and last contact of a pair are those of the unloaded flanks."
    ),
    "bearing_compliance": (
        "Sun, carrier, ring and the planets' seats stay in their places: nothing floats, and errors load planets more "
        "than in a set whose sun finds its own place."
    ),
    "position_errors": "All planets stand in their ideal places, and share the torque evenly.",
    "clearance": "Flanks have no tip relief: tip edges meet the other flanks early and late, under high pressure.",
    "inertia": (
        "No member has mass in the equations: planets do not press outward on their bearings, and forces are those of "
        "a set that creeps."
    ),
    "casing_on_mounts": "The casing stands still: there is no vibration velocity and no zone to judge it by.",
}

NEVER_SIMULATED = {
    "errors of pitch, run-out and profile": "All teeth are alike: their errors add to the transmission error.",
    "load over the face width": (
        "Teeth carry evenly over the face width: misalignment and the twist of the wheels load one end more."
    ),
    "elasticity of carrier, shafts and casing": (
        "The set finds them rigid but for the springs of the scene: what these leave out adds to the wind-up here."
    ),
    "bolts and feet of the ring": (
        "The ring's outer edge is fixed all round, or its torque is taken evenly: a ring held at a few places yields "
        "between them."
    ),
    "roundness of bores under load": "Bores of sun and planets keep their shape: thin planets on rollers yield more.",
    "friction": "Forces are normal to the flanks: nothing is lost, and the torques are those of the ratio.",
    "temperature": "All members are equally warm: thermal growth takes up none of the play.",
}


def title(stages: Stages) -> str:
    """Return the name of the drive, as in "Planetary set 2K-H 20/30/80"."""
    d = stages.scene.drive
    return f"Planetary set 2K-H {d.z_sun}/{d.z_planet}/{d.z_ring}"


def facts(stages: Stages) -> dict[str, Quantity]:
    """Return the main data of the drive, in the engineer's units; runs no more than the kinematics."""
    scene, d, found = stages.scene, stages.scene.drive, stages.speeds
    speed = scene.operation.input_speed
    output = speed / float(found.ratio)
    return {
        "Teeth sun / planet / ring": Quantity(f"{d.z_sun} / {d.z_planet} / {d.z_ring}"),
        "Planets": Quantity(float(d.planets)),
        "Ratio": Quantity(float(found.ratio)),
        "Fixed": Quantity(d.fixed),
        "Input / output": Quantity(f"{d.driving} / {d.driven}"),
        "Module": Quantity(float(millimetres(d.module)), "mm"),
        "Centre distance": Quantity(float(millimetres(d.center_distance)), "mm"),
        "Face width": Quantity(float(millimetres(d.face_width)), "mm"),
        "Input speed": Quantity(speed / RPM, "rpm"),
        "Output speed": Quantity(output / RPM, "rpm"),
        "Output torque": Quantity(scene.operation.output_torque, "N*m"),
        "Power": Quantity(1e-3 * scene.operation.output_torque * abs(output), "kW"),
    }


def not_simulated(scene: PlanetaryScene) -> dict[str, str]:
    """Return each effect that is not in the equations with what its absence means: unlisted ones first."""
    elastic = scene.has("elastic_contact")
    unlisted = {
        name: said
        for name, said in ABSENT_EFFECTS.items()
        if not scene.has(name) and (elastic or name in ("elastic_contact", "inertia"))
    }
    never = dict(NEVER_SIMULATED)
    if scene.drive.lead is not None:
        never["load over the face width"] = (
            "Only the face load factor knows of it: all other answers take teeth that carry evenly. Slices are coupled "
            "by the rotation of the wheels alone: too much falls on the end that touches first."
        )
    return unlisted | never
