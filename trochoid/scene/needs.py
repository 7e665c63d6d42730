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
    "bearing_life",
    "reactions",
    "balance",
    "natural_frequencies",
    "torsional_vibration",
    "vibration_velocity",
    "vibration_zone",
    "indexing_motion",
    "solutions",
    "dynamic_factor",
    "residual_vibration",
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
        "bearing_life": ("bearing_compliance",),
        "reactions": ("inertia",),
        "balance": (),
        "natural_frequencies": ("inertia",),
        "torsional_vibration": ("inertia",),
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
        "load_sharing": ("elastic_contact",),
        "contact_force_max": ("elastic_contact",),
        "contact_pressure_max": ("elastic_contact",),
        "transmission_error": ("elastic_contact",),
        "mesh_stiffness": ("elastic_contact",),
        "torsional_stiffness": ("elastic_contact",),
        "lost_motion": ("elastic_contact",),
        "bearing_loads": ("elastic_contact",),
        "bearing_stiffness": ("bearing_compliance",),
        "bearing_life": ("bearing_compliance", "inertia"),
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
        "stress_max": ("elastic_contact",),
        "transmission_error": ("elastic_contact",),
        "mesh_stiffness": ("elastic_contact",),
        "torsional_stiffness": ("elastic_contact",),
        "stiffness_breakdown": ("elastic_contact",),
        "lost_motion": ("elastic_contact",),
        "efficiency": ("elastic_contact", "friction"),
        "power_loss": ("elastic_contact", "friction"),
        "bearing_loads": ("elastic_contact",),
        "bearing_stiffness": ("elastic_contact", "bearing_compliance"),
        "bearing_life": ("elastic_contact", "bearing_compliance"),
        "reactions": ("elastic_contact", "inertia"),
        "natural_frequencies": ("elastic_contact", "inertia"),
        "balance": (),
        "vibration_velocity": ("elastic_contact", "inertia", "casing_on_mounts"),
        "vibration_zone": ("elastic_contact", "inertia", "casing_on_mounts"),
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
        "bearing_stiffness": ("elastic_contact", "bearing_compliance"),
        "bearing_life": ("elastic_contact", "bearing_compliance"),
        "reactions": (),
        "natural_frequencies": ("elastic_contact", "inertia"),
        "vibration_velocity": ("elastic_contact", "inertia", "casing_on_mounts"),
        "vibration_zone": ("elastic_contact", "inertia", "casing_on_mounts"),
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
        "contact_pressure_max": ("elastic_contact",),
        "mesh_stiffness": ("elastic_contact",),
        "torsional_stiffness": ("elastic_contact",),
        "dynamic_factor": ("elastic_contact", "inertia"),
        "residual_vibration": ("elastic_contact", "inertia"),
        "natural_frequencies": ("elastic_contact", "inertia"),
        "reactions": ("inertia",),
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
        "time_varying_stiffness",
        "backlash",
    ),
    "precessional": (
        "elastic_contact",
        "pin_compliance",
        "clearance",
        "bearing_compliance",
        "inertia",
        "casing_on_mounts",
    ),
    "rv": (
        "elastic_contact",
        "pin_compliance",
        "clearance",
        "bearing_compliance",
        "inertia",
        "friction",
        "casing_on_mounts",
    ),
    "planetary": (
        "elastic_contact",
        "bearing_compliance",
        "position_errors",
        "clearance",
        "inertia",
        "casing_on_mounts",
    ),
    "indexer": ("elastic_contact", "clearance", "inertia", "casing_on_mounts"),
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
    "precessional": ("slices",),
    "planetary": ("level0", "strips"),
    "indexer": ("rigid_wheel", "elastic_wheel"),
}
ELASTIC_MODELS = ("level0", "strips", "slices", "rigid_wheel", "elastic_wheel")
MESHLESS = ("springs", "rigid_wheel")  # models without a mesh
# quantities that mean nothing without operation.output_torque, and why
UNDER_TORQUE = {
    "lost_motion": "it is measured at shares of that torque",
    "backlash": "the loop that it is read off goes up to that torque",
    "torsion_curve": "the loop goes up to that torque",
    "efficiency": "it is the share of the power that comes out, and nothing would",
    "power_loss": "friction follows the forces in the contacts, and nothing would press them",
    "torsional_vibration": "the drive swings on the stiffness that its contacts have under that torque",
}
# the kinds of drive whose elastic contacts need that torque, and the quantities that they then change as well
LOADED = {"planetary": ("bearing_loads", "reactions")}
NO_FLANK = "no flank is pressed without it"
NOT_WITH_SPRINGS = ("stress_max",)  # rigid discs on springs have no stress field

# the places where a kind of drive presses its casing, which the bores of an elastic one hold
SEATS_OF: dict[str, tuple[str, ...]] = {
    "khv": ("ring", "input shaft A", "input shaft B", "output flange A", "output flange B"),
    "rv": ("ring", "carrier A", "carrier B", "sun"),
    "planetary": ("sun", "ring", "carrier"),
    "precessional": ("fixed wheel", "bearing B", "bearings C", "motor"),
    "indexer": ("fixed wheel", "input shaft", "motor", "output shaft", "lock"),
}

# the tables that a rolling bearing may stand in, of kinds of drive that have none of their own
ROLLING_OF: dict[str, tuple[tuple[str, ...], ...]] = {
    "precessional": (("bearing_a",), ("bearing_b",), ("bearing_c",)),
    "planetary": (("planet", "bearing"),),
}
