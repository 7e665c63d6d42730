"""Answers from kinematics, geometry and masses alone."""

from __future__ import annotations

import math

import numpy as np

from trochoid.drives.exact import RPM, cycloid_profile, exact
from trochoid.drives.rv.design import ROLES
from trochoid.drives.rv.stages import Stages
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Parts, Quantity


def ratio(s: Stages) -> Quantity:
    """Speed of the driving over that of the driven member, with sign."""
    _fail_if_ways_differ(s)
    return Quantity(float(s.design.speeds.ratio), "", 0.0, "exact")


def member_speeds(s: Stages) -> Quantity:
    """Absolute speeds of all members; the crankshafts turn with their planets."""
    _fail_if_ways_differ(s)
    speed = s.scene.operation.input_speed / RPM
    members = {name: float(value) * speed for name, value in s.design.speeds.members.items()}
    return Quantity(parts={name: Quantity(value, "rpm", 0.0, "exact") for name, value in members.items()})


def _fail_if_ways_differ(s: Stages) -> None:
    """The constraint matrix, inverted motion and compound motion must agree as rational numbers (sources §1)."""
    from trochoid.kinematics.train_motions import rv_compound, rv_inverted, superposed

    f, c = s.design.drive.first_stage, s.design.drive.cycloid
    teeth, choice = (
        (f.z_sun, f.z_planet, c.lobes, c.pins),
        (s.design.drive.fixed, *ROLES[s.design.drive.fixed]),
    )
    for way in (rv_inverted(*teeth), rv_compound(*teeth)):
        if superposed(way, *choice) != s.design.speeds:
            raise TrochoidError(f"three ways to the speeds of teeth {teeth} do not agree; please report this")


def profile(s: Stages) -> Quantity:
    """Numbers of the tooth profiles of both stages."""
    parts: dict[str, Parts | Quantity] = {"cycloid": _parts(cycloid_profile(s.feasible.flank))}
    stage = s.design.first
    parts["first_stage"] = _parts(
        {
            "center_distance": (1e3 * stage.arm, "mm"),
            "operating_pressure_angle": (math.degrees(stage.pair.operating_angle), "deg"),
        }
    )
    gears = zip(("sun", "planet"), (stage.pair.first, stage.pair.second), stage.tips, stage.cuts, strict=True)
    for name, gear, tip, cut in gears:
        parts[name] = _parts(
            {
                "shift": (float(gear.shift), ""),
                "reference_diameter": (2e3 * gear.pitch_radius, "mm"),
                "base_diameter": (2e3 * gear.base_radius, "mm"),
                "tip_diameter": (2e3 * tip, "mm"),
                "root_diameter": (2e3 * cut.root_radius, "mm"),
                "tip_thickness": (1e3 * float(gear.thickness_at(tip)), "mm"),
            }
        )
    return Quantity(parts=parts)


def _parts(values: dict[str, tuple[float, str]]) -> Parts:
    return exact(values).parts or {}


