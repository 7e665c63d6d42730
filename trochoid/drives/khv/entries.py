"""Entries of the dataset: values with their dimensions, unit and name, and the figure that shows them."""

from __future__ import annotations

import numpy.typing as npt

from trochoid.drives.entries import ANGLE, Entries, Entry, named, numbered
from trochoid.drives.entries import entry as plain

__all__ = ["ANGLE", "Entries", "Entry", "entry", "named", "numbered"]

SHARING, OUTPUT, ECCENTRIC = "Load sharing of the ring pins", "Output pins", "Eccentric bearings"
PRESSURE, STIFFNESS, ERROR = "Contact pressure", "Torsional stiffness", "Transmission error"
REACTIONS, CHANGE, VELOCITY = "Bearing reactions", "Elastic less rigid reactions", "Vibration velocity"
LINES = "Harmonics of the bearing reactions"
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
    LINES: "Amplitude of the force vector in each bearing at the multiples of the input speed, by both models.",
    VELOCITY: "Amplitude at the multiples of the input speed, by the vector sum of all forces on the casing.",
}


def entry(
    dims: tuple[str, ...], values: npt.ArrayLike, units: str, name: str, figure: str = "", **more: str
) -> Entry:
    """Return values in SI with what plots and scripts must know of them, the figure's caption with them."""
    caption = {"caption": CAPTIONS[figure]} if figure in CAPTIONS else {}
    return plain(dims, values, units, name, figure, **(caption | more))
