"""Two involute gears as a pair of the contact engine: gaps, normals and places of all teeth that may touch.

On both involutes a contact lies on the common tangent of the base circles; everything is in closed form, also at the
displaced centres of floating members. Beyond the end of an involute the rounded tip edge of one tooth meets the flank of
the other, early and late. Relief shifts the contact along the flanks to where they are closest. Nothing is sampled.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem.edge_law import centroid
from trochoid.fem.gear_flank import Flank, Posed
from trochoid.fem.pair import Member, Seat, State, arms_of, tangent_of, turning_of
from trochoid.kinematics.types import Array, BoolArray, ComplexArray, IntArray

SEARCH = 40  # steps towards the closest place of relieved flanks; they halve a bracket at the worst
FINE = 1e-13  # slope between flanks that touch


@dataclass(frozen=True, slots=True)
class GearPair:
    """Flanks of one hand of the first gear (external) against those of the second (external, or a ring).

    `hand` 1: flanks at positive polar angles from their spaces; they push the first gear counter-clockwise when pressed.
    `numbers`: the spaces (n, c) of both gears beside which the flanks of the c contacts stand, in the members' frames,
    whose x axis at angle zero is the middle of a space. `half_width` in m of a typical contact: beside a tip edge the
    pressure lies inside it by about that much. `offset` (c,) in m
    is added to the gaps (pitch errors, a slice's place on a crowned or misaligned flank).
    """

    first: Member
    second: Member
    flanks: tuple[Flank, Flank]
    hand: int
    numbers: tuple[IntArray, IntArray]
    half_width: float
    seats: tuple[Seat | None, Seat | None]
    offset: Array

    @property
    def seat(self) -> Seat | None:
        """The first gear's body."""
        return self.seats[0]

    @property
    def far_seat(self) -> Seat | None:
        """The second gear's body."""
        return self.seats[1]

    def rows(self, rows: IntArray) -> GearPair:
        """Return the pair at some positions."""
        one, two = self.seats
        return replace(
            self,
            first=self.first.at(rows),
            second=self.second.at(rows),
            numbers=(_taken(self.numbers[0], rows), _taken(self.numbers[1], rows)),
            seats=(None if one is None else one.at(rows), None if two is None else two.at(rows)),
        )

    def at(self, motion: Array, start: Array | None = None) -> State:
        """Return gaps, normals and places at the displaced poses."""
        touch = self._touch(motion)
        centers = self.first.displaced(motion)[0], self.second.displaced(motion)[0]
        point, normal = _plane(touch.point), _plane(touch.normal)
        edge, place, far = self._places(touch)
        return State(
            touch.gap + self.offset,
            arms_of(self.first, self.second, centers, point, normal),
            point,
            normal,
            touch.along,
            1.0 / touch.plain,
            place if self.seats[0] else None,
            far if self.seats[1] else None,
            edge,
        )

    def gap_along(self, state: State, motion: Array, offset: Array) -> Array:
        """Return the exact distance of points of the first profile, flank and rounding, from the second's."""
        one, two = (p.wide() for p in self._posed(motion))
        gap = (state.gap - self.offset)[..., None]
        normal = (state.normal[..., 0] + 1j * state.normal[..., 1])[..., None]
        point = _profile(one, state.parameter[..., None] + offset) + gap * normal
        distance, rho, _ = two.seen(point)
        rounded = np.abs(point - two.edge()) - two.flank.rounding
        return np.where(two.flank.beyond(rho) > 0.0, rounded, distance) + state.gap[..., None]

    def turning(self, state: State, motion: Array, force: Array) -> Array:
        """Return the stiffness of turning arms: the second flank is a circle to second order."""
        touch = self._touch(motion)
        (center, _), (other, _) = self.first.displaced(motion), self.second.displaced(motion)
        middle = touch.point + (touch.gap + touch.radii[1]) * touch.normal
        away = 1.0 / touch.bend + touch.radii[1] + touch.gap
        reach = _plane(middle) - center[..., None, :], _plane(middle) - other[..., None, :]
        return turning_of(self.first, self.second, reach, state.normal, 1.0 / away, force)

    def sliding(self, state: State, motion: Array) -> Array:
        """Return how fast the first gear's flanks slide past the second's."""
        centers = self.first.displaced(motion)[0], self.second.displaced(motion)[0]
        return arms_of(self.first, self.second, centers, state.point, tangent_of(state.normal))

    def _posed(self, motion: Array) -> tuple[Posed, Posed]:
        one, two = self.flanks
        other = int(two.side) * self.hand
        return (
            Posed.at(one, self.first.displaced(motion), self.numbers[0], self.hand),
            Posed.at(two, self.second.displaced(motion), self.numbers[1], other),
        )

    def _touch(self, motion: Array) -> _Touch:
        one, two = self._posed(motion)
        rho = _closest(one, two)
        point, normal = one.point(rho)
        gap, facing, _ = two.seen(point)
        over = one.flank.beyond(rho), two.flank.beyond(facing)
        along = 0.5 * rho**2 / one.flank.base_radius
        plain = _Touch(
            gap, point, normal, (rho, facing), along, over, *_bends(one.flank, two.flank, rho, facing)
        )
        return _over_second(one, two, _over_first(one, two, plain))

    def _places(self, touch: _Touch) -> tuple[Array, Array, Array]:
        """Return the nearer edge (n, c, 2), and the arc lengths (n, c) on both flanks under the pressure's centroid.

        Beside an edge the pressure lies off the closest place, towards the inside; what it does to both bodies counts there.
        """
        one, two = self.flanks
        inside = np.minimum(-touch.over[0], -touch.over[1])
        own = touch.over[0] >= touch.over[1]
        rounding = np.where(own, one.rounding, two.rounding)
        shift = centroid(self.half_width, inside) - np.maximum(inside, 0.0)
        shift = np.where(own, -shift, shift)  # along the first flank, outwards
        place, far = one.arc(touch.rho[0]) + shift, two.arc(touch.rho[1]) - two.side * shift
        return np.stack([inside, rounding], axis=-1), place, far


@dataclass(frozen=True, slots=True)
class _Touch:
    """Closest places (n, c): gap, `point` on the first profile and normal out of it, ρ on both flanks, arc length `along`
    the first profile; `over`, how far the flanks' closest place lies beyond both involutes; `bend` (1/m) of the first
    profile and `radii` (m) of both, positive where convex; `plain` the flanks' common curvature, as if they went on.
    """

    gap: Array
    point: ComplexArray
    normal: ComplexArray
    rho: tuple[Array, Array]
    along: Array
    over: tuple[Array, Array]
    bend: Array
    radii: tuple[Array, Array]
    plain: Array


def _bends(one: Flank, two: Flank, rho: Array, facing: Array) -> tuple[Array, tuple[Array, Array], Array]:
    first = one.side / one.curved(rho) + one.relief(rho)[2]
    second = two.side / two.curved(facing) + two.relief(facing)[2]
    return first, (1.0 / first, 1.0 / second), first + second


def _closest(one: Posed, two: Posed) -> Array:
    """Return ρ (n, c) on the first flank where two involutes, that may go on beyond their ends, are closest."""
    apart = two.center - one.center
    cosine = (one.flank.base_radius + two.flank.side * two.flank.base_radius) / np.abs(apart)
    turn = two.flank.side * one.hand * np.arccos(np.clip(cosine, -1.0, 1.0))
    rho = one.rho(np.angle(apart) + turn)
    if not (one.flank.reliefs or two.flank.reliefs):
        return rho
    return _searched(one, two, rho)


def _searched(one: Posed, two: Posed, rho: Array) -> Array:
    """Move ρ to where relieved flanks are parallel: Newton on their slope along the arc, within a bracket."""
    base = one.flank.base_radius
    s = 0.5 * np.maximum(rho, 0.0) ** 2 / base
    low, high = np.zeros(s.shape), s + 0.5 * one.flank.end**2 / base
    for _ in range(SEARCH):
        rho = np.sqrt(2.0 * base * s)
        slope, bend = _slope(one, two, rho)
        low, high = np.where(slope < 0.0, s, low), np.where(slope > 0.0, s, high)
        step = s - slope / bend
        inside = (step >= low) & (step <= high) & (bend > 0.0)
        done = np.abs(slope) <= FINE
        s = np.where(done, s, np.where(inside, step, 0.5 * (low + high)))
        if done.all():
            break
    return np.sqrt(2.0 * base * s)


def _slope(one: Posed, two: Posed, rho: Array) -> tuple[Array, Array]:
    """Return how the distance between the flanks grows along the first one's arc, and its growth's growth in 1/m."""
    point, normal = one.point(rho)
    _, facing, other = two.seen(point)
    slope = np.real(np.conj(other) * (1j * one.hand * normal))
    return np.asarray(slope), _bends(one.flank, two.flank, rho, facing)[2]


def _over_first(one: Posed, two: Posed, touch: _Touch) -> _Touch:
    """Put the first gear's tip rounding in the place of its flank where the closest place lies beyond."""
    center, radius = one.edge(), one.flank.rounding
    distance, facing, other = two.seen(center)
    end = np.full(facing.shape, one.flank.end)
    _, last = one.point(end)
    turned = np.clip(one.hand * np.angle(-other / last), 0.0, math.pi)
    bend = np.full(facing.shape, 1.0 / radius)
    second = _bends(one.flank, two.flank, end, facing)[1][1]
    along = 0.5 * end**2 / one.flank.base_radius + radius * turned
    edge = _Touch(
        distance - radius,
        center - radius * other,
        -other,
        (end, facing),
        along,
        touch.over,
        bend,
        (1.0 / bend, second),
        touch.plain,
    )
    return _chosen(touch.over[0] > 0.0, edge, touch)


def _over_second(one: Posed, two: Posed, touch: _Touch) -> _Touch:
    """Put the second gear's tip rounding in the place of its flank where the closest place lies beyond."""
    center, radius = two.edge(), two.flank.rounding
    distance, rho, normal = one.seen(center)
    end = np.full(rho.shape, two.flank.end)
    first, radii, _ = _bends(one.flank, two.flank, rho, end)
    gap = distance - radius
    edge = _Touch(
        gap,
        center - distance * normal,
        normal,
        (rho, end),
        0.5 * np.maximum(rho, 0.0) ** 2 / one.flank.base_radius,
        touch.over,
        first,
        (radii[0], np.full(rho.shape, radius)),
        touch.plain,
    )
    return _chosen((touch.over[1] > 0.0) & (touch.over[0] <= 0.0), edge, touch)


def _chosen(where: BoolArray, one: _Touch, other: _Touch) -> _Touch:
    def pick(a: Array, b: Array) -> Array:
        return np.where(where, a, b)

    return _Touch(
        pick(one.gap, other.gap),
        np.where(where, one.point, other.point),
        np.where(where, one.normal, other.normal),
        (pick(one.rho[0], other.rho[0]), pick(one.rho[1], other.rho[1])),
        pick(one.along, other.along),
        other.over,
        pick(one.bend, other.bend),
        (pick(one.radii[0], other.radii[0]), pick(one.radii[1], other.radii[1])),
        other.plain,
    )


def _profile(one: Posed, along: Array) -> ComplexArray:
    """Return points of the first profile at arc lengths (n, c, m): flank, then rounding."""
    f = one.flank
    last = 0.5 * f.end**2 / f.base_radius
    rho = np.sqrt(2.0 * f.base_radius * np.clip(along, 0.0, last))
    point, _ = one.point(rho)
    center = one.edge()
    _, normal = one.point(np.full(one.phase.shape, f.end))
    turned = np.clip((along - last) / f.rounding, 0.0, math.pi)
    round_ = center + f.rounding * normal * np.exp(1j * one.hand * turned)
    return np.where(along > last, round_, point)


def _taken(numbers: IntArray, rows: IntArray) -> IntArray:
    return numbers if numbers.ndim == 1 else numbers[rows]


def _plane(z: ComplexArray) -> Array:
    return np.stack([z.real, z.imag], axis=-1)
