"""Two involute gears as a pair of the contact engine: gaps, normals and places of all teeth that may touch.

On both involutes a contact lies on the common tangent of the base circles; everything is in closed form, also at the
displaced centres of floating members. Beyond the end of an involute the rounded tip edge of one tooth meets the flank
of the other, early and late. Relief shifts the contact along the flanks to where they are closest. Nothing is
sampled.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem.edge_law import centroid
from trochoid.fem.gear_flank import Flank, Posed
from trochoid.fem.gear_touch import Touching, closest, profile
from trochoid.fem.pair import Member, Seat, State, arms_of, tangent_of, turning_of
from trochoid.kinematics.types import Array, ComplexArray, IntArray


@dataclass(frozen=True, slots=True)
class GearPair:
    """Flanks of one hand of the first gear (external) against those of the second (external, or a ring).

    `hand` 1: flanks at positive polar angles from their spaces; they push the first gear counter-clockwise when
    pressed. `numbers`: the spaces (n, c) of both gears beside which the flanks of the c contacts stand, in the
    members' frames, whose x axis at angle zero is the middle of a space. `half_width` in m of a typical contact:
    beside a tip edge the pressure lies inside it by about that much. `offset` (c,) in m is added to the gaps (pitch
    errors, a slice's place on a crowned or misaligned flank).
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
            self._size(),
        )

    def gap_along(self, state: State, motion: Array, offset: Array) -> Array:
        """Return the exact distance of points of the first profile, flank and rounding, from the second's."""
        one, two = (p.wide() for p in self._posed(motion))
        gap = (state.gap - self.offset)[..., None]
        normal = (state.normal[..., 0] + 1j * state.normal[..., 1])[..., None]
        point = profile(one, state.parameter[..., None] + offset) + gap * normal
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
        bend = np.divide(1.0, away, out=np.full_like(away, np.inf), where=away != 0.0)
        return turning_of(self.first, self.second, reach, state.normal, bend, force)

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

    def _size(self) -> float:
        """Return what the rounding of gaps is in proportion to, in m: angles are known to that of two radians or so."""
        return 2.0 * max(f.base_radius for f in self.flanks)

    def _touch(self, motion: Array) -> Touching:
        return closest(*self._posed(motion))

    def _places(self, touch: Touching) -> tuple[Array, Array, Array]:
        """Return the nearer edge (n, c, 2), and the arc lengths (n, c) on both flanks under the pressure's centroid.

        Beside an edge the pressure lies off the closest place, towards the inside; what it does to both bodies counts
        there.
        """
        one, two = self.flanks
        inside = np.minimum(-touch.over[0], -touch.over[1])
        own = touch.over[0] >= touch.over[1]
        rounding = np.where(own, one.rounding, two.rounding)
        shift = centroid(self.half_width, inside) - np.maximum(inside, 0.0)
        shift = np.where(own, -shift, shift)  # along the first flank, outwards
        place, far = one.arc(touch.rho[0]) + shift, two.arc(touch.rho[1]) - two.side * shift
        return np.stack([inside, rounding], axis=-1), place, far


def _taken(numbers: IntArray, rows: IntArray) -> IntArray:
    return numbers if numbers.ndim == 1 else numbers[rows]


def _plane(z: ComplexArray) -> Array:
    return np.stack([z.real, z.imag], axis=-1)
