"""Pairs: two surfaces that may touch, and how gap, normal and place follow from the motions of their members.

Gaps come from the analytic curves at the displaced poses, never from the mesh. Many positions are taken side by side:
poses, motions and states then have the positions as first axis, written (n) here; one position has none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol, Self, TypeVar

import numpy as np
import numpy.typing as npt

from trochoid.fem.compliance import Surface, Weights, surface_weights
from trochoid.kinematics.curve import ArcLength, Circle
from trochoid.kinematics.cycloid import Cycloid, Modification, gap
from trochoid.kinematics.types import Array, IntArray, frozen


@dataclass(frozen=True, slots=True)
class Member:
    """A rigid member at its nominal pose: centre (n, 2) in m, angle (n) in rad; `moves` (3, k) turns the motions
    into x, y and rotation of its centre.
    """

    center: Array
    angle: Array | float
    moves: Array

    def displaced(self, motion: Array) -> tuple[Array, Array]:
        """Return centre (n, 2) and angle (n) after the motion (n, k)."""
        step = motion @ self.moves.T
        return self.center + step[..., :2], np.asarray(self.angle + step[..., 2])

    def at(self, rows: IntArray) -> Member:
        """Return the member at some positions; one without that axis stands still."""
        center = self.center if self.center.ndim == 1 else self.center[rows]
        angle = np.asarray(self.angle)
        return Member(center, angle if angle.ndim == 0 else angle[rows], self.moves)


@dataclass(frozen=True, slots=True)
class Seat:
    """Where contacts press an elastic body: body number, and per contact a surface; all are equal but for
    their start.

    `surface` is the first contact's; `first` (c,) the first station of each one's own, `shift` (c,) in m how
    much later its arc length begins. Contacts that move on from tooth to tooth have both for each position, (n, c).
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
        """Return spline weights at arc-length positions (n, c): columns and values (n, c, 4)."""
        template = surface_weights(self.surface, position - self.shift)
        columns = template.columns + (self.first - self.surface.first)[..., None]
        return replace(template, columns=columns, surface=np.broadcast_to(self.first, position.shape))

    def at(self, rows: IntArray) -> Seat:
        """Return the seat at some positions."""
        return replace(self, first=_rows(self.first, rows), shift=_rows(self.shift, rows))


@dataclass(frozen=True, slots=True)
class State:
    """A pair at given motions, for its c contacts.

    `gap` (n, c) in m, `arms` (n, c, k) closing per unit motion, `point` (n, c, 2) and `normal` (n, c, 2) (out of the
    first member) in the fixed frame, `parameter` (n, c) on the curve, `radius` (n, c) combined radius of
    curvature and `place` (n, c) arc length on the seat (None: rigid), both in m; `far` (n, c) that on the second
    member's seat. `edge` (n, c, 2) where surfaces end: how far inside the edge the contact lies, negative beyond it,
    and the rounding of the edge, in m. Gaps are known to rounding of the coordinates of `point`, or of `size` (m).
    """

    gap: Array
    arms: Array
    point: Array
    normal: Array
    parameter: Array
    radius: Array
    place: Array | None
    far: Array | None = None
    edge: Array | None = None
    size: float = 0.0


class Pair(Protocol):
    """What the position solver asks of a pair."""

    @property
    def seat(self) -> Seat | None:
        """The elastic body pressed, or None."""
        ...

    @property
    def far_seat(self) -> Seat | None:
        """The second member's elastic body, or None where that side is rigid or in closed form."""
        ...

    def rows(self, rows: IntArray) -> Self:
        """Return the pair at some positions."""
        ...

    def at(self, motion: Array, start: Array | None = None) -> State:
        """Return the pair at the motions (n, k), searching from the parameters of an earlier state."""
        ...

    def gap_along(self, state: State, motion: Array, offset: Array) -> Array:
        """Return gaps (n, c, m) at arc-length offsets (n, c, m) from the contact points."""
        ...

    def turning(self, state: State, motion: Array, force: Array) -> Array:
        """Return the stiffness (n, k, k) that forces (n, c) give the motions because their arms turn with them."""
        ...

    def sliding(self, state: State, motion: Array) -> Array:
        """Return how fast the first member slides past the second along the tangent, per unit motion (n, c, k).

        The tangent is the normal turned by +90°.
        """
        ...


def arms_of(
    first: Member, second: Member, centers: tuple[Array, Array], point: Array, direction: Array
) -> Array:
    """Return how fast the first member's point moves along a direction past the second's (n, c, k): along the normal
    gaps close.
    """
    return _arm(first, point - centers[0][..., None, :], direction) - _arm(
        second, point - centers[1][..., None, :], direction
    )


