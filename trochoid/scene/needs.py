"""Which quantities exist, which of them a drive offers, and the effects that each needs."""

from __future__ import annotations

QUANTITIES = (
    "ratio",
    "member_speeds",
    "profile",
    "geometry_quality",
    "blocking_contour",
    "contact_ratio",
    "load_sharing",
    "contact_force_max",
    "contact_pressure_max",
    "stress_max",
    "transmission_error",
    "mesh_stiffness",
    "torsional_stiffness",
    "lost_motion",
    "efficiency",
    "bearing_loads",
    "bearing_stiffness",
    "reactions",
    "balance",
    "natural_frequencies",
    "vibration_velocity",
    "vibration_zone",
    "indexing_motion",
    "mass",
)

# quantity -> effects without which it has no meaning: how rigid bodies share a load is not determined
NEEDS: dict[str, dict[str, tuple[str, ...]]] = {
    "khv": {
        "ratio": (),
        "member_speeds": (),
        "profile": (),
        "geometry_quality": (),
        "contact_ratio": (),
        "load_sharing": ("elastic_contact",),
        "contact_force_max": ("elastic_contact",),
        "contact_pressure_max": ("elastic_contact",),
        "stress_max": ("elastic_contact",),
        "transmission_error": ("elastic_contact",),
        "torsional_stiffness": ("elastic_contact",),
        "bearing_loads": ("elastic_contact",),
        "bearing_stiffness": ("elastic_contact", "bearing_compliance"),
        "reactions": ("elastic_contact", "inertia"),
        "balance": (),
        "vibration_velocity": ("elastic_contact", "inertia", "casing_on_mounts"),
        "vibration_zone": ("elastic_contact", "inertia", "casing_on_mounts"),
        "mass": (),
    },
}

KINDS = tuple(NEEDS)
NOT_WITH_SPRINGS = ("stress_max",)  # rigid discs on springs have no stress field
AT_POINTS = ("vibration_velocity", "vibration_zone")  # reported at [[casing.points]]
