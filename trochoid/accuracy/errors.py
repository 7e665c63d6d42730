"""Errors of numbers against a reference."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from trochoid.accuracy.study import Error, Numbers
from trochoid.results.outcome import Parts, Quantity

SMALL = 0.1  # parts smaller than this share of the largest like them are measured by that share


def leaves(entry: Quantity | Parts, path: str = "") -> Iterator[tuple[str, Quantity]]:
    """Yield the single values among nested parts with the path to each."""
    parts = entry.parts if isinstance(entry, Quantity) else entry
    if parts is None:
        assert isinstance(entry, Quantity)
        yield path, entry
        return
    for name, part in parts.items():
        yield from leaves(part, f"{path}.{name}" if path else name)


def modelled(quantity: Quantity) -> dict[str, tuple[float, str]]:
    """Return the numbers of a quantity that a model gave: closed forms, words and places are left out."""
    return {
        path: (float(leaf.value), leaf.unit)
        for path, leaf in leaves(quantity)
        if leaf.model not in (None, "exact") and isinstance(leaf.value, (int, float))
    }


def errors(found: Numbers, reference: Numbers, share: float = 1.0) -> dict[str, Error]:
    """Return the error of each quantity that both have: the largest of its parts', times `share`.

    A part's error is relative to the part, or to a tenth of the largest part of the same unit where it is smaller.
    """
    result = {}
    for name, parts in reference.items():
        known = found.get(name, {})
        sizes = _sizes(parts)
        off = {
            path: share * abs(known[path][0] - value) / sizes[path]
            for path, (value, _) in parts.items()
            if path in known and sizes[path] > 0.0 and math.isfinite(known[path][0] + value)
        }
        if off:
            part = max(off, key=lambda path: off[path])
            result[name] = Error(off[part], part)
    return result


def _sizes(parts: Mapping[str, tuple[float, str]]) -> dict[str, float]:
    largest: dict[str, float] = {}
    for value, unit in parts.values():
        if math.isfinite(value):
            largest[unit] = max(largest.get(unit, 0.0), abs(value))
    return {path: max(abs(value), SMALL * largest.get(unit, 0.0)) for path, (value, unit) in parts.items()}
