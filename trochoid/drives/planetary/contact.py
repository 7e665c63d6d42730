"""All contacts of a set at many positions: sun, planets and ring together, in the frame of the carrier.

Motions: rotation of each planet; rotation of the driven member; with compliant bearings also x and y of sun, carrier
and every planet, and of a ring that is held evenly. Planet centres then hang on the carrier by springs; else they move
with it. The frame turns with the nominal carrier, so that the centres stand still in it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.drives.planetary.bodies import Level
from trochoid.drives.planetary.design import Design
from trochoid.drives.planetary.mesh_phase import period
from trochoid.fem.assembly import Assembly, Family
from trochoid.fem.gear_mesh import Wheel, conjugate_angle, contact_width, mesh_family, mesh_pair
from trochoid.fem.pair import Member
from trochoid.kinematics.train import Speeds
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, slots=True)
class Load:
    """External torque (N·m) on the driven member and on the sun, and the outward inertia force (N) of a planet."""

    driven: float
    sun: float
    centrifugal: float


@dataclass(frozen=True, slots=True)
class Layout:
    """The motions of a scene by name, and the rows that turn them into a member's x, y, rotation."""

    names: tuple[str, ...]
    driven: str
    floating: bool

    def rows(self, member: str) -> Array:
        """Return (3, k): x, y and rotation of a member per unit motion."""
        rows = np.zeros((3, len(self.names)))
        for i, motion in enumerate(("x", "y", "rotation")):
            if f"{member}.{motion}" in self.names:
                rows[i, self.names.index(f"{member}.{motion}")] = 1.0
        return rows

    def seat(self, center: Array) -> Array:
        """Return (2, k): how a place (2,) on the carrier moves per unit motion."""
        x, y, turn = self.rows("carrier")
        return np.stack([x - center[1] * turn, y + center[0] * turn])

    def planet(self, i: int, center: Array) -> Array:
        """Return (3, k) of a planet about its nominal centre (2,)."""
        rows = self.rows(f"planet{i}")
        if not self.floating:
            rows[:2] = self.seat(center)
        return rows


def layout(design: Design) -> Layout:
    """Choose the motions that the scene's effects ask for."""
    d, floating = design.drive, design.scene.has("bearing_compliance")
    names = [f"planet{i}.rotation" for i in range(d.planets)] + [f"{d.driven}.rotation"]
    if floating:
        free = ["sun", "carrier", *(f"planet{i}" for i in range(d.planets))]
        free += ["ring"] if d.ring.held == "evenly" else []
        names += [f"{member}.{axis}" for member in free for axis in "xy"]
    return Layout(tuple(names), d.driven, floating)


def centers(design: Design) -> Array:
    """Return the planets' places (N, 2) in the carrier's frame, m, off by the scene's tangential errors if listed."""
    d = design.drive
    angle = 2.0 * math.pi * np.arange(d.planets) / d.planets
    out = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    place = d.center_distance * out
    if design.scene.has("position_errors"):
        errors = np.zeros(d.planets)
        errors[: len(d.planet.position_errors)] = d.planet.position_errors
        place = place + errors[:, None] * np.stack([-out[:, 1], out[:, 0]], axis=-1)
    return frozen(place)


def angles(design: Design, turning: Speeds, positions: int) -> Array:
    """Return input angles (n,) over one pitch of the meshes, after which everything repeats; its end left out."""
    whole = period(design.given, float(turning.relative("sun", "carrier")))
    return frozen(whole * np.arange(positions) / positions)


def hands(load: Load) -> tuple[int, int]:
    """Return the hands of the flanks of sun and planets that carry: those of the sun are pushed back by the planets."""
    forward = 1 if load.sun >= 0.0 else -1
    return -forward, forward


def assembly(design: Design, turning: Speeds, level: Level, load: Load, angle: Array) -> Assembly:
    """Return the contact problem at input angles (n,) in rad."""
    motions, places = layout(design), centers(design)
    held, weights = springs(design, motions, places), loads(motions, places, load, len(angle))
    return held_by(design, turning, level, load, angle, (motions, held, weights))


