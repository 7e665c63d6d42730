"""The involute planetary set 2K-H: sun, planets, ring with internal teeth, one centre distance (sources §4).

Indices 1, 2, 3 are sun, planet, ring; lengths in m, angles in rad.  A planet has one tip circle: the one of the
mesh with the sun.  The source also uses another for the ring mesh (`planet_tip_for_ring`); see its table.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute import Gear
from trochoid.kinematics.involute_pair import Pair, mesh_at
from trochoid.kinematics.shaper import Shaper, ring_boundary, ring_root_radius, trimming


@dataclass(frozen=True, slots=True)
class PlanetarySet:
    """What defines a set: teeth and shifts (sun, planet, ring), basic rack, centre distance, cutter of the ring."""

    teeth: tuple[int, int, int]
    module: float
    center_distance: float
    shifts: tuple[float, float, float]
    cutter: Shaper
    planets: int = 3
    pressure_angle: float = math.radians(20.0)
    addendum: float = 1.0
    clearance: float = 0.25

    def gears(self, shifts: tuple[Any, Any, Any] | None = None) -> tuple[Gear, Gear, Gear]:
        """Sun, planet and ring, by default with the set's shifts; these may be arrays."""
        x = self.shifts if shifts is None else shifts
        rack = (self.addendum, self.clearance)
        z, m, alpha = self.teeth, self.module, self.pressure_angle
        return (
            Gear(z[0], m, alpha, x[0], *rack),
            Gear(z[1], m, alpha, x[1], *rack),
            Gear(z[2], m, alpha, x[2], *rack, internal=True),
        )


@dataclass(frozen=True, slots=True)
class Planetary:
    """A set with its two meshes and circles; radii in m.

    `boundaries` are the radii of curvature ρ_l where the involutes begin above the fillets, `trimming` the one of
    the ring below which its cutter would trim the tips.
    """

    outer: Pair
    inner: Pair
    tips: tuple[Any, Any, Any]
    roots: tuple[Any, Any, Any]
    boundaries: tuple[Any, Any, Any]
    planet_tip_for_ring: Any
    trimming: Any

    @property
    def gears(self) -> tuple[Gear, Gear, Gear]:
        """Sun, planet, ring."""
        return self.outer.first, self.outer.second, self.inner.second

    @property
    def gear_ratio(self) -> float:
        """Sun turns per carrier turn with the ring fixed, 1 + z3/z1."""
        return 1.0 + self.gears[2].teeth / self.gears[0].teeth


def planetary(given: PlanetarySet, shifts: tuple[Any, Any, Any] | None = None) -> Planetary:
    """Geometry of a set at its centre distance; `shifts` (numbers or arrays) replaces those of the set.

    Raises Infeasible where teeth cannot reach each other; `geometry.planetary_check` says all that is wrong.
    """
    sun, planet, ring = given.gears(shifts)
    _fail_if_cutter_cannot_enter(given, ring)
    outer = mesh_at(sun, planet, given.center_distance)
    inner = mesh_at(planet, ring, given.center_distance)
    root = ring_root_radius(ring, given.cutter)
    return Planetary(
        outer,
        inner,
        (*outer_tips(outer), ring_tip(inner)),
        (sun.rack_root_radius, planet.rack_root_radius, root),
        (sun.rack_boundary, planet.rack_boundary, ring_boundary(ring, given.cutter)),
        planet_tip_for_ring(inner, root),
        trimming(ring, given.cutter),
    )


def outer_tips(pair: Pair) -> tuple[Any, Any]:
    """Tip radii d/2 + m(h_a* + x − Δy) of two external gears, m."""
    one, two = pair.first, pair.second
    short = pair.tip_shortening
    return (
        one.pitch_radius + one.module * (one.addendum + one.shift - short),
        two.pitch_radius + two.module * (two.addendum + two.shift - short),
    )


def ring_tip(pair: Pair) -> Any:
    """Tip radius d3/2 − m(h_a* − x3 + Δy − k2) of a ring (m), k2 = 0.25 − 0.125 x3 down to 0 (GOST 19274)."""
    ring = pair.second
    relief = np.maximum(0.0, 0.25 - 0.125 * np.asarray(ring.shift))[()]
    return ring.pitch_radius - ring.module * (ring.addendum - ring.shift + pair.tip_shortening - relief)


def planet_tip_for_ring(pair: Pair, ring_root: Any) -> Any:
    """Planet tip radius (m) of a mesh with a ring alone: full height, kept c* m away from the ring's root."""
    planet = pair.first
    full = planet.pitch_radius + planet.module * (planet.addendum + planet.shift)
    return np.minimum(full, ring_root - pair.center_distance - planet.clearance * planet.module)[()]


def _fail_if_cutter_cannot_enter(given: PlanetarySet, ring: Gear) -> None:
    root = ring_root_radius(ring, given.cutter)
    if np.ndim(root) == 0 and not np.isfinite(root):
        raise Infeasible(
            f"a ring of {ring.teeth} teeth with shift {ring.shift:g}: a cutter of {given.cutter.teeth} teeth with "
            f"shift {given.cutter.shift:g} has no pressure angle with it; take a larger ring shift or a cutter with "
            "less teeth or shift"
        )
