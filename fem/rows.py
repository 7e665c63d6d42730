"""Positions side by side: every array of a value has them as its first axis. Take some, join many.

Works on arrays, tuples, dictionaries and dataclasses of them, however nested. What is `Shared` by all positions
stays as it is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

import numpy as np

from trochoid.kinematics.types import IntArray

T = TypeVar("T")


class Shared:
    """Marks a class whose arrays have no axis of positions."""

    __slots__ = ()


def taken(value: T, rows: int | IntArray | slice | None) -> T:
    """Return the value at some positions; None adds the axis to a value for a single position."""
    return _merged([value], lambda arrays: arrays[0][rows])


def joined(parts: Sequence[tuple[IntArray, T]]) -> T:
    """Put parts, each with the positions that it holds, in the order of positions."""
    order = np.argsort(np.concatenate([rows for rows, _ in parts]))
    return _merged([part for _, part in parts], lambda arrays: np.concatenate(arrays)[order])


def _merged(values: Sequence[T], merge: Callable[[list[Any]], Any]) -> T:
    first: Any = values[0]
    every: list[Any] = list(values)
    made: Any = first
    if isinstance(first, np.ndarray):
        made = merge(every)
    elif isinstance(first, tuple):
        made = tuple(_merged(items, merge) for items in zip(*every, strict=True))
    elif isinstance(first, dict):
        made = {key: _merged([each[key] for each in every], merge) for key in first}
    elif is_dataclass(first) and not isinstance(first, (type, Shared)):
        changed = {f.name: _merged([getattr(each, f.name) for each in every], merge) for f in fields(first)}
        made = replace(first, **changed)
    return made  # type: ignore[no-any-return]
