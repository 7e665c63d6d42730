"""The words at the head of the report: what drive this is, its main data, and what its numbers leave out."""

from __future__ import annotations

import math

from trochoid.drives.exact import RPM, millimetres
from trochoid.drives.indexer.stages import Stages
from trochoid.drives.indexer.words import path_words
from trochoid.results.outcome import Quantity
from trochoid.scene.drive_indexer import IndexerScene

ABSENT_EFFECTS = {
    "elastic_contact": (
        "Pin and slot are rigid: the soft shock is a jump of the acceleration, where a real wheel swings; there is no "
        "contact pressure, no stiffness and no residual vibration after the stop."
    ),
    "clearance": (
        "The pin fits its slot without play: where the acceleration changes its sign a real pin goes over to the "
        "other side of the slot with a knock."
    ),
    "inertia": (
        "The wheel has no mass in the equations: pin force and reactions are those of a drive that creeps against "
        "the friction torque."
    ),
    "casing_on_mounts": "The casing stands still: there is no vibration velocity and no zone to judge it by.",
}

NEVER_SIMULATED = {
    "elasticity of teeth, arm and planet": (
        "The pin is held rigidly in its planet, and moves as the rigid train does: what is in front of it adds to the "
        "lag, and lowers the natural frequencies."
    ),
    "mass of arm and planet": (
        "Arm, planet and pin have no mass: their centrifugal forces add to the reactions and, at the arm's speed, to "
        "what shakes the casing; the input torque is that of the wheel alone."
    ),
    "friction in the slot": "The pin pushes along the normal of the slot; sliding takes no power and no tooth force.",
    "separating forces of the teeth": (
        "The bevel teeth push along the pitch circle only: their pressure angle adds to the planet's bearing load."
    ),
    "the lock": (
        "What holds the wheel in its dwell is not in the picture; the reactions are those of the index alone. On the "
        "casing it acts as a torque about the wheel's axis."
    ),
}


def title(stages: Stages) -> str:
    """Return the name of the drive, as in "Spherical indexer 90°, hypotrochoid i = 4"."""
    drive = stages.scene.drive
    return f"Spherical indexer {math.degrees(drive.swing_angle):g}°, {drive.train}trochoid i = {drive.ratio}"


def facts(stages: Stages) -> dict[str, Quantity]:
    """Return the main data of the drive, in the engineer's units."""
    made, path = stages.design, stages.design.indexer.path
    wheel = f"{made.slots} slots" if made.closes else "no whole number of slots"
    return {
        "Swing": Quantity(math.degrees(made.drive.swing_angle), "deg"),
        "Wheel": Quantity(wheel),
        "Shafts at": Quantity(math.degrees(made.drive.axis_angle), "deg"),
        "Pin path": Quantity(path_words(made.chosen)),
        "Arm angle γ": Quantity(math.degrees(path.arm), "deg"),
        "Pin angle β": Quantity(math.degrees(path.pin), "deg"),
        "Pin ratio ρ": Quantity(path.pin_ratio),
        "Relative turning time k": Quantity(made.indexer.duration),
        "Sphere radius": Quantity(float(millimetres(made.drive.sphere_radius)), "mm"),
        "Input speed": Quantity(made.speed / RPM, "rpm"),
        "Indices per minute": Quantity(made.speed / RPM),
    }


def not_simulated(scene: IndexerScene) -> dict[str, str]:
    """Return each effect that is not in the equations with what its absence means: unlisted ones first."""
    return {name: said for name, said in ABSENT_EFFECTS.items() if not scene.has(name)} | NEVER_SIMULATED
