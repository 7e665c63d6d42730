"""Entries of a dataset: values with their dimensions, unit and name, and the figure that shows them."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

ANGLE = "input_angle"

STIFFNESS_ENTRIES = (  # of a stiffness (4, 4) on x, y and both tilts: name, place, scale, unit
    ("k_xx", (0, 0), 1e-6, "N/um"),
    ("k_yy", (1, 1), 1e-6, "N/um"),
    ("k_xy", (0, 1), 1e-6, "N/um"),
    ("k_tilt_xx", (2, 2), 1.0, "N*m/rad"),
    ("k_tilt_yy", (3, 3), 1.0, "N*m/rad"),
    ("k_tilt_xy", (2, 3), 1.0, "N*m/rad"),
)

Entry = tuple[tuple[str, ...], npt.NDArray[Any], dict[str, str]]
Entries = dict[str, Entry]


def entry(
    dims: tuple[str, ...], values: npt.ArrayLike, units: str, name: str, figure: str = "", **more: str
) -> Entry:
    """Return values in SI with what plots and scripts must know of them; `more`: other attributes of a dataset."""
    attributes = {"units": units, "long_name": name}
    if figure:
        attributes["figure"] = figure
    return dims, np.asarray(values), attributes | more


def numbered(dim: str, count: int, name: str) -> Entry:
    """Return a coordinate 1 … count."""
    return entry((dim,), np.arange(1, count + 1), "", name)


def named(dim: str, names: tuple[str, ...], name: str) -> Entry:
    """Return a coordinate of words."""
    return entry((dim,), np.array(names), "", name)
