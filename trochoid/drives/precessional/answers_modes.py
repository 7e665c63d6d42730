"""Answers about natural frequencies."""

from __future__ import annotations

from collections.abc import Mapping

from trochoid.drives.exact import RPM
from trochoid.drives.modes import CLOSE
from trochoid.drives.precessional.stages import Stages
from trochoid.results.outcome import Quantity

LINES = {"of_the_input_speed": "critical", "of_an_uneven_satellite": "critical_uneven"}


def natural_frequencies(s: Stages) -> Quantity:
    """Modes at the speed of operation by rising frequency, who moves in each; the lowest critical speeds."""
    found, speed = s.modes, s.design.speed
    parts: dict[str, Quantity | Mapping[str, Quantity]] = {
        f"mode_{i}": Quantity(mode.frequency, "Hz", None, "elastic", note=mode.words)
        for i, mode in enumerate(found.modes, 1)
    }
    nearest = ""
    for name, which in LINES.items():
        values = getattr(found, which)
        if not values:
            continue
        parts[f"critical_speeds_{name}"] = {
            f"speed_{i}": Quantity(value / RPM, "rpm", None, "elastic") for i, value in enumerate(values, 1)
        }
        near = min(values, key=lambda value: abs(value / speed - 1.0))
        if abs(near / speed - 1.0) < CLOSE:
            nearest += f"; near resonance: {name.replace('_', ' ')} at {near / RPM:.4g} rpm"
    where = "with the casing on its mounts" if found.with_casing else "the casing stands still"
    return Quantity(
        parts=parts,
        note=f"undamped, about the steady nutation, as the fixed frame hears them; {where}{nearest}",
    )
