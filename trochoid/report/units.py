"""From SI to the units of an engineer's plot: the only place of the report that converts."""

from __future__ import annotations

import math
from typing import NamedTuple


class DisplayUnit(NamedTuple):
    """Symbol, and the factor that takes an SI number to it."""

    symbol: str
    factor: float


_FIXED: dict[str, DisplayUnit] = {
    "Pa": DisplayUnit("MPa", 1e-6),
    "m/s": DisplayUnit("mm/s", 1e3),
    "N/m": DisplayUnit("N/µm", 1e-6),
    "N*m/rad": DisplayUnit("N·m/arcmin", math.pi / 10800),
    "m^2": DisplayUnit("mm²", 1e6),
    "rad/s": DisplayUnit("rpm", 30 / math.pi),
    "m/s^2": DisplayUnit("m/s²", 1.0),
    "1/m": DisplayUnit("1/mm", 1e-3),
}
# largest value up to which the unit is used, smallest first
_BY_SIZE: dict[str, tuple[tuple[float, DisplayUnit], ...]] = {
    "m": ((1e-4, DisplayUnit("µm", 1e6)), (math.inf, DisplayUnit("mm", 1e3))),
    "rad": (
        (math.radians(0.5 / 60), DisplayUnit("arcsec", math.degrees(3600))),
        (math.radians(1.0), DisplayUnit("arcmin", math.degrees(60))),
        (math.inf, DisplayUnit("°", math.degrees(1))),
    ),
    "N": ((2e4, DisplayUnit("N", 1.0)), (math.inf, DisplayUnit("kN", 1e-3))),
}
_SPELLINGS = {
    "N·m/rad": "N*m/rad",
    "N m/rad": "N*m/rad",
    "m²": "m^2",
    "m**2": "m^2",
    "m/s²": "m/s^2",
    "m/s**2": "m/s^2",
}
_UNITLESS = ("", "1", "-", "dimensionless")


def display_unit(units: str, largest: float) -> DisplayUnit:
    """Return the unit in which to show numbers of SI unit `units` whose largest magnitude is `largest`."""
    known = _SPELLINGS.get(units, units)
    if known in _UNITLESS:
        return DisplayUnit("", 1.0)
    if known in _FIXED:
        return _FIXED[known]
    for limit, unit in _BY_SIZE.get(known, ()):
        if not largest > limit:
            return unit
    from trochoid.results.text import pretty_unit

    return DisplayUnit(pretty_unit(units), 1.0)


def axis_unit(units: str) -> DisplayUnit:
    """Return the unit of a coordinate axis: angles always in degrees, lengths in mm."""
    return display_unit(units, math.inf)
