"""Units at the edge: numbers and texts of a scene become SI here, once."""

from __future__ import annotations

import math
import re

from trochoid.faults import shown
from trochoid.scene.units import NUMBER, Family, needed

LARGEST = 1e20  # in SI, of any quantity: nothing of a drive is larger, and squares and products stay numbers
_NUMBER_AND_UNIT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(\S.*)?", re.DOTALL)


def read(value: object, family: Family) -> float:
    """Return `value`, a number of the family's default unit or a text with a unit, in SI.

    Raises ValueError that says what was given and what is needed.
    """
    if isinstance(value, str):
        return _read_text(value, family)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ValueError(f"given {shown(value)}; need {needed(family)}")
    return _sized(family.to_si(_finite(value, family)), value, family)


def _finite(value: int | float, family: Family) -> float:
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ValueError(f"given {shown(value)}; need a finite number")
    return number


def _sized(si: float, value: object, family: Family) -> float:
    if abs(si) > LARGEST:
        unit = f" {family.si}" if family.si else ""
        raise ValueError(f"given {shown(value)}; need {family.name} of at most {LARGEST:g}{unit} in size")
    return si


def _read_text(text: str, family: Family) -> float:
    match = _NUMBER_AND_UNIT.fullmatch(text)
    if match is None or family is NUMBER:
        raise ValueError(f"given the text {shown(text)}; need {needed(family)}")
    digits, unit = match.groups()
    if unit is None:
        raise ValueError(f"given the text {shown(text)} without a unit; need {needed(family)}")
    number = _finite(float(digits), family)
    if unit.strip() == family.unit:
        return _sized(family.to_si(number), text, family)
    from trochoid.scene.unit_text import to_si

    return _sized(_finite(to_si(number, unit.strip(), text, family), family), text, family)
