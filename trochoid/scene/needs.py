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
    "backlash",
    "torsion_curve",
    "efficiency",
    "power_loss",
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

# kind -> quantity -> effects without which it has no meaning; load sharing without "elastic_contact": equal springs
NEEDS: dict[str, dict[str, tuple[str, ...]]] = {
    "khv": {
        "ratio": (),
        "member_speeds": (),
        "profile": (),
        "geometry_quality": (),
        "contact_ratio": (),
        "load_sharing": (),
        "contact_force_max": (),
        "contact_pressure_max": (),
        "stress_max": ("elastic_contact",),
        "transmission_error": (),
        "torsional_stiffness": (),
        "lost_motion": (),
        "backlash": (),
        "torsion_curve": (),
        "efficiency": ("friction",),
        "power_loss": ("friction",),
        "bearing_loads": (),
        "bearing_stiffness": ("bearing_compliance",),
        "reactions": ("inertia",),
        "balance": (),
        "vibration_velocity": ("inertia", "casing_on_mounts"),
        "vibration_zone": ("inertia", "casing_on_mounts"),
        "mass": (),
    },
}

KINDS = tuple(NEEDS)

# the effects that a kind of drive can have in its equations
EFFECTS_OF: dict[str, tuple[str, ...]] = {
    "khv": (
        "elastic_contact",
        "pin_compliance",
        "clearance",
        "bearing_compliance",
        "inertia",
        "casing_on_mounts",
        "friction",
    ),
}

# the contact models among which a kind of drive chooses; none: closed forms, and nothing to choose
MODELS_OF: dict[str, tuple[str, ...]] = {"khv": ("springs", "level0", "strips")}
ELASTIC_MODELS = ("level0", "strips")
UNDER_TORQUE = (
    "lost_motion",
    "backlash",
    "torsion_curve",
    "efficiency",
    "power_loss",
)  # operation.output_torque is their measure: the rated torque
NOT_WITH_SPRINGS = ("stress_max",)  # rigid discs on springs have no stress field