def _arm(member: Member, reach: Array, direction: Array) -> Array:
    turning = reach[..., 0] * direction[..., 1] - reach[..., 1] * direction[..., 0]
    return np.asarray(np.concatenate([direction, turning[..., None]], axis=-1) @ member.moves)


def tangent_of(normal: Array) -> Array:
    """Return the normal turned by +90°."""
    return np.stack([-normal[..., 1], normal[..., 0]], axis=-1)


def turning_of(
    first: Member, second: Member, reach: tuple[Array, Array], normal: Array, bend: Array, force: Array
) -> Array:
    """Return Σ F ∂arm/∂motion (n, k, k), which is symmetric: the gaps' second derivatives.

    `reach` (n, c, 2) from both members' centres to a point fixed to the second member, `bend` (n, c) in 1/m the
    curvature of the path on which that point keeps its distance from the first member's curve.
    """
    tangent = tangent_of(normal)
    slide = _arm(first, reach[0], tangent) - _arm(second, reach[1], tangent)
    spin, other = first.moves[2], second.moves[2]
    along = np.matmul(force[..., None, :], slide)  # (n, 1, k)
    result = spin[:, None] * along
    result = result + result.swapaxes(-1, -2)
    result -= (slide * (force * bend)[..., None]).swapaxes(-1, -2) @ slide
    inner, outer = ((force * (r * normal).sum(axis=-1)).sum(axis=-1)[..., None, None] for r in reach)
    result -= inner * np.outer(spin, spin)
    result += outer * np.outer(other, other)
    return np.asarray(result)


def rotation(angle: Array | float) -> Array:
    """Return the plane rotation matrices (n, 2, 2)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([np.stack([c, -s], axis=-1), np.stack([s, c], axis=-1)], axis=-2)


def _placed(points: Array, center: Array, angle: Array) -> Array:
    """Return points (c, 2) or (n, c, 2) of a member in the fixed frame."""
    return np.asarray(points @ rotation(angle).swapaxes(-1, -2) + center[..., None, :])


T = TypeVar("T", bound=np.generic)


def _rows(values: npt.NDArray[T], rows: IntArray) -> npt.NDArray[T]:
    """Return parameters (n, c) at some positions; (c,) belong to a single one."""
    return values if values.ndim == 1 else values[rows]


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
        disc: Member, ring: Member, flank: Cycloid, crank_angle: Array | float, surface: Surface | None = None
    ) -> FlankPair:
        """Return an unmodified flank against all pins at crank angles (n) in rad; they press a `surface` of body 0."""
        number = np.arange(flank.pins)
        pins = Circle((0.0, 0.0), flank.pin_circle_radius).point(2 * np.pi * number / flank.pins)
        start = flank.contact_parameter(number, np.asarray(crank_angle)[..., None])
        seat = None if surface is None else Seat.on(0, [surface] * flank.pins)
        return FlankPair(disc, ring, flank, Modification(), 0.0, pins, start, ArcLength(flank), seat)

    @property
    def far_seat(self) -> None:
        """None: the round side is in closed form."""
        return None

    def rows(self, rows: IntArray) -> FlankPair:
        """Return the pair at some positions."""
        parameter = _rows(self.parameter, rows)
        return replace(self, disc=self.disc.at(rows), ring=self.ring.at(rows), parameter=parameter)

    def at(self, motion: Array, start: Array | None = None) -> State:
        """Return gaps and arms at the displaced pose; the classical calculation takes the unmodified flank's arms."""
        (center, angle), (ring_center, ring_angle) = self.disc.displaced(motion), self.ring.displaced(motion)
        pins = _placed(self.pins, ring_center, ring_angle)
        turn = rotation(angle)
        back = turn.swapaxes(-1, -2)
        local = (pins - center[..., None, :]) @ turn
        opening, t = gap(self.flank, self.modification, local, self.parameter if start is None else start)
        ground = self.flank.modified(self.modification)
        normal = ground.normal(t) @ back
        if self.modification.rotation:
            # the flank itself is turned: by as much as its pin stands turned beside the unturned one
            beside = ground.point(t) + (opening + self.flank.pin_radius)[..., None] * ground.normal(t)
            normal = _turned_back(normal, local, beside)
        if self.classical:
            normal = self.flank.normal(self.parameter) @ back
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
        t = state.parameter[..., None] + offset / ground.speed(state.parameter)[..., None]
        middle = ground.point(state.parameter) + (state.gap - self.play + self.flank.pin_radius)[
            ..., None
        ] * ground.normal(state.parameter)
        distance = np.linalg.norm(ground.point(t) - middle[..., None, :], axis=-1)
        return np.asarray(distance - self.flank.pin_radius + self.play)

    def turning(self, state: State, motion: Array, force: Array) -> Array:
        """Return the stiffness of turning arms; a pin's centre keeps its distance on a curve parallel to the flank."""
        (center, _), (ring_center, ring_angle) = self.disc.displaced(motion), self.ring.displaced(motion)
        pins = _placed(self.pins, ring_center, ring_angle)
        bend = 1 / state.radius - 1 / self.flank.pin_radius
        bend = bend / (1 + bend * (state.gap - self.play + self.flank.pin_radius))
        reach = pins - center[..., None, :], pins - ring_center[..., None, :]
        return turning_of(self.disc, self.ring, reach, state.normal, bend, force)

    def sliding(self, state: State, motion: Array) -> Array:
        """Return how fast the flank slides past the pins."""
        centers = self.disc.displaced(motion)[0], self.ring.displaced(motion)[0]
        return arms_of(self.disc, self.ring, centers, state.point, tangent_of(state.normal))


