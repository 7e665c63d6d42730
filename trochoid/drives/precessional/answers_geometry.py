"""Answers from kinematics and geometry alone."""

from __future__ import annotations

import math

import numpy as np

from trochoid.drives.exact import RPM, exact
from trochoid.drives.precessional.stages import Stages
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.results.outcome import Quantity

NO_TEETH = Quantity("no teeth given", note="the scene has no table [drive.teeth]")
LOBE_POINTS = 2001


def ratio(s: Stages) -> Quantity:
    """Input speed over output speed, with sign."""
    return Quantity(float(s.design.nutation.ratio), "", 0.0, "exact")


def member_speeds(s: Stages) -> Quantity:
    """Speeds of all members, and where the satellite's instantaneous axis lies (sources §2 (1)–(3), (9))."""
    made = s.design
    speed = made.speed / RPM
    wheel, satellite = made.pitch_cones
    whole = float(np.linalg.norm(made.nutation.relative_velocity))
    return exact(
        {
            "input": (speed, "rpm"),
            "output": (made.output_speed / RPM, "rpm"),
            "satellite_about_its_axis": (-float(made.nutation.tooth_ratio) * speed, "rpm"),
            "satellite_about_instantaneous_axis": (whole * speed, "rpm"),
            "instantaneous_axis_from_shaft": (math.degrees(wheel), "deg"),
            "instantaneous_axis_from_satellite_axis": (math.degrees(satellite), "deg"),
        }
    )


def profile(s: Stages) -> Quantity:
    """Numbers of the sphere tooth; angles at O, radii of curvature at the middle of the teeth."""
    made = s.feasible
    tooth = made.tooth
    if tooth is None:
        return NO_TEETH
    p = np.linspace(0.0, math.pi / tooth.lobes, LOBE_POINTS)
    polar = np.degrees(np.arccos(tooth.point(p)[:, 2]))
    bend = tooth.curvature(p)
    values = {
        "pins": (float(tooth.pins), ""),
        "lobes": (float(tooth.lobes), ""),
        "pin_angle_undercut_limit": (math.degrees(tooth.undercut_angle), "deg"),
        "flank_polar_angle_min": (float(polar.min()), "deg"),
        "flank_polar_angle_max": (float(polar.max()), "deg"),
        "tooth_height_angle": (float(np.ptp(polar)), "deg"),
        "tooth_pitch_angle": (360.0 / tooth.lobes, "deg"),
        "tooth_height": (1e3 * made.tooth_radius * math.radians(float(np.ptp(polar))), "mm"),
        "pitch_cone_wheel": (math.degrees(made.pitch_cones[0]), "deg"),
        "pitch_cone_satellite": (math.degrees(made.pitch_cones[1]), "deg"),
    }
    for name, most in (("convex", float(bend.max())), ("concave", -float(bend.min()))):
        if most > 0.0:
            values[f"least_{name}_radius_angle"] = (math.degrees(math.atan2(1.0, most)), "deg")
            values[f"least_{name}_radius"] = (1e3 * made.tooth_radius * math.atan2(1.0, most), "mm")
    return exact(values)


def geometry_quality(s: Stages) -> Quantity:
    """Margins of the geometry: what is left before the teeth cannot be made."""
    from trochoid.kinematics.sphere_tooth_checks import largest_nutation, nutation_limit, overlap_angle
    from trochoid.kinematics.sphere_tooth_clearance import clear_pin_angle

    tooth = s.feasible.tooth
    if tooth is None or s.penetration is None:
        return NO_TEETH
    clear, overlap, most = clear_pin_angle(tooth), overlap_angle(tooth), nutation_limit(tooth)
    margins = exact(
        {
            "undercut_margin": (math.degrees(clear - tooth.pin_angle), "deg"),
            "largest_pin_angle": (math.degrees(min(clear, overlap)), "deg"),
            "gap_between_pins": (math.degrees(2.0 * (overlap - tooth.pin_angle)), "deg"),
            "nutation_margin": (math.degrees(most - tooth.nutation), "deg"),
            "largest_nutation": (math.degrees(most), "deg"),
            "largest_nutation_of_any_pin": (math.degrees(largest_nutation(tooth)), "deg"),
        }
    )
    found = {"penetration": Quantity(max(s.penetration, 0.0), "rad", None, "brute force")}
    return Quantity(parts={**(margins.parts or {}), **found})


def contact_ratio(s: Stages) -> Quantity:
    """Pins that can push at once one way round, by geometry, and the angle of their force off the flank's motion."""
    tooth = s.feasible.tooth
    if tooth is None:
        return NO_TEETH
    pushing, angle, weight = pressure_angles(tooth)
    return Quantity(
        parts={
            "geometric": Quantity(tooth.pins * pushing, "", 0.0, "exact"),
            "pressure_angle_min": Quantity(_settled(math.degrees(angle.min())), "deg", 0.0, "exact"),
            "pressure_angle_mean": Quantity(
                math.degrees(angle @ weight / weight.sum()),
                "deg",
                0.0,
                "exact",
                note="weighted with the levers",
            ),
        },
        note="pins with a lever for the one sense of the torque; under load, elasticity decides",
    )


def _settled(angle: float) -> float:
    """Return the angle (°), 0 where it is rounding."""
    return angle if abs(angle) > 1e-12 else 0.0


def pressure_angles(tooth: SphereTooth) -> tuple[float, np.ndarray, np.ndarray]:
    """Share of the flank that pushes one way, its pressure angles (n,), rad, and levers (n,) per unit radius.

    On a sphere the flank's point moves across its axis with |e_z × f|, and the force has the lever (f × n)·e_z.
    """
    p = np.linspace(0.0, 2.0 * math.pi / tooth.lobes, LOBE_POINTS)[:-1]
    lever, point = tooth.lever(p), tooth.point(p)
    push = lever > 1e-12
    share = np.clip(lever[push] / np.hypot(point[push, 0], point[push, 1]), 0.0, 1.0)
    return (
        float(np.mean(lever > 1e-12) + 0.5 * np.mean(np.abs(lever) <= 1e-12)),
        np.arccos(share),
        lever[push],
    )
