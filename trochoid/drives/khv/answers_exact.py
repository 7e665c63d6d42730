"""Answers from kinematics, geometry and masses alone."""

from __future__ import annotations

import numpy as np

from trochoid.drives.exact import RPM, cycloid_profile, exact
from trochoid.drives.khv.numbers import over_turn
from trochoid.drives.khv.stages import Stages
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Quantity


def ratio(s: Stages) -> Quantity:
    """Input speed over output speed, with sign."""
    return Quantity(float(s.design.speeds.ratio), "", 0.0, "exact")


def member_speeds(s: Stages) -> Quantity:
    """Absolute speeds of all members."""
    speed = s.scene.operation.input_speed / RPM
    members = {name: float(value) * speed for name, value in s.design.speeds.members.items()}
    return Quantity(parts={name: Quantity(value, "rpm", 0.0, "exact") for name, value in members.items()})


def profile(s: Stages) -> Quantity:
    """Numbers of the tooth profile."""
    return exact(cycloid_profile(s.feasible.flank))


def geometry_quality(s: Stages) -> Quantity:
    """Margins of the geometry: what is left before the drive cannot be made."""
    from trochoid.geometry.check import walls

    d, flank = s.feasible.drive, s.design.flank
    wall = walls(
        flank,
        d.bore_radius,
        d.output_pins.count,
        d.output_pins.circle_radius,
        s.design.hole_radius,
        s.design.hole_angles[0],
    )
    between = flank.pin_circle_radius * np.sin(np.pi / flank.pins) - flank.pin_radius
    return exact(
        {
            "undercut_margin": (1e3 * (flank.undercut_radius - flank.pin_radius), "mm"),
            "gap_between_pins": (2e3 * float(between), "mm"),
            "wall_hole_flank": (1e3 * wall.hole_to_flank, "mm"),
            "wall_hole_bore": (1e3 * wall.hole_to_bore, "mm"),
            "wall_hole_hole": (1e3 * wall.hole_to_hole, "mm"),
            "distinct_discs": (float(len(s.design.hole_angles)), ""),
        }
    )


def contact_ratio(s: Stages) -> Quantity:
    """Pins in mesh and output pins that carry, by geometry; pins under load when contacts are solved; the
    pressure angles.
    """
    from trochoid.kinematics.meshing import contact_ratio as geometric
    from trochoid.kinematics.parallel_crank import loaded_output_pins

    found = geometric(s.feasible.flank)
    carrying = loaded_output_pins(s.design.drive.output_pins.count)
    parts = {
        "geometric": Quantity(found.mean, "", 0.0, "exact"),
        "output_pins_mean": Quantity(carrying.mean, "", 0.0, "exact"),
        "output_pins_least": Quantity(carrying.least, "", 0.0, "exact"),
        "output_pins_most": Quantity(carrying.most, "", 0.0, "exact"),
        "pressure_angle_min": Quantity(float(np.degrees(found.pressure_angle_min)), "deg", 0.0, "exact"),
        "pressure_angle_mean": Quantity(float(np.degrees(found.pressure_angle_mean)), "deg", 0.0, "exact"),
    }
    if "contact" in stages_asked(s):
        parts["loaded_mean"] = over_turn(s, lambda x: float(x.ring.touching.mean()), "")
        parts["loaded_min"] = over_turn(s, lambda x: float(x.ring.touching.min()), "")
        parts["loaded_max"] = over_turn(s, lambda x: float(x.ring.touching.max()), "")
    return Quantity(parts=parts)


def balance(s: Stages) -> Quantity:
    """What the eccentric discs leave unbalanced: force and couple on the casing."""
    made, masses = s.feasible, s.masses
    force = made.flank.eccentricity * made.crank_speed**2 * masses.disc.mass
    angles = np.array([d.crank for d in made.discs])
    vectors = force * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    z = np.array([d.z for d in made.discs])
    return Quantity(
        parts={
            "inertia_force_of_a_disc": Quantity(force, "N", None, "exact"),
            "unbalanced_force": Quantity(_settled(vectors), "N", None, "exact"),
            "unbalanced_couple": Quantity(_settled(vectors * z[:, None]), "N*m", None, "exact"),
        }
    )


def _settled(vectors: Array) -> float:
    """Return the length of the sum of vectors (n, 2), 0 when only rounding is left."""
    total = float(np.linalg.norm(vectors.sum(axis=0)))
    return total if total > 1e-12 * float(np.abs(vectors).max(initial=0.0)) else 0.0


def mass(s: Stages) -> Quantity:
    """Masses of all members, and the specific mass in kg per N·m of output torque."""
    from trochoid.drives.casing import casing_mass
    from trochoid.drives.khv.mass import total_mass

    parts = total_mass(s.feasible, s.masses)
    casing, given = casing_mass(s.scene, lambda: s.casing_body)
    whole = sum(parts.values()) + casing
    torque = s.scene.operation.output_torque
    entries = {name: Quantity(value, "kg", None, "exact") for name, value in parts.items()}
    entries["casing"] = Quantity(casing, "kg", None, given)
    entries["total"] = Quantity(whole, "kg", None, "exact")
    note = "specific mass needs a torque above zero"
    if torque > 0:
        note = "the textbook's range of the specific mass is 0.02 … 0.05 kg/(N·m)"
        entries["specific"] = Quantity(whole / torque, "kg/(N*m)", None, "exact")
    return Quantity(parts=entries, note=note)


def stages_asked(s: Stages) -> tuple[str, ...]:
    """Return the stages that the scene's other quantities need anyway."""
    from trochoid.drives.khv.plan import STAGES_OF

    return tuple(
        stage for name in s.scene.ask.quantities if name != "contact_ratio" for stage in STAGES_OF[name]
    )
