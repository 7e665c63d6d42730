"""Bodies of rays between two spheres as loops of curves on the unit sphere: what STEP files are written from."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.geometry.slotted import SlottedWheel
from trochoid.geometry.sphere_rim import RimShape
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Trace:
    """A smooth piece of an outline: unit vectors (n, 3) of the parameters (n,) from `first` to `last`.

    `arc` says that it is a part of a circle.
    """

    point: Callable[[Array], Array]
    first: float
    last: float
    arc: bool = False


@dataclass(frozen=True, slots=True)
class RaySolid:
    """The rays of a part of the unit sphere from `inner` to `outer` (m).

    `outline` goes once round the z axis, piece by piece; `hub` is the polar angle (rad) of the circle on its other
    side.
    """

    outline: tuple[Trace, ...]
    hub: float
    inner: float
    outer: float

    @property
    def volume(self) -> float:
        """Volume in m³: (outer³ − inner³)/3 times the solid angle, ∫ Δcos(polar angle) dφ round the outline."""
        total = 0.0
        for trace in self.outline:
            point = trace.point(np.linspace(trace.first, trace.last, 4001))
            azimuth = np.unwrap(np.arctan2(point[:, 1], point[:, 0]))
            height = point[:, 2] - math.cos(self.hub)
            total += float(np.sum(0.5 * (height[1:] + height[:-1]) * np.diff(azimuth)))
        return abs(total) * (self.outer**3 - self.inner**3) / 3.0


def rim_solid(shape: RimShape, inner: float, outer: float) -> RaySolid:
    """Return a whole toothed rim between two distances (m) from O: its exact flanks, its crests cut where they are."""
    tooth, start, pitch = shape.tooth, shape.start, shape.pitch
    if shape.edges is None or shape.tip is None:
        return RaySolid((Trace(tooth.point, start, start + tooth.period),), shape.hub, inner, outer)
    low, high = shape.edges
    s, c = math.sin(shape.tip), math.cos(shape.tip)
    ends = tooth.point(np.array([low, high]))
    first, wide = (
        float(np.arctan2(ends[0, 1], ends[0, 0])),
        float(np.ptp(np.unwrap(np.arctan2(ends[:, 1], ends[:, 0])))),
    )
    pieces = []
    for k in range(tooth.lobes):
        turn = k * pitch
        pieces.append(Trace(_parallel(s, c), first + turn, first + wide + turn, arc=True))
        pieces.append(Trace(tooth.point, high + turn, low + pitch + turn))
    return RaySolid(tuple(pieces), shape.hub, inner, outer)


def wheel_solid(wheel: SlottedWheel, inner: float, outer: float) -> RaySolid:
    """Return a slotted wheel between two distances (m) from O: rim, walls of the slots, their round bottoms."""
    pieces = []
    rim = _parallel(math.sin(wheel.rim), math.cos(wheel.rim))
    for k in range(wheel.slots):
        azimuth = k * wheel.swing
        gap = wheel.swing if k < wheel.slots - 1 else wheel.last_gap
        pieces += [
            Trace(_turned(_mirrored(wheel.wall.point), azimuth), wheel.mouth, wheel.bottom, arc=True),
            Trace(_turned(_round_end(wheel), azimuth), -0.5 * math.pi, 0.5 * math.pi, arc=True),
            Trace(_turned(wheel.wall.point, azimuth), wheel.bottom, wheel.mouth, arc=True),
            Trace(rim, azimuth + wheel.edge, azimuth + gap - wheel.edge, arc=True),
        ]
    return RaySolid(tuple(pieces), wheel.hub, inner, outer)


def _parallel(sine: float, cosine: float) -> Callable[[Array], Array]:
    return lambda t: np.stack([sine * np.cos(t), sine * np.sin(t), cosine + 0.0 * t], axis=-1)


def _turned(curve: Callable[[Array], Array], azimuth: float) -> Callable[[Array], Array]:
    c, s = math.cos(azimuth), math.sin(azimuth)
    return lambda t: np.asarray(curve(t) @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]))


def _round_end(wheel: SlottedWheel) -> Callable[[Array], Array]:
    """Half circle about the end of the middle of slot 0, from its wall at lower azimuth to the one at higher."""
    s, c = math.sin(wheel.bottom), math.cos(wheel.bottom)
    middle, inwards, across = np.array([s, 0.0, c]), np.array([-c, 0.0, s]), np.array([0.0, 1.0, 0.0])
    co, so = math.cos(wheel.opening), math.sin(wheel.opening)
    return lambda t: co * middle + so * (np.cos(t)[:, None] * inwards + np.sin(t)[:, None] * across)


def _mirrored(curve: Callable[[Array], Array]) -> Callable[[Array], Array]:
    return lambda t: np.asarray(curve(t) * np.array([1.0, -1.0, 1.0]))
