"""The set as a system that moves: members with mass, the stiffness of all meshes, supports, what is free to move.

All motions are seen in the frame that turns with the nominal carrier: x, y and rotation of sun, ring, carrier and every
planet, three each, named as in `contact.Layout`.  The stiffness of the teeth is the tangent of the solved contacts at
every position: each planet's meshes in their own phase, with what sun, planets and ring pass on as elastic bodies.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.planetary.bodies import Level
from trochoid.drives.planetary.contact import Layout, held_by, layout
from trochoid.drives.planetary.design import Design
from trochoid.drives.planetary.mass import Masses, carrier
from trochoid.drives.planetary.series import CHUNK, Series
from trochoid.dynamics.supports import Support
from trochoid.fem.position import solve_positions
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.train import Speeds
from trochoid.kinematics.types import Array, frozen

MAIN = ("sun", "ring", "carrier")
SOFTER = 0.05  # times Young's modulus: the stiffness of a mesh per width
ROUNDING = 1e-14  # of the coordinates
SAME = 1e-6  # of the motions: how far the members may be found beside where the contacts put them


@dataclass(frozen=True, slots=True)
class Moving:
    """F motions by name, of which `free` (F, k) gives those of the k that are free, `names` the names of these.

    `mass` (F,) in kg and kg·m²; `rate` (F, F) is Ω × of the carrier's frame, 1/s; `teeth` (n, F, F) the stiffness of
    all meshes at n positions of a pitch and `forces` (n, F) what the teeth resist with there, N and N·m; `supports`
    are springs on the F motions; `motion` (n, F) the quasi-static one; `speed` rad/s of the meshes.
    """

    layout: Layout
    names: tuple[str, ...]
    free: Array
    mass: Array
    rate: Array
    supports: tuple[Support, ...]
    teeth: Array
    forces: Array
    motion: Array
    speed: float

    @property
    def springs(self) -> Array:
        """Stiffness (F, F) of the supports."""
        total = np.zeros((len(self.mass),) * 2)
        for each in self.supports:
            total += each.selection.T @ each.stiffness @ each.selection
        return total

    def stiffness(self, at: slice = slice(None)) -> Array:
        """Stiffness (n, k, k) of teeth and supports on the free motions."""
        whole = self.free.T @ (self.teeth[at] + self.springs) @ self.free
        return np.asarray(0.5 * (whole + np.swapaxes(whole, 1, 2)))

    def inertia(self) -> tuple[Array, Array, Array]:
        """Return M, 2 M Ω× and M Ω×Ω× (k, k) on the free motions: Coriolis and centrifugal ones among them."""
        mass = np.diag(self.mass)
        return (
            self.free.T @ mass @ self.free,
            2.0 * self.free.T @ mass @ self.rate @ self.free,
            self.free.T @ mass @ self.rate @ self.rate @ self.free,
        )


def everything(design: Design) -> Layout:
    """Return the layout of all motions of all members."""
    d = design.drive
    members = [*MAIN, *(f"planet{i}" for i in range(d.planets))]
    return Layout(tuple(f"{m}.{axis}" for m in members for axis in ("x", "y", "rotation")), d.driven, True)


def moving(design: Design, turning: Speeds, masses: Masses, series: Series, level: Level) -> Moving:
    """Assemble the system on the contacts of a series; raises NotConverged."""
    whole, own = everything(design), layout(design)
    placed = np.stack([_free(whole, own, series, name) for name in own.names], axis=1)
    motion = series.motion @ placed.T
    forces = tooth_forces(whole, series)
    teeth = tooth_stiffness(design, turning, series, level, (motion, forces))
    turns = tuple(f"{member}.rotation" for member in twisting(design))
    names = (*own.names, *turns)
    free = np.concatenate([placed, *(_free(whole, own, series, name)[:, None] for name in turns)], axis=1)
    supports = supported(design, whole, series.places)
    omega = float(turning.members["carrier"]) * design.scene.operation.input_speed
    speed = mesh_speed(design, turning)
    found = Moving(
        whole,
        names,
        frozen(free),
        frozen(mass_of(design, masses)),
        frozen(_rate(whole, omega)),
        supports,
        teeth,
        frozen(forces),
        frozen(motion),
        speed,
    )
    return _twisted(found, turns) if turns else found


def mesh_speed(design: Design, turning: Speeds) -> float:
    """Return the angular frequency of the meshes, rad/s."""
    on_carrier = abs(float(turning.relative("sun", "carrier")))
    return design.drive.z_sun * on_carrier * design.scene.operation.input_speed


def twisting(design: Design) -> tuple[str, ...]:
    """Return the members that turn on a shaft or seat that twists, its far end held or driven evenly.

    That of the driven one passes the constant torque of the output: it winds up, and does not vibrate.
    """
    d = design.drive
    if not design.scene.has("bearing_compliance"):
        return ()
    return tuple(
        name for name in MAIN if name != d.driven and getattr(d, name).torsional_stiffness is not None
    )


def mass_of(design: Design, masses: Masses) -> Array:
    """Return masses and moments of inertia (F,)."""
    beam = carrier(design)
    wheels = [(s.mass, s.axial_inertia) for s in (masses.sun, masses.ring)]
    planet = (masses.planet.mass, masses.planet.axial_inertia)
    return np.array([x for m, j in (*wheels, beam, *[planet] * design.drive.planets) for x in (m, m, j)])


def supported(design: Design, whole: Layout, places: Array) -> tuple[Support, ...]:
    """Return the springs of members that float, of the planets' seats and of shafts that twist."""
    d = design.drive
    if not design.scene.has("bearing_compliance"):
        return ()
    found = []
    for name in ("sun", "carrier", *(("ring",) if d.ring.held == "evenly" else ())):
        stiffness = getattr(d, name).bearing_stiffness
        found.append(Support(name, frozen(whole.rows(name)[:2]), frozen(stiffness * np.eye(2))))
    for i, place in enumerate(places):
        relative = whole.rows(f"planet{i}")[:2] - whole.seat(place)
        held = design.seat_stiffness(place)
        seat = held if isinstance(held, np.ndarray) else held * np.eye(2)
        found.append(Support(f"planet{i}", frozen(relative), frozen(seat)))
    for name in twisting(design):
        stiffness = getattr(d, name).torsional_stiffness
        found.append(Support(f"{name} shaft", frozen(whole.rows(name)[2:]), frozen([[stiffness]])))
    return tuple(found)


