"""The words at the head of the report: what drive this is, its main data, and what its numbers leave out."""

from __future__ import annotations

from trochoid.drives.exact import RPM, millimetres
from trochoid.drives.rv.stages import Stages
from trochoid.results.outcome import Quantity
from trochoid.scene.drive_rv import RvScene

ABSENT_EFFECTS = {
    "elastic_contact": (
        "All answers are those of rigid members of exact shape: there are no contact forces, no stiffness, no lost "
        "motion and no transmission error."
    ),
    "pin_compliance": "Ring pins do not yield where they are pressed: contacts and drive come out too stiff.",
    "clearance": (
        "Flanks, pins, rollers and teeth fit without play and without modification, whatever the scene gives: more "
        "pins share the load than in a drive that can be assembled, and nothing is lost on reversal."
    ),
    "bearing_compliance": (
        "Crankshafts, their bearings and the rollers of the turning-arm bearings are rigid: the drive comes out much "
        "too stiff."
    ),
    "inertia": (
        "No member has mass in the equations: forces are those of a drive that creeps, without unbalance and without a "
        "response to it."
    ),
    "friction": "Flanks and teeth slide without losses: there is no efficiency.",
    "casing_on_mounts": "The casing stands still: there is no vibration velocity and no zone to judge it by.",
}
NEVER_SIMULATED = {
    "friction of bearings, seals and oil": (
        "Rolling bearings, seals and oil take nothing: a real drive loses more, most of all at low torque. Where "
        "friction is listed it is in the efficiency and the losses; all other answers are those of normal forces, the "
        "lost motion without hysteresis."
    ),
    "carrier, ring and main bearings": (
        "They are rigid: a real carrier twists between its plates, its main bearings tilt, a thin ring gives way under "
        "its pins. All that makes a drive softer than computed here."
    ),
    "tilting of discs and rollers": "Discs stay in their planes, and rollers carry evenly over their length.",
    "teeth that change stiffness": (
        "Sun and planets are a spring of constant stiffness; what its ripple adds to the transmission error is divided "
        "by the ratio of the second stage. Their noise is not in the vibration."
    ),
    "manufacturing errors": (
        "Pins, lobes, teeth, crank holes and eccentrics are alike and in place: errors of pitch and size load some "
        "crankshafts more and add to the transmission error."
    ),
    "temperature": "All members are equally warm: thermal growth takes up none of the clearances.",
}


def title(stages: Stages) -> str:
    """Return the name of the drive, as in "RV drive 2K-V 12/36/39/40"."""
    f, c = stages.scene.drive.first_stage, stages.scene.drive.cycloid
    return f"RV drive 2K-V {f.z_sun}/{f.z_planet}/{c.lobes}/{c.pins}"


def facts(stages: Stages) -> dict[str, Quantity]:
    """Return the main data of the drive, in the engineer's units; runs no more than the kinematics."""
    scene, made = stages.scene, stages.design
    f, c = scene.drive.first_stage, scene.drive.cycloid
    speed = scene.operation.input_speed
    output_speed = float(made.speeds.members[made.driven]) * speed
    return {
        "Sun / planets": Quantity(
            f"{f.z_sun} / {f.cranks} × {f.z_planet}, module {millimetres(f.module)} mm"
        ),
        "Discs": Quantity(f"{c.discs} × {c.lobes} lobes, {millimetres(c.face_width)} mm wide"),
        "Ring pins": Quantity(f"{c.pins} of R {millimetres(c.pin_radius)} mm"),
        "Pin circle radius R": _mm(c.pin_circle_radius),
        "Eccentricity e": _mm(c.eccentricity),
        "Ratio": Quantity(float(made.speeds.ratio)),
        "Fixed": Quantity(scene.drive.fixed),
        "Driving / driven": Quantity(f"{made.driving} / {made.driven}"),
        "Input speed": Quantity(speed / RPM, "rpm"),
        "Output speed": Quantity(output_speed / RPM, "rpm"),
        "Output torque": Quantity(scene.operation.output_torque, "N*m"),
        "Power": Quantity(1e-3 * scene.operation.output_torque * abs(output_speed), "kW"),
    }


def not_simulated(scene: RvScene, solved: bool) -> dict[str, str]:
    """Return each effect that is not in the equations with what its absence means: unlisted ones first.

    Where no contacts were `solved` all else is beside the point.
    """
    if not solved:
        return {"elasticity": ABSENT_EFFECTS["elastic_contact"]}
    return {name: said for name, said in ABSENT_EFFECTS.items() if not scene.has(name)} | NEVER_SIMULATED


def _mm(length: float) -> Quantity:
    return Quantity(float(millimetres(length)), "mm")
