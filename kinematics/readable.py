"""Numbers in messages: a few digits, and no powers of ten where an engineer writes none."""

from __future__ import annotations


def readable(value: float, digits: int = 3) -> str:
    """Return `value` with so many significant digits: "1450", "100", "0.00023"; powers of ten from 1e10 on."""
    return f"{float(f'{value:.{digits}g}'):.10g}"
