"""The quantities of a K-H-V drive, by their public names."""

from __future__ import annotations

from trochoid.drives.lazy import answers

QUANTITIES = answers(
    "trochoid.drives.khv",
    {
        "answers_exact": (
            "ratio",
            "member_speeds",
            "profile",
            "geometry_quality",
            "contact_ratio",
            "balance",
            "mass",
        ),
        "answers_contact": (
            "load_sharing",
            "contact_force_max",
            "contact_pressure_max",
            "stress_max",
            "transmission_error",
            "torsional_stiffness",
        ),
        "answers_path": ("lost_motion", "backlash", "torsion_curve", "efficiency", "power_loss"),
        "answers_bearings": ("bearing_life",),
        "answers_torsional": ("torsional_vibration",),
        "answers_dynamics": (
            "bearing_loads",
            "bearing_stiffness",
            "reactions",
            "natural_frequencies",
            "vibration_velocity",
            "vibration_zone",
        ),
    },
)
