"""Answers from the forces of the rigid mechanism, the spherical Geneva wheel's beside each."""

from __future__ import annotations

import math
from collections.abc import Mapping

from trochoid.drives.indexer.forces import Forces
from trochoid.drives.indexer.reactions import ASKED, ELASTIC, RIGID, Turn
from trochoid.drives.indexer.stages import Stages
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Parts, Quantity


def contact_force_max(s: Stages) -> Quantity:
    """Largest force between pin and slot over an index, and the one with which it starts."""
    rows: dict[str, Parts] = {}
    for name, found in s.forces.items():
        force, at = found.largest(lambda x: x.pin)
        start = found.state(_start(found))
        rows[name] = {
            "pin_force": _rigid(abs(force), "N"),
            "at": _rigid(math.degrees(at), "deg"),
            "pin_force_at_start": _rigid(abs(float(start.pin[0])), "N"),
            "wheel_torque_at_start": _rigid(abs(float(start.torque[0])), "N*m"),
        }
    return Quantity(parts=rows)


def reactions(s: Stages) -> Quantity:
    """Largest loads over an index on teeth, bearings and input by model; moments about the centre of the sphere."""
    rows: dict[str, Parts] = {}
    for name, models in s.reactions.items():
        found = s.forces[name]
        row = {key: _rigid(abs(found.largest(get)[0]), unit) for key, (get, unit) in ASKED.items()}
        held = {key: x for key, x in models[RIGID].largest().items() if key not in ASKED}
        rows[name] = row | {key: _rigid(x, "N") for key, x in held.items()}
        if ELASTIC in models:
            rows[f"{name}_elastic"] = _elastic(models)
    note = "arm and planet without mass; teeth push along the pitch circle"
    marched, why = s.response
    said = "rigid; elastic: with the pin force of the march" if marched else "rigid"
    said += f", and no elastic ones ({why})" if why else ""
    return Quantity(parts=rows, note=f"{said}; {note}")


def _elastic(models: Mapping[str, Turn]) -> Parts:
    """Return the largest loads of the elastic drive, and by how much its harmonics are more."""
    units = {key: unit for key, (_, unit) in ASKED.items()}
    turn = models[ELASTIC]
    row = {key: Quantity(x, units.get(key, "N"), None, ELASTIC) for key, x in turn.largest().items()}
    lines = {model: x.lines["input_torque"][1:] for model, x in models.items()}
    more = lines[ELASTIC] - lines[RIGID]
    return row | {
        "input_torque_harmonic_most_raised": Quantity(float(1 + more.argmax()), "", None, ELASTIC),
        "raised_by": Quantity(float(more.max()), "N*m", None, ELASTIC),
    }


def _start(found: Forces) -> Array:
    import numpy as np

    return np.array([-found.indexer.half_turn])


def _rigid(value: float, unit: str) -> Quantity:
    return Quantity(value, unit, None, "rigid")
