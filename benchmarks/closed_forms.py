"""Contact pressure against published closed forms: Hertz's line contact and Persson's pin in its hole."""

from __future__ import annotations

from time import perf_counter

import numpy as np

from benchmarks.table import Row, Table
from trochoid.fem import complementarity as lcp
from trochoid.fem.body import build_body
from trochoid.fem.compliance import Compliance, press
from trochoid.fem.conforming import Face, conforming_group
from trochoid.fem.material import Material
from trochoid.fem.strips import REACH, STRIPS, strip_centres, strip_compliance
from trochoid.geometry.mesh import mesh_outline
from trochoid.geometry.outline import Loop, Outline
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.types import Array

STEEL, ALUMINIUM = Material(210e9, 0.3).plane("strain"), Material(70e9, 0.3).plane("strain")
RADIUS, LOAD, HALF_WIDTH, PRESSURE = 50e-3, 35e6, 6.2146e-3, 3585.37e6  # NAFEMS R0094, case 1; per metre
PERSSON = {  # half angle of contact in deg: E'ΔR/Q, p0 R/Q
    10.0: (82.2206, 3.66156),
    20.0: (19.5353, 1.85239),
    30.0: (7.94354, 1.26029),
    40.0: (3.90504, 0.97388),
    50.0: (2.05456, 0.81119),
    60.0: (1.06720, 0.71172),
    70.0: (0.48803, 0.64955),
    80.0: (0.12615, 0.61161),
    84.828: (0.0, 0.59963),
}
HOLE, FACETS, ARC = 20e-3, 48, 361  # radius in m, facets round it, strips along the contact


def measure() -> list[Table]:
    """Compare pressures, half widths and angles of contact."""
    return [_cylinder(), _pin_in_hole()]


def _cylinder() -> Table:
    """Cylinder of steel on a block of aluminium, as the strips of the program resolve it."""
    x = strip_centres() * REACH * HALF_WIDTH
    width = 2 * REACH * HALF_WIDTH / STRIPS
    local = strip_compliance(np.array([STEEL.kernel + ALUMINIUM.kernel]), np.array([width]))
    group = lcp.Group(local, (x**2 / (2 * RADIUS))[None], np.ones((1, STRIPS, 1)))
    force = lcp.solve(_problem(group, np.array([LOAD]))).forces[0][0]
    half = 2 * np.sqrt((force * x**2).sum() / force.sum())
    rows = (
        Row("largest pressure: error", _off(force.max() / width, PRESSURE), "", 2e-3),
        Row("half width: error", _off(half, HALF_WIDTH), "", 5e-3),
    )
    return Table("Hertz line contact", f"NAFEMS R0094 case 1, 35 kN/mm, {STRIPS} strips", rows)


def _pin_in_hole() -> Table:
    """Pin in the hole of a large plate of the same steel, both by finite elements."""
    start = perf_counter()
    pin = _pressed(Outline(Loop("rim", Circle((0.0, 0.0), HOLE), FACETS)))
    edge = Loop("edge", Circle((0.0, 0.0), 40 * HOLE), 24)
    plate = _pressed(Outline(edge, (Loop("rim", Circle((0.0, 0.0), HOLE, hole=True), FACETS),)), ("edge",))
    rows = [Row("set-up of both bodies", perf_counter() - start, "s")]
    for angle, (gap, peak) in PERSSON.items():
        pressure, reach = _conforming(pin, plate, angle, gap)
        rows.append(Row(f"{angle:g}°: largest pressure: error", _off(pressure, peak), "", 2e-3))
        rows.append(Row(f"{angle:g}°: angle of contact: error", _off(reach, angle), "", 5e-3))
    return Table("pin in its hole (Persson)", f"{FACETS} facets round the hole, {ARC} strips", tuple(rows))


def _pressed(outline: Outline, supports: tuple[str, ...] = ()) -> Compliance:
    rim = next(loop for loop in outline.loops if loop.name == "rim")
    return press(build_body(mesh_outline(outline), STEEL, supports), [rim])


def _conforming(pin: Compliance, plate: Compliance, angle: float, gap: float) -> tuple[float, float]:
    """Return p0 R/Q and the half angle of contact in deg, for E'ΔR/Q = `gap`; Q is 1 kN/m."""
    load, reach = 1e3, np.radians(min(180.0, 1.4 * angle))
    theta = strip_centres(ARC) * reach
    width = np.full(ARC, 2 * reach / ARC * HOLE)
    normal = np.stack([np.cos(theta), np.sin(theta)], axis=-1)
    faces = [Face(body, body.surfaces["rim"], HOLE * theta, HOLE * normal) for body in (pin, plate)]
    play = np.full(ARC, gap * load / STEEL.modulus)
    group = conforming_group(faces, width, 1.0, play, normal)
    pressure = lcp.solve(_problem(group, np.array([load, 0.0]))).forces[0][0] / width
    last = np.flatnonzero(pressure > 0)[-3:]  # near its edge the square of the pressure falls linearly
    slope, offset = np.polyfit(theta[last], pressure[last] ** 2, 1)
    return float(pressure.max() * HOLE / load), float(np.degrees(-offset / slope))


def _problem(group: lcp.Group, load: Array) -> lcp.Problem:
    free = np.zeros((len(load), len(load)))
    return lcp.Problem((group,), np.zeros((1, 1)), free, load)


def _off(found: float, published: float) -> float:
    return abs(float(found) / published - 1)
