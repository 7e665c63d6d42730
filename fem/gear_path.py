"""One pair of gears under a torque, over base pitches: load sharing, mesh stiffness, loaded transmission error.

The first gear stands at given angles, the torque loads the second; centres are held. The transmission error is what
the second gear lags behind its conjugate angle, as a length on its base circle: zero for unrelieved flanks without
load.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.assembly import Assembly, Contact, Touch
from trochoid.fem.gear_mesh import Wheel, conjugate_angle, contact_width, mesh_family, mesh_pair, shifted
from trochoid.fem.pair import Member
from trochoid.fem.position import solve_positions
from trochoid.kinematics.types import Array, frozen

HELD, TURNS = np.zeros((3, 1)), np.array([[0.0], [0.0], [1.0]])


@dataclass(frozen=True, slots=True)
class Mating:
    """Two wheels at a centre distance (m); torque (N·m) on the second, carried by flanks of `hand` of the first."""

    wheels: tuple[Wheel, Wheel]
    center_distance: float
    torque: float
    hand: int = 1

    @property
    def normal_force(self) -> float:
        """Total force along the line of action, N."""
        return self.torque / self.wheels[1].flank.base_radius

    @property
    def sense(self) -> float:
        """Sign of the second gear's rotation that closes the gaps."""
        return -self.wheels[1].flank.side * self.hand

    @property
    def pitch(self) -> float:
        """Angle of the first gear over a base pitch, rad."""
        return self.wheels[0].flank.pitch


@dataclass(frozen=True, slots=True)
class Path:
    """A mating at n angles of the first gear, in rad; c contacts at each, in the order of growing ρ of the first.

    `error` (n,): loaded transmission error in m on the line of action, `stiffness` (n,) its tangent dF/dδ in N/m;
    `force` (n, c) in N and `pressure` (n, c) in Pa; `contact` is the whole solution. `into_fillet` (n,): how far in m
    a pressed contact lies below the start of an involute, where the model lets it go on: the tip then digs into the
    fillet.
    """

    angle: Array
    error: Array
    stiffness: Array
    force: Array
    pressure: Array
    contact: Contact
    into_fillet: Array

    @property
    def secant(self) -> Array:
        """Normal force over transmission error (n,), N/m; of flanks without relief, what ISO 6336 calls stiffness."""
        loaded = self.error != 0.0
        force = self.force.sum(axis=1)
        return np.asarray(np.divide(force, self.error, out=self.stiffness.copy(), where=loaded))


def base_pitch(mating: Mating, positions: int) -> Array:
    """Return angles (n,) of the first gear over one base pitch, its end left out."""
    return np.asarray(mating.pitch * np.arange(positions) / positions)


def mating_assembly(mating: Mating, angle: Array) -> Assembly:
    """Return the contact problem at angles (n,) of the first gear: one motion, the second gear's rotation."""
    return path_assembly(mating, angle, np.zeros(1))


def solve_path(mating: Mating, angle: Array, resolve: bool = False) -> Path:
    """Solve at angles (n,); `resolve` gives the pressure in strips. Raises NotConverged, Infeasible."""
    contact = solve_positions(mating_assembly(mating, angle), resolve)
    radius = mating.wheels[1].flank.base_radius
    width = min(w.width for w in mating.wheels)
    touch = contact.touches["mesh0"]
    return Path(
        frozen(angle),
        frozen(mating.sense * contact.motion[:, 0] * radius),
        frozen(contact.stiffness[:, 0, 0] / radius**2),
        frozen(touch.force),
        frozen(touch.peak / width),
        contact,
        frozen(_into_fillet(mating, touch)),
    )


def _into_fillet(mating: Mating, touch: Touch) -> Array:
    assert touch.state.place is not None
    assert touch.state.far is not None
    one, two = (w.flank for w in mating.wheels)
    deep = np.maximum(one.below(touch.state.place), two.below(touch.state.far))
    return np.asarray(np.where(touch.force > 0.0, deep, 0.0).max(axis=1))


def path_assembly(mating: Mating, angle: Array, offset: Array) -> Assembly:
    """Return the contact problem of slices of equal width with gaps wider by `offset` (slices,) in m.

    Slices share the rotation of the second gear, and nothing else couples them.
    """
    angle = np.asarray(angle, dtype=np.float64)
    slices = len(offset)
    first = Member(np.zeros(2), angle, HELD)
    place = Member(np.array([mating.center_distance, 0.0]), 0.0, TURNS)
    one, two = (w.flank for w in mating.wheels)
    turned = conjugate_angle((one, two), (first, place), mating.hand)
    second = Member(place.center, turned, TURNS)
    half = contact_width(mating.wheels, mating.center_distance, mating.normal_force)
    families, bodies = [], []
    for i in range(slices):
        wheels = tuple(Wheel(w.flank, w.body, w.width / slices) for w in mating.wheels)
        pair = mesh_pair((wheels[0], wheels[1]), (first, second), (2 * i, 2 * i + 1), mating.hand, half)
        pair = shifted(pair, offset[i])
        families.append(mesh_family(f"mesh{i}", pair, (wheels[0], wheels[1])))
        bodies += [w.elastic for w in wheels]
    load = np.full((len(angle), 1), mating.sense * mating.torque)
    return Assembly(tuple(families), tuple(bodies), np.zeros((1, 1)), load)
