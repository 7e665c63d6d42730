"""A mesh of two gears for the contact engine: which teeth may touch, what they press, and with what local law.

    Tooth, bore or outer radius ──► Blank ──► press_gear ──► GearBody      gear_body: S of all flanks, by symmetry
    GearBody, face width, reliefs ──► Wheel                                 once per gear
    Members of two wheels ──► mesh_pair ──► GearPair                        gear_pair: gaps, normals, places (n, c)
    GearPair, Wheels ──► mesh_family ──► Family                             edge_law: Hertz, cut off at tip edges
    Families, elastic bodies, springs, loads ──► Assembly                   one for the whole drive
    Assembly ──► solve_positions ──► Contact                                forces, motions, tangent stiffness
    Contact ──► Path (error of transmission, k(φ), load sharing, pressure)  gear_path, for a pair alone
    the same in slices, each with its own gap ──► FaceLoad                  gear_slices: misalignment, lead crowning
    forces and places ──► RootTable ──► stress in fillets                   gear_root
    two levels of facets ──► PathError                                      gear_estimate

A wheel may be in several meshes at once, a planet with sun and ring: give it the same body number in all of them, and
what one mesh presses the other feels. The first wheel of a mesh has external teeth.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem.assembly import Family
from trochoid.fem.coupling import ElasticBody
from trochoid.fem.gear_body import GearBody
from trochoid.fem.gear_flank import Flank, Posed, Relief
from trochoid.fem.gear_pair import GearPair
from trochoid.fem.laws import HertzLine
from trochoid.fem.material import Plane
from trochoid.fem.pair import Member, Seat
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, IntArray, frozen

MARGIN = 0.5  # of the base pitch: how far off the path of contact, on either side, teeth may still touch

LEAST = 1e-6  # of the radius of curvature: the half width of a contact that nothing loads


@dataclass(frozen=True, slots=True)
class Wheel:
    """A gear for its meshes: flanks, elastic body, face width in m."""

    flank: Flank
    body: GearBody
    width: float

    @staticmethod
    def of(body: GearBody, width: float, reliefs: tuple[Relief, ...] = ()) -> Wheel:
        """Return the wheel of a pressed gear; `reliefs` of its flanks, the same on both hands."""
        return Wheel(Flank.of(body.blank.tooth, reliefs), body, width)

    @property
    def plane(self) -> Plane:
        """The moduli of the body."""
        return self.body.body.plane

    @property
    def elastic(self) -> ElasticBody:
        """The body as the assembly takes it."""
        return ElasticBody(self.body.compliance, self.width)


def mesh_pair(
    wheels: tuple[Wheel, Wheel],
    members: tuple[Member, Member],
    bodies: tuple[int, int],
    hand: int,
    half_width: float,
) -> GearPair:
    """Return the teeth that may touch at the members' nominal poses: centres (n, 2), angles (n,).

    `hand` 1: the flanks of the first wheel at positive polar angles from their spaces; pressed, they push it
    counter-clockwise. A drive with play or floating members has a pair for each hand. `bodies`: numbers in the
    assembly; `half_width` in m of a typical contact, see `contact_width`. Raises Infeasible.
    """
    pair = flank_pair((wheels[0].flank, wheels[1].flank), members, hand, half_width)
    hands = hand, int(wheels[1].flank.side) * hand
    one, two = (_seat(w, b, n, h) for w, b, n, h in zip(wheels, bodies, pair.numbers, hands, strict=True))
    return replace(pair, seats=(one, two))


def flank_pair(
    flanks: tuple[Flank, Flank], members: tuple[Member, Member], hand: int, half_width: float
) -> GearPair:
    """Return the same of rigid gears, which press no bodies."""
    _fail_if_apart(*flanks, members)
    numbers = _numbers(flanks, members, hand)
    nothing = np.zeros(numbers[0].shape[-1])
    return GearPair(members[0], members[1], flanks, hand, numbers, half_width, (None, None), nothing)


def mesh_family(name: str, pair: GearPair, wheels: tuple[Wheel, Wheel]) -> Family:
    """Return the contacts with Hertz's law over the common face width.

    The wider wheel's body counts with its own width; both meet at the depth that the load reaches at 45° when it has
    become as wide as that wheel.
    """
    count, width = len(pair.offset), min(w.width for w in wheels)
    kernel, side = 0.0, 0.0
    for wheel in wheels:
        kernel += wheel.plane.kernel / width
        if wheel.width > width:
            depth = 0.5 * (wheel.width - width)
            side += wheel.plane.kernel * (1.0 / width - 1.0 / wheel.width) * math.log(depth)
    return Family(name, pair, np.full(count, kernel), np.full(count, side))


def contact_width(wheels: tuple[Wheel, Wheel], center_distance: float, force: float) -> float:
    """Return Hertz's half width (m) at the pitch point under a normal force (N): that of a typical contact."""
    one, two = wheels[0].flank, wheels[1].flank
    length = math.sqrt(center_distance**2 - (one.base_radius + two.side * two.base_radius) ** 2)
    share = one.base_radius / (one.base_radius + two.side * two.base_radius)
    rho = abs(length * share), abs(length * (1.0 - share))
    radius = 1.0 / (1.0 / rho[0] + two.side / rho[1])
    width = min(w.width for w in wheels)
    law = HertzLine(np.array([sum(w.plane.kernel for w in wheels) / width]), np.array([radius]))
    return max(float(law.half_width(np.array([force]))[0]), LEAST * radius)


