"""What yields in a scene of a precessional drive, the steady motion that follows, and what it changes."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.drives.precessional.bearings import Joints, joints
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.elastic import Elastic, respond
from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.members import Bodies, bodies
from trochoid.drives.precessional.reactions import reactions
from trochoid.kinematics.types import Array

POSITIONS = 16  # over a period of the reactions, for their mean


@dataclass(frozen=True, slots=True)
class Yielding:
    """Joints, members on them with the casing held still, and the steady motion: `elastic`."""

    joints: Joints
    bodies: Bodies
    elastic: Elastic


def yielding(design: Design, drive: PrecessionalDrive, factor: float = 1.0) -> Yielding:
    """Return joints and steady motion; all stiffnesses are multiplied by `factor`."""
    held = scene_joints(design, drive).times(factor)
    made = bodies(drive, design.speed, design.shaft_shape, held, output_mass(design))
    return Yielding(held, made, respond(drive, made, design.speed, design.scene.operation.damping_ratio))


def scene_joints(design: Design, drive: PrecessionalDrive) -> Joints:
    """Return the joints of the scene under the mean reactions of the rigid drive."""
    return joints(design, reactions(drive, period(drive), design.speed))


def period(drive: PrecessionalDrive) -> Array:
    """Angles of the input shaft evenly over a period of the reactions."""
    import numpy as np

    return np.asarray(drive.reaction_period * np.arange(POSITIONS) / POSITIONS)


def output_mass(design: Design) -> float:
    """Mass of the output shaft, kg, 0 where it is not given."""
    shaft = design.scene.drive.output_shaft
    return 0.0 if shaft is None else shaft.mass
