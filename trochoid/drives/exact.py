"""What the answers of all drives share: exact numbers in the engineer's units."""

from __future__ import annotations

import math
from collections.abc import Mapping

from trochoid.results.outcome import Quantity

ARCMIN = math.pi / 180 / 60
RPM = 2 * math.pi / 60


def exact(values: Mapping[str, tuple[float, str]]) -> Quantity:
    """Return parts, each (value, unit), that rest on closed forms."""
    return Quantity(
        parts={name: Quantity(value, unit, 0.0, "exact") for name, (value, unit) in values.items()}
    )


def millimetres(length: float) -> str:
    """Return a length (m) in mm without the rounding that a conversion leaves."""
    return f"{1e3 * length:.12g}"
