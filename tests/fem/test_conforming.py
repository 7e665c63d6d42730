"""A pin in its hole, from a loose fit to none, against Persson's closed form; and a press fit."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np
import pytest

from tests.fem.cases import (
    STEEL,
    free_disc_smooth,
    hole_in_plate_green,
    on_circle,
    round_disc,
)
from trochoid.fem.body import build_body
from trochoid.fem.complementarity import Group, Problem, Solution, solve
from trochoid.fem.compliance import Compliance, press
from trochoid.fem.conforming import Face, conforming_group, face_compliance
from trochoid.fem.material import Material, Plane
from trochoid.fem.strips import curve_compliance
from trochoid.geometry.mesh import mesh_outline
from trochoid.geometry.outline import Loop, Outline
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.types import Array

Build = Callable[[Array, Array, Array], Group]

RADIUS, LOAD, FAR = 0.02, 1e5, 40.0  # m, N/m, radii to the held edge of the plate

# Persson (1964), E'ΔR/Q and p0 R/Q at the contact's half angle ε in degrees, as in the public table
TABLE = {
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
rows = pytest.mark.parametrize("angle", TABLE)


@lru_cache
def _plate(facets: int) -> Compliance:
    """Return the hole's compliance in a large round plate that is held at its edge."""
    edge = Loop("edge", Circle((0.0, 0.0), FAR * RADIUS), 24)
    hole = Loop("hole", Circle((0.0, 0.0), RADIUS, hole=True), facets)
    return press(build_body(mesh_outline(Outline(edge, (hole,))), STEEL, ("edge",)), [hole])


def _angles(reach: float, count: int) -> tuple[Array, Array]:
    """Return the strips' angles round the point that is pressed, up to ±`reach`, and their widths."""
    place: Array = (np.arange(count) - 0.5 * (count - 1)) * 2 * reach / count
    return place, np.full(count, 2 * reach / count * RADIUS)


def _elements(angle: Array, width: Array, gap: Array, facets: int = 48) -> Group:
    """Return the contact of a finite-element pin (a free disc) in a finite-element plate."""
    points, disc, plate = on_circle(RADIUS, angle), round_disc(facets, RADIUS)[1], _plate(facets)
    pin = Face(disc, disc.surfaces["rim"], RADIUS * angle, points)
    hole = Face(plate, plate.surfaces["hole"], RADIUS * angle, points)
    return conforming_group((pin, hole), width, 1.0, gap, points / RADIUS)


def _closed(angle: Array, width: Array, gap: Array, pin: Plane = STEEL, plate: Plane = STEEL) -> Group:
    """Return the same with both bodies in closed form; their kinks at x = y averaged over a strip."""
    points, apart = on_circle(RADIUS, angle), angle[:, None] - angle
    hole = hole_in_plate_green(plate, apart + np.eye(len(angle)))
    chord = 2 * RADIUS * np.abs(np.sin(apart / 2)) + np.eye(len(angle))
    hole += plate.kernel * np.log(np.where(chord == 1.0, 2 * RADIUS * np.sin(0.5), chord))
    # at x = y: the limit of the closed form, 2/(πE')(ln R − ¾) + (3(κ−1)/4 + 1)/(4πG)
    own = plate.kernel * (np.log(RADIUS) - 0.75) + (0.75 * (plate.kolosov - 1) + 1) / (
        4 * np.pi * plate.shear
    )
    slope = [s * (p.kolosov - 1) / (8 * p.shear * RADIUS) for s, p in ((1, pin), (-1, plate))]
    np.fill_diagonal(hole, own + slope[1] * width / 4)
    disc = free_disc_smooth(pin, RADIUS, apart)
    disc[np.diag_indices_from(disc)] += slope[0] * width / 4
    local = curve_compliance(pin.kernel + plate.kernel, points, width) + disc + hole
    return Group(local[None], gap[None], points[None] / RADIUS)


def _pressed(group: Group) -> Solution:
    """Push the pin along x; its other motion is free."""
    return solve(Problem((group,), np.zeros((1, 1)), np.zeros((2, 2)), np.array([LOAD, 0.0])))


def _edge(angle: Array, pressure: Array) -> float:
    """Return the contact's half angle in degrees: p² falls linearly to zero at it."""
    last = np.flatnonzero(pressure > 0)[-3:]
    slope, start = np.polyfit(angle[last], pressure[last] ** 2, 1)
    return float(np.degrees(-start / slope))


