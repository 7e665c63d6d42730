"""What is said of a rolling bearing: stiffness under its loads, how wrong a rigid ring is, safety and life."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.mesh_error import Pair, scalar_error
from trochoid.drives.rolling import Held, endured
from trochoid.results.outcome import Quantity
from trochoid.scene.rolling import inner_geometry

if TYPE_CHECKING:
    from trochoid.fem.bearing_duty import Endurance

MODEL = "ISO/TS 16281"
ENTRIES = (  # of a stiffness (5, 5) on x, y, z and both tilts
    ("k_xx", (0, 0), 1e-6, "N/um"),
    ("k_yy", (1, 1), 1e-6, "N/um"),
    ("k_xy", (0, 1), 1e-6, "N/um"),
    ("k_zz", (2, 2), 1e-6, "N/um"),
    ("k_tilt_xx", (3, 3), 1.0, "N*m/rad"),
    ("k_tilt_yy", (4, 4), 1.0, "N*m/rad"),
    ("k_x_tilt_y", (0, 4), 1.0, "N"),
    ("k_y_tilt_x", (1, 3), 1.0, "N"),
)
ROUNDING = 1e-9  # of the largest stiffness of the bearing
ASSUMED = "inner geometry assumed from the boundary dimensions: stiffness to perhaps 20 %"
STIFFER = "; below 0: the thick seat that ISO/TS 16281 contains is softer than this, and both laws differ by as much"
SINKS = "below 1: the raceways sink in under the largest load"
NONE = "no rolling bearing: give the drive one by its kind and sizes"


def stiffness_parts(found: Held, off: float | None = None) -> dict[str, Quantity]:
    """Return the mean stiffness over the loads, its extremes along the load, and how much a rigid ring is too stiff.

    `off`: by how much (relative) the radial stiffness would change with the loads that were found with it.
    """
    mean, duty = found.mean, found.duty
    unit = np.array([1.0, 1.0, 1.0, duty.row.lever, duty.row.lever])
    size = float(np.abs(mean / np.outer(unit, unit)).max())
    parts = {"radial": _one(1e-6 * found.radial, "N/um", None if off is None else 1e-6 * found.radial * off)}
    for name, (i, j), scale, said in ENTRIES:
        value = float(mean[i, j])
        if abs(value) > ROUNDING * size * unit[i] * unit[j]:
            parts[name] = _one(scale * value, said)
    if len(duty.loads) > 1:
        least, most = found.extremes
        parts["along_load_least"], parts["along_load_most"] = (
            _one(1e-6 * least, "N/um"),
            _one(1e-6 * most, "N/um"),
        )
    parts["elements_carrying_least"] = Quantity(float(duty.carrying[0]), "", None, MODEL)
    parts["elements_carrying_most"] = Quantity(float(duty.carrying[1]), "", None, MODEL)
    if found.seat is not None:
        parts |= seat_parts(found)
    return parts


def seat_parts(found: Held) -> dict[str, Quantity]:
    """Return how much the rigid ring is wrong in a flexible seat."""
    seat = found.seat
    assert seat is not None
    return {
        "rigid_ring_over_flexible": Quantity(
            seat.too_stiff,
            "%",
            seat.too_stiff_error,
            "finite elements",
            note="how much more the radial stiffness on rigid rings is, along the load, mean over its directions"
            + (STIFFER if seat.too_stiff < 0.0 else ""),
        ),
        "most_loaded_element_over_rigid_ring": Quantity(
            100.0 * (seat.largest - 1.0), "%", None, "finite elements"
        ),
    }


def life_parts(found: Held, speed: float, inner_turns: bool = True, number: int = 1) -> dict[str, Quantity]:
    """Return loads, pressure, safety and life of one bearing whose rings turn with `speed` rad/s past each other."""
    lasting, duty = endured(found, inner_turns), found.duty
    radial = np.linalg.norm(duty.loads[:, :2], axis=1)
    parts = {
        "radial_load_mean": Quantity(float(radial.mean()), "N", None, MODEL),
        "radial_load_max": Quantity(float(radial.max()), "N", None, MODEL),
        "axial_load": Quantity(float(duty.loads[:, 2].mean()), "N", None, MODEL),
        "element_load_max": Quantity(duty.element_load, "N", None, MODEL),
        "pressure_max": Quantity(1e-6 * duty.pressure, "MPa", None, MODEL),
    }
    return parts | endurance_parts(lasting, speed, found.table.dynamic_rating is None)


def endurance_parts(lasting: Endurance, speed: float, computed: bool = True) -> dict[str, Quantity]:
    """Return ratings, safety and lives; what is not finite, as without load, is left out."""
    rating = "ISO 281" if computed else "given"
    numbers: dict[str, tuple[float | None, str, str]] = {
        "dynamic_rating": (lasting.rating, "N", rating),
        "static_rating": (lasting.static_rating, "N", "ISO 76"),
        "static_safety": (lasting.static, "", "ISO 76"),
        "permissible_over_largest_element_load": (lasting.permissible, "", "ISO 76"),
        "equivalent_load": (lasting.equivalent, "N", MODEL),
        "L10": (_millions(lasting.basic), "Mrev", "ISO 281"),
        "L10r": (_millions(lasting.reference), "Mrev", MODEL),
        "L10r_hours": (_hours(lasting.reference, speed), "h", MODEL),
        "L10mr": (_millions(lasting.modified), "Mrev", MODEL),
        "L10mr_hours": (_hours(lasting.modified, speed), "h", MODEL),
    }
    found = {
        name: Quantity(value, unit, None, model)
        for name, (value, unit, model) in numbers.items()
        if value is not None and math.isfinite(value)
    }
    if lasting.static is not None and lasting.static < 1.0:
        found["static_safety"] = replace(found["static_safety"], note=SINKS)
    return found


def with_errors(levels: Pair[dict[str, Quantity]], difference: float) -> dict[str, Quantity]:
    """Return the numbers of the finer mesh with the errors that the coarser one suggests."""
    found = {}
    for name, fine in levels.fine.items():
        other = None if levels.coarse is None else levels.coarse.get(name)
        error = fine.error
        known = "rating" not in name and other is not None and fine.value
        if known and other is not None and isinstance(fine.value, float) and isinstance(other.value, float):
            error = scalar_error(fine.value, other.value, difference)
        found[name] = replace(fine, error=error)
    return found


def noted(parts: Mapping[str, Quantity], found: Held) -> dict[str, Quantity]:
    """Return the parts, the first with what a reader must know of the bearing's geometry."""
    said = assumed(found)
    first = next(iter(parts))
    return {**parts, first: replace(parts[first], note=said)} if said else dict(parts)


def assumed(found: Held) -> str:
    """Say whether an inner geometry was assumed, or nothing."""
    absent = [name for name in inner_geometry(found.table.kind) if getattr(found.table, name) is None]
    return ASSUMED if absent else ""


def _one(value: float, unit: str, error: float | None = None) -> Quantity:
    return Quantity(value, unit, error, MODEL)


def _millions(revolutions: float | None) -> float | None:
    return None if revolutions is None else 1e-6 * revolutions


def _hours(revolutions: float | None, speed: float) -> float | None:
    if revolutions is None or speed == 0.0:
        return None
    return revolutions * 2.0 * math.pi / abs(speed) / 3600.0
