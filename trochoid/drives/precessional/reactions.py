"""Dynamic reactions of a precessional K-H-V drive over a turn of its input shaft (sources §2).

Bodies: 1 the fixed wheel, 2 the satellite, which turns about O with its axis OA inclined by the nutation angle
θ, 3 the input shaft, 4 the output shaft, which a plunging constant-velocity joint at O holds to the satellite,
5 the counterweight.  All vectors are in the frame of the input shaft: z along it, y towards A, so that
n = (0, s, c) is the satellite's axis; φ is the shaft's angle and f = φ_2r = −q φ the satellite's about OA.

Two models of the satellite's inertia couple about O:

    exact     M = J ε + ω × J ω, and a tooth force along x at a point of the instantaneous axis (workless)
    printed   M = J ε: equations (10)–(14), (19)–(24) of the paper, without the Euler terms and the tooth force

Both have ω = ω_3 (k − q n): the paper's (2) prints the modulus of the relative speed, (9) carries its sign.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from trochoid.drives.precessional.mechanism import PrecessionalDrive, mass_moments
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.spherical import rotation, turn
from trochoid.kinematics.types import Array, frozen

Model = Literal["exact", "printed", "elastic"]


@dataclass(frozen=True, eq=False, slots=True)
class Reactions:
    """Reactions over the shaft angles `crank` (n,), in the frame of the shaft; forces (n, 3), N.

    `joint_a` and `joint_o` act on the satellite, from the shaft and from the output shaft; `support` and
    `support_moment` (n, 3), N·m, on the shaft, from the casing; `torque` (n,) on it from the motor; `mesh` and
    `mesh_couple` (n, 3), about O, on the satellite from the fixed wheel: both 0 in the printed model.  `output` is
    what the bearings C give the output shaft, `joint_o` where that has no motion of its own.
    """

    drive: PrecessionalDrive
    crank: Array
    speed: float
    model: Model
    joint_a: Array
    joint_o: Array
    support: Array
    support_moment: Array
    torque: Array
    mesh: Array
    mesh_couple: Array
    output: Array | None = None

    def magnitude(self, name: str) -> Array:
        """R_A, R_B, R_O in N, M_B and M_3 in N·m, (n,): (25), (26) with M_B = √(M_Bx² + M_By²); M_3 has its sign."""
        vector = self.vector(name)
        if vector.ndim == 1:
            return vector
        size: Array = np.linalg.norm(vector, axis=1)
        return size

    def vector(self, name: str) -> Array:
        """R_A, R_B, R_O, M_B (n, 3), M_3 (n,)."""
        vectors = {
            "R_A": self.joint_a,
            "R_B": self.support,
            "R_O": self.joint_o,
            "M_B": self.support_moment,
            "M_3": self.torque,
        }
        if name not in vectors:
            raise TrochoidError(f"no reaction {name!r}: take one of {', '.join(vectors)}")
        return vectors[name]


def inertia_couple(
    drive: PrecessionalDrive,
    crank: npt.ArrayLike,
    speed: float,
    model: Model = "exact",
    acceleration: float = 0.0,
) -> Array:
    """d'Alembert's couple −M (n, 3) of the satellite about O, N·m, in the frame of the shaft.

    `speed` ω_3 in rad/s and `acceleration` α_3 in rad/s²: ε = α_3 (k − q n) + ω_3 k × (−q ω_3 n).
    """
    q, k, n = drive.tooth_ratio, np.array([0.0, 0.0, 1.0]), np.array([0.0, *drive.tilt])
    pose = rotation(0, -drive.nutation.angle) @ rotation(2, -q * np.atleast_1d(np.asarray(crank, np.float64)))
    to_body = np.swapaxes(pose, -1, -2)
    inertia = np.asarray(drive.satellite.inertia)
    twist = turn(to_body, acceleration * (k - q * n) - q * speed**2 * np.cross(k, n))
    couple = inertia * twist
    if model == "exact":
        spin = turn(to_body, speed * (k - q * n))
        couple = couple + np.cross(spin, inertia * spin)
    elif model != "printed":
        raise TrochoidError(f"model = {model!r}: take 'exact' or 'printed'")
    return -turn(pose, couple)


def reactions(
    drive: PrecessionalDrive, crank: npt.ArrayLike, speed: float, model: Model = "exact"
) -> Reactions:
    """Reactions at the shaft angles `crank` (n,), rad, and the constant speed ω_3, rad/s."""
    angle = np.atleast_1d(np.asarray(crank, dtype=np.float64))
    s, c = drive.tilt
    couple = inertia_couple(drive, angle, speed, model)
    side = np.array([0.0, c, -s])
    lever, radius = tooth_couple(drive), drive.mesh_radius
    teeth = (
        np.zeros(angle.size) if model == "printed" else -(couple @ [0.0, s, c]) / float(lever @ [0.0, s, c])
    )
    push = teeth / radius  # along x
    x_a = -(couple @ side + teeth * float(lever @ side)) / drive.joint  # (14), where cos θ cancels
    y_a = couple[:, 0] / (drive.joint * c)  # (13)
    satellite, shaft, weight = (size * speed**2 for size in mass_moments(drive))
    y_b = y_a - shaft + weight  # (20)
    products = (
        drive.shaft.product + drive.counterweight.product - mass_moments(drive)[2] * drive.counterweight.z
    )
    m_x = -y_a * drive.joint * c + y_b * drive.support + products * speed**2  # (22), I_yz = +∫yz dm
    m_y = x_a * (drive.joint * c - drive.support)  # (23)
    zero = np.zeros(angle.size)
    return Reactions(
        drive=drive,
        crank=frozen(angle),
        speed=speed,
        model=model,
        joint_a=_columns(x_a, y_a, zero),
        joint_o=_columns(-x_a - push, -y_a - satellite, zero),  # (10) with the tooth force, (11)
        support=_columns(x_a, y_b, zero),  # (19), (20), (21)
        support_moment=_columns(m_x, m_y, zero),
        torque=frozen(-x_a * drive.joint * s),  # (24)
        mesh=_columns(push, zero, zero),
        mesh_couple=frozen(teeth[:, None] * lever),
    )


def tooth_couple(drive: PrecessionalDrive) -> Array:
    """Moment (3,) about O of a unit force along x at the unit distance on the instantaneous axis, on the side z > 0."""
    (s, c), q = drive.tilt, drive.tooth_ratio
    axis = np.array([0.0, -q * s, 1.0 - q * c])
    axis *= math.copysign(1.0, axis[2]) / float(np.linalg.norm(axis))
    return np.array([0.0, axis[2], -axis[1]])


def _columns(x: Array, y: Array, z: Array) -> Array:
    return frozen(np.stack((x, y, z), axis=-1))
