"""Answers from the forces of the rigid mechanism, the spherical Geneva wheel's beside each."""

from __future__ import annotations

import math
from collections.abc import Callable

from trochoid.drives.indexer.forces import Forces, State
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
    """Largest loads over an index on teeth, bearings and input; moments about the centre of the sphere."""
    asked: dict[str, tuple[Callable[[State], Array], str]] = {
        "tooth_force": (lambda x: x.tooth, "N"),
        "planet_bearing_force": (lambda x: x.arm_force, "N"),
        "arm_tilting_moment": (lambda x: x.arm_moment, "N*m"),
        "wheel_bearing_force": (lambda x: x.pin, "N"),
        "wheel_tilting_moment": (lambda x: x.wheel_moment, "N*m"),
        "wheel_torque": (lambda x: x.torque, "N*m"),
        "input_torque": (lambda x: x.input_torque, "N*m"),
        "input_power": (lambda x: x.power, "W"),
    }
    rows: dict[str, Parts] = {
        name: {key: _rigid(abs(found.largest(get)[0]), unit) for key, (get, unit) in asked.items()}
        for name, found in s.forces.items()
    }
    return Quantity(parts=rows, note="rigid; arm and planet without mass; teeth push along the pitch circle")


def _start(found: Forces) -> Array:
    import numpy as np

    return np.array([-found.indexer.half_turn])


def _rigid(value: float, unit: str) -> Quantity:
    return Quantity(value, unit, None, "rigid")
