"""The slotted wheel of an indexer on the unit sphere: rim, slots with round bottoms, hub, one wall of a slot finer.

Walls lie `opening` beside the great circle in the middle of a slot, as a pin cuts them whose apex is the centre.
The chart is the stereographic one from the pole opposite to the wheel's axis: it keeps angles and closes round it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.geometry.sphere_outline import Side, SphereOutline
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.spherical_curve import SmallCircle
from trochoid.kinematics.types import Array

WALL, HUB = "wall", "hub"  # names of sides
SLOPE = 0.3  # of the distance, by which facets grow
BESIDE = 3  # slots to either side of the pressed one that are cut; farther ones are not felt


@dataclass(frozen=True, slots=True)
class SlottedWheel:
    """Angles in rad from the wheel's axis: `rim`, `bottom` (middle of a slot's round end), `hub`; `opening` is half
    the slot's width, `swing` from one of the `slots` to the next (the last gap takes what is left of a turn).

    Raises Infeasible where slots cut the hub or each other.
    """

    rim: float
    bottom: float
    hub: float
    opening: float
    swing: float
    slots: int

    def __post_init__(self) -> None:
        """Refuse what is no wheel."""
        if not 0.0 < self.hub < self.bottom - self.opening:
            raise Infeasible(
                f"a hub at {math.degrees(self.hub):.6g}° from the axis and slots down to "
                f"{math.degrees(self.bottom - self.opening):.6g}°: the hub must be above 0° and below these"
            )
        if not self.bottom < self.rim < math.pi - self.opening:
            raise Infeasible(
                f"a rim at {math.degrees(self.rim):.6g}° and slots from {math.degrees(self.bottom):.6g}°: the rim "
                f"must be farther from the axis, and below {180.0 - math.degrees(self.opening):.6g}°"
            )
        if 2.0 * self.edge >= min(self.swing, self.last_gap):
            raise Infeasible(
                f"slots {2.0 * math.degrees(self.edge):.6g}° wide at the rim run into each other on a swing of "
                f"{math.degrees(self.swing):.6g}°"
            )

    @property
    def mouth(self) -> float:
        """Angle (rad) along the middle of a slot at which its walls end."""
        return math.acos(math.cos(self.rim) / math.cos(self.opening))

    @property
    def edge(self) -> float:
        """Azimuth (rad) from the middle of a slot to its wall on the rim."""
        return math.asin(math.sin(self.opening) / math.sin(self.rim))

    @property
    def azimuths(self) -> Array:
        """Azimuths (rad) of the slots that are cut, growing: of many, those next to slot 0 alone."""
        number = np.arange(self.slots)
        near = np.minimum(number, self.slots - number) <= BESIDE
        return np.asarray(self.swing * number[near])

    @property
    def last_gap(self) -> float:
        """Azimuth (rad) from the last slot to the first."""
        return 2.0 * math.pi - (self.slots - 1) * self.swing

    @property
    def wall(self) -> SmallCircle:
        """The pressed wall, that of slot 0 towards growing azimuth; its parameter is the angle along the slot."""
        return SmallCircle((0.0, 1.0, 0.0), 0.5 * math.pi - self.opening)


@dataclass(frozen=True, eq=False, slots=True)
class PolarOutline(SphereOutline):
    """An outline about the z axis in the stereographic chart: tan(polar angle/2) times the direction."""

    def to_chart(self, vectors: Array) -> Array:
        """Return chart coordinates (..., 2) of unit vectors (..., 3)."""
        return np.asarray(vectors[..., :2] / (1.0 + vectors[..., 2:]))

    def from_chart(self, places: Array) -> Array:
        """Return unit vectors (..., 3) of chart coordinates (..., 2)."""
        square = np.sum(places**2, axis=-1, keepdims=True)
        return np.asarray(np.concatenate([2.0 * places, 1.0 - square], axis=-1) / (1.0 + square))


def slotted_outline(
    wheel: SlottedWheel, facet: float, edge: float, nearest: float, coarse: float = 4.0, times: float = 1.0
) -> PolarOutline:
    """Return the outline with facets of the size `facet` (rad) on the pressed wall from `nearest` (rad) to its mouth.

    They shrink to the size `edge` (rad) at both ends. Other walls have facets `coarse` times as long.  Facets that
    follow from the shape alone, of rim, hub, round ends and slim walls, are `times` as many.
    Sides: "wall", "hub" and "free0" and on.
    """
    breaks = wall_breaks(wheel, facet, edge, nearest)
    up = _side(WALL, wheel.wall.point, breaks)
    plain = _plain_breaks(wheel, facet * coarse, times)
    rounds = np.linspace(-0.5 * math.pi, 0.5 * math.pi, round(6.0 * times) + 1)
    finer = _round_breaks(float(breaks[1] - breaks[0]) / wheel.opening, times)
    sides: list[Side] = []

    def free(curve: Callable[[Array], Array], breaks: Array) -> None:
        sides.append(_side(f"free{len(sides)}", curve, breaks))

    azimuths = np.append(wheel.azimuths, 2.0 * math.pi)
    for k, (azimuth, following) in enumerate(zip(azimuths[:-1].tolist(), azimuths[1:].tolist(), strict=True)):
        if k == 0:
            sides.append(up)
        else:
            free(_turned(wheel.wall.point, azimuth), plain)
        start, end = azimuth + wheel.edge, following - wheel.edge
        finest = float(breaks[-1] - breaks[-2]) if k == 0 else float(plain[-1] - plain[-2])
        free(_parallel(wheel.rim), _rim_breaks(start, end, finest / math.sin(wheel.rim), times))
        free(_turned(_mirrored(wheel.wall.point), following), plain[::-1])
        free(_turned(_bottom(wheel), following), rounds if k < len(azimuths) - 2 else finer)
    gap = wheel.bottom - wheel.opening - wheel.hub
    around = min(96, max(16, 4 * (len(azimuths) - 1), math.ceil(2.0 * math.pi * math.sin(wheel.hub) / gap)))
    hub = np.linspace(0.0, 2.0 * math.pi, round(times * around) + 1)
    return PolarOutline((tuple(sides), (_side(HUB, _parallel(wheel.hub), hub),)), np.eye(3))


def wall_breaks(wheel: SlottedWheel, facet: float, edge: float, nearest: float) -> Array:
    """Return the facets' ends (k+1,), angles along the slot, from its round bottom to the mouth."""

    def size(t: Array) -> Array:
        to_end = np.minimum(wheel.mouth - t, t - wheel.bottom)
        below = facet + SLOPE * np.maximum(0.0, nearest - 2.0 * facet - t)
        return np.asarray(np.minimum(edge + SLOPE * to_end, below))

    return _by_size(wheel.bottom, wheel.mouth, size, 4)


