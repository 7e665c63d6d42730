"""Outlines on the unit sphere: the sides of a sector of a toothed rim, or of a roller, cut into facets.

A body of rays through O between two spheres is known by its cut with the unit sphere alone.  The flank's facets
grow and shrink smoothly along it, so that contacts see the like mesh wherever they are.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.geometry.sphere_rim import RimShape, beyond_edge
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.spherical import rotation
from trochoid.kinematics.spherical_curve import SmallCircle, SphericalCurve
from trochoid.kinematics.types import Array

BENT = 0.6  # of the facets' density on a flank: curvature
EDGE = 0.3  # of the facets' length: the last one at an edge


@dataclass(frozen=True, eq=False, slots=True)
class Side:
    """Facets in a row: `ends` (k+1, 3) and `middles` (k, 3) are unit vectors on the true curve.

    `parameters` (3, k) at start, end and middle of each facet: the curve's, or angles from the flank or along the hub.
    """

    name: str
    ends: Array
    middles: Array
    parameters: Array

    def reversed(self) -> Side:
        """Return the same facets run through backwards."""
        return Side(self.name, self.ends[::-1], self.middles[::-1], self.parameters[[1, 0, 2], ::-1])


@dataclass(frozen=True, eq=False, slots=True)
class SphereOutline:
    """Closed loops of sides, counter-clockwise seen from outside (holes too), the outer one first.

    `frame` (3, 3) turns the body's vectors so that it lies round longitude 0.  The chart is Mercator's, which keeps
    angles, so that elements are as good on the sphere as on the chart.
    """

    loops: tuple[tuple[Side, ...], ...]
    frame: Array

    def to_chart(self, vectors: Array) -> Array:
        """Return longitude and −ln tan(polar angle/2) (..., 2) of unit vectors (..., 3)."""
        x, y, z = np.moveaxis(vectors @ self.frame.T, -1, 0)
        return np.stack([np.arctan2(y, x), -np.log(np.hypot(x, y) / (1.0 + z))], axis=-1)

    def from_chart(self, places: Array) -> Array:
        """Return unit vectors (..., 3) of chart coordinates (..., 2)."""
        longitude, height = places[..., 0], places[..., 1]
        c = 1.0 / np.cosh(height)
        v = np.stack([c * np.cos(longitude), c * np.sin(longitude), np.tanh(height)], axis=-1)
        return np.asarray(v @ self.frame)


def sector_outline(shape: RimShape, facets: int, teeth: int = 1, growth: float = 1.3) -> SphereOutline:
    """Return `teeth` teeth with half a space on either side, cut along meridians, `facets` on each flank.

    Facets grow from the flank towards the hub.  Sides: "flank", "right", "hub", "left"; right is left turned.
    """
    if facets < 6:
        raise Infeasible(f"{facets} facets on a tooth; take at least 6, better 16")
    z = shape.tooth.lobes
    if not 1 <= teeth < z:
        raise Infeasible(f"a sector of {teeth} of {z} teeth; take 1 to {z - 1}")
    lobe = _lobe_breaks(shape, facets)
    breaks = np.concatenate([lobe[:-1] + i * shape.pitch for i in range(teeth)])
    return outline_of_breaks(shape, np.append(breaks, shape.start + teeth * shape.pitch), growth)


def _lobe_breaks(shape: RimShape, facets: int) -> Array:
    """Return the facets' ends (k+1,) from bottom to bottom; where the crest is cut, finer towards its edges."""
    first, last = shape.start, shape.start + shape.pitch
    if shape.edges is None:
        return bent_breaks(shape.tooth, first, last, facets)
    one, other = shape.edges
    up = bent_breaks(shape.tooth, first, one, max(4, facets // 2), edge=EDGE)
    ends = shape.tooth.point(np.array([one, other]))
    land = float(np.linalg.norm(ends[1] - ends[0]))
    size = float(np.linalg.norm(np.diff(shape.tooth.point(up[-2:]), axis=0)))
    across = np.linspace(one, other, max(2, round(land / (2.0 * size))) + 1)
    return np.concatenate([up, across[1:-1], (first + last - up)[::-1]])


def outline_of_breaks(shape: RimShape, breaks: Array, growth: float = 1.3) -> SphereOutline:
    """Return a sector whose flank facets end at the parameters `breaks` (k+1,), from bottom to bottom."""
    tooth = shape.tooth
    first, last = float(breaks[0]), float(breaks[-1])
    flank = _cut_side(shape, breaks)
    finest = float(np.linalg.norm(flank.ends[1] - flank.ends[0]))
    bottom = float(np.arccos(flank.ends[0, 2]))
    heights = [-math.log(math.tan(0.5 * polar)) for polar in (bottom, shape.hub)]
    cut = _graded(heights[0], heights[1], finest / math.sin(bottom), growth - 1.0, 0.5 * (last - first))
    polar = 2.0 * np.arctan(np.exp(-cut))
    count = max(2, round((last - first) / abs(float(cut[-1] - cut[-2]))))
    azimuth = np.linspace(first, last, count + 1)
    right, left = (_arc("right", polar, last), _arc("left", polar, first))
    hub = _arc("hub", shape.hub, azimuth)
    sides = (flank, right, hub.reversed(), left.reversed())
    if tooth.hole:
        sides = (flank.reversed(), left, hub, right.reversed())
    return SphereOutline((sides,), rotation(2, -0.5 * (first + last)))


def _cut_side(shape: RimShape, breaks: Array) -> Side:
    """Return the flank's facets, those on cut crests moved to the cone of the tips."""
    side = curve_side("flank", shape.tooth, breaks)
    if shape.edges is None or shape.tip is None:
        return side
    ends, middles = side.ends.copy(), side.middles.copy()
    for points, p in ((ends, breaks), (middles, side.parameters[2])):
        off = beyond_edge(shape, p)
        turn = np.floor((p[off] - shape.start) / shape.pitch)
        low, high = (shape.tooth.point(edge + turn * shape.pitch) for edge in shape.edges)
        share = (p[off] - turn * shape.pitch - shape.edges[0]) / (shape.edges[1] - shape.edges[0])
        start = np.arctan2(low[:, 1], low[:, 0])
        wide = np.mod(np.arctan2(high[:, 1], high[:, 0]) - start, 2.0 * math.pi)
        azimuth, s = start + share * wide, math.sin(shape.tip)
        points[off] = np.stack(
            [s * np.cos(azimuth), s * np.sin(azimuth), math.cos(shape.tip) + 0.0 * azimuth], axis=-1
        )
    return Side("flank", ends, middles, side.parameters)


def roller_outline(angle: float, facets: int, bore: float = 0.0) -> SphereOutline:
    """Return a roller about the x axis, a cone of half angle `angle` (rad), with a bore of half angle `bore`.

    The middle of facet 0 of the side "flank" is towards the z axis; the other side is "hub".
    """
    if not 0.0 <= bore < angle < 0.5 * math.pi:
        raise Infeasible(
            f"roller of half angle {math.degrees(angle):.6g}° with a bore of {math.degrees(bore):.6g}°: "
            "the bore must be the smaller, and both below 90°"
        )
    axis = (1.0, 0.0, 0.0)
    breaks = 2.0 * math.pi * (np.arange(facets + 1) - 0.5) / facets
    loops: tuple[tuple[Side, ...], ...] = ((curve_side("flank", SmallCircle(axis, angle), breaks),),)
    if bore > 0.0:
        count = max(12, round(facets * bore / angle))
        round_ = 2.0 * math.pi * np.arange(count + 1) / count
        loops = (*loops, (curve_side("hub", SmallCircle(axis, bore), round_),))
    return SphereOutline(loops, np.eye(3))


def bent_breaks(
    curve: SphericalCurve, first: float, last: float, facets: int, share: float = BENT, edge: float = 1.0
) -> Array:
    """Return parameters (facets+1,) of facets, shorter where the curve bends: `share` of their density is curvature.

    The rest is arc length; the curvature counts from its mean on, so that the density is smooth.  The last facet is
    `edge` times as long as it would be, those before it grow by half of the distance from it.
    """
    t = np.linspace(first, last, 2001)
    speed, bend = curve.speed(t), np.abs(curve.curvature(t))
    mean = float((speed * bend).sum() / speed.sum())
    density = speed * (
        (1.0 - share) / speed.sum() + share * np.hypot(bend, mean) / (speed * np.hypot(bend, mean)).sum()
    )
    if edge < 1.0:
        way = np.concatenate([np.cumsum(speed[::-1])[::-1][1:], [0.0]]) * (t[1] - t[0])
        plain = float(way[0]) / facets
        density = density * np.maximum(1.0, plain / (edge * plain + 0.5 * way))
    total = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]))])
    breaks: Array = np.interp(np.arange(facets + 1) / facets * total[-1], total, t)
    return breaks


