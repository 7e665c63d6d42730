"""Texts with a unit, read by pint; imported only when a scene has one that is not in its default unit."""

from __future__ import annotations

from functools import cache

import pint
from pint.facets.plain import PlainQuantity

from trochoid.faults import quoted, shown
from trochoid.scene.units import ANGLE, FAMILIES, SPEED, Family, needed

_WRITTEN = {"Nm": "N*m", "Nmm": "N*mm", "kNm": "kN*m"}  # pint reads "Nm" as the textile unit "number metric"
_OTHERS = {
    "time": "s",
    "power": "W",
    "area": "m^2",
    "volume": "m^3",
    "velocity": "m/s",
    "acceleration": "m/s^2",
    "temperature": "kelvin",
    "frequency": "Hz",
    "torsional stiffness": "N*m/rad",
}


@cache
def _registry() -> pint.UnitRegistry[float]:
    registry: pint.UnitRegistry[float] = pint.UnitRegistry()
    registry.define("@alias turn = rev")
    return registry


def to_si(number: float, unit: str, given: str, family: Family) -> float:
    """Return `number` of `unit` in SI; raises ValueError for an unknown unit or a wrong dimension."""
    registry = _registry()
    try:
        parsed = registry.parse_units(_WRITTEN.get(unit, unit))
        base = registry.Quantity(1.0, parsed).to_base_units()
    except Exception as error:  # pint raises half a dozen types, tokenizer errors among them
        raise ValueError(
            f"given {shown(given)}: unknown unit {quoted(unit)}; need {needed(family)}"
        ) from error
    if _signature(base) != _signature(_base(family.si)):
        raise ValueError(f"given {shown(given)} ({_dimension(base)}); need {needed(family)}")
    return number * float(base.magnitude)


def _base(unit: str) -> PlainQuantity[float]:
    return _registry().Quantity(1.0, unit).to_base_units()


def _signature(base: PlainQuantity[float]) -> tuple[object, ...]:
    """Return what must agree: the dimension and, as "25 Hz" is not 25 rad/s, the power of the angle in it."""
    angle = dict(base.unit_items()).get("radian", 0)
    return (base.dimensionality, angle if base.dimensionality in _with_angle() else 0)


@cache
def _with_angle() -> tuple[object, ...]:
    return tuple(_base(family.si).dimensionality for family in (ANGLE, SPEED))


def _dimension(base: PlainQuantity[float]) -> str:
    """Return the name of the dimension of what was given."""
    for name, si in [(family.noun, family.si) for family in FAMILIES] + list(_OTHERS.items()):
        if _signature(base) == _signature(_base(si)):
            return name
    return f"dimension {base.dimensionality}"
