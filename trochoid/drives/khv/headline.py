"""The words at the head of the report: what drive this is, its main data, and what its numbers leave out."""

from __future__ import annotations

from trochoid.drives.exact import RPM, millimetres
from trochoid.drives.khv.stages import Stages
from trochoid.results.outcome import Quantity
from trochoid.scene.drive_khv import KhvScene

ABSENT_EFFECTS = {
    "elastic_contact": (
        "The discs are rigid and every contact is one and the same linear spring: there is no stress field, and "
        "discs do not yield between their contacts."
    ),
    "pin_compliance": (
        "Ring pins and output rollers do not yield where they are pressed: contacts and drive come out too stiff."
    ),
    "clearance": (
        "Flanks, pins, holes and bearings fit without play and without modification, whatever the scene gives: "
        "more pins share the load than in a drive that can be assembled, and nothing is lost on reversal."
    ),
    "bearing_compliance": (
        "The bearings of eccentric, shaft and flange are rigid: the drive comes out too stiff, and no elastic "
        "motion feeds back into the reactions."
    ),
    "inertia": (
        "No member has mass in the equations: forces are those of a drive that creeps, without unbalance and "
        "without a response to it."
    ),
    "casing_on_mounts": "The casing stands still: there is no vibration velocity and no zone to judge it by.",
    "time_varying_stiffness": (
        "Torsional vibration has the mean stiffness of the contacts over the turn: nothing can excite itself."
    ),
    "backlash": (
        "In torsional vibration contacts hold on to each other where they would part: there are no jumps, and no "
        "hammering within the play."
    ),
    "friction": (
        "Contact forces are normal to the surfaces: no losses, no efficiency, no hysteresis; friction turns real "
        "contact forces by a few degrees, and with them the bearing loads."
    ),
}

NEVER_SIMULATED = {
    "friction of bearings, seals and oil": (
        "Rolling bearings, seals and the oil that is churned take nothing: a real drive loses more, most of all at "
        "low torque. Where friction is listed, it is in the torsion curve, the efficiency and what belongs to them; "
        "all other answers are those of normal forces."
    ),
    "manufacturing errors": (
        "Apart from the modification and the clearances of the scene, pins, lobes and holes are alike and in "
        "place: errors of pitch, run-out and size load some pins more and add to the transmission error."
    ),
    "temperature": "All members are equally warm: thermal growth takes up none of the clearances.",
    "bending of ring pins and output pins": (
        "Pins yield only where they are pressed, and carry evenly over the face width: long or overhung pins "
        "make a drive softer and load the discs at their edges."
    ),
    "elasticity of ring and housing": (
        "The ring keeps its pins on an exact circle, and no casing gives way under the members: a thin ring makes a "
        "drive softer and spreads the load over other pins."
    ),
    "bending and torsion of the shafts": (
        "Input shaft and output flange move in their bearings as rigid bodies: their own wind-up adds to the one "
        "computed here."
    ),
    "tilting of the discs": (
        "Discs stay in their planes: where shaft or flange tilts, the load of a disc changes, but no edge of it "
        "carries more."
    ),
}


def title(stages: Stages) -> str:
    """Return the name of the drive, as in "Cycloid drive K-H-V 20/19"."""
    drive = stages.scene.drive
    return f"Cycloid drive K-H-V {drive.pins}/{drive.lobes}"


def facts(stages: Stages) -> dict[str, Quantity]:
    """Return the main data of the drive, in the engineer's units; runs no more than the kinematics."""
    scene, drive, made = stages.scene, stages.scene.drive, stages.design
    driven = "output" if drive.fixed == "ring" else "ring"
    speed = scene.operation.input_speed
    output_speed = float(made.speeds.members[driven]) * speed
    fixed = "ring" if drive.fixed == "ring" else "output flange"
    return {
        "Pins / lobes": Quantity(f"{drive.pins} / {drive.lobes}"),
        "Ratio": Quantity(float(made.speeds.ratio)),
        "Fixed": Quantity(fixed),
        "Pin circle radius R": _mm(drive.pin_circle_radius),
        "Pin radius r": _mm(drive.pin_radius),
        "Eccentricity e": _mm(drive.eccentricity),
        "Discs": Quantity(f"{drive.discs} × {millimetres(drive.face_width)} mm"),
        "Output pins": Quantity(
            f"{drive.output_pins.count} on R {millimetres(drive.output_pins.circle_radius)} mm"
        ),
        "Input speed": Quantity(speed / RPM, "rpm"),
        "Output speed": Quantity(output_speed / RPM, "rpm"),
        "Output torque": Quantity(scene.operation.output_torque, "N*m"),
        "Power": Quantity(1e-3 * scene.operation.output_torque * abs(output_speed), "kW"),
    }


def not_simulated(scene: KhvScene) -> dict[str, str]:
    """Return each effect that is not in the equations with what its absence means: unlisted ones first."""
    unlisted = {name: said for name, said in ABSENT_EFFECTS.items() if not scene.has(name)}
    return unlisted | NEVER_SIMULATED


def _mm(length: float) -> Quantity:
    return Quantity(float(millimetres(length)), "mm")