def conjugate_angle(flanks: tuple[Flank, Flank], members: tuple[Member, Member], hand: int) -> Array:
    """Return the angle (n,) of the second member at which unrelieved flanks just touch."""
    one, two = flanks
    length, direction = _line(flanks, members, hand)
    angle = np.asarray(members[0].angle)
    first = Posed(one, np.zeros(1, dtype=complex), angle, hand)
    facing = two.side * (length - first.rho(direction))
    other = int(two.side) * hand
    turned = direction + (math.pi if two.side > 0 else 0.0)
    return np.asarray(turned - other * (two.angle + two.side * facing / two.base_radius))


def _line(flanks: tuple[Flank, Flank], members: tuple[Member, Member], hand: int) -> tuple[Array, Array]:
    """Return the length in m along the first's normal between the feet of the line of action, and the first foot's
    direction in rad, (n,).
    """
    one, two = flanks
    apart = members[1].center - members[0].center
    distance = np.hypot(apart[..., 0], apart[..., 1])
    cosine = (one.base_radius + two.side * two.base_radius) / distance
    turn = np.arccos(np.clip(cosine, -1.0, 1.0))
    length = two.side * distance * np.sqrt(np.maximum(1.0 - cosine**2, 0.0))
    direction = np.arctan2(apart[..., 1], apart[..., 0]) + two.side * hand * turn
    shape = np.broadcast_shapes(direction.shape, np.shape(members[0].angle))
    return np.broadcast_to(length, shape), np.broadcast_to(direction, shape)


def _numbers(
    flanks: tuple[Flank, Flank], members: tuple[Member, Member], hand: int
) -> tuple[IntArray, IntArray]:
    """Return the spaces (n, c) of both wheels beside which flanks may touch, in the order of growing ρ of the first."""
    one, two = flanks
    length, direction = _line(flanks, members, hand)
    pitch, other = one.base_radius * one.pitch, int(two.side) * hand
    low, high = length - two.side * two.end, one.end
    origin = np.zeros(1, dtype=complex)
    zero = Posed(one, origin, np.asarray(members[0].angle), hand).rho(direction)
    begin = np.ceil((low - MARGIN * pitch - zero) / pitch)
    count = int(np.ceil((np.max(high - low) + 2.0 * MARGIN * pitch) / pitch))
    step = begin[..., None] + np.arange(max(1, min(count, round(2.0 * math.pi / one.pitch))))
    facing = two.side * (length[..., None] - zero[..., None] - pitch * step)
    turned = direction + (math.pi if two.side > 0 else 0.0)
    start = Posed(two, origin, np.asarray(members[1].angle), other).rho(turned)
    second = np.rint(two.side * other * (start[..., None] - facing) / pitch)
    first, second = np.broadcast_arrays(-hand * step, second)
    return first.astype(np.intp), second.astype(np.intp)


def _seat(wheel: Wheel, body: int, number: IntArray, hand: int) -> Seat:
    return Seat(body, wheel.body.flank, wheel.body.first(number, hand), frozen(np.zeros(number.shape)))


def _fail_if_apart(one: Flank, two: Flank, members: tuple[Member, Member]) -> None:
    if one.side < 0.0:
        raise Infeasible("the first wheel of a mesh is a ring; give the ring as the second")
    pitches = [f.base_radius * f.pitch for f in (one, two)]
    if abs(pitches[0] - pitches[1]) > 1e-9 * pitches[0]:
        raise Infeasible(
            f"base pitches {1e3 * pitches[0]:.6g} and {1e3 * pitches[1]:.6g} mm: gears that mesh have the same"
        )
    distance = np.linalg.norm(members[1].center - members[0].center, axis=-1)
    least = abs(one.base_radius + two.side * two.base_radius)
    if np.any(distance <= least):
        raise Infeasible(
            f"centre distance {1e3 * float(np.min(distance)):.6g} mm: the base circles need more than "
            f"{1e3 * least:.6g} mm"
        )


def shifted(pair: GearPair, offset: Array | float) -> GearPair:
    """Return the pair with gaps wider by `offset` (c,) in m."""
    return replace(pair, offset=pair.offset + offset)