def held_by(
    design: Design, turning: Speeds, level: Level, load: Load, angle: Array, rest: tuple[Layout, Array, Array]
) -> Assembly:
    """Return the contact problem with motions, springs (k, k) and loads (n, k) of one's own."""
    motions, held, weights = rest
    places = centers(design)
    sun, planet, ring = level.wheels
    own, outer = hands(load)
    width = _widths(design, level, load)
    sun_member = Member(np.zeros(2), float(turning.relative("sun", "carrier")) * angle, motions.rows("sun"))
    nominal = _nominal(design, level, (own, outer), sun_member)
    ring_member = Member(np.zeros(2), nominal[-1], motions.rows("ring"))
    families: list[Family] = []
    for i, center in enumerate(places):
        member = Member(center, nominal[i], motions.planet(i, center))
        pair = mesh_pair((sun, planet), (sun_member, member), (0, 1 + i), own, width[0])
        families.append(mesh_family(f"sun{i}", pair, (sun, planet)))
        pair = mesh_pair((planet, ring), (member, ring_member), (1 + i, 1 + len(places)), outer, width[1])
        families.append(mesh_family(f"ring{i}", pair, (planet, ring)))
    bodies = (sun.elastic, *[planet.elastic] * len(places), ring.elastic)
    return Assembly(tuple(families), bodies, held, weights)


def _nominal(design: Design, level: Level, hand: tuple[int, int], sun: Member) -> list[Array]:
    """Return the angles (n,) of all planets and, last, of the ring, at which unloaded flanks just touch."""
    d = design.drive
    wheels = [wheel.flank for wheel in level.wheels]
    still, found = np.zeros((3, 1)), []
    for i in range(d.planets):
        angle = 2.0 * math.pi * i / d.planets
        center = d.center_distance * np.array([math.cos(angle), math.sin(angle)])
        place = Member(center, 0.0, still)
        found.append(conjugate_angle((wheels[0], wheels[1]), (sun, place), hand[0]))
    first = Member(np.array([d.center_distance, 0.0]), found[0], still)
    ring = Member(np.zeros(2), 0.0, still)
    found.append(conjugate_angle((wheels[1], wheels[2]), (first, ring), hand[1]))
    return found


def _widths(design: Design, level: Level, load: Load) -> tuple[float, float]:
    """Return typical half widths (m) of contacts in both meshes."""
    d, (sun, planet, ring) = design.drive, level.wheels
    force = abs(load.sun) / (d.planets * sun.flank.base_radius)
    return (
        contact_width((sun, planet), d.center_distance, force),
        contact_width((planet, ring), d.center_distance, force),
    )


def springs(design: Design, motions: Layout, places: Array) -> Array:
    """Return what floating members rest on, N/m: their bearings, those of the planets between them and the carrier."""
    d = design.drive
    total = np.zeros((len(motions.names),) * 2)
    if not motions.floating:
        return total
    for name, stiffness in (
        ("sun", d.sun.bearing_stiffness),
        ("carrier", d.carrier.bearing_stiffness),
        ("ring", d.ring.bearing_stiffness),
    ):
        at = motions.rows(name)[:2]
        total += stiffness * at.T @ at
    for i, center in enumerate(places):
        at = motions.rows(f"planet{i}")[:2] - motions.seat(center)
        seat = design.seat_stiffness(center)
        total += at.T @ seat @ at if isinstance(seat, np.ndarray) else seat * at.T @ at
    return total


def loads(motions: Layout, places: Array, load: Load, positions: int) -> Array:
    """Return the loads (n, k) on the motions: the output's torque, and the planets' inertia where they float."""
    total = np.zeros((positions, len(motions.names)))
    total[:, motions.names.index(f"{motions.driven}.rotation")] = load.driven
    if motions.floating:
        for i, center in enumerate(places):
            total += load.centrifugal * (center / np.linalg.norm(center)) @ motions.rows(f"planet{i}")[:2]
    return total


def twists(design: Design) -> dict[str, float]:
    """Return how far the driven member turns per its torque (rad/(N·m)) because sun shaft, ring seat or carrier twist.

    (T/T_driven)²/k, by the work that they take; only those that the scene gives, and with "bearing_compliance".
    """
    d = design.drive
    if not design.scene.has("bearing_compliance"):
        return {}
    torque = {"sun": d.z_sun, "ring": d.z_ring, "carrier": d.z_sun + d.z_ring}
    given = {name: getattr(d, name).torsional_stiffness for name in torque}
    return {
        name: (torque[name] / torque[d.driven]) ** 2 / stiffness
        for name, stiffness in given.items()
        if stiffness is not None
    }


def wheel_pair(level: Level, outer: bool) -> tuple[Wheel, Wheel]:
    """Return sun and planet, or planet and ring."""
    sun, planet, ring = level.wheels
    return (sun, planet) if outer else (planet, ring)
