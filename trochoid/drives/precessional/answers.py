"""The quantities of a precessional drive, by their public names."""

from __future__ import annotations

from trochoid.drives.lazy import answers

QUANTITIES = answers(
    "trochoid.drives.precessional",
    {
        "answers_geometry": ("ratio", "member_speeds", "profile", "geometry_quality", "contact_ratio"),
        "answers_dynamics": ("reactions", "balance", "vibration_velocity", "vibration_zone", "mass"),
        "answers_contact": (
            "load_sharing",
            "contact_force_max",
            "contact_pressure_max",
            "transmission_error",
            "mesh_stiffness",
            "torsional_stiffness",
            "lost_motion",
            "bearing_loads",
        ),
        "answers_bearings": ("bearing_stiffness", "bearing_life"),
        "answers_modes": ("natural_frequencies",),
    },
)
