"""Answers about the casing that an indexer shakes, and the zone of its vibration."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from trochoid.drives.indexer.stages import Stages
from trochoid.drives.mesh_error import Pair, scalar_error
from trochoid.drives.vibration import RIGID, CasingVibration
from trochoid.drives.vibration_answers import casing_note, velocity_parts, zone_answer
from trochoid.results.outcome import Quantity


def vibration_velocity(s: Stages) -> Quantity:
    """Velocity of the casing, rms 10–1000 Hz, at each point by direction; without each effect the worst beside it."""
    found = s.vibration
    off = _typical(found)

    def made(get: Callable[[CasingVibration], float], unit: str, model: str) -> Quantity:
        levels = found.map(get)
        if levels.coarse is None or levels.fine == levels.coarse:  # no march in it, no mesh
            return Quantity(levels.fine, unit, None, model if off is None else RIGID)
        return Quantity(levels.fine, unit, scalar_error(levels.fine, levels.coarse, off or 0.0), model)

    loads, (_, why) = s.casing_loads.fine, s.response
    note = (
        f"by all that the drive and its motor put on the casing in a turn of the arm, index and dwell; "
        f"{loads.lines} harmonics of the arm's speed, up to {loads.lines * loads.base:.4g} Hz"
    )
    note += f"; no elastic drive ({why})" if why else ""
    return Quantity(
        parts=velocity_parts(found.fine, made, loads.best), note=f"{note}{casing_note(found.fine)}"
    )


def _typical(found: Pair[CasingVibration]) -> float | None:
    """Return the largest relative difference of the levels at any point; None where there is one level."""
    if found.coarse is None:
        return None
    fine, coarse = found.fine.elastic.rms_vector, found.coarse.elastic.rms_vector
    return float((np.abs(fine - coarse) / np.maximum(fine, np.finfo(float).tiny)).max())


def vibration_zone(s: Stages) -> Quantity:
    """Zone by the standard that applies, or the statement that none does."""
    return zone_answer(s.vibration.fine.zone)
