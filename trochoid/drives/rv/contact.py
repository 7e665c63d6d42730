"""All contacts of an RV drive over the input angle: ring pins on the flanks, rollers of the turning-arm bearings.

Seen from the carrier, which stands: crankshafts have fixed places, discs only shift, the ring turns by a z_p-th of the
crankshafts. Motions: x, y and rotation of each disc; x, y and rotation of each eccentric (of rigid crankshafts their
rotation alone); rotation of the ring, on which the load acts. The sun is held.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.disc_pack import circle
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.supports import Supports, material, supports
from trochoid.fem.bearing import EXPONENT
from trochoid.fem.laws import PowerLaw
from trochoid.fem.material import Plane
from trochoid.fem.pair import FlankPair, HolePair, Member, Seat
from trochoid.fem.position import Assembly, ElasticBody, Family
from trochoid.fem.rows import Shared
from trochoid.fem.seat_law import RollerSeat, round_side
from trochoid.kinematics.types import Array

RING = "ring.rotation"


@dataclass(frozen=True, slots=True)
class Layout(Shared):
    """The motions of a scene by name, with the linear part that holds the crankshafts."""

    names: tuple[str, ...]
    supports: Supports

    def rows(self, **motions: str) -> Array:
        """Return (3, k): x, y and rotation of a member per unit motion, from the motions named for them."""
        rows = np.zeros((3, len(self.names)))
        for i, motion in enumerate(("x", "y", "rotation")):
            if motions.get(motion) in self.names:
                rows[i, self.names.index(motions[motion])] = 1.0
        return rows

    def disc(self, i: int) -> Array:
        """Rows of a disc."""
        return self.rows(x=f"disc{i}.x", y=f"disc{i}.y", rotation=f"disc{i}.rotation")

    def crank(self, j: int, i: int) -> Array:
        """Rows of crankshaft j in the plane of disc i."""
        turn = f"crank{j}.rotation{i}"
        turn = turn if turn in self.names else f"crank{j}.rotation"
        return self.rows(x=f"crank{j}.x{i}", y=f"crank{j}.y{i}", rotation=turn)

    @property
    def ring(self) -> Array:
        """Rows of the ring."""
        return self.rows(rotation=RING)

    def of_cranks(self, values: Array) -> Array:
        """Return the columns of motions (…, k) that are those of the crankshafts."""
        return np.asarray(values[..., [self.names.index(name) for name in self.supports.names]])

    def on_all(self, columns: Array) -> Array:
        """Return rows (…, k) on the crankshafts' motions as rows on all."""
        rows = np.zeros((*columns.shape[:-1], len(self.names)))
        rows[..., [self.names.index(name) for name in self.supports.names]] = columns
        return rows

    def springs(self, matrix: Array) -> Array:
        """Return a stiffness on the crankshafts' motions as one on all (k, k)."""
        at = [self.names.index(name) for name in self.supports.names]
        total = np.zeros((len(self.names),) * 2)
        total[np.ix_(at, at)] = matrix
        return total


def layout(design: Design, teeth: float, cranks: Array | None = None) -> Layout:
    """Choose the motions; `teeth`: stiffness of one mesh of sun and planet along the line of action, N/m.

    `cranks`: that of the crankshafts' bearings, see `supports`.
    """
    discs = [f"disc{i}.{m}" for i in range(len(design.discs)) for m in ("x", "y", "rotation")]
    held = supports(design, teeth, cranks)
    return Layout((*discs, *held.names, RING), held)


def plane(design: Design) -> Plane:
    """Return the plane moduli of discs, pins and rollers."""
    return material(design).plane(design.drive.plane)


def assembly(
    design: Design,
    motions: Layout,
    bodies: tuple[ElasticBody, ...],
    crank: Array,
    torque: float | None = None,
) -> Assembly:
    """Return the contact problem at crank angles (n,) in rad as seen from the carrier.

    `torque` (N·m) on the ring, by default that of the operation, which turns it counter-clockwise.
    """
    families: list[Family] = []
    for i, disc in enumerate(design.discs):
        turn = disc.lead - disc.crank / design.flank.lobes
        member = Member(design.eccentric(i, crank), turn, motions.disc(i))
        families.append(_ring(design, motions, i, member, bodies[disc.body], crank))
        for j in range(len(design.crank_places)):
            families.append(_arm(design, motions, (i, j), member, bodies[disc.body], crank))
    load = np.zeros((len(crank), len(motions.names)))
    load[:, -1] = design.ring_torque if torque is None else torque
    for i in range(len(design.discs)):
        disc_force, eccentric_force = inertia(design, i, crank)
        load += disc_force @ motions.disc(i)[:2]
        for j in range(len(design.crank_places)):
            load += eccentric_force @ motions.crank(j, i)[:2]
    on = tuple(bodies[disc.body] for disc in design.discs)
    return Assembly(tuple(families), on, motions.springs(motions.supports.total), load)