def geometry_quality(s: Stages) -> Quantity:
    """Margins of the geometry: what is left before the drive cannot be made or put together."""
    from trochoid.drives.rv.feasible import conditions
    from trochoid.geometry.check import walls, window_walls
    from trochoid.kinematics.assembly import neighbors_clear

    made, flank = s.feasible, s.design.flank
    d, holes, windows = made.drive, made.holes(0), made.windows(0)
    wall = walls(flank, d.cycloid.bore_radius, holes.count, holes.circle_radius, holes.radius, holes.angle0)
    between = flank.pin_circle_radius * math.sin(math.pi / flank.pins) - flank.pin_radius
    cycloid = {
        "undercut_margin": (1e3 * (flank.undercut_radius - flank.pin_radius), "mm"),
        "gap_between_pins": (2e3 * between, "mm"),
        "wall_hole_flank": (1e3 * wall.hole_to_flank, "mm"),
        "wall_hole_bore": (1e3 * wall.hole_to_bore, "mm"),
        "wall_hole_hole": (1e3 * wall.hole_to_hole, "mm"),
        "distinct_discs": (float(len(made.hole_angles)), ""),
    }
    if windows is not None:
        beside = window_walls(flank, d.cycloid.bore_radius, holes, windows)
        cycloid["wall_window_flank"] = (1e3 * beside.hole_to_flank, "mm")
        cycloid["wall_window_bore"] = (1e3 * beside.hole_to_bore, "mm")
        cycloid["wall_window_hole"] = (1e3 * beside.hole_to_hole, "mm")
    neighbors = neighbors_clear("planets", d.first_stage.cranks, made.first.arm, made.first.tips[1])
    stage = {
        "gap_between_planets": (1e3 * neighbors.margin, "mm"),
        "assembly_misfit": (0.0, "pitch"),  # feasible: teeth of sun and planet are a multiple of the cranks
        **{
            f"margin_{c.name.replace(' ', '_')}": _margin(c.margin, c.unit)
            for c in conditions(made.first)
            if not c.name.startswith("contact ratio")
        },
    }
    return Quantity(
        parts={"cycloid": _parts(cycloid), "first_stage": _parts(stage)},
        note="margins are positive: what is left before a limit",
    )


def _margin(value: float, unit: str) -> tuple[float, str]:
    return (1e3 * float(value), "mm") if unit == "m" else (float(value), "")


def contact_ratio(s: Stages) -> Quantity:
    """Pins in mesh by geometry and their pressure angles; teeth in mesh of sun and planet."""
    from trochoid.kinematics.meshing import contact_ratio as geometric

    found = geometric(s.feasible.flank)
    cycloid = {
        "geometric": (found.mean, ""),
        "pressure_angle_min": (math.degrees(found.pressure_angle_min), "deg"),
        "pressure_angle_mean": (math.degrees(found.pressure_angle_mean), "deg"),
    }
    stage = s.design.first
    first = {"transverse": (float(stage.pair.contact_ratio(*stage.tips)), "")}
    return Quantity(parts={"cycloid": _parts(cycloid), "first_stage": _parts(first)})


def balance(s: Stages) -> Quantity:
    """What discs and eccentrics leave unbalanced: force and couple on the casing.

    Disc i and the eccentrics in it have their centres at e from the axes that they orbit, all in one direction.
    """
    made, masses = s.feasible, s.masses
    orbiting = masses.disc.mass + made.drive.first_stage.cranks * masses.orbiting
    force = made.flank.eccentricity * made.crank_speed**2 * orbiting
    angles = np.array([disc.crank for disc in made.discs])
    vectors = force * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    z = np.array([disc.z for disc in made.discs])
    parts = {
        "inertia_force_of_a_disc": (made.flank.eccentricity * made.crank_speed**2 * masses.disc.mass, "N"),
        "inertia_force_with_eccentrics": (force, "N"),
        "unbalanced_force": (_settled(vectors), "N"),
        "unbalanced_couple": (_settled(vectors * z[:, None]), "N*m"),
    }
    return Quantity(
        parts={name: Quantity(value, unit, None, "exact") for name, (value, unit) in parts.items()}
    )


def _settled(vectors: Array) -> float:
    """Return the length of the sum of vectors (n, 2), 0 when only rounding is left."""
    total = float(np.linalg.norm(vectors.sum(axis=0)))
    return total if total > 1e-12 * float(np.abs(vectors).max(initial=0.0)) else 0.0


def mass(s: Stages) -> Quantity:
    """Masses of all members, and the specific mass in kg per N·m of output torque."""
    from trochoid.drives.rv.mass import total_mass

    parts = total_mass(s.feasible, s.masses)
    whole, torque = sum(parts.values()), s.scene.operation.output_torque
    entries = {name: Quantity(value, "kg", None, "exact") for name, value in parts.items()}
    entries["total"] = Quantity(whole, "kg", None, "exact")
    if torque > 0:
        entries["specific"] = Quantity(whole / torque, "kg/(N*m)", None, "exact")
    note = "round shafts, carrier and ring; cages, seals and main bearings are not counted"
    return Quantity(parts=entries, note=note)
