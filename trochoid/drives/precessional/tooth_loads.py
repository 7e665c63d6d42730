"""What the output torque puts on joints and bearings through the teeth, from the forces of the contacts.

Forces on the satellite: F of the teeth, R_A and R_O.  The joint O gives way along z and passes the moment M_O; the
bearing A passes a force alone, so that about O

    OA n × R_A = −(M_teeth + M_O),   (F + R_A)·k = 0,   R_O = −F − R_A.

The shaft passes R_A on: R_B = R_A, and M = (A − B) × R_A, whose z component the motor gives.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.precessional.contact import Series
from trochoid.drives.precessional.design import Design
from trochoid.kinematics.types import Array


@dataclass(frozen=True, eq=False, slots=True)
class ToothLoads:
    """Loads (n, 3) in the crank's frame, N and N·m: A and O on the satellite, B on the shaft, its moment without z.

    `motor` (n,) is the torque of the motor on the shaft, `output_moment` (3,) what tilts the output shaft.
    """

    joint_a: Array
    joint_o: Array
    support: Array
    support_moment: Array
    motor: Array
    output_moment: Array


def tooth_loads(design: Design, series: Series) -> ToothLoads:
    """Return the loads at all positions."""
    d, n, k = design.scene.drive, series.axis, np.array([0.0, 0.0, 1.0])
    arm = d.satellite.bearing_distance
    moment = -(series.tooth_moment + series.load)  # of A about O
    across = np.cross(moment, n) / arm
    along = -(series.tooth_force[:, 2] + across[:, 2]) / n[2]
    joint_a = across + along[:, None] * n
    whole = np.cross(arm * n - d.input_shaft.bearing_distance * k, joint_a)
    motor = whole[:, 2].copy()
    whole[:, 2] = 0.0
    out = -series.load
    return ToothLoads(joint_a, -series.tooth_force - joint_a, joint_a, whole, motor, out - out[2] * k)


def spin_residual(series: Series) -> float:
    """Moment of teeth and joint O on the satellite about its own axis, over the torque; nothing else acts there."""
    off = np.abs((series.tooth_moment + series.load) @ series.axis).max()
    return float(off / abs(series.torque)) if series.torque else float(off)


def power_residual(design: Design, series: Series, loads: ToothLoads) -> float:
    """Power of the motor, of the teeth on the satellite and of the load, over the last: forces do no other work."""
    relative = design.nutation.relative_velocity
    teeth = series.tooth_moment @ relative
    out = -abs(series.torque / float(design.nutation.ratio)) * np.sign(series.torque)
    off = float(np.abs(loads.motor + teeth + out).max())
    return off / abs(out) if out else off
