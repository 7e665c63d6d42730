"""Answers from the pin's path and the wheel's slots, the spherical Geneva wheel's beside each."""

from __future__ import annotations

import math

import numpy as np

from trochoid.drives.indexer.design import INDEXER
from trochoid.drives.indexer.feasible import between_slots, bottom_to_hub, slot_length
from trochoid.drives.indexer.stages import Stages
from trochoid.drives.indexer.words import path_words
from trochoid.kinematics.indexer import Indexer
from trochoid.kinematics.indexer_slot import pressure_angle
from trochoid.kinematics.zeros import zeros_between
from trochoid.results.outcome import Parts, Quantity

STEEP = math.radians(60.0)
SAMPLES = 361


def profile(s: Stages) -> Quantity:
    """Numbers of the pin's path and of what it asks of the slot; lengths on the sphere."""
    made = s.feasible
    radius, path = made.drive.sphere_radius, made.indexer.path
    rows: dict[str, Parts | Quantity] = {
        "path": Quantity(path_words(made.chosen), model="exact"),
        "arm_angle": _degrees(path.arm),
        "pin_angle": _degrees(path.pin),
        "pin_ratio": _exact(path.pin_ratio),
        "planet_pitch_cone": _degrees(path.planet_cone),
        "central_pitch_cone": _degrees(path.central_cone),
        "inflections_per_half_index": _exact(float(made.chosen.inflections)),
    }
    for name, travel in s.slots.items():
        rows[name] = {
            "slot_length": _mm(slot_length(made, travel)),
            "pin_travel": _mm(radius * (travel.farthest - travel.nearest)),
            "closest_approach": _mm(radius * travel.nearest),
            "closest_approach_at": _degrees(travel.nearest_at),
            "rim_angle": _degrees(travel.farthest),
            "entry_angle": _degrees(travel.entry),
        }
    teeth = "inwards" if path.central_cone > math.pi / 2 else "outwards"
    note = (
        "lengths on the sphere; arm_angle is negative where the arm leans away from the wheel's axis; "
        f"teeth of the fixed wheel look {teeth}"
    )
    return Quantity(parts=rows, note=note)


def geometry_quality(s: Stages) -> Quantity:
    """Margins of the wheel, accuracy of the rest, pressure angles."""
    made = s.feasible
    rows: dict[str, Parts] = {}
    for name, travel in s.slots.items():
        found = s.measured[name]
        peak = float(pressure_angle(found.indexer, found.peaks.acceleration_at))
        needed, given = slot_length(made, travel), made.drive.wheel.slot_length if name == INDEXER else None
        row = {
            "bottom_of_slot_to_hub": _mm(bottom_to_hub(made, travel, given or needed)),
            "wall_between_slots": _wall(between_slots(made, travel) - 2.0 * made.drive.pin_radius),
            "pin_farthest_in_dwell": _degrees(_farthest(found.indexer)),
            "mouth_offset": _mm(made.drive.sphere_radius * travel.offset),
            "dwell_disturbance": _degrees(travel.disturbance),
            "pressure_angle_at_acceleration_max": _degrees(peak),
            "share_of_index_above_60_deg": _exact(_steep_share(found.indexer)),
        }
        if given is not None:
            row["slot_length_margin"] = _mm(given - needed)
        rows[name] = row
    return Quantity(parts=rows)


def _steep_share(indexer: Indexer) -> float:
    """Share of an index over which the pressure angle is above 60°."""
    t = np.linspace(0.0, indexer.half_turn, SAMPLES)
    edges = zeros_between(lambda x: pressure_angle(indexer, x) - STEEP, t[:-1], t[1:], 1e-12)
    ends = np.sort(np.concatenate((t[[0, -1]], edges)))
    steep = pressure_angle(indexer, 0.5 * (ends[1:] + ends[:-1])) > STEEP
    return float(np.diff(ends)[steep].sum() / indexer.half_turn)


def _farthest(indexer: Indexer) -> float:
    rest = np.linspace(indexer.half_turn, math.pi, SAMPLES)
    return float(indexer.reach(rest).max())


def mass(s: Stages) -> Quantity:
    """Mass and moment of inertia of the wheel."""
    found = s.wheel
    given = s.scene.drive.wheel.inertia is not None
    return Quantity(
        parts={
            "wheel": Quantity(found.mass, "kg", None, "exact"),
            "wheel_inertia": Quantity(found.own, "kg*m^2", None, "exact"),
            "inertia_used": Quantity(found.used, "kg*m^2", None, "given" if given else "exact"),
        },
        note="the wheel as a full zone of a spherical shell, without slots and hub",
    )


def _wall(wall: float) -> Quantity:
    if not math.isfinite(wall):
        return Quantity("one slot", model="exact")
    return _mm(wall)


def _mm(length: float) -> Quantity:
    return _exact(1e3 * length, "mm")


def _degrees(angle: float) -> Quantity:
    return _exact(math.degrees(angle), "deg")


def _exact(value: float, unit: str = "") -> Quantity:
    return Quantity(value, unit, 0.0, "exact")
