"""What a precessional drive puts on its casing, in the fixed frame, and the vibration velocity that follows.

The vector sum of all reactions counts: under static balance only a couple remains, and the casing rocks.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.reactions import Model, Reactions, inertia_couple, reactions
from trochoid.dynamics.casing import Casing
from trochoid.dynamics.newton_euler import RotatingMass, inertia_wrench
from trochoid.dynamics.vibration import BAND, Point, Vibration, vibrate
from trochoid.dynamics.wrench import Wrench, couple, total, wrench
from trochoid.kinematics.spherical import rotation, turn
from trochoid.kinematics.types import Array


def casing_load(found: Reactions) -> Wrench:
    """Force and moment about O (n, 3), fixed frame, of all members on the casing: opposite to their reactions.

    The bearing B, the bearings of the output shaft (which pass on the force at O), the fixed wheel and the
    motor's stator.
    """
    fixed = rotation(2, found.crank)
    points = np.array([[0.0, 0.0, found.drive.support], [0.0, 0.0, 0.0]])
    forces = -np.stack((found.support, _output(found) + found.mesh), axis=1)
    moments = -(found.support_moment + found.mesh_couple + _axial(found))
    return total(
        [
            wrench(points, np.stack([turn(fixed, forces[:, i]) for i in (0, 1)], axis=1)),
            couple(turn(fixed, moments)),
        ]
    )


def places(found: Reactions) -> dict[str, Wrench]:
    """Return what the casing feels in the fixed frame, by the names of the places (needs.SEATS_OF): their sum is
    `casing_load`.
    """
    fixed = rotation(2, found.crank)
    support = np.array([0.0, 0.0, found.drive.support])

    def pressed(force: Array, moment: Array, at: Array) -> Wrench:
        load = wrench(at[None], turn(fixed, -force)[:, None])
        return total([load, couple(turn(fixed, -moment))])

    nothing, origin = 0.0 * found.support, np.zeros(3)
    return {
        "fixed wheel": pressed(found.mesh, found.mesh_couple, origin),
        "bearing B": pressed(found.support, found.support_moment, support),
        "bearings C": pressed(_output(found), nothing, origin),
        "motor": pressed(nothing, _axial(found), origin),
    }


def _output(found: Reactions) -> Array:
    return found.joint_o if found.output is None else found.output


def _axial(found: Reactions) -> Array:
    return np.stack((0.0 * found.torque, 0.0 * found.torque, found.torque), axis=-1)


def inertia_load(drive: PrecessionalDrive, crank: Array, speed: float, model: Model = "exact") -> Wrench:
    """d'Alembert's forces and couples of all members about O (n, 3), fixed frame.

    Newton's and Euler's check: the exact model's casing load is this, whatever acts inside.
    """
    fixed = rotation(2, crank)
    satellite, shaft, weight = drive.satellite, drive.shaft, drive.counterweight
    # about O: couples of satellite and shaft come from their inertia, so their masses stand at z = 0
    masses = (
        RotatingMass(satellite.mass, satellite.offset * drive.tilt[0], 0.5 * math.pi, 0.0),
        RotatingMass(shaft.mass, shaft.offset, 0.5 * math.pi, 0.0),
        RotatingMass(weight.mass, weight.radius, -0.5 * math.pi, weight.z),
    )
    products = np.array([-(shaft.product + weight.product) * speed**2, 0.0, 0.0])
    own = inertia_couple(drive, crank, speed, model) + products
    return total([inertia_wrench(masses, crank, speed), couple(turn(fixed, own))])


def closed_record(drive: PrecessionalDrive) -> Array:
    """Angles of the input shaft (n,) over which the loads close in the fixed frame, fine enough for all their lines."""
    turns = drive.nutation.closing_turns
    count = 4 * math.ceil(turns * (drive.tooth_ratio + 1.0)) + 5
    angles: Array = 2.0 * math.pi * turns * np.arange(count, dtype=np.float64) / count
    return angles


def casing_vibration(
    drive: PrecessionalDrive,
    speed: float,
    casing: Casing,
    points: Sequence[Point],
    model: Model = "exact",
    band: tuple[float, float] = BAND,
    found: Reactions | None = None,
) -> Vibration:
    """Vibration of the rigid casing (centre from O) at the constant speed ω_3 (rad/s) of the input shaft.

    `found`: reactions over `closed_record` by another model.
    """
    found = reactions(drive, closed_record(drive), speed, model) if found is None else found
    base = speed / (2.0 * math.pi * drive.nutation.closing_turns)
    vibration = vibrate(casing, casing_load(found), base, points, band)
    return replace(vibration, warnings=())  # these loads have three lines, all of them resolved
