"""Pairs: two surfaces that may touch, and how gap, normal and place follow from the motions of their members.

Gaps come from the analytic curves at the displaced poses, never from the mesh.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from trochoid.fem.compliance import Surface, Weights, surface_weights
from trochoid.kinematics.curve import ArcLength, Circle
from trochoid.kinematics.cycloid import Cycloid, Modification, gap
from trochoid.kinematics.types import Array, IntArray, frozen


@dataclass(frozen=True, slots=True)
class Member:
    """A rigid member at its nominal pose: centre (2,) in m, angle in rad; `moves` (3, k) turns the motions
    into x, y and rotation of its centre.
    """

    center: Array
    angle: float
    moves: Array

    def displaced(self, motion: Array) -> tuple[Array, float]:
        """Return centre and angle after the motion (k,)."""
        step = self.moves @ motion
        return self.center + step[:2], self.angle + float(step[2])


@dataclass(frozen=True, slots=True)
class Seat:
    """Where contacts press an elastic body: body number, and per contact a surface; all are equal but for
    their start.

    `surface` is the first contact's; `first` (c,) the first station of each one's own, `shift` (c,) in m how
    much later its arc length begins.
    """

    body: int
    surface: Surface
    first: IntArray
    shift: Array

    @staticmethod
    def on(body: int, surfaces: Sequence[Surface]) -> Seat:
        """Return the seat of contacts on these surfaces, one each."""
        start = surfaces[0].positions[0]
        return Seat(
            body,
            surfaces[0],
            np.array([s.first for s in surfaces], dtype=np.intp),
            frozen([s.positions[0] - start for s in surfaces]),
        )

    def weights(self, position: Array) -> Weights:
        """Return spline weights at arc-length positions (c,)."""
        template = surface_weights(self.surface, position - self.shift)
        return Weights(
            template.columns + (self.first - self.surface.first)[:, None],
            template.values,
            self.first,
            template.kink,
        )


@dataclass(frozen=True, slots=True)
class State:
    """A pair at given motions, for its c contacts.

    `gap` (c,) in m, `arms` (c, k) closing per unit motion, `point` (c, 2) and `normal` (c, 2) (out of the
    first member) in the fixed frame, `parameter` (c,) on the curve, `radius` (c,) combined radius of
    curvature and `place` (c,) arc length on the seat (None: rigid), both in m.
    """

    gap: Array
    arms: Array
    point: Array
    normal: Array
    parameter: Array
    radius: Array
    place: Array | None


class Pair(Protocol):
    """What the position solver asks of a pair."""

    @property
    def seat(self) -> Seat | None:
        """The elastic body pressed, or None."""
        ...

    def at(self, motion: Array, start: Array | None = None) -> State:
        """Return the pair at the motions (k,), searching from the parameters of an earlier state."""
        ...

    def gap_along(self, state: State, motion: Array, offset: Array) -> Array:
        """Return gaps (c, m) at arc-length offsets (c, m) from the contact points."""
        ...

    def turning(self, state: State, motion: Array, force: Array) -> Array:
        """Return the stiffness (k, k) that forces (c,) give the motions because their arms turn with them."""
        ...


def arms_of(
    first: Member, second: Member, centers: tuple[Array, Array], point: Array, normal: Array
) -> Array:
    """Return how fast gaps close (c, k): the first member moving along the normal, the second against it."""
    return _arm(first, centers[0], point, normal) - _arm(second, centers[1], point, normal)


def _arm(member: Member, center: Array, point: Array, normal: Array) -> Array:
    r = point - center
    turning = r[:, 0] * normal[:, 1] - r[:, 1] * normal[:, 0]
    return np.column_stack([normal, turning]) @ member.moves


def turning_of(
    first: Member, second: Member, reach: tuple[Array, Array], normal: Array, bend: Array, force: Array
) -> Array:
    """Return Σ F ∂arm/∂motion (k, k), which is symmetric: the gaps' second derivatives.

    `reach` (c, 2) from both members' centres to a point fixed to the second member, `bend` (c,) in 1/m the
    curvature of the path on which that point keeps its distance from the first member's curve.
    """
    tangent, origin = np.stack([-normal[:, 1], normal[:, 0]], axis=-1), np.zeros(2)
    slide = _arm(first, origin, reach[0], tangent) - _arm(second, origin, reach[1], tangent)
    spin, other = first.moves[2], second.moves[2]
    result = np.outer(spin, force @ slide)
    result = result + result.T - (slide.T * (force * bend)) @ slide
    result -= (force @ (reach[0] * normal).sum(axis=1)) * np.outer(spin, spin)
    result += (force @ (reach[1] * normal).sum(axis=1)) * np.outer(other, other)
    return np.asarray(result)


def rotation(angle: float) -> Array:
    """Return the plane rotation matrix."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])


