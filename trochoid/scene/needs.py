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
    "stiffness_breakdown",
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
    "solutions",
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
        "natural_frequencies": ("inertia",),
        "vibration_velocity": ("inertia", "casing_on_mounts"),
        "vibration_zone": ("inertia", "casing_on_mounts"),
        "mass": (),
    },
    "precessional": {
        "ratio": (),
        "member_speeds": (),
        "profile": (),
        "geometry_quality": (),
        "contact_ratio": (),
        "reactions": ("inertia",),
        "balance": (),
        "natural_frequencies": ("bearing_compliance", "inertia"),
        "vibration_velocity": ("inertia", "casing_on_mounts"),
        "vibration_zone": ("inertia", "casing_on_mounts"),
        "mass": (),
    },
    "rv": {
        "ratio": (),
        "member_speeds": (),
        "profile": (),
        "geometry_quality": (),
        "contact_ratio": (),
        "load_sharing": ("elastic_contact",),
        "contact_force_max": ("elastic_contact",),
        "contact_pressure_max": ("elastic_contact",),
        "transmission_error": ("elastic_contact",),
        "mesh_stiffness": ("elastic_contact",),
        "torsional_stiffness": ("elastic_contact",),
        "stiffness_breakdown": ("elastic_contact",),
        "lost_motion": ("elastic_contact",),
        "efficiency": ("elastic_contact", "friction"),
        "power_loss": ("elastic_contact", "friction"),
        "bearing_loads": ("elastic_contact",),
        "balance": (),
        "mass": (),
    },
    "planetary": {
        "ratio": (),
        "member_speeds": (),
        "profile": (),
        "geometry_quality": (),
        "blocking_contour": (),
        "contact_ratio": (),
        "load_sharing": ("elastic_contact",),
        "contact_force_max": ("elastic_contact",),
        "contact_pressure_max": ("elastic_contact",),
        "stress_max": ("elastic_contact",),
        "transmission_error": ("elastic_contact",),
        "mesh_stiffness": ("elastic_contact",),
        "torsional_stiffness": ("elastic_contact",),
        "bearing_loads": (),
        "reactions": (),
        "mass": (),
    },
    "indexer": {
        "ratio": (),
        "member_speeds": (),
        "indexing_motion": (),
        "solutions": (),
        "profile": (),
        "geometry_quality": (),
        "contact_force_max": (),
        "reactions": ("inertia",),
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
    "precessional": ("bearing_compliance", "inertia", "casing_on_mounts"),
    "rv": ("elastic_contact", "pin_compliance", "clearance", "bearing_compliance", "inertia", "friction"),
    "planetary": ("elastic_contact", "bearing_compliance", "position_errors", "clearance", "inertia"),
    "indexer": ("inertia",),
}

# the contacts of a kind of drive that friction has a coefficient for
FRICTION_OF: dict[str, tuple[str, ...]] = {
    "khv": ("ring_pins", "output_pins"),
    "rv": ("ring_pins", "teeth"),
}

# the contact models among which a kind of drive chooses; none: closed forms, and nothing to choose
MODELS_OF: dict[str, tuple[str, ...]] = {
    "khv": ("springs", "level0", "strips"),
    "rv": ("level0", "strips"),
    "precessional": (),
    "planetary": ("level0", "strips"),
    "indexer": (),
}
ELASTIC_MODELS = ("level0", "strips")
UNDER_TORQUE = (
    "lost_motion",
    "backlash",
    "torsion_curve",
    "efficiency",
    "power_loss",
)  # operation.output_torque is their measure: the rated torque
NOT_WITH_SPRINGS = ("stress_max",)  # rigid discs on springs have no stress field