def _turned_back(vectors: Array, at: Array, turned: Array) -> Array:
    """Turn vectors (…, 2) by the angle from points `turned` to points `at` (…, 2), about the origin."""
    angle = np.arctan2(at[..., 1], at[..., 0]) - np.arctan2(turned[..., 1], turned[..., 0])
    c, s = np.cos(angle), np.sin(angle)
    x, y = vectors[..., 0], vectors[..., 1]
    return np.stack([c * x - s * y, s * x + c * y], axis=-1)


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

    @property
    def far_seat(self) -> None:
        """None: the round side is in closed form."""
        return None

    def rows(self, rows: IntArray) -> HolePair:
        """Return the pair at some positions."""
        rollers = self.rollers if self.rollers.ndim == 2 else self.rollers[rows]
        return replace(self, disc=self.disc.at(rows), carrier=self.carrier.at(rows), rollers=rollers)

    def at(self, motion: Array, start: Array | None = None) -> State:
        """Return gaps and arms at the displaced pose; a roller centred in its hole touches nothing."""
        (center, angle), (hub, hub_angle) = self.disc.displaced(motion), self.carrier.displaced(motion)
        holes, rollers = _placed(self.holes, center, angle), _placed(self.rollers, hub, hub_angle)
        apart = rollers - holes
        distance = np.linalg.norm(apart, axis=-1)
        normal = -apart / np.maximum(distance, 1e-300)[..., None]
        point = holes - self.hole_radius * normal
        local = -normal @ rotation(angle)
        t = np.arctan2(local[..., 1], local[..., 0])
        return State(
            self.hole_radius - self.roller_radius - distance,
            arms_of(self.disc, self.carrier, (center, hub), point, normal),
            point,
            normal,
            t,
            np.full(t.shape, 1 / (1 / self.roller_radius - 1 / self.hole_radius)),
            self.hole_radius * t if self.seat else None,
        )

    def gap_along(self, state: State, motion: Array, offset: Array) -> Array:
        """Return the exact distance of points of the hole from the roller's circle."""
        apart = self.hole_radius - self.roller_radius - state.gap[..., None]
        angle = offset / self.hole_radius
        # law of cosines between the roller's centre, the hole's centre and the point of the hole
        square = self.hole_radius**2 + apart**2 - 2 * self.hole_radius * apart * np.cos(angle)
        return np.sqrt(square) - self.roller_radius

    def turning(self, state: State, motion: Array, force: Array) -> Array:
        """Return the stiffness of turning arms; a roller's centre keeps its distance on a circle round the hole's."""
        (center, _), (hub, hub_angle) = self.disc.displaced(motion), self.carrier.displaced(motion)
        rollers = _placed(self.rollers, hub, hub_angle)
        apart = self.hole_radius - self.roller_radius - state.gap
        bend = -np.divide(1.0, apart, out=np.zeros_like(apart), where=apart > 0)
        reach = rollers - center[..., None, :], rollers - hub[..., None, :]
        return turning_of(self.disc, self.carrier, reach, state.normal, bend, force)

    def sliding(self, state: State, motion: Array) -> Array:
        """Return how fast the holes slide past the rollers."""
        centers = self.disc.displaced(motion)[0], self.carrier.displaced(motion)[0]
        return arms_of(self.disc, self.carrier, centers, state.point, tangent_of(state.normal))
