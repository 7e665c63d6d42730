"""The quantities of a K-H-V drive, by their public names; imported only when one is asked for."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module

from trochoid.drives.khv.stages import Stages
from trochoid.results.outcome import Quantity

_MODULE_OF = {
    **dict.fromkeys(
        ("ratio", "member_speeds", "profile", "geometry_quality", "contact_ratio", "balance", "mass"),
        "answers_exact",
    ),
    **dict.fromkeys(
        (
            "load_sharing",
            "contact_force_max",
            "contact_pressure_max",
            "stress_max",
            "transmission_error",
            "torsional_stiffness",
        ),
        "answers_contact",
    ),
    **dict.fromkeys(
        ("lost_motion", "backlash", "torsion_curve", "efficiency", "power_loss"),
        "answers_path",
    ),
    **dict.fromkeys(
        ("bearing_loads", "bearing_stiffness", "reactions", "vibration_velocity", "vibration_zone"),
        "answers_dynamics",
    ),
}


def _lazy(name: str) -> Callable[[Stages], Quantity]:
    def answer(stages: Stages) -> Quantity:
        module = import_module(f"trochoid.drives.khv.{_MODULE_OF[name]}")
        found: Quantity = getattr(module, name)(stages)
        return found

    return answer


QUANTITIES = {name: _lazy(name) for name in _MODULE_OF}
