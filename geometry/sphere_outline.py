"""Outlines on the unit sphere: the sides of a sector of a toothed rim, or of a roller, cut into facets.

A body of rays through O between two spheres is known by its cut with the unit sphere alone.  The flank's facets
grow and shrink smoothly along it, so that contacts see the like mesh wherever they are.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.spherical import rotation
from trochoid.kinematics.spherical_curve import SmallCircle, SphericalCurve
from trochoid.kinematics.types import Array


BENT = 0.6  # of the facets' density on a flank: curvature


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

    `frame` (3, 3) turns the body's vectors so that it lies round the equator's longitude 0; `latitude` (rad) is
    where the chart longitude·cos(latitude), latitude is true to scale.
    """

    loops: tuple[tuple[Side, ...], ...]
    frame: Array
    latitude: float

    def to_chart(self, vectors: Array) -> Array:
        """Return chart coordinates (..., 2), rad, of unit vectors (..., 3)."""
        v = vectors @ self.frame.T
        longitude, latitude = np.arctan2(v[..., 1], v[..., 0]), np.arcsin(np.clip(v[..., 2], -1.0, 1.0))
        return np.stack([longitude * math.cos(self.latitude), latitude], axis=-1)

    def from_chart(self, places: Array) -> Array:
        """Return unit vectors (..., 3) of chart coordinates (..., 2)."""
        longitude, latitude = places[..., 0] / math.cos(self.latitude), places[..., 1]
        c = np.cos(latitude)
        v = np.stack([c * np.cos(longitude), c * np.sin(longitude), np.sin(latitude)], axis=-1)
        return np.asarray(v @ self.frame)


@dataclass(frozen=True, slots=True)
class RimShape:
    """A rim of sphere teeth on a hub: the body between the flank and the cone at the polar angle `hub` (rad).

    The hub lies on the material's side: nearer to the pole than the flank, or farther where the flank is a hole.
    """

    tooth: SphereTooth
    hub: float

    def __post_init__(self) -> None:
        """Refuse a hub that cuts the tooth spaces."""
        low, high = self.reach
        if self.tooth.hole and not high < self.hub < math.pi:
            raise Infeasible(
                f"hub at polar angle {math.degrees(self.hub):.6g}°: outside a rim that reaches to "
                f"{math.degrees(high):.6g}° it must be more than that"
            )
        if not self.tooth.hole and not 0.0 < self.hub < low:
            raise Infeasible(
                f"hub at polar angle {math.degrees(self.hub):.6g}°: the tooth spaces reach down to "
                f"{math.degrees(low):.6g}°; take less than that, and more than 0°"
            )

    @property
    def reach(self) -> tuple[float, float]:
        """Least and largest polar angle (rad) of the flank."""
        ends = np.arccos(self.tooth.point(np.array([0.0, math.pi / self.tooth.lobes]))[:, 2])
        return float(ends.min()), float(ends.max())

    @property
    def pitch(self) -> float:
        """Azimuth (rad) from tooth to tooth."""
        return 2.0 * math.pi / self.tooth.lobes

    @property
    def start(self) -> float:
        """Flank parameter of the bottom of the tooth space before tooth 0."""
        polar = np.arccos(self.tooth.point(np.array([0.0, 0.5 * self.pitch]))[:, 2])
        first_is_bottom = (polar[0] > polar[1]) == self.tooth.hole
        return 0.0 if first_is_bottom else -0.5 * self.pitch


def sector_outline(shape: RimShape, facets: int, teeth: int = 1, growth: float = 1.3) -> SphereOutline:
    """Return `teeth` teeth with half a space on either side, cut along meridians, `facets` on each flank.

    Facets grow from the flank towards the hub.  Sides: "flank", "right", "hub", "left"; right is left turned.
    """
    if facets < 6:
        raise Infeasible(f"{facets} facets on a tooth; take at least 6, better 16")
    tooth, z = shape.tooth, shape.tooth.lobes
    if not 1 <= teeth < z:
        raise Infeasible(f"a sector of {teeth} of {z} teeth; take 1 to {z - 1}")
    lobe = bent_breaks(tooth, shape.start, shape.start + shape.pitch, facets)
    breaks = np.concatenate([lobe[:-1] + i * shape.pitch for i in range(teeth)])
    return outline_of_breaks(shape, np.append(breaks, shape.start + teeth * shape.pitch), growth)


def outline_of_breaks(shape: RimShape, breaks: Array, growth: float = 1.3) -> SphereOutline:
    """Return a sector whose flank facets end at the parameters `breaks` (k+1,), from bottom to bottom."""
    tooth = shape.tooth
    first, last = float(breaks[0]), float(breaks[-1])
    flank = curve_side("flank", tooth, breaks)
    finest = float(np.linalg.norm(flank.ends[1] - flank.ends[0]))
    bottom = float(np.arccos(flank.ends[0, 2]))
    polar = _graded(bottom, shape.hub, finest, growth - 1.0)
    coarse = abs(float(polar[-1] - polar[-2]))
    count = max(2, round((last - first) * math.sin(shape.hub) / coarse))
    azimuth = np.linspace(first, last, count + 1)
    right, left = (_arc("right", polar, last), _arc("left", polar, first))
    hub = _arc("hub", shape.hub, azimuth)
    sides = (flank, right, hub.reversed(), left.reversed())
    if tooth.hole:
        sides = (flank.reversed(), left, hub, right.reversed())
    frame = rotation(2, -0.5 * (first + last))
    return SphereOutline((sides,), frame, 0.5 * math.pi - 0.5 * (bottom + shape.hub))


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
    return SphereOutline(loops, np.eye(3), 0.0)


def bent_breaks(curve: SphericalCurve, first: float, last: float, facets: int, share: float = BENT) -> Array:
    """Return parameters (facets+1,) of facets, shorter where the curve bends: `share` of their density is curvature.

    The rest is arc length; the curvature counts from its mean on, so that the density is smooth.
    """
    t = np.linspace(first, last, 2001)
    speed, bend = curve.speed(t), np.abs(curve.curvature(t))
    mean = float((speed * bend).sum() / speed.sum())
    density = speed * (
        (1.0 - share) / speed.sum() + share * np.hypot(bend, mean) / (speed * np.hypot(bend, mean)).sum()
    )
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


def _graded(first: float, last: float, finest: float, slope: float) -> Array:
    """Return angles from `first` to `last` whose steps begin with `finest` and grow by `slope` times the distance."""
    length = abs(last - first)
    count = max(2, round(math.log1p(slope * length / finest) / slope))
    away = finest / slope * np.expm1(slope * np.arange(count + 1))
    graded: Array = first + math.copysign(length, last - first) * away / away[-1]
    return graded
