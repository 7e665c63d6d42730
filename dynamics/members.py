"""Rigid members in space, joined by bearings, meshes and mounts: their matrices, gyroscopic terms included.

    members (mass, inertia, centre, spin) ──┐
    joints: springs on relative motions ────┼──► System(M, C, K, G), six coordinates per member
    dampers: the same with N·s/m ───────────┘

Coordinates of a member: displacement u (m) of its centre of mass and small rotation θ (rad), along axes that do
not turn.  A member that spins must be round about its spin axis, or its inertia would change as it turns.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.dynamics.casing import Triple, follow
from trochoid.dynamics.modes import natural_modes
from trochoid.dynamics.supports import Support, assemble
from trochoid.dynamics.system import System
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, frozen

AXES = ("x", "y", "z", "about x", "about y", "about z")


@dataclass(frozen=True, eq=False, slots=True)
class Member:
    """A rigid body: `mass` kg, `inertia` (3, 3) kg·m² about its centre of mass `center` (m), `spin` (3,) rad/s.

    A matrix of inertia has −∫xy dm off its diagonal.
    """

    name: str
    mass: float
    inertia: Array
    center: Triple = (0.0, 0.0, 0.0)
    spin: Triple = (0.0, 0.0, 0.0)


def disc_member(name: str, mass: float, polar: float, across: float, z: float, speed: float) -> Member:
    """Return a member that is round about the z axis: moments of inertia about it and across it, kg·m²."""
    return Member(name, mass, np.diag([across, across, polar]), (0.0, 0.0, z), (0.0, 0.0, speed))


def joint(
    name: str, members: Sequence[Member], first: str | None, second: str, at: Triple, stiffness: Array
) -> Support:
    """Return a spring of `stiffness` (6, 6) on what `second` moves past `first` (None: the ground) at a point."""
    relative = _motion(members, second, at) - _motion(members, first, at)
    return Support(name, frozen(relative), frozen(stiffness))


def line(
    name: str,
    members: Sequence[Member],
    first: str | None,
    second: str,
    at: Triple,
    direction: Triple,
    stiffness: float,
) -> Support:
    """Return a spring (N/m) along the unit `direction` at a point: a tooth mesh along its line of action."""
    along = np.asarray(direction, dtype=np.float64)
    if abs(np.linalg.norm(along) - 1.0) > 1e-9:
        raise TrochoidError(f"{name}: the line of action must have a unit direction, given {direction}")
    relative = along @ (_motion(members, second, at) - _motion(members, first, at))[:3]
    return Support(name, frozen(relative[None]), frozen([[stiffness]]))


def system(members: Sequence[Member], springs: Sequence[Support], dampers: Sequence[Support] = ()) -> System:
    """Return the matrices of all members; `dampers` are supports whose stiffness counts as N·s/m.

    Raises TrochoidError for a mass or inertia that is not positive, and a spinning member that is not round.
    """
    count = 6 * len(members)
    mass, gyroscopic = np.zeros((2, count, count))
    for i, member in enumerate(members):
        at = slice(6 * i, 6 * i + 3)
        turn = slice(6 * i + 3, 6 * i + 6)
        _fail_if_impossible(member)
        mass[at, at] = member.mass * np.eye(3)
        mass[turn, turn] = member.inertia
        # the momentum H = J Ω turns with the member: its rate is θ' × H
        gyroscopic[turn, turn] = -_cross(np.asarray(member.inertia) @ member.spin)
    names = tuple(f"{member.name} {axis}" for member in members for axis in AXES)
    spins = bool(gyroscopic.any())
    return System(
        frozen(mass),
        _symmetric(assemble(dampers, count)),
        _symmetric(assemble(springs, count)),
        frozen(gyroscopic) if spins else None,
        names,
    )


def modal_damping(undamped: System, ratio: float) -> System:
    """Return the system with the damping that gives every mode at standstill the same `ratio` of critical."""
    modes = natural_modes(undamped.mass, undamped.stiffness)
    weighted = np.asarray(undamped.mass) @ modes.shapes
    damping = undamped.damping + (weighted * (2.0 * ratio * modes.angular_frequencies)) @ weighted.T
    return System(undamped.mass, frozen(damping), undamped.stiffness, undamped.gyroscopic, undamped.names)


def column(members: Sequence[Member], name: str) -> int:
    """Return the first of the six coordinates of a member.  Raises TrochoidError for one that is not there."""
    for i, member in enumerate(members):
        if member.name == name:
            return 6 * i
    raise TrochoidError(f"no member {name!r}; there are {', '.join(member.name for member in members)}")


def _motion(members: Sequence[Member], name: str | None, at: Triple) -> Array:
    """Return the (6, n) map from all coordinates to a member's displacement and rotation at a point."""
    moved = np.zeros((6, 6 * len(members)))
    if name is None:
        return moved
    i = column(members, name)
    moved[:3, i : i + 6] = follow(at, members[i // 6].center)
    moved[3:, i + 3 : i + 6] = np.eye(3)
    return moved


def _symmetric(matrix: Array) -> Array:
    """Return the matrix without what rounding makes unlike its transpose."""
    return frozen(0.5 * (matrix + matrix.T))


def _cross(vector: Array) -> Array:
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def _fail_if_impossible(member: Member) -> None:
    inertia = np.asarray(member.inertia, dtype=np.float64)
    principal = np.linalg.eigvalsh(inertia)
    if not (member.mass > 0.0 and principal[0] > 0.0):
        raise TrochoidError(
            f"{member.name}: mass and principal moments of inertia must be above 0, given {member.mass:g} kg, "
            f"{', '.join(f'{j:g}' for j in principal)} kg·m²"
        )
    if principal[2] > (principal[0] + principal[1]) * (1.0 + 1e-9):
        raise TrochoidError(
            f"{member.name}: no body has the moments of inertia {', '.join(f'{j:g}' for j in principal)} kg·m²; "
            "the largest is at most the sum of the others"
        )
    spin = np.asarray(member.spin)
    if spin.any():
        turned = _cross(spin / np.linalg.norm(spin))
        if np.abs(turned @ inertia - inertia @ turned).max() > 1e-6 * principal[2]:
            raise TrochoidError(
                f"{member.name} spins but is not round about its axis: its inertia changes as it turns, which "
                "matrices that are constant in time cannot say"
            )
