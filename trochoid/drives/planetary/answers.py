"""The quantities of a planetary set, by their public names."""

from __future__ import annotations

from trochoid.drives.lazy import answers

QUANTITIES = answers(
    "trochoid.drives.planetary",
    {
        "answers_motion": ("ratio", "member_speeds"),
        "answers_geometry": ("profile", "geometry_quality", "contact_ratio"),
        "answers_blocking": ("blocking_contour",),
        "answers_contact": (
            "load_sharing",
            "contact_force_max",
            "contact_pressure_max",
            "stress_max",
            "transmission_error",
            "mesh_stiffness",
            "torsional_stiffness",
        ),
        "answers_forces": ("reactions", "bearing_loads", "mass"),
        "answers_bearings": ("bearing_stiffness", "bearing_life"),
        "answers_dynamics": ("natural_frequencies", "vibration_velocity", "vibration_zone"),
    },
)
