"""The contacts of a set over one pitch of its meshes, and what follows from them by equilibrium."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from trochoid.drives.planetary.bodies import Level
from trochoid.drives.planetary.contact import Layout, Load, assembly, centers, layout, twists
from trochoid.drives.planetary.design import Design
from trochoid.drives.unsolved import unsolved
from trochoid.fem.assembly import Contact, Touch
from trochoid.fem.moving import softness, wandering
from trochoid.fem.position import solve_positions
from trochoid.fem.rows import joined, taken
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.train import Speeds
from trochoid.kinematics.types import Array, IntArray, frozen

CHUNK = 64  # positions side by side
FLUNG = 1e4  # times the force in mesh: a planet is then flung out, and nothing else matters
ROUNDING = 1e-10  # of a planet's bearing force: a resultant below it is none


@dataclass(frozen=True, slots=True)
class Touches:
    """Contacts of one kind of mesh: n positions, N planets, c pairs of teeth.

    `force` (n, N, c) N, `pressure` (n, N, c) Pa, `place` (n, N, c) arc length in m along the first wheel's profile,
    `point` and `normal` (n, N, c, 2) in the carrier's frame, the normal out of the first wheel.
    """

    force: Array
    pressure: Array
    place: Array
    point: Array
    normal: Array

    @property
    def resultant(self) -> Array:
        """Force (n, N, 2) of the first wheel on the second in each mesh, N."""
        return np.asarray(np.einsum("nic,nicx->nix", self.force, self.normal))

    def moment(self, about: Array) -> Array:
        """Moment (n, N) of that force about places (..., 2) per mesh, N·m."""
        arm = self.point - about[..., None, :]
        push = self.force[..., None] * self.normal
        return np.asarray((arm[..., 0] * push[..., 1] - arm[..., 1] * push[..., 0]).sum(axis=-1))


@dataclass(frozen=True, slots=True)
class Series:
    """Positions at input angles (n,) in rad over one pitch; `motion` (n, k) and `stiffness` (n, k, k) on `layout`.

    `wandering` (n,): compliance at the driven member in rad/(N·m) beside the tangent's, of contacts that a load moves;
    `places` (N, 2) of the planets, `rounding` of the tip edges in m; `twists` of shafts at the driven member in
    rad/(N·m), which no contact feels; `imbalance` and `penetration` are the largest relative residuals.
    """

    rung: str
    angle: Array
    layout: Layout
    load: Load
    places: Array
    rounding: float
    twists: Mapping[str, float]
    sun: Touches
    ring: Touches
    motion: Array
    stiffness: Array
    wandering: Array
    imbalance: float
    penetration: float

    def thinned(self, stride: int) -> Iterator[Series]:
        """Yield every so-manieth position, from each of the first on; nothing where there are too few."""
        at = replace(self, places=None)  # type: ignore[arg-type]  # the only array without an axis of positions
        for start in range(stride) if len(self.angle) >= stride else ():
            yield replace(taken(at, slice(start, None, stride)), places=self.places)

    def moved(self, member: str) -> Array:
        """Return x, y and rotation (n, 3) of "sun", "ring", "carrier" in m and rad."""
        return np.asarray(self.motion @ self.layout.rows(member).T)

    @property
    def planet_centers(self) -> Array:
        """Displaced centres (n, N, 2), m."""
        rows = [self.layout.planet(i, place)[:2] for i, place in enumerate(self.places)]
        return np.asarray(self.places + np.stack([self.motion @ row.T for row in rows], axis=1))

    @property
    def lag(self) -> Array:
        """Rotation (n,) of the driven member behind its ideal angle, rad, with the twist of shafts."""
        row = self.layout.names.index(f"{self.layout.driven}.rotation")
        twist = sum(self.twists.values()) * abs(self.load.driven)
        return np.asarray(np.sign(self.load.driven) * self.motion[:, row] + twist)

    @property
    def torsional_stiffness(self) -> Array:
        """Torque per rotation (n,) at the driven member with the driving one held, N·m/rad: the tangent."""
        row = self.layout.names.index(f"{self.layout.driven}.rotation")
        yields = softness(self.stiffness, row)[:, row]
        whole = yields + self.wandering + sum(self.twists.values())
        return np.asarray(np.divide(1.0, whole, out=np.zeros_like(yields), where=yields > 0))

    @property
    def planet_torque(self) -> Array:
        """Torque (n, N) of each planet on the sun about its displaced axis, N·m."""
        return -self.sun.moment(self.moved("sun")[:, None, :2])

    @property
    def shares(self) -> Array:
        """Share (n, N) of each planet in the sun's torque."""
        torque = self.planet_torque
        return np.asarray(torque / torque.sum(axis=1, keepdims=True))

    @property
    def bearing(self) -> Array:
        """Force (n, N, 2) of each planet on its bearing, N, inertia among it."""
        out = self.places / np.linalg.norm(self.places, axis=1, keepdims=True)
        return np.asarray(self.sun.resultant - self.ring.resultant + self.load.centrifugal * out)

    @property
    def members(self) -> dict[str, Array]:
        """Force (n, 2) in N on sun, ring and carrier that their own bearings take; 0 where only rounding is left."""
        found = {
            "sun": -self.sun.resultant.sum(axis=1),
            "ring": self.ring.resultant.sum(axis=1),
            "carrier": self.bearing.sum(axis=1),
        }
        least = ROUNDING * float(np.abs(self.bearing).max())
        return {name: np.where(np.abs(force) > least, force, 0.0) for name, force in found.items()}


