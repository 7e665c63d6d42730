"""The words at the head of the report: what drive this is, its main data, and what its numbers leave out."""

from __future__ import annotations

import math

from trochoid.drives.exact import RPM, millimetres
from trochoid.drives.precessional.stages import Stages
from trochoid.results.outcome import Quantity
from trochoid.scene.drive_precessional import PrecessionalScene

ABSENT_EFFECTS = {
    "elastic_contact": (
        "The teeth are rigid: no load sharing, no contact pressure, no stiffness, and the output torque loads nothing."
    ),
    "pin_compliance": "Rollers are rigid, and so are their pins.",
    "clearance": "Rollers are straight and as thick as the flanks are cut for: no crown, no lost motion of the teeth.",
    "inertia": "No member has mass in the equations: there are no reactions and there is no vibration.",
    "bearing_compliance": (
        "All members and joints are rigid: no elastic motion feeds back into the reactions, and the only natural modes "
        "are those of the casing on its mounts."
    ),
    "casing_on_mounts": "The casing stands still: there is no vibration velocity and no zone to judge it by.",
}

NEVER_SIMULATED = {
    "torque and inertia together": (
        "Reactions and vibration are those of inertia alone, whose tooth load acts as one force at the middle of the "
        "teeth on the instantaneous axis. Contacts and bearing loads are those of the output torque alone."
    ),
    "friction": "Teeth, joints and bearings have no friction: no losses and no efficiency.",
    "shocks": "Nothing strikes on reversal, and the bearings' play is in their stiffness alone.",
    "elasticity of shafts, teeth and casing": (
        "Shafts, the member with the pins, the hub and the casing's seats are rigid, pins but for "
        "rollers.seat_stiffness: of members only the toothed rim and the rollers yield, in the contacts alone; "
        "reactions and modes know springs in A, B, O, C and the mounts."
    ),
    "uneven output": "The joint at O is a constant-velocity one that gives way along z: it holds the satellite "
    "without a moment across its axis, but for half of the tilting moment that the output torque has there.",
    "manufacturing errors": "Pins and lobes are alike and in place.",
}

ELASTIC = (
    "Elastic: the small motion of satellite and shafts on their joints about the steady nutation, with gyroscopic and "
    "centrifugal terms, driven by the exact rigid loads; its inertia adds to the reactions, and with stiffnesses that "
    "grow nothing of it is left. The casing stands still in it. Taken as constant: the satellite's inertia (its mean "
    "about OA) and the bearings' stiffness under the mean load; what steady loads add to stiffnesses is left out."
)

MODELS = (
    "Rigid: Newton's and Euler's equations of all members, with a tooth force that does no work. Printed: the "
    "equations as the paper has them, which leave out the gyroscopic terms of the satellite and the tooth force. "
    "Forces of A, B and O are in the frame of the input shaft."
)


def notes(stages: Stages) -> dict[str, str]:
    """Say what the models of the reactions are."""
    said = {"Rigid and printed reactions": MODELS}
    if stages.elastic is None:
        return said
    from trochoid.drives.precessional.answers_dynamics import most_changed

    return said | {"Elastic reactions": f"{ELASTIC} {most_changed(stages)}"}


def title(stages: Stages) -> str:
    """Return the name of the drive, as in "Precessional drive K-H-V 15/14"."""
    drive = stages.scene.drive
    return f"Precessional drive K-H-V {drive.z_wheel}/{drive.z_satellite}"


def facts(stages: Stages) -> dict[str, Quantity]:
    """Return the main data of the drive, in the engineer's units; runs no more than the kinematics."""
    scene, made = stages.scene, stages.design
    operation, tooth, teeth = scene.operation, made.tooth, made.teeth
    found = {
        "Wheel / satellite": Quantity(f"{scene.drive.z_wheel} / {scene.drive.z_satellite}"),
        "Ratio": Quantity(float(made.nutation.ratio)),
        "Nutation angle θ": _degrees(made.nutation.angle),
    }
    if tooth is not None and teeth is not None:
        found |= {
            "Pins": Quantity(f"{tooth.pins} on the {teeth.pins_on}"),
            "Lobes": Quantity(f"{tooth.lobes}, {'outside' if tooth.hole else 'inside'} the pins"),
            "Polar angle of the pins α": _degrees(tooth.polar_angle),
            "Half angle of a pin r": _degrees(tooth.pin_angle),
            "Teeth from O": Quantity(
                f"{millimetres(teeth.inner_radius)} … {millimetres(teeth.outer_radius)} mm"
            ),
        }
    return found | {
        "Input speed": Quantity(operation.input_speed / RPM, "rpm"),
        "Output speed": Quantity(made.output_speed / RPM, "rpm"),
        "Output torque": Quantity(operation.output_torque, "N*m"),
        "Power": Quantity(1e-3 * operation.output_torque * abs(made.output_speed), "kW"),
    }


def not_simulated(scene: PrecessionalScene) -> dict[str, str]:
    """Return each effect that is not in the equations with what its absence means: unlisted ones first."""
    unlisted = {name: said for name, said in ABSENT_EFFECTS.items() if not scene.has(name)}
    return unlisted | NEVER_SIMULATED


def _degrees(angle: float) -> Quantity:
    return Quantity(float(f"{math.degrees(angle):.12g}"), "deg")
