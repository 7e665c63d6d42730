"""What yields in a scene of a precessional drive, the steady motion that follows, and what it changes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.drives.precessional.bearings import (
    Carried,
    Joints,
    bearings_of,
    joints,
    seats,
    speeds,
    unsized,
)
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.elastic import Elastic, respond
from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.members import Bodies, bodies
from trochoid.drives.precessional.reactions import reactions
from trochoid.drives.precessional.tooth_loads import ToothLoads
from trochoid.drives.rolling import Held
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array
from trochoid.scene.drive_precessional import OutputBearing

STEPS, SETTLED = (
    40,
    1e-6,
)  # of loads and stiffnesses in turn; relative change of the stiffness when they agree
POSITIONS = 16  # over a period of the reactions, for their mean


@dataclass(frozen=True, slots=True)
class Yielding:
    """Joints, members on them with the casing held still, and the steady motion: `elastic`."""

    joints: Joints
    bodies: Bodies
    elastic: Elastic


def yielding(design: Design, drive: PrecessionalDrive, factor: float = 1.0) -> Yielding:
    """Return joints and steady motion; all stiffnesses are multiplied by `factor`.

    Rolling bearings that carry what the members' inertia asks for are taken under the mean elastic reactions: joints
    and motion are found in turn until stiffness and load agree. Raises NotConverged where they do not.
    """
    angle, change = period(drive), 0.0
    loads, seated = Carried.by(reactions(drive, angle, design.speed)), seats(design)
    held = joints(design, loads, seated)
    for _ in range(STEPS):
        made = bodies(drive, design.speed, design.shaft_shape, held.times(factor), output_mass(design))
        found = respond(drive, made, design.speed, design.scene.operation.damping_ratio)
        if not depends_on_load(held):
            return Yielding(held.times(factor), made, found)
        loads = Carried.by(found.reactions(angle))
        new = joints(design, loads, seated)
        change, held = _change(held, new), new
        if change <= SETTLED:
            return Yielding(held.times(factor), made, found)
    from trochoid.drives.precessional.modes import fail_if_unstable

    fail_if_unstable(Yielding(held.times(factor), made, found), design.speed)
    raise NotConverged(
        f"bearings: stiffness and load still change each other by {change:.1e} after {STEPS} steps; give the bearings' "
        f"radial_load, or smaller clearances"
    )


def bearings_over_period(
    design: Design, drive: PrecessionalDrive, found: Yielding, teeth: ToothLoads | None = None
) -> dict[str, tuple[Held, ...]]:
    """Return the rolling bearings of A, B and C under the elastic reactions over a period.

    With what `teeth` put on them besides, the load is known, and neither `radial_load` nor `moment_load` stands for it.
    """
    loads = Carried.by(found.elastic.reactions(period(drive)))
    if teeth is not None:
        loads = loads.beside(teeth)
    d, turning = design.scene.drive, speeds(design)
    still = np.zeros_like(loads.b_moment)
    made = {}
    for joint, table, push, moment, tilts in (
        (found.joints.a, d.bearing_a, loads.a, still, False),
        (found.joints.b, d.bearing_b, loads.b, loads.b_moment, True),
        (found.joints.c, d.bearing_c, loads.c, still, False),
    ):
        if joint is None or table is None or not joint.bearings:
            continue
        share = push / table.number if isinstance(table, OutputBearing) else push
        whole = np.concatenate([share, np.zeros((len(push), 1)), moment], axis=1)
        carrying = table if teeth is None else unsized(table)
        over = bearings_of(joint.name, carrying, whole, tilts, None, turning[joint.name])
        made[joint.name] = tuple(
            replace(one, seat=at.seat) for one, at in zip(over, joint.bearings, strict=True)
        )
    return made


def depends_on_load(held: Joints) -> bool:
    """Whether a rolling bearing's stiffness follows from the members' reactions."""
    return any(one.table.radial_load is None for joint in held.all for one in joint.bearings)


def _change(old: Joints, new: Joints) -> float:
    """Return the largest relative change of a joint's stiffness along a motion."""
    found = [0.0]
    for one, other in zip(old.all, new.all, strict=True):
        was, now = np.diag(one.stiffness), np.diag(other.stiffness)
        held = now > 0.0
        found.append(float(np.abs(was[held] / now[held] - 1.0).max(initial=0.0)))
    return max(found)


def period(drive: PrecessionalDrive) -> Array:
    """Angles of the input shaft evenly over a period of the reactions."""
    return np.asarray(drive.reaction_period * np.arange(POSITIONS) / POSITIONS)


def output_mass(design: Design) -> float:
    """Mass of the output shaft, kg, 0 where it is not given."""
    shaft = design.scene.drive.output_shaft
    return 0.0 if shaft is None else shaft.mass
