"""The quantities of an RV drive, by their public names."""

from __future__ import annotations

from trochoid.drives.lazy import answers

QUANTITIES = answers(
    "trochoid.drives.rv",
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
            "transmission_error",
            "mesh_stiffness",
            "torsional_stiffness",
            "stiffness_breakdown",
            "lost_motion",
            "efficiency",
            "power_loss",
            "bearing_loads",
        ),
        "answers_bearings": ("bearing_stiffness", "bearing_life"),
        "answers_stress": ("stress_max",),
        "answers_dynamics": ("reactions", "natural_frequencies", "vibration_velocity", "vibration_zone"),
    },
)