def curve_side(name: str, curve: SphericalCurve, breaks: npt.ArrayLike) -> Side:
    """Return the facets of a curve between the parameters `breaks`; middles at half the arc length."""
    breaks = np.asarray(breaks, dtype=np.float64)
    arc = ArcLength(curve)
    s = arc.length(breaks)
    middle = arc.parameter(0.5 * (s[1:] + s[:-1]))
    parameters = np.stack([breaks[:-1], breaks[1:], middle])
    return Side(name, curve.point(breaks), curve.point(middle), parameters)


def _arc(name: str, polar: npt.ArrayLike, azimuth: npt.ArrayLike) -> Side:
    """Return a side along a meridian or a parallel; its middles halve angles."""

    def place(polar: Array, azimuth: Array) -> Array:
        s = np.sin(polar)
        return np.stack([s * np.cos(azimuth), s * np.sin(azimuth), np.cos(polar) + 0.0 * azimuth], axis=-1)

    both = np.broadcast_arrays(np.asarray(polar, dtype=np.float64), np.asarray(azimuth, dtype=np.float64))
    half = [0.5 * (x[1:] + x[:-1]) for x in both]
    along = [np.abs(x - x[0]) for x in both]
    way, middle = along[0] + along[1], 0.5 * (along[0] + along[1])[1:] + 0.5 * (along[0] + along[1])[:-1]
    return Side(name, place(*both), place(*half), np.stack([way[:-1], way[1:], middle]))


def _graded(first: float, last: float, finest: float, slope: float, coarsest: float) -> Array:
    """Return places from `first` to `last` whose steps begin with `finest` and grow by `slope` times the distance."""
    length = abs(last - first)
    away = np.linspace(0.0, length, 2001)
    step = np.minimum(finest + slope * away, max(finest, coarsest))
    number = np.concatenate([[0.0], np.cumsum(0.5 * (1.0 / step[1:] + 1.0 / step[:-1]) * np.diff(away))])
    count = max(2, round(float(number[-1])))
    breaks = np.interp(np.arange(count + 1) / count * number[-1], number, away)
    graded: Array = first + math.copysign(1.0, last - first) * breaks
    graded[-1] = last
    return graded
