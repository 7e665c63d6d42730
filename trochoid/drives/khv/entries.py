"""Entries of the dataset: values with their dimensions, unit and name, and the figure that shows them."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

ANGLE = "input_angle"
SHARING, OUTPUT, ECCENTRIC = "Load sharing of the ring pins", "Output pins", "Eccentric bearings"
PRESSURE, STIFFNESS, ERROR = "Contact pressure", "Torsional stiffness", "Transmission error"
REACTIONS, CHANGE, VELOCITY = "Bearing reactions", "Elastic less rigid reactions", "Vibration velocity"
TORSION, LOSSES = "Torsion curve", "Friction losses"
CAPTIONS = {
    LOSSES: "Work lost per radian of the input on each disc, as a torque at the input.",
    SHARING: "Force of every ring pin on each disc, and each disc's share of the torque.",
    OUTPUT: "Force between each output pin's roller and its hole.",
    ECCENTRIC: "Force of each disc on its eccentric, and the part of it that each roller carries.",
    PRESSURE: "Largest Hertz pressure of each kind of contact on each disc.",
    STIFFNESS: "Torque per angle at the output with the input held: the tangent at the operating torque.",
    REACTIONS: "Size of the force on shaft and flange in each of their bearings, A at the lower z.",
    CHANGE: "Size of the vector difference: what the inertia of the members' elastic motion adds.",
    VELOCITY: "Amplitude at the multiples of the input speed, by the vector sum of all forces on the casing.",
}

Entry = tuple[tuple[str, ...], npt.NDArray[Any], dict[str, str]]
Entries = dict[str, Entry]


def entry(
    dims: tuple[str, ...], values: npt.ArrayLike, units: str, name: str, figure: str = "", **more: str
) -> Entry:
    """Return values in SI with what plots and scripts must know of them; `more`: other attributes of a dataset."""
    attributes = {"units": units, "long_name": name}
    if figure:
        attributes["figure"] = figure
    if figure in CAPTIONS:
        attributes["caption"] = CAPTIONS[figure]
    return dims, np.asarray(values), attributes | more


def numbered(dim: str, count: int, name: str) -> Entry:
    """Return a coordinate 1 … count."""
    return entry((dim,), np.arange(1, count + 1), "", name)


def named(dim: str, names: tuple[str, ...], name: str) -> Entry:
    """Return a coordinate of words."""
    return entry((dim,), np.array(names), "", name)