def tooth_forces(whole: Layout, series: Series) -> Array:
    """Return what the teeth resist the motions with (n, F): less the forces that they press members with."""
    found = np.zeros((len(series.angle), len(whole.names)))
    center = series.planet_centers
    sun, ring = series.sun.resultant, series.ring.resultant
    found += _on(
        whole, "sun", sun.sum(axis=1), series.sun.moment(series.moved("sun")[:, None, :2]).sum(axis=1)
    )
    found -= _on(
        whole, "ring", ring.sum(axis=1), series.ring.moment(series.moved("ring")[:, None, :2]).sum(axis=1)
    )
    turns = series.ring.moment(center) - series.sun.moment(center)
    for i in range(len(series.places)):
        found += _on(whole, f"planet{i}", ring[:, i] - sun[:, i], turns[:, i])
    return found


def _on(whole: Layout, member: str, force: Array, moment: Array) -> Array:
    return np.asarray(np.concatenate([force, moment[:, None]], axis=1) @ whole.rows(member))


def tooth_stiffness(
    design: Design, turning: Speeds, series: Series, level: Level, at: tuple[Array, Array]
) -> Array:
    """Return the tangent stiffness of all meshes (n, F, F) where `at` puts the members: motion, forces (n, F).

    Springs hold every motion there while the contacts are solved; they are taken off afterwards.
    Raises NotConverged where the contacts are found elsewhere.
    """
    whole, (motion, forces) = everything(design), at
    reach = np.array([1.0, 1.0, 0.2 * design.drive.center_distance])
    # of a mesh's own order, N/m, at the arm of a tooth for rotations
    linear = SOFTER * design.scene.materials[design.drive.material].youngs_modulus * design.drive.face_width
    springs = np.diag(np.tile(linear * reach**2, len(whole.names) // 3))
    found = []
    for start in range(0, len(series.angle), CHUNK):
        rows = slice(start, start + CHUNK)
        load = forces[rows] + motion[rows] @ springs
        rest = (whole, springs, load)
        problem = held_by(design, turning, level, series.load, series.angle[rows], rest)
        contact = solve_positions(problem, resolve=series.rung == "strips")
        arm = np.tile(reach, len(whole.names) // 3)
        apart = float(np.abs((contact.motion - motion[rows]) * arm).max())
        moves = max(float(np.abs(motion * arm).max()), float(np.abs(forces).max()) / linear)
        if apart > SAME * moves + ROUNDING * design.drive.center_distance:
            raise NotConverged(
                f"the stiffness of the meshes was found {apart * 1e6:.3g} µm beside the members' places; take another "
                "number of ask.positions"
            )
        found.append(contact.stiffness - springs)
    return frozen(np.concatenate(found))


def _free(whole: Layout, own: Layout, series: Series, name: str) -> Array:
    """Return all motions (F,) that a unit of a free one makes: planets that do not float go with the carrier."""
    column = (np.array(whole.names) == name).astype(float)
    if not own.floating and name == "carrier.rotation":
        for i, place in enumerate(series.places):
            column += whole.rows(f"planet{i}")[:2].T @ whole.seat(place) @ column
    return np.asarray(column)


def _rate(whole: Layout, omega: float) -> Array:
    rate = np.zeros((len(whole.names),) * 2)
    for i in range(0, len(whole.names), 3):
        rate[i, i + 1], rate[i + 1, i] = -omega, omega
    return rate


def _twisted(found: Moving, turns: tuple[str, ...]) -> Moving:
    """Let shafts twist as the torque in them varies; their mean twist is in the wind-up, and turns all evenly."""
    rows = [found.layout.names.index(name) for name in turns]
    resists = np.zeros_like(found.forces)
    resists[:, rows] = found.forces[:, rows] - found.forces[:, rows].mean(axis=0)
    moved = -np.linalg.solve(found.stiffness(), (resists @ found.free)[..., None])[..., 0] @ found.free.T
    return Moving(
        found.layout,
        found.names,
        found.free,
        found.mass,
        found.rate,
        found.supports,
        found.teeth,
        frozen(found.forces + np.einsum("nij,nj->ni", found.teeth, moved)),
        frozen(found.motion + moved),
        found.speed,
    )