@dataclass(frozen=True, slots=True)
class FlankPair:
    """A cycloid flank (first member) against round pins fixed to the second; `pins` (c, 2) in the second
    member's frame.
    """

    disc: Member
    ring: Member
    flank: Cycloid
    modification: Modification
    play: float
    pins: Array
    parameter: Array
    arc: ArcLength
    seat: Seat | None
    classical: bool = False

    @staticmethod
    def nominal(
        disc: Member, ring: Member, flank: Cycloid, crank_angle: float, surface: Surface | None = None
    ) -> FlankPair:
        """Return an unmodified flank against all pins at a crank angle in rad; they press a `surface` of body 0."""
        number = np.arange(flank.pins)
        pins = Circle((0.0, 0.0), flank.pin_circle_radius).point(2 * np.pi * number / flank.pins)
        start = flank.contact_parameter(number, crank_angle)
        seat = None if surface is None else Seat.on(0, [surface] * flank.pins)
        return FlankPair(disc, ring, flank, Modification(), 0.0, pins, start, ArcLength(flank), seat)

    def at(self, motion: Array, start: Array | None = None) -> State:
        """Return gaps and arms at the displaced pose; the classical calculation takes the unmodified flank's arms."""
        (center, angle), (ring_center, ring_angle) = self.disc.displaced(motion), self.ring.displaced(motion)
        pins = self.pins @ rotation(ring_angle).T + ring_center
        local = (pins - center) @ rotation(angle)
        opening, t = gap(self.flank, self.modification, local, self.parameter if start is None else start)
        ground = self.flank.modified(self.modification)
        normal = ground.normal(t) @ rotation(angle).T
        if self.modification.rotation:
            # the flank itself is turned: by as much as its pin stands turned beside the unturned one
            beside = ground.point(t) + (opening + self.flank.pin_radius)[:, None] * ground.normal(t)
            normal = _turned_back(normal, local, beside)
        if self.classical:
            normal = self.flank.normal(self.parameter) @ rotation(angle).T
        point = pins - self.flank.pin_radius * normal
        bend = ground.curvature(t) + 1 / self.flank.pin_radius
        return State(
            opening + self.play,
            arms_of(self.disc, self.ring, (center, ring_center), point, normal),
            point,
            normal,
            t,
            1 / bend,
            self.arc.length(t) if self.seat else None,
        )

    def gap_along(self, state: State, motion: Array, offset: Array) -> Array:
        """Return the exact distance of flank points from the pin's circle, less nothing at the contact."""
        ground = self.flank.modified(self.modification)
        t = state.parameter[:, None] + offset / ground.speed(state.parameter)[:, None]
        middle = ground.point(state.parameter) + (state.gap - self.play + self.flank.pin_radius)[
            :, None
        ] * ground.normal(state.parameter)
        distance = np.linalg.norm(ground.point(t) - middle[:, None], axis=-1)
        return np.asarray(distance - self.flank.pin_radius + self.play)

    def turning(self, state: State, motion: Array, force: Array) -> Array:
        """Return the stiffness of turning arms; a pin's centre keeps its distance on a curve parallel to the flank."""
        (center, _), (ring_center, ring_angle) = self.disc.displaced(motion), self.ring.displaced(motion)
        pins = self.pins @ rotation(ring_angle).T + ring_center
        bend = 1 / state.radius - 1 / self.flank.pin_radius
        bend = bend / (1 + bend * (state.gap - self.play + self.flank.pin_radius))
        reach = pins - center, pins - ring_center
        return turning_of(self.disc, self.ring, reach, state.normal, bend, force)


def _turned_back(vectors: Array, at: Array, turned: Array) -> Array:
    """Turn vectors (c, 2) by the angle from points `turned` to points `at` (c, 2), about the origin."""
    angle = np.arctan2(at[:, 1], at[:, 0]) - np.arctan2(turned[:, 1], turned[:, 0])
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * vectors[:, 0] - s * vectors[:, 1], s * vectors[:, 0] + c * vectors[:, 1]], axis=-1)


@dataclass(frozen=True, slots=True)
class HolePair:
    """Round holes in the first member round rollers on the second: holes and rollers (c, 2), each in its
    member's frame.
    """

    disc: Member
    carrier: Member
    holes: Array
    hole_radius: float
    rollers: Array
    roller_radius: float
    seat: Seat | None

    def at(self, motion: Array, start: Array | None = None) -> State:
        """Return gaps and arms at the displaced pose; a roller centred in its hole touches nothing."""
        (center, angle), (hub, hub_angle) = self.disc.displaced(motion), self.carrier.displaced(motion)
        turn = rotation(angle)
        holes = self.holes @ turn.T + center
        rollers = self.rollers @ rotation(hub_angle).T + hub
        apart = rollers - holes
        distance = np.linalg.norm(apart, axis=1)
        normal = -apart / np.maximum(distance, 1e-300)[:, None]
        point = holes - self.hole_radius * normal
        local = -normal @ turn
        t = np.arctan2(local[:, 1], local[:, 0])
        return State(
            self.hole_radius - self.roller_radius - distance,
            arms_of(self.disc, self.carrier, (center, hub), point, normal),
            point,
            normal,
            t,
            np.full(len(t), 1 / (1 / self.roller_radius - 1 / self.hole_radius)),
            self.hole_radius * t if self.seat else None,
        )

    def gap_along(self, state: State, motion: Array, offset: Array) -> Array:
        """Return the exact distance of points of the hole from the roller's circle."""
        apart = self.hole_radius - self.roller_radius - state.gap[:, None]
        angle = offset / self.hole_radius
        # law of cosines between the roller's centre, the hole's centre and the point of the hole
        square = self.hole_radius**2 + apart**2 - 2 * self.hole_radius * apart * np.cos(angle)
        return np.sqrt(square) - self.roller_radius

    def turning(self, state: State, motion: Array, force: Array) -> Array:
        """Return the stiffness of turning arms; a roller's centre keeps its distance on a circle round the hole's."""
        (center, _), (hub, hub_angle) = self.disc.displaced(motion), self.carrier.displaced(motion)
        rollers = self.rollers @ rotation(hub_angle).T + hub
        apart = self.hole_radius - self.roller_radius - state.gap
        bend = -np.divide(1.0, apart, out=np.zeros_like(apart), where=apart > 0)
        return turning_of(
            self.disc, self.carrier, (rollers - center, rollers - hub), state.normal, bend, force
        )