def _persson(angle: float, build: Build) -> tuple[float, float]:
    """Return p0 R/Q and the half angle in degrees for the clearance of one row."""
    place, width = _angles(np.radians(min(180.0, 1.4 * angle)), 241)
    clearance = TABLE[angle][0] * LOAD / STEEL.modulus
    pressure = _pressed(build(place, width, np.full(241, clearance))).forces[0][0] / width
    return float(pressure.max() * RADIUS / LOAD), _edge(place, pressure)


@pytest.mark.exact
@rows
def test_printed_table_is_perssons_formula(angle: float) -> None:
    """E'ΔR/Q = (2 − ln(1+b²) − 2b⁴)/(π(1+b²)b²), b = tan(ε/2): the table above, to its printed digits."""
    b2 = np.tan(np.radians(angle) / 2) ** 2
    formula = (2 - np.log(1 + b2) - 2 * b2**2) / (np.pi * (1 + b2) * b2)
    assert formula == pytest.approx(TABLE[angle][0], rel=3e-6, abs=5e-6)


@pytest.mark.published
@rows
@pytest.mark.parametrize("build", [_closed, _elements])
def test_persson(angle: float, build: Build) -> None:
    """Persson (1964), same materials: p0 within 0.2 % and the contact angle within 0.5 %, down to ΔR = 0."""
    peak, edge = _persson(angle, build)
    assert peak == pytest.approx(TABLE[angle][1], rel=5e-4)
    assert edge == pytest.approx(angle, rel=1e-3)


@pytest.mark.property
def test_vanishing_clearance_is_no_clearance() -> None:
    """ΔR → 0: contact angle and pressure go to those of ΔR = 0, without a jump."""
    place, width = _angles(np.pi, 361)
    peaks = []
    for clearance in (1e-6, 1e-9, 1e-12, 0.0):
        solution = _pressed(_elements(place, width, np.full(361, clearance)))
        peaks.append(float((solution.forces[0][0] / width).max()))
        assert solution.imbalance < 1e-12
        assert solution.penetration < 1e-12
    change = np.array(peaks[:-1]) / peaks[-1] - 1
    assert change[0] > 0
    assert np.abs(change[1:]).max() < 1e-3
    assert abs(change[2]) < 1e-6


@pytest.mark.exact
@pytest.mark.parametrize("build", [_closed, _elements])
@pytest.mark.parametrize("tight", [2e-5, 1e-4])
def test_press_fit_under_load(tight: float, build: Build) -> None:
    """ΔR < 0 and contact all round: p = E'|ΔR|/(2R) (Lamé) + Q cos θ/(πR)."""
    place, width = _angles(np.pi, 180)
    pressure = _pressed(build(place, width, np.full(180, -tight))).forces[0][0] / width
    exact = STEEL.modulus * tight / (2 * RADIUS) + LOAD * np.cos(place) / (np.pi * RADIUS)
    assert exact.min() > 0
    assert pressure == pytest.approx(exact, rel=3e-3)


@pytest.mark.independent
def test_bodies_of_finite_elements_and_in_closed_form() -> None:
    """Steel pin in the closed-form plate of another material, and the finite-element pin's own matrix: same block."""
    angle, width = _angles(0.8, 81)
    disc = round_disc(48, RADIUS)[1]
    found = face_compliance(Face(disc, disc.surfaces["rim"], RADIUS * angle, on_circle(RADIUS, angle)), width)
    apart = angle[:, None] - angle
    exact = curve_compliance(STEEL.kernel, on_circle(RADIUS, angle), width) + free_disc_smooth(
        STEEL, RADIUS, apart
    )
    exact[np.diag_indices_from(exact)] += (STEEL.kolosov - 1) / (8 * STEEL.shear * RADIUS) * width / 4
    assert np.abs(found - exact).max() < 1.5e-3 * STEEL.kernel
    assert np.linalg.eigvalsh(found)[0] > 0


@pytest.mark.property
def test_softer_plate_spreads_the_contact() -> None:
    """Dundurs' constants: at the same clearance a softer plate, and only that, widens the contact and lowers p0."""
    place, width = _angles(np.pi, 241)
    gap, soft = np.full(241, 1e-5), Material(70e9, 0.3).plane("strain")
    both, softer = (
        _pressed(_closed(place, width, gap, STEEL, plate)).forces[0][0] / width for plate in (STEEL, soft)
    )
    assert softer.max() < both.max()
    assert _edge(place, softer) > _edge(place, both)