def _flung(design: Design, load: Load) -> str:
    """Say when what flings planets out is beyond comparison with what presses their teeth, or nothing."""
    d = design.drive
    pressed = abs(load.sun) / (0.5 * d.module * d.z_sun * d.planets)
    if load.centrifugal < FLUNG * pressed:
        return ""
    return (
        f"; operation.input_speed flings each planet out with {load.centrifugal:.3g} N, beside {pressed:.3g} N in its "
        f"mesh with the sun: take a lower speed"
    )


def solve_series(
    design: Design, turning: Speeds, level: Level, load: Load, angle: Array, rung: str
) -> Series:
    """Solve positions at input angles (n,) in rad on "level0" or "strips". Raises NotConverged."""
    parts: list[tuple[IntArray, Contact]] = []
    wanders, row = np.zeros(len(angle)), layout(design).names.index(f"{design.drive.driven}.rotation")
    for start in range(0, len(angle), CHUNK):
        rows = np.arange(start, min(start + CHUNK, len(angle)))
        problem = assembly(design, turning, level, load, angle[rows])
        try:
            contact = solve_positions(problem, resolve=rung == "strips")
        except NotConverged as fault:
            said = _flung(design, load)
            raise unsolved(fault, angle[rows[fault.row or 0]], layout(design).names, said) from fault
        parts.append((rows, contact))
        wanders[rows] = wandering(problem, contact, softness(contact.stiffness, row))
    found, count = joined(parts), design.drive.planets
    sun, ring = ([found.touches[f"{name}{i}"] for i in range(count)] for name in ("sun", "ring"))
    width = design.drive.face_width
    return Series(
        rung,
        angle,
        layout(design),
        load,
        centers(design),
        level.wheels[0].flank.rounding,
        twists(design),
        _gathered(sun, width),
        _gathered(ring, width),
        found.motion,
        found.stiffness,
        frozen(wanders),
        float(found.imbalance.max()),
        float(found.penetration.max()),
    )


def _gathered(touches: list[Touch], width: float) -> Touches:
    return Touches(
        frozen(np.stack([t.force for t in touches], axis=1)),
        frozen(np.stack([t.peak for t in touches], axis=1) / width),
        frozen(np.stack([t.state.parameter for t in touches], axis=1)),
        frozen(np.stack([t.state.point for t in touches], axis=1)),
        frozen(np.stack([t.state.normal for t in touches], axis=1)),
    )
