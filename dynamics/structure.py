"""A casing that yields: matrices on modal coordinates, and maps to where loads act and velocities are read.

    reduced body (fem.reduction) ─┐  coordinates: modes of the free body, the six rigid ones first, at exactly 0 Hz
    mounts at its feet ───────────┼──► Structure(M, C, K, seats, points) ──► vibration.vibrate
    damping ratio of its modes ───┘

With rigid modes among the coordinates, a casing that is nearly rigid loses no digits against its soft mounts.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from trochoid.dynamics.casing import Casing, Mount, Triple, follow
from trochoid.dynamics.modes import natural_modes
from trochoid.dynamics.wrench import Wrench, moved
from trochoid.fem.reduction import Reduced, reading, rigid_coordinates
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, ComplexArray, frozen

BATCH = 64  # frequencies at once
FLAT = 1e-8  # of Ω², below which a dynamic stiffness is singular, as for the rigid casing
HEARD = 1e-13  # of the largest line, below which a line is rounding


@dataclass(frozen=True, eq=False, slots=True)
class Place:
    """A point at `position` (m) whose displacement and rotation are `motion` (6, n) times the coordinates."""

    position: Triple
    motion: Array


@dataclass(frozen=True, eq=False, slots=True)
class Structure:
    """`mass`, `damping`, `stiffness` (n, n); `seats` where loads act and `points` where velocities are read, by name.

    Modes above `upper` Hz are only there as far as they are static.
    """

    mass: Array
    damping: Array
    stiffness: Array
    seats: Mapping[str, Place]
    points: Mapping[str, Place]
    upper: float = math.inf


def elastic_casing(
    reduced: Reduced,
    mounts: Mapping[str, Mount],
    points: Mapping[str, Triple],
    damping_ratio: float,
    held: Collection[str] = (),
) -> Structure:
    """Return a reduced casing on `mounts` by the interface that each holds, read at `points`.

    Loads may act at every interface; those `held` do not move.  Each elastic mode of the casing, free or held, has
    `damping_ratio` of its critical damping; rigid motions are damped by the mounts alone.  Raises TrochoidError for a
    mount at no interface, a point off the body and a ratio that is not in [0, 1).
    """
    if not 0.0 <= damping_ratio < 1.0:
        raise TrochoidError(f"a damping ratio is at least 0 and below 1, given {damping_ratio:g}")
    natural, shapes = _modes(reduced, held)
    stiffness, damping = np.diag(natural**2), np.diag(2.0 * damping_ratio * natural)
    seats = {i.name: Place(i.position, frozen(shapes[reduced.columns(i.name)])) for i in reduced.interfaces}
    for name, mount in mounts.items():
        if name not in seats:
            raise TrochoidError(f"no interface {name!r} for a mount; there are {', '.join(seats)}")
        foot = seats[name]
        at = follow(mount.position, foot.position) @ foot.motion
        turn = foot.motion[3:]
        stiffness += (
            at.T @ np.diag(mount.stiffness) @ at + turn.T @ np.diag(mount.rotational_stiffness) @ turn
        )
        damping += at.T @ np.diag(mount.damping) @ at + turn.T @ np.diag(mount.rotational_damping) @ turn
    read = {name: Place(at, frozen(reading(reduced, at) @ shapes)) for name, at in points.items()}
    return Structure(
        frozen(np.eye(len(natural))),
        frozen(0.5 * (damping + damping.T)),
        frozen(0.5 * (stiffness + stiffness.T)),
        MappingProxyType(seats),
        MappingProxyType(read),
        reduced.upper,
    )


def _modes(reduced: Reduced, held: Collection[str]) -> tuple[Array, Array]:
    """Return angular frequencies (m,) and shapes (n, m) of a casing with some interfaces held, or free."""
    moves = np.ones(reduced.size, dtype=bool)
    for name in held:
        moves[reduced.columns(name)] = False
    rows = np.flatnonzero(moves)
    modes = natural_modes(reduced.mass[np.ix_(rows, rows)], reduced.stiffness[np.ix_(rows, rows)])
    shapes = np.zeros((reduced.size, len(rows)))
    shapes[rows] = modes.shapes
    return modes.angular_frequencies, shapes


def rigid_casing(reduced: Reduced, mounts: Mapping[str, Mount]) -> Casing:
    """Return the rigid casing of the same mass, inertia and mounts: what it tends to as it gets stiffer."""
    rigid = rigid_coordinates(reduced)
    mass = rigid.T @ reduced.mass @ rigid
    weight = float(np.trace(mass[:3, :3])) / 3.0
    x, y, z = mass[2, 4], mass[0, 5], mass[1, 3]  # m × (−x, −y, −z): moments about the origin
    center: Triple = (-float(x) / weight, -float(y) / weight, -float(z) / weight)
    central = rigid_coordinates(reduced, center)
    return Casing(
        weight, frozen((central.T @ reduced.mass @ central)[3:, 3:]), center, tuple(mounts.values())
    )


def loads_on(structure: Structure, loads: Mapping[str, Wrench]) -> Array:
    """Return the loads (n_pos, n) on the coordinates; raises TrochoidError for a seat that is not there."""
    unknown = [name for name in loads if name not in structure.seats]
    if unknown or not loads:
        raise TrochoidError(
            f"loads act at {', '.join(unknown) or 'no seat'}; the casing has {', '.join(structure.seats)}"
        )
    lengths = {len(load.force) for load in loads.values()}
    if len(lengths) > 1:
        raise TrochoidError(f"loads of one record must be equally long, given {sorted(lengths)} positions")
    parts = []
    for name, load in loads.items():
        seat = structure.seats[name]
        here = moved(load, seat.position)
        parts.append(np.concatenate([here.force, here.moment], axis=1) @ seat.motion)
    return np.asarray(np.sum(parts, axis=0))


def velocities(structure: Structure, angular: Array, lines: ComplexArray) -> ComplexArray:
    """Return the coordinates' velocities (nf, n) under load lines (nf, n) at `angular` frequencies (nf,), rad/s.

    Raises TrochoidError where a line meets a natural frequency that nothing damps.
    """
    size = np.linalg.norm(lines, axis=1)
    heard = np.flatnonzero(size > HEARD * size.max(initial=0.0))
    motion = np.zeros(lines.shape, dtype=np.complex128)
    for start in range(0, len(heard), BATCH):
        rows = heard[start : start + BATCH]
        omega = angular[rows, None, None]
        dynamic = structure.stiffness + 1j * omega * structure.damping - omega**2 * structure.mass
        try:
            motion[rows] = np.linalg.solve(dynamic, lines[rows][:, :, None])[:, :, 0]
        except np.linalg.LinAlgError:  # a pivot is exactly zero
            least = np.linalg.svd(dynamic, compute_uv=False)[:, -1] / angular[rows] ** 2
            _refuse(int(rows[np.argmin(least)]), angular)
    flat = FLAT * angular**2 * np.linalg.norm(motion, axis=1) >= size
    if flat[heard].any():
        _refuse(int(heard[np.argmax(flat[heard])]), angular)
    return np.asarray(1j * angular[:, None] * motion)


def _refuse(line: int, angular: Array) -> None:
    raise TrochoidError(
        f"harmonic {line + 1} ({angular[line] / 2 / np.pi:.6g} Hz) coincides with a natural frequency of the elastic "
        "casing on its mounts and there is no damping; give the casing a damping ratio, or the mounts damping"
    )
