"""Blocking contours of an involute planetary set: which shifts its meshes allow, by themselves and together.

In a plane contour each mesh has the centre distance that its shifts ask for, and its own tips: (x1, x2) for sun and
planet, (x2, x3) for planet and ring.  The body of (x1, x2, x3) is what both contours allow (sources §4).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.geometry.blocking_contour import Contour, trace
from trochoid.geometry.planetary import PlanetarySet, outer_tips, planet_tip_for_ring, ring_tip
from trochoid.geometry.planetary_quality import (
    Condition,
    Limits,
    inner_conditions,
    least_margin,
    outer_conditions,
)
from trochoid.kinematics.involute import Gear
from trochoid.kinematics.involute_pair import mesh
from trochoid.kinematics.shaper import ring_boundary, ring_root_radius
from trochoid.kinematics.types import Array, frozen


def outer_plane(given: PlanetarySet, x1: Array, x2: Array, limits: Limits) -> tuple[Condition, ...]:
    """Conditions of sun and planet meshing without play at shifts x1, x2 (any one shape)."""
    sun, planet, _ = given.gears((x1, x2, np.zeros(1)))
    pair = mesh(sun, planet)
    return outer_conditions(pair, outer_tips(pair), limits)


def inner_plane(given: PlanetarySet, x2: Array, x3: Array, limits: Limits) -> tuple[Condition, ...]:
    """Conditions of planet and ring meshing without play at shifts x2, x3 (any one shape)."""
    _, planet, ring = given.gears((np.zeros(1), x2, x3))
    pair = mesh(planet, ring)
    tips = (planet_tip_for_ring(pair, ring_root_radius(ring, given.cutter)), ring_tip(pair))
    return inner_conditions(pair, tips, ring_boundary(ring, given.cutter), limits)


def outer_contour(given: PlanetarySet, limits: Limits | None = None, steps: int = 160) -> Contour:
    """Blocking contour (x1, x2) of sun and planet."""
    limits = limits or Limits()
    sun, planet, _ = given.gears()
    names, _ = least_margin(outer_plane(given, np.zeros(1), np.zeros(1), limits), given.module)

    def margins(x: Array, y: Array) -> Array:
        return least_margin(outer_plane(given, x, y, limits), given.module)[1]

    return trace(margins, names, (_low(sun), _low(planet)), (_high(sun), _high(planet)), steps)


def inner_contour(given: PlanetarySet, limits: Limits | None = None, steps: int = 160) -> Contour:
    """Blocking contour (x2, x3) of planet and ring."""
    limits = limits or Limits()
    _, planet, ring = given.gears()
    names, _ = least_margin(inner_plane(given, np.zeros(1), np.zeros(1), limits), given.module)

    def margins(x: Array, y: Array) -> Array:
        return least_margin(inner_plane(given, x, y, limits), given.module)[1]

    return trace(margins, names, (_low(planet), -4.0), (_high(planet), _high(ring)), steps)


def _low(gear: Gear) -> float:
    """A shift that is below any contour: undercut."""
    return gear.least_shift - 0.5


def _high(gear: Gear) -> float:
    """A shift that is above any contour: pointed teeth."""
    return 4.0 + 0.08 * gear.teeth if gear.internal else 3.0 + 0.03 * gear.teeth


@dataclass(frozen=True, eq=False, slots=True)
class Body:
    """The body on a grid: axes x1, x2, x3 (n,) and the least margin (n, n, n), positive inside."""

    x1: Array
    x2: Array
    x3: Array
    margin: Array

    @property
    def volume(self) -> float:
        """Volume of the cells whose middles are inside; off by about a cell's width times half the surface."""
        cell = (self.x1[1] - self.x1[0]) * (self.x2[1] - self.x2[0]) * (self.x3[1] - self.x3[0])
        return float(cell * np.count_nonzero(self.margin >= 0.0))


def volume(outer: Contour, inner: Contour) -> float:
    """Volume of the body: ∫ (length of the outer contour along x1)(of the inner along x3) dx2, of the polygons."""
    along_x1, along_x3 = outer, _swapped(inner)
    levels = np.unique(np.concatenate([b.points[:, 1] for c in (along_x1, along_x3) for b in c.boundaries]))
    half, middle = 0.5 * np.diff(levels), 0.5 * (levels[1:] + levels[:-1])
    total = 0.0
    for node in (-1.0, 1.0):  # two Gauss points: products of straight sides are quadratic between vertices
        y = middle + node / np.sqrt(3.0) * half
        total += float(half @ (along_x1.slices(y) * along_x3.slices(y)))
    return total


def _swapped(contour: Contour) -> Contour:
    """The same region with its axes exchanged and its boundaries still anticlockwise."""
    return replace(
        contour,
        boundaries=tuple(
            replace(b, points=b.points[::-1, ::-1], conditions=np.roll(b.conditions[::-1], -1))
            for b in contour.boundaries
        ),
    )


def body(given: PlanetarySet, limits: Limits | None = None, resolution: int = 200) -> Body:
    """The volumetric blocking contour on `resolution`³ points over the box that holds it."""
    limits = limits or Limits()
    outer, inner = outer_contour(given, limits, 60), inner_contour(given, limits, 60)
    x1, x2 = _axes(outer, resolution)
    _, x3 = _axes(inner, resolution)
    a, b = np.meshgrid(x1, x2, indexing="ij")
    c, d = np.meshgrid(x2, x3, indexing="ij")
    _, first = least_margin(outer_plane(given, a, b, limits), given.module)
    _, second = least_margin(inner_plane(given, c, d, limits), given.module)
    margin = np.minimum(first.min(axis=0)[:, :, None], second.min(axis=0)[None])
    margin.setflags(write=False)
    return Body(frozen(x1), frozen(x2), frozen(x3), margin)


def _axes(contour: Contour, n: int) -> tuple[Array, Array]:
    """Middles of n cells over the contour's box, made a little larger."""
    points = np.concatenate([b.points for b in contour.boundaries])
    low, high = points.min(axis=0), points.max(axis=0)
    low, high = low - 0.01 * (high - low), high + 0.01 * (high - low)
    middles = low + (high - low) * (np.arange(n)[:, None] + 0.5) / n
    return middles[:, 0], middles[:, 1]
