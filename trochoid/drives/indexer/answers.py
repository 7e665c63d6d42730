"""The quantities of an indexer, by their public names."""

from __future__ import annotations

from trochoid.drives.lazy import answers

QUANTITIES = answers(
    "trochoid.drives.indexer",
    {
        "answers_motion": ("ratio", "member_speeds", "indexing_motion", "solutions"),
        "answers_geometry": ("profile", "geometry_quality", "mass"),
        "answers_forces": ("contact_force_max", "reactions"),
        "answers_contact": ("contact_pressure_max", "mesh_stiffness", "torsional_stiffness"),
        "answers_modes": ("natural_frequencies",),
        "answers_vibration": ("dynamic_factor", "residual_vibration"),
        "answers_casing": ("vibration_velocity", "vibration_zone"),
    },
)