def inertia(design: Design, i: int, crank: Array) -> tuple[Array, Array]:
    """Return the centrifugal forces (n, 2) of disc i and of one eccentric in it; zero without the effect."""
    if not design.scene.has("inertia"):
        return np.zeros((len(crank), 2)), np.zeros((len(crank), 2))
    out = design.crank_speed**2 * design.eccentric(i, crank)
    return design.disc_solid.mass * out, design.eccentric_mass * out


def ring_turn(design: Design, crank: Array) -> Array:
    """Return the angle of the ring as seen from the carrier."""
    return np.asarray(crank) * (design.flank.pins - design.flank.lobes) / design.flank.pins


def _ring(design: Design, motions: Layout, i: int, member: Member, body: ElasticBody, crank: Array) -> Family:
    flank, disc = design.flank, design.discs[i]
    count, width = flank.pins, design.drive.cycloid.face_width
    turn = ring_turn(design, crank)
    start = flank.contact_parameter(np.arange(count), (crank - turn + disc.crank)[..., None]) - disc.lead
    pair = FlankPair(
        member,
        Member(np.zeros(2), turn, motions.ring),
        flank,
        design.modification,
        design.pin_play,
        circle(flank.pin_circle_radius, count),
        start,
        design.arc,
        Seat.on(i, [body.compliance.surfaces["flank"]] * count),
    )
    yields = design.scene.has("pin_compliance")
    kernel, side = round_side(plane(design), count, flank.pin_radius, width, yields)
    return Family(f"ring{i}", pair, kernel, side)


def _arm(
    design: Design, motions: Layout, which: tuple[int, int], member: Member, body: ElasticBody, crank: Array
) -> Family:
    (i, j), bearing = which, design.drive.arm_bearing
    disc, count = design.discs[i], bearing.rollers
    holes = design.holes(disc.body)
    number = (j + disc.first_hole) % holes.count
    # the frame of the crankshaft's axis: turning it swings the eccentric with its rollers
    axis = Member(design.crank_places[j], 0.0, motions.crank(j, i))
    rollers = design.eccentric(i, crank)[:, None] + _on_cage(design, crank)
    pair = HolePair(
        member,
        axis,
        np.repeat(holes.centers[number][None], count, axis=0),
        bearing.hole_radius,
        rollers,
        bearing.roller_radius,
        Seat.on(i, [body.compliance.surfaces[f"hole{number}"]] * count),
    )
    rolling, name = roller_seat(design), f"arm{i}_{j}"
    one, wider = rolling.kernel, rolling.widening
    if not design.scene.has("bearing_compliance"):  # rigid rollers on rigid eccentrics
        return Family(name, pair, np.full(count, one), np.full(count, wider))
    law = PowerLaw(rolling.constant, EXPONENT)
    side = wider + rolling.seat_for_seat(law, rolling.typical_load(nominal_arm_force(design)))
    return Family(name, pair, np.full(count, 2 * one), np.full(count, side), law)


def _on_cage(design: Design, crank: Array) -> Array:
    """Return the rollers (n, c, 2) of a bearing about the eccentric's centre: they roll on it and in the hole."""
    place = circle(design.pitch_radius, design.drive.arm_bearing.rollers)
    angle = cage_angle(design, crank)
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    return np.stack([c * place[:, 0] - s * place[:, 1], s * place[:, 0] + c * place[:, 1]], axis=-1)


def cage_angle(design: Design, crank: Array) -> Array:
    """Return the angle (n,) of a bearing's first roller about the eccentric's centre."""
    inner, outer = design.race_radius, design.drive.arm_bearing.hole_radius
    return np.asarray(crank * inner / (inner + outer))


def roller_seat(design: Design) -> RollerSeat:
    """Return the rollers of a turning-arm bearing in the crank hole of a disc."""
    bearing = design.drive.arm_bearing
    return RollerSeat(
        plane(design),
        design.drive.plane,
        bearing.rollers,
        bearing.roller_radius,
        bearing.roller_length,
        design.race_radius,
        bearing.hole_radius,
        design.drive.cycloid.face_width,
    )


def side_slopes(design: Design) -> dict[str, float]:
    """Return by families how their round sides change with the ring's torque, m/N per N·m: rollers have the seat of a
    typical load.
    """
    if not design.scene.has("bearing_compliance") or not design.ring_torque:
        return {}
    seat, small = roller_seat(design), 1e-4
    law = PowerLaw(seat.constant, EXPONENT)
    force = nominal_arm_force(design)  # grows with the torque in proportion
    more, less = (seat.seat_for_seat(law, seat.typical_load(force * (1.0 + x))) for x in (small, -small))
    slope = (more - less) / (2.0 * small * design.ring_torque)
    return {f"arm{i}_{j}": slope for i in range(len(design.discs)) for j in range(len(design.crank_places))}


def nominal_arm_force(design: Design) -> float:
    """Return a typical force of a turning-arm bearing, N: the share of the pins' √2 T/(e z_c) and of the torque about
    the axis, T/L, both over discs and crankshafts.
    """
    flank, cranks = design.flank, len(design.crank_places)
    torque = design.ring_torque / len(design.discs)
    pins = np.sqrt(2) * torque / (flank.eccentricity * flank.lobes)
    return float(np.hypot(pins, torque / design.first.arm) / cranks)
