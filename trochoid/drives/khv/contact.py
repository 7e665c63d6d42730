"""All contacts of the drive over the input angle: ring pins, output rollers in their holes, rollers of the
eccentric bearing.

Motions: x, y, rotation of each disc; rotation of the output flange; with compliant bearings also x, y and
tilt of shaft and flange. Contacts are solved in the frame of the ring.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.drives.disc_pack import Disc, circle
from trochoid.drives.khv.design import Design
from trochoid.fem.bearing import EXPONENT
from trochoid.fem.laws import HertzLine, Law, LinearSpring, PowerLaw
from trochoid.fem.material import Material, Plane
from trochoid.fem.pair import FlankPair, HolePair, Member, Seat
from trochoid.fem.position import Assembly, ElasticBody, Family
from trochoid.fem.seat_law import RollerSeat, least_load, round_side
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Layout:
    """The motions of a scene by name, and for each member the rows that turn them into its x, y, rotation."""

    names: tuple[str, ...]
    lateral: bool
    floating: bool

    def rows(self, member: str, z: float = 0.0) -> Array:
        """Return (3, k): x, y and rotation of a member's centre at the axial place z per unit motion."""
        rows = np.zeros((3, len(self.names)))
        for i, motion in enumerate(("x", "y", "rotation")):
            if f"{member}.{motion}" in self.names:
                rows[i, self.names.index(f"{member}.{motion}")] = 1.0
        for i, (motion, sign) in enumerate((("tilt_y", 1.0), ("tilt_x", -1.0))):
            if f"{member}.{motion}" in self.names:
                rows[i, self.names.index(f"{member}.{motion}")] = sign * z
        return rows


def layout(design: Design, rung: str) -> Layout:
    """Choose the motions: the classical calculation (rigid disc, rigid bearing) has rotations only."""
    floating = design.scene.has("bearing_compliance")
    lateral = floating or rung != "springs"
    disc = ("x", "y", "rotation") if lateral else ("rotation",)
    names = [f"disc{i}.{m}" for i in range(len(design.discs)) for m in disc] + ["output.rotation"]
    if floating:
        names += [f"{member}.{m}" for member in ("shaft", "output") for m in ("x", "y", "tilt_x", "tilt_y")]
    return Layout(tuple(names), lateral, floating)


def material(design: Design) -> Material:
    """Return the material of discs, pins and rollers."""
    given = design.scene.materials[design.drive.material]
    return Material(given.youngs_modulus, given.poissons_ratio, given.density)


def plane(design: Design) -> Plane:
    """Return the plane moduli of discs, pins and rollers."""
    return material(design).plane(design.drive.plane)


def assembly(design: Design, rung: str, bodies: tuple[ElasticBody, ...], crank: Array | float) -> Assembly:
    """Return the contact problem at crank angles (n,) in rad relative to the ring, or at a single one.

    `bodies` is empty for rigid discs.
    """
    crank = np.asarray(crank, dtype=np.float64)
    motions = layout(design, rung)
    families: list[Family] = []
    for i, disc in enumerate(design.discs):
        angle = crank + disc.crank
        center = design.flank.eccentricity * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        turn = -angle / design.flank.lobes + disc.lead
        member = Member(center, turn, motions.rows(f"disc{i}"))
        body = bodies[disc.body] if bodies else None
        families += _ring(design, motions, disc, i, member, body, angle)
        families += _output(design, motions, disc, i, member, body, crank)
        if motions.lateral:
            families += _bearing(design, motions, disc, i, member, body, crank)
    return Assembly(
        tuple(families),
        tuple(bodies[x.body] for x in design.discs) if bodies else (),
        springs(design, motions),
        loads(design, motions, crank),
        follow=rung != "springs",
    )


def springs(design: Design, motions: Layout) -> Array:
    """Return what shaft and flange rest on: their two bearings each, N/m and N·m/rad."""
    total = np.zeros((len(motions.names),) * 2)
    if motions.floating:
        for member, table in (("shaft", design.drive.input_shaft), ("output", design.drive.output_flange)):
            for z, stiffness in zip(table.bearing_positions, design.supports[member], strict=True):
                at = motions.rows(member, z)[:2]
                total += stiffness * at.T @ at
    return total


def loads(design: Design, motions: Layout, crank: Array | float) -> Array:
    """Return the loads (n, k) on the motions: the load torque, and the centrifugal force of each disc when inertia
    is in the scene.
    """
    crank = np.asarray(crank, dtype=np.float64)
    load = np.zeros((*crank.shape, len(motions.names)))
    load[..., motions.names.index("output.rotation")] = design.flange_torque
    if motions.lateral:
        forces = centrifugal(design, crank)
        for i in range(len(design.discs)):
            load += forces[..., i, :] @ motions.rows(f"disc{i}")[:2]
    return load


def centrifugal(design: Design, crank: Array) -> Array:
    """Return the inertia forces (n, discs, 2) of the discs at crank angles (n,); zero when the scene leaves
    inertia out.
    """
    angle = crank[..., None] + np.array([d.crank for d in design.discs])
    size = design.flank.eccentricity * design.crank_speed**2 * design.eccentric_mass
    return size * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def _ring(
    design: Design,
    motions: Layout,
    disc: Disc,
    i: int,
    member: Member,
    body: ElasticBody | None,
    angle: Array,
) -> list[Family]:
    flank, count = design.flank, design.flank.pins
    pins = circle(flank.pin_circle_radius, count)
    ring = Member(np.zeros(2), 0.0, np.zeros((3, len(motions.names))))
    start = flank.contact_parameter(np.arange(count), angle[..., None]) - disc.lead
    seat = _seat(body, i, ["flank"] * count)
    pair = FlankPair(
        member,
        ring,
        flank,
        design.modification,
        design.pin_play,
        pins,
        start,
        design.arc,
        seat,
        classical=body is None,
    )
    yields = design.scene.has("pin_compliance")
    kernel, side = round_side(plane(design), count, flank.pin_radius, design.drive.face_width, yields)
    return [Family(f"ring{i}", pair, kernel, side, _classical(design, body))]


