"""Answers from the geometry of the teeth."""

from __future__ import annotations

import math
from typing import Any

from trochoid.drives.exact import exact
from trochoid.drives.planetary.stages import Stages
from trochoid.geometry.planetary_quality import Condition
from trochoid.results.outcome import Parts, Quantity
from trochoid.results.text import sentence

WHEELS = ("sun", "planet", "ring")
LENGTHS = {  # name -> field of geometry.planetary_table.Table, in the order of the source's Table 1
    "reference_diameter": "reference_diameter",
    "pitch_diameter": "pitch_diameter",
    "tip_diameter": "tip_diameter",
    "root_diameter": "root_diameter",
    "tooth_thickness": "thickness",
    "tip_thickness": "tip_thickness",
    "constant_chord": "chord",
    "constant_chord_height": "chord_height",
    "span": "span",
    "size_over_rollers": "over_rollers",
    "roller_circle_diameter": "roller_circle",
    "rho_tip": "rho_a",
    "rho_active_end": "rho_p",
    "rho_involute_end": "rho_l",
    "rho_at_chord": "rho_s",
    "rho_at_span": "rho_w",
    "rho_at_roller": "rho_m",
}
UNITS = {"m": (1e3, "mm"), "rad": (math.degrees(1.0), "deg"), "1": (1.0, "")}


def profile(s: Stages) -> Quantity:
    """Every dimension of the wheels and of their meshes, and the sizes by which they are measured."""
    from trochoid.geometry.planetary_table import table

    made, curves = s.feasible, s.curves
    numbers = table(made.geometry, made.roller)
    cuts = (curves.sun.cut, curves.planet.cut, curves.ring.cut)
    parts: dict[str, Quantity | Parts] = {}
    for k, (name, gear) in enumerate(zip(WHEELS, made.geometry.gears, strict=True)):
        values = {
            "teeth": (float(gear.teeth), ""),
            "shift": (float(gear.shift), ""),
            "base_diameter": (2e3 * gear.base_radius, "mm"),
            **{key: (1e3 * getattr(numbers, field)[k], "mm") for key, field in LENGTHS.items()},
            "span_teeth": (float(numbers.span_teeth[k]), ""),
            "roller_diameter": (1e3 * numbers.roller, "mm"),
            "roller_pressure_angle": (math.degrees(numbers.roller_angle[k]), "deg"),
            "involute_starts_at_diameter": (2e3 * math.hypot(gear.base_radius, cuts[k].start), "mm"),
        }
        parts[name] = exact(values)
    parts |= _meshes(s)
    return Quantity(
        parts=parts, note="rho: radius of curvature of the flank at the place that the name tells"
    )


def _meshes(s: Stages) -> dict[str, Quantity]:
    set_ = s.feasible.geometry
    sun, planet, ring = set_.tips
    pitch = math.pi * set_.outer.first.module * math.cos(set_.outer.first.pressure_angle)
    full = set_.planet_tip_for_ring
    found = {}
    for name, pair, tips in (
        ("sun_and_planet", set_.outer, (sun, planet)),
        ("planet_and_ring", set_.inner, (planet, ring)),
    ):
        slide = pair.sliding(*tips)
        values = {
            "ratio": (pair.ratio, ""),
            "center_distance": (1e3 * float(pair.center_distance), "mm"),
            "operating_pressure_angle": (math.degrees(float(pair.operating_angle)), "deg"),
            "base_pitch": (1e3 * pitch, "mm"),
            "path_of_contact": (1e3 * pitch * float(pair.contact_ratio(*tips)), "mm"),
            "contact_ratio": (float(pair.contact_ratio(*tips)), ""),
            "specific_sliding_" + name.split("_")[0]: (float(slide[0]), ""),
            "specific_sliding_" + name.split("_")[-1]: (float(slide[1]), ""),
            "backlash": (1e6 * float(pair.backlash), "um"),
        }
        if pair is set_.outer:
            values |= {
                "least_shift_of_sun_without_undercut": (pair.first.least_shift, ""),
                "least_shift_of_planet_without_undercut": (pair.second.least_shift, ""),
            }
        if pair is set_.inner:
            values |= {
                "planet_tip_diameter_of_this_mesh_alone": (2e3 * float(full), "mm"),
                "contact_ratio_with_that_tip": (float(pair.contact_ratio(full, ring)), ""),
                "rho_active_end_of_ring_with_that_tip": (1e3 * float(pair.lowest(full, ring)[1]), "mm"),
            }
        found[name] = exact(values)
    return found


def geometry_quality(s: Stages) -> Quantity:
    """Margin of each condition, positive where it holds; those for assembly by hand are not required."""
    from trochoid.geometry.planetary_quality import quality

    made = s.feasible
    found = quality(made.geometry, made.limits).conditions
    return Quantity(parts={condition.name.replace(" ", "_"): _margin(condition) for condition in found})


def _margin(condition: Condition) -> Quantity:
    factor, unit = (1e6, "um") if condition.name.startswith("backlash") else UNITS[condition.unit]
    value, limit = (sentence(Quantity(factor * float(v), unit)) for v in (condition.value, condition.limit))
    need = "must be" if condition.required else "would have to be"
    note = f"{value}, {need} {condition.relation} {limit}"
    margin = factor * float(condition.margin)
    if math.isinf(margin):  # tip circles that do not cross
        return Quantity("cannot occur", "", None, "exact")
    return Quantity(margin, unit, 0.0, "exact", note=note)


def contact_ratio(s: Stages) -> Quantity:
    """Pairs of teeth in contact in the mean, the share of time with the fewest, and how planets follow each other."""
    made, set_ = s.feasible.given, s.feasible.geometry
    sun, planet, ring = set_.tips
    meshes: dict[str, Any] = {
        "sun_and_planet": set_.outer.contact_ratio(sun, planet),
        "planet_and_ring": set_.inner.contact_ratio(planet, ring),
    }
    step = (
        made.teeth[2] % made.planets / made.planets
    )  # that of the sun's mesh is −z1/N, the same when planets fit
    note = "phase step: share of a pitch by which the next planet's mesh is ahead on its path; 0: all are in step"
    return Quantity(parts={name: _pairs(float(ratio), step) for name, ratio in meshes.items()}, note=note)


def _pairs(ratio: float, step: float) -> Quantity:
    fewest = math.floor(ratio)
    return exact(
        {
            "transverse": (ratio, ""),
            "fewest_pairs": (float(fewest), ""),
            "share_of_time_with_fewest": (fewest + 1.0 - ratio, ""),
            "phase_step": (step, ""),
        }
    )
