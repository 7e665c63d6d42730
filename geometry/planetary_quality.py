"""Quality of an involute planetary set: every condition with its value, limit and signed margin.

The direction of a ring's conditions is its own: its flank is active inward from ρ_p, so ρ_p ≤ ρ_l, and its tip
must stay outside the base circle (sources §4 prints the external form for the ring).
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from trochoid.geometry.planetary import Planetary
from trochoid.kinematics.involute import involute
from trochoid.kinematics.involute_pair import Pair, radial_clash, tip_clash
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Limits:
    """Least tip thickness (m) and contact ratio; `sources §4`: 0.4 mm (not 0.4 modules) and 1.2."""

    tip_thickness: float = 0.4e-3
    contact_ratio: float = 1.2


@dataclass(frozen=True, slots=True)
class Condition:
    """One condition: `value` against `limit`, both in `unit` ("m", "rad" or "1"); `least` tells which way.

    Values may be arrays.  `required` is False for what a design may do without.
    """

    name: str
    value: Any
    limit: Any
    unit: str
    least: bool = True
    required: bool = True

    @property
    def margin(self) -> Any:
        """How far the value is on the good side of the limit; negative where the condition fails."""
        return self.value - self.limit if self.least else self.limit - self.value

    @property
    def fulfilled(self) -> bool:
        """Whether the margin is not negative."""
        return bool(self.margin >= 0.0)

    @property
    def relation(self) -> str:
        """The sign between value and limit."""
        return "≥" if self.least else "≤"


@dataclass(frozen=True, slots=True)
class Quality:
    """All conditions of a set."""

    conditions: tuple[Condition, ...]

    @property
    def failed(self) -> tuple[Condition, ...]:
        """Required conditions that do not hold."""
        return tuple(c for c in self.conditions if c.required and not c.fulfilled)

    def __getitem__(self, name: str) -> Condition:
        """Return the condition of that name."""
        return next(c for c in self.conditions if c.name == name)


def quality(set_: Planetary, limits: Limits | None = None) -> Quality:
    """Every condition of a set with its own tips, those for assembly by hand among them (not required)."""
    limits = limits or Limits()
    sun, planet, ring = set_.tips
    outer = outer_conditions(set_.outer, (sun, planet), limits)
    inner = inner_conditions(set_.inner, (planet, ring), set_.boundaries[2], limits)
    seen = {c.name for c in outer}
    rest = (*_clearances(set_), *_backlash(set_), *_assembly(set_))
    return Quality((*outer, *(c for c in inner if c.name not in seen), *rest))


def outer_conditions(pair: Pair, tips: tuple[Any, Any], limits: Limits) -> tuple[Condition, ...]:
    """Conditions of sun and planet, tip radii in m."""
    sun, planet = pair.first, pair.second
    low_sun, low_planet = pair.lowest(*tips)
    return (
        _meshes("sun and planet", pair),
        Condition("undercut of the sun", sun.shift, sun.least_shift, "1"),
        Condition("undercut of the planet", planet.shift, planet.least_shift, "1"),
        Condition("pointed tip of the sun", sun.thickness_at(tips[0]), limits.tip_thickness, "m"),
        Condition("pointed tip of the planet", planet.thickness_at(tips[1]), limits.tip_thickness, "m"),
        Condition("planet tip in sun fillet", low_sun, sun.rack_boundary, "m"),
        Condition("sun tip in planet fillet", low_planet, planet.rack_boundary, "m"),
        Condition("contact ratio of sun and planet", pair.contact_ratio(*tips), limits.contact_ratio, "1"),
    )


def inner_conditions(
    pair: Pair, tips: tuple[Any, Any], ring_boundary: Any, limits: Limits
) -> tuple[Condition, ...]:
    """Conditions of planet and ring, tip radii and the ring's boundary radius of curvature in m."""
    planet, ring = pair.first, pair.second
    low_planet, low_ring = pair.lowest(*tips)
    return (
        _meshes("planet and ring", pair),
        Condition("undercut of the planet", planet.shift, planet.least_shift, "1"),
        Condition("pointed tip of the planet", planet.thickness_at(tips[0]), limits.tip_thickness, "m"),
        Condition("pointed tip of the ring", ring.thickness_at(tips[1]), limits.tip_thickness, "m"),
        Condition("ring tip inside its base circle", tips[1], ring.base_radius, "m"),
        Condition("ring tip in planet fillet", low_planet, planet.rack_boundary, "m"),
        Condition("planet tip in ring fillet", low_ring, ring_boundary, "m", least=False),
        Condition("contact ratio of planet and ring", pair.contact_ratio(*tips), limits.contact_ratio, "1"),
        Condition("tip interference of planet and ring", tip_clash(pair, *tips), 0.0, "rad"),
    )


def _meshes(who: str, pair: Pair) -> Condition:
    first = pair.first
    least = -0.5 * pair.teeth * involute(first.pressure_angle) / math.tan(first.pressure_angle)
    return Condition(f"operating pressure angle of {who}", pair.shift, least, "1")


def _clearances(set_: Planetary) -> Iterable[Condition]:
    a = set_.outer.center_distance
    (sun, planet, ring), (root1, root2, root3) = set_.tips, set_.roots
    yield Condition("sun tip on planet root", a - root2, sun, "m")
    yield Condition("planet tip on sun root", a - root1, planet, "m")
    yield Condition("planet tip on ring root", root3 - a, planet, "m")
    yield Condition("ring tip on planet root", ring - a, root2, "m")
    bend = set_.gears[2].curvature_radius(ring)
    yield Condition("ring tip trimmed by the cutter", bend, set_.trimming, "m")


def _backlash(set_: Planetary) -> Iterable[Condition]:
    yield Condition("backlash of sun and planet", set_.outer.backlash, 0.0, "m", required=False)
    yield Condition("backlash of planet and ring", set_.inner.backlash, 0.0, "m", required=False)


def _assembly(set_: Planetary) -> Iterable[Condition]:
    free = radial_clash(set_.inner, set_.tips[1], set_.tips[2])
    yield Condition("radial assembly of planet and ring", free, 0.0, "rad", required=False)


def least_margin(conditions: Iterable[Condition], module: float) -> tuple[tuple[str, ...], Array]:
    """Names (k,) and margins (k, ...) of conditions, lengths over the module; −∞ where undefined."""
    chosen = [c for c in conditions if c.required]
    rows = [np.asarray(c.margin) / (module if c.unit == "m" else 1.0) for c in chosen]
    margins = np.stack(np.broadcast_arrays(*rows))
    return tuple(c.name for c in chosen), np.where(np.isnan(margins), -np.inf, margins)