def _output(
    design: Design,
    motions: Layout,
    disc: Disc,
    i: int,
    member: Member,
    body: ElasticBody | None,
    crank: Array,
) -> list[Family]:
    pins = design.drive.output_pins
    start = design.drive.output_pins.phase
    flange = Member(np.zeros(2), -crank / design.flank.lobes, motions.rows("output", disc.z))
    hole = (np.arange(pins.count) + disc.first_hole) % pins.count
    holes = circle(pins.circle_radius, pins.count, design.hole_angles[disc.body])[hole]
    rollers = circle(pins.circle_radius, pins.count, start)
    seat = _seat(body, i, [f"hole{j}" for j in hole])
    pair = HolePair(member, flange, holes, design.hole_radius, rollers, pins.roller_radius, seat)
    yields = design.scene.has("pin_compliance")
    kernel, side = round_side(plane(design), pins.count, pins.roller_radius, design.drive.face_width, yields)
    return [Family(f"output{i}", pair, kernel, side, _classical(design, body))]


def _bearing(
    design: Design,
    motions: Layout,
    disc: Disc,
    i: int,
    member: Member,
    body: ElasticBody | None,
    crank: Array,
) -> list[Family]:
    bearing = design.drive.eccentric_bearing
    count = bearing.rollers
    cage = Member(member.center, design.cage_angle(crank), motions.rows("shaft", disc.z))
    seat = _seat(body, i, ["bore"] * count)
    rollers = circle(design.pitch_radius, count)
    pair = HolePair(
        member, cage, np.zeros((count, 2)), design.drive.bore_radius, rollers, bearing.roller_radius, seat
    )
    rolling = roller_seat(design)
    one, wider = rolling.kernel, 0.0 if body is None else rolling.widening
    if not motions.floating:  # rigid rollers on a rigid eccentric: the seat's own Hertz contact is left
        return [Family(f"bearing{i}", pair, np.full(count, one), np.full(count, wider))]
    law = PowerLaw(rolling.constant, EXPONENT)
    exchanged = 0.0 if body is None else wider + rolling.seat_for_seat(law, nominal_roller_load(design))
    side = np.full(count, exchanged)
    return [Family(f"bearing{i}", pair, np.full(count, 2 * one), side, law)]


def roller_seat(design: Design) -> RollerSeat:
    """Return the eccentric bearing's rollers in the bore of a disc."""
    bearing, drive = design.drive.eccentric_bearing, design.drive
    return RollerSeat(
        plane(design),
        drive.plane,
        bearing.rollers,
        bearing.roller_radius,
        bearing.roller_length,
        design.race_radius,
        drive.bore_radius,
        drive.face_width,
    )


def side_slopes(design: Design, rung: str) -> dict[str, float]:
    """Return by families how their round sides change with the flange's torque, m/N per N·m: rollers have the seat of
    a typical load.
    """
    if rung == "springs" or not layout(design, rung).floating or not design.flange_torque:
        return {}
    seat, small = roller_seat(design), 1e-4 * design.flange_torque
    law = PowerLaw(seat.constant, EXPONENT)
    more, less = (
        seat.seat_for_seat(law, nominal_roller_load(design, design.flange_torque + step))
        for step in (small, -small)
    )
    return {f"bearing{i}": (more - less) / (2.0 * small) for i in range(len(design.discs))}


def nominal_roller_load(design: Design, torque: float | None = None) -> float:
    """Return a typical load of a loaded roller in N: Stribeck's 4/Z of a disc's bearing force.

    That force is √2·T/(e z_c) and the inertia of the disc; T that of the operation unless given.
    """
    flank = design.flank
    torque = design.flange_torque if torque is None else torque
    force = np.sqrt(2) * torque / (len(design.discs) * flank.eccentricity * flank.lobes)
    force += flank.eccentricity * design.crank_speed**2 * design.eccentric_mass
    return roller_seat(design).typical_load(float(force))


def _classical(design: Design, body: ElasticBody | None) -> Law | None:
    """Return the spring of the classical calculation for a rigid disc; None leaves Hertz's law."""
    return LinearSpring(contact_stiffness(design)) if body is None else None


def contact_stiffness(design: Design) -> float:
    """Return the stiffness of one contact in N/m: given, or Hertz's at the largest pin force of the
    classical calculation.
    """
    d = design.drive
    if d.contact_stiffness is not None:
        return d.contact_stiffness
    force = 4 * design.flange_torque / len(design.discs)
    force /= design.flank.trochoid_ratio * d.pin_circle_radius * design.flank.lobes
    force = max(force, least_load(plane(design), d.pin_radius) * d.face_width)
    kernel = np.array([2 * plane(design).kernel / d.face_width])
    approach, _ = HertzLine(kernel, np.array([d.pin_radius])).approach(np.array([force]))
    # the logarithm counts from a depth of one pin diameter in both bodies
    return float(force / (approach[0] + kernel[0] * force * np.log(2 * d.pin_radius)))


def _seat(body: ElasticBody | None, i: int, names: Sequence[str]) -> Seat | None:
    if body is None:
        return None
    return Seat.on(i, [body.compliance.surfaces[name] for name in names])