def _plain_breaks(wheel: SlottedWheel, facet: float, times: float) -> Array:
    count = max(round(2.0 * times), min(round(5.0 * times), round((wheel.mouth - wheel.bottom) / facet)))
    return np.linspace(wheel.bottom, wheel.mouth, count + 1)


def _rim_breaks(start: float, end: float, finest: float, times: float) -> Array:
    """Return azimuths, fine at the start, where the pressed wall is, and growing with the distance from it."""
    most, slope = 0.5 * min(end - start, 1.0) / times, SLOPE / times
    return _by_size(start, end, lambda t: np.minimum(finest + slope * (t - start), most), round(3.0 * times))


def _round_breaks(finest: float, times: float) -> Array:
    """Return angles round a slot's end that meets the pressed wall at the last of them."""
    quarter, slope = 0.5 * math.pi, SLOPE / times
    return _by_size(
        -quarter,
        quarter,
        lambda t: np.minimum(finest + slope * (quarter - t), 0.5 / times),
        round(6.0 * times),
    )


def _by_size(first: float, last: float, size: Callable[[Array], Array], least: int) -> Array:
    t = np.linspace(first, last, 2001)
    density = 1.0 / size(t)
    number = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(t))])
    count = max(least, round(float(number[-1])))
    breaks: Array = np.interp(np.arange(count + 1) / count * number[-1], number, t)
    return breaks


def _side(name: str, curve: Callable[[Array], Array], breaks: Array) -> Side:
    middle = 0.5 * (breaks[1:] + breaks[:-1])
    return Side(name, curve(breaks), curve(middle), np.stack([breaks[:-1], breaks[1:], middle]))


def _parallel(polar: float) -> Callable[[Array], Array]:
    s, c = math.sin(polar), math.cos(polar)
    return lambda t: np.stack([s * np.cos(t), s * np.sin(t), c + 0.0 * t], axis=-1)


def _turned(curve: Callable[[Array], Array], azimuth: float) -> Callable[[Array], Array]:
    c, s = math.cos(azimuth), math.sin(azimuth)
    return lambda t: np.asarray(curve(t) @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]))


def _mirrored(curve: Callable[[Array], Array]) -> Callable[[Array], Array]:
    return lambda t: np.asarray(curve(t) * np.array([1.0, -1.0, 1.0]))


def _bottom(wheel: SlottedWheel) -> Callable[[Array], Array]:
    """Round end of slot 0 from its wall at lower azimuth to the one at higher."""
    c, s = math.cos(wheel.bottom), math.sin(wheel.bottom)
    middle, inwards, across = np.array([s, 0.0, c]), np.array([-c, 0.0, s]), np.array([0.0, 1.0, 0.0])
    co, so = math.cos(wheel.opening), math.sin(wheel.opening)
    return lambda t: co * middle + so * (np.cos(t)[:, None] * inwards + np.sin(t)[:, None] * across)
