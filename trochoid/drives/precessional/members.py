"""The members of a precessional drive as rigid bodies in the frame of the input shaft, their joints and their loads."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.precessional.bearings import Joint, Joints
from trochoid.drives.precessional.mechanism import PrecessionalDrive, mass_moments
from trochoid.drives.precessional.reactions import inertia_couple, tooth_couple
from trochoid.dynamics.members import Member, column, joint
from trochoid.dynamics.turning import Turning, mean_over_turn, standing, turning
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, frozen

CASING = "casing"
Shape = tuple[
    float, float, float
]  # of the input shaft: place of its centre on z; moments of inertia across and about it


@dataclass(frozen=True, eq=False, slots=True)
class Link:
    """A joint in the equations: `selection` (6, n) of the second member's motion past the first's, at `at` (3,)."""

    joint: Joint
    selection: Array
    at: tuple[float, float, float]


@dataclass(frozen=True, eq=False, slots=True)
class Bodies:
    """Members in the frame of the shaft: `matrices` of their motion (n, n), `springs` (n, n) of joints and mounts.

    `links` by name; `rows` (r, n) of all that is rigid and the `labels` of these rows: a joint and its motion, the
    "teeth", whose force is along x at a point of the instantaneous axis, and the "motor", which keeps the speed.
    """

    members: tuple[Member, ...]
    matrices: Turning
    springs: Array
    links: dict[str, Link]
    rows: Array
    labels: tuple[tuple[str, int], ...]

    @property
    def size(self) -> int:
        """Number n of coordinates."""
        return len(self.springs)


def bodies(
    drive: PrecessionalDrive,
    speed: float,
    shape: Shape,
    held: Joints,
    output_mass: float = 0.0,
    casing: tuple[Array, Array] | None = None,
) -> Bodies:
    """Assemble satellite, input shaft with counterweight, output shaft (where C yields), and the casing.

    `casing` is its mass and the stiffness of its mounts, (6, 6) about O in the fixed frame, of which the mean over a
    turn counts; without it the casing stands still.  Raises Infeasible for moments of inertia that no body has.
    """
    parts = [satellite_member(drive, speed), shaft_member(drive, speed, shape)]
    if held.c is not None:
        parts.append(
            Member("output shaft", output_mass, output_mass * 1e-6 * np.eye(3))
        )  # its rotations are held
    if casing is not None:
        parts.append(Member(CASING, float(casing[0][0, 0]), np.eye(3)))
    members = tuple(parts)
    ground = None if casing is None else CASING
    (s, c), n = drive.tilt, 6 * len(members)
    a, b, o = (0.0, drive.joint * s, drive.joint * c), (0.0, 0.0, drive.support), (0.0, 0.0, 0.0)
    placed = [(held.a, "input shaft", "satellite", a), (held.b, ground, "input shaft", b)]
    placed.append((held.o, ground if held.c is None else "output shaft", "satellite", o))
    if held.c is not None:
        placed.append((held.c, ground, "output shaft", o))
    links = {
        each.name: Link(each, joint(each.name, members, first, second, at, each.stiffness).selection, at)
        for each, first, second, at in placed
    }
    springs = np.zeros((n, n))
    rows, labels = [_teeth(drive, members, ground), _motor(members, ground)], [("teeth", 0), ("motor", 0)]
    for name, link in links.items():
        springs += link.selection.T @ link.joint.stiffness @ link.selection
        rows += [link.selection[i] for i in link.joint.rigid]
        labels += [(name, i) for i in link.joint.rigid]
    matrices = _turning(members, speed, None if casing is None else casing[0])
    if casing is not None:
        springs[-6:, -6:] += mean_over_turn(casing[1])
    springs = 0.5 * (springs + springs.T)
    return Bodies(members, matrices, frozen(springs), links, frozen(np.array(rows)), tuple(labels))


def _turning(members: tuple[Member, ...], speed: float, casing: Array | None) -> Turning:
    frame = np.array([0.0, 0.0, speed])
    moving = tuple(member for member in members if member.name != CASING)
    turned = [_of_member(member, frame, speed) for member in moving]
    if casing is not None:
        turned.append(standing(casing, frame))
    from scipy.linalg import block_diag

    def whole(name: str) -> Array:
        return frozen(block_diag(*(getattr(each, name) for each in turned)))

    return Turning(whole("mass"), whole("gyroscopic"), whole("centrifugal"), whole("rate"))


def _of_member(member: Member, frame: Array, speed: float) -> Turning:
    if member.name == "output shaft":  # it moves across z only, whatever it turns with
        return turning((Member(member.name, member.mass, member.inertia, spin=(0.0, 0.0, speed)),), frame)
    return turning((member,), frame)


def satellite_member(drive: PrecessionalDrive, speed: float) -> Member:
    """Return the satellite, round about OA: the mean of its moments of inertia across it."""
    (s, c), q, body = drive.tilt, drive.tooth_ratio, drive.satellite
    x, y, z = body.inertia
    axis = np.array([0.0, s, c])
    across = 0.5 * (x + y) - body.mass * body.offset**2
    inertia = across * np.eye(3) + (z - across) * np.outer(axis, axis)
    if not min(across, z) > 0.0:
        raise Infeasible(
            f"satellite.inertia: about its centre of mass {across:.4g} kg·m² are left across its axis; elastic motion "
            "needs more than 0: the moments about O must be larger than mass * center^2"
        )
    center = body.offset * axis
    spin = speed * (np.array([0.0, 0.0, 1.0]) - q * axis)
    return Member(
        "satellite", body.mass, frozen(inertia), (0.0, center[1], center[2]), (0.0, spin[1], spin[2])
    )


def shaft_member(drive: PrecessionalDrive, speed: float, shape: Shape) -> Member:
    """Return the input shaft with its counterweight, which both stand still in the frame."""
    shaft, weight, (place, across, about) = drive.shaft, drive.counterweight, shape
    whole = np.diag([across, across, about])
    whole[1, 2] = whole[2, 1] = -(shaft.product - shaft.mass * shaft.offset * place) - weight.product
    masses = np.array([shaft.mass, weight.mass])
    places = np.array([[0.0, shaft.offset, place], [0.0, -weight.radius, weight.z]])
    mass = float(masses.sum())
    center = masses @ places / mass
    for each, arm in zip(masses, places - center, strict=True):
        whole += each * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    least = float(np.linalg.eigvalsh(whole)[0])
    if not least > 0.0:
        raise Infeasible(
            f"input_shaft.inertia: with product_of_inertia and center no body has it (least principal moment "
            f"{least:.4g} kg·m²); give larger moments, or the center at which offset and product belong together"
        )
    return Member("input shaft", mass, frozen(whole), (0.0, center[1], center[2]), (0.0, 0.0, speed))


def loads(drive: PrecessionalDrive, members: tuple[Member, ...], crank: Array, speed: float) -> Array:
    """Return d'Alembert's loads (p, n) of the steady motion on all coordinates, at shaft angles (p,)."""
    towards, shaft, weight = mass_moments(drive)
    found = np.zeros((crank.size, 6 * len(members)))
    products = drive.shaft.product + drive.counterweight.product - weight * drive.counterweight.z
    about = {
        "satellite": (towards * speed**2, inertia_couple(drive, crank, speed)),
        "input shaft": ((shaft - weight) * speed**2, np.array([[-products * speed**2, 0.0, 0.0]])),
    }
    for name, (push, couple) in about.items():
        at = column(members, name)
        force = np.array([0.0, push, 0.0])
        found[:, at : at + 3] = force
        found[:, at + 3 : at + 6] = couple - np.cross(members[at // 6].center, force)
    return found


def _teeth(drive: PrecessionalDrive, members: tuple[Member, ...], ground: str | None) -> Array:
    """Return the motion (n,) that the teeth prevent: its force is a couple `tooth_couple` and 1/radius along x."""
    still = np.eye(6)
    at_o = joint("teeth", members, ground, "satellite", (0.0, 0.0, 0.0), still).selection
    row = tooth_couple(drive) @ at_o[3:]
    return np.asarray(row if np.isinf(drive.mesh_radius) else row + at_o[0] / drive.mesh_radius)


def _motor(members: tuple[Member, ...], ground: str | None) -> Array:
    return np.asarray(joint("motor", members, ground, "input shaft", (0.0, 0.0, 0.0), np.eye(6)).selection[5])
