"""The blocking contours and conditions of the set of sources §4."""

from __future__ import annotations

import math

import numpy as np

from trochoid.geometry.blocking import inner_contour, inner_plane, outer_contour, outer_plane, volume
from trochoid.geometry.blocking_line import Line, coaxial_line
from trochoid.geometry.planetary import planetary
from trochoid.geometry.planetary_quality import Limits, least_margin, quality
from trochoid.sources.planetary_table import ROLLER, SET, found
from trochoid.sources.row import Finding

SUMS = (1.134, 1.134)  # x1 + x2 and x3 − x2, as the printed shifts have them
WHEELS = ("sun", "planet", "ring")


def feasible_line(limits: Limits | None = None) -> Line:
    """The coaxial line of the printed shifts, with the source's limits unless others are given."""
    return coaxial_line(SET, SUMS, limits)


def end(upper: bool) -> tuple[float, ...]:
    """Shifts of sun, planet, ring at an end of the coaxial line."""
    line = feasible_line()
    (stretch,) = line.stretches
    return tuple(float(x) for x in line.shifts(stretch.high if upper else stretch.low))


def binding() -> Finding:
    """What ends the line below."""
    (stretch,) = feasible_line().stretches
    lower = stretch.low_condition
    return Finding(lower, lower == "ring tip in planet fillet")


def upper_binds() -> Finding:
    """Whether anything binds where the source ends the line."""
    printed = quality(planetary(SET, (1.15, -0.016, 1.118)))
    required = [c for c in printed.conditions if c.required and "root" not in c.name]
    least = min(float(c.margin) / (SET.module if c.unit == "m" else 1.0) for c in required)
    (stretch,) = feasible_line().stretches
    return Finding(f"least margin {least:.3f}; what ends the line: {stretch.high_condition}", least < 1e-3)


def largest_contact_ratio() -> float:
    """The largest of sun and planet on the line."""
    line = feasible_line()
    x1 = np.linspace(line.stretches[0].low, line.stretches[0].high, 20001)
    set_ = planetary(SET, line.shifts(x1))
    return float(np.max(set_.outer.contact_ratio(*set_.tips[:2])))


def aims() -> Finding:
    """Whether a contact ratio of 1.4 leaves anything of the line."""
    lines = feasible_line(Limits(contact_ratio=1.4)).stretches
    return Finding(f"at most {largest_contact_ratio():.3f} for sun and planet", bool(lines))


def upper_with_modules() -> float:
    """Upper end of x1 if the tip limit means 0.4 modules."""
    (stretch,) = feasible_line(Limits(tip_thickness=0.4 * SET.module)).stretches
    return stretch.high


def on_a_grid() -> tuple[float, float, float]:
    """Areas and volume as sums over the nodes of a grid of step 0.01 through 0."""
    limits, h = Limits(), 0.01
    x, x3 = np.arange(-200, 301) * h, np.arange(-200, 801) * h
    a, b = np.meshgrid(x, x, indexing="ij")
    c, d = np.meshgrid(x, x3, indexing="ij")
    outer = least_margin(outer_plane(SET, a, b, limits), SET.module)[1].min(axis=0) >= 0.0
    inner = least_margin(inner_plane(SET, c, d, limits), SET.module)[1].min(axis=0) >= 0.0
    body = float(outer.sum(axis=0) @ inner.sum(axis=1))
    return float(outer.sum()) * h**2, float(inner.sum()) * h**2, body * h**3


def traced() -> tuple[float, float, float]:
    """Areas and volume with their boundaries traced."""
    outer, inner = outer_contour(SET), inner_contour(SET)
    return outer.area, inner.area, volume(outer, inner)


def largest_angle() -> Finding:
    """Range of the operating pressure angle along the line, at the given centre distance."""
    line = feasible_line()
    angles = planetary(SET, line.shifts(np.linspace(-0.09, 1.19, 50))).outer.operating_angle
    spread = float(np.ptp(angles))
    return Finding(f"{math.degrees(float(np.max(angles))):.4f}° all along the line", spread > 0.0)


def order(low: str, high: str) -> Finding:
    """Whether low < high of Table 1 holds, wheel by wheel."""
    table = found()
    holds = [getattr(table, low)[k] < getattr(table, high)[k] for k in range(3)]
    return by_wheel(holds)


def by_wheel(holds: list[bool]) -> Finding:
    """A claim that must hold for all wheels."""
    words = [f"{wheel} {'yes' if good else 'no'}" for wheel, good in zip(WHEELS, holds, strict=True)]
    return Finding(", ".join(words), all(holds))


def rollers(reach: str) -> Finding:
    """`D_d + D_r > D_a` or `D_d − D_r < D_f`, as printed, for all three wheels."""
    table = found()
    if reach == "tip":
        pairs = zip(table.roller_circle, table.tip_diameter, strict=True)
        return by_wheel([circle + ROLLER > tip for circle, tip in pairs])
    feet = zip(table.roller_circle, table.root_diameter, strict=True)
    return by_wheel([circle - ROLLER < root for circle, root in feet])


def above_least() -> Finding:
    """Whether the shifts of sun and planet are above x_min."""
    least = found().least_shift
    holds = [x > low for x, low in zip(SET.shifts, least, strict=False)]
    return Finding(", ".join(f"{wheel} yes" for wheel in WHEELS[:2]) if all(holds) else "no", all(holds))


def coaxial() -> Finding:
    """Both sides of (1)."""
    set_ = planetary(SET)
    sides = [pair.teeth / math.cos(pair.operating_angle) for pair in (set_.outer, set_.inner)]
    return Finding(", ".join(f"{side:.4f}" for side in sides), math.isclose(*sides, rel_tol=1e-12))


def distance_with_printed_indices() -> tuple[float, float]:
    """Centre distance (mm) of the inner pair with z2 − z1 and with z3 − z2."""
    inner = planetary(SET).inner
    factor = 0.5e3 * SET.module * math.cos(SET.pressure_angle) / math.cos(float(inner.operating_angle))
    z1, z2, z3 = SET.teeth
    return (z2 - z1) * factor, (z3 - z2) * factor


def right(name: str) -> tuple[float, float]:
    """The ring's number (mm) as printed and right."""
    return 1e3 * getattr(found(), name)[2], 1e3 * getattr(found(printed=False), name)[2]
