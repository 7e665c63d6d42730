"""Blocking contours: the tracer on regions with known areas, contours against grids, body, line and choices."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.geometry.blocking import body, inner_contour, inner_plane, outer_contour, outer_plane, volume
from trochoid.geometry.blocking_contour import END, trace
from trochoid.geometry.blocking_line import choose, coaxial_line, needed_sums
from trochoid.geometry.planetary import PlanetarySet, planetary
from trochoid.geometry.planetary_check import planetary_faults
from trochoid.geometry.planetary_quality import Limits, least_margin, quality
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.shaper import Shaper
from trochoid.kinematics.types import Array

SOURCE = PlanetarySet((20, 30, 80), 2e-3, 52e-3, (0.5, 0.634, 1.768), Shaper(25, 0.15, 55.6e-3), planets=4)
LIMITS = Limits()


def lens(x: Array, y: Array) -> Array:
    """Half of a disc of radius 1 with a hole of radius 0.3 about (0, 0.5)."""
    return np.stack((1.0 - x**2 - y**2, y, x**2 + (y - 0.5) ** 2 - 0.09))


@pytest.mark.exact
def test_traced_area_of_a_half_disc_with_a_hole() -> None:
    """π/2 − 0.09π; the error falls with the fourth power of the step; every part of the boundary is named."""
    errors = []
    for steps in (40, 80, 160):
        contour = trace(lens, ("rim", "floor", "hole"), (-2.0, -2.0), (2.0, 2.0), steps)
        errors.append(abs(contour.area - math.pi * (0.5 - 0.09)))
        assert len(contour.boundaries) == 2
        assert contour.binding == ("rim", "floor", "hole")
    assert errors[2] < 1e-7
    assert errors[0] / errors[2] > 100.0
    corners = [
        p for b in contour.boundaries for p in b.points if abs(p[1]) < 1e-12 and abs(abs(p[0]) - 1.0) < 1e-9
    ]
    assert len(corners) == 2
    assert contour.slices(np.array([0.5, 0.9, 3.0])) == pytest.approx(
        [2.0 * math.sqrt(0.75) - 0.6, 2.0 * math.sqrt(0.19), 0.0], abs=2e-4
    )


@pytest.mark.exact
def test_two_pieces_and_nothing() -> None:
    """Regions may be in pieces, or empty."""
    two = trace(
        lambda x, y: np.stack((x**2 - 0.25, 1.0 - x**2, 1.0 - y**2)), ("a", "b", "c"), (-2, -2), (2, 2), 50
    )
    assert len(two.boundaries) == 2
    assert two.area == pytest.approx(2.0, abs=1e-9)
    assert trace(lambda x, y: np.stack((x - 9.0,)), ("far",), (-2, -2), (2, 2)).area == 0.0


@pytest.mark.exact
def test_what_the_box_cuts_is_named() -> None:
    """A half plane has an end where the box has one, and its boundary says so."""
    half = trace(lambda x, y: np.stack((x + y,)), ("slope",), (-2, -2), (2, 2), 60)
    assert half.binding == ("slope", END)
    assert half.area == pytest.approx(8.0, rel=1e-3)


@pytest.mark.regression
def test_areas_and_volume_of_the_source() -> None:
    """Traced: 2.08701, 10.06699, 10.80812; sources §4 has 2.08, 10.07, 10.77 from a grid of step 0.01."""
    outer, inner = outer_contour(SOURCE), inner_contour(SOURCE)
    assert outer.area == pytest.approx(2.087013835, abs=1e-8)
    assert inner.area == pytest.approx(10.066989, abs=2e-6)
    assert volume(outer, inner) == pytest.approx(10.80812, abs=2e-5)


@pytest.mark.independent
def test_contours_by_quadrature_of_columns() -> None:
    """Areas and volume again, by lengths of columns on a fine grid that knows nothing of tracing."""
    x2 = np.linspace(-0.8, 1.45, 601)
    step = x2[1] - x2[0]
    x1, x3 = np.linspace(-0.3, 1.4, 900), np.linspace(-1.3, 7.0, 900)
    a, b = np.meshgrid(x1, x2, indexing="ij")
    c, d = np.meshgrid(x2, x3, indexing="ij")
    outer = least_margin(outer_plane(SOURCE, a, b, LIMITS), SOURCE.module)[1].min(axis=0) >= 0.0
    inner = least_margin(inner_plane(SOURCE, c, d, LIMITS), SOURCE.module)[1].min(axis=0) >= 0.0
    across, along = outer.sum(axis=0) * (x1[1] - x1[0]), inner.sum(axis=1) * (x3[1] - x3[0])
    contours = outer_contour(SOURCE, steps=80), inner_contour(SOURCE, steps=80)
    assert contours[0].area == pytest.approx(across.sum() * step, rel=2e-3)
    assert contours[1].area == pytest.approx(along.sum() * step, rel=2e-3)
    assert volume(*contours) == pytest.approx(float(across @ along) * step, rel=2e-3)


@pytest.mark.exact
def test_boundary_points_lie_on_what_they_name() -> None:
    """Each traced point fulfils all conditions to rounding, and the named one is zero there."""
    for contour, plane in ((outer_contour(SOURCE), outer_plane), (inner_contour(SOURCE), inner_plane)):
        for boundary in contour.boundaries:
            x, y = boundary.points.T
            names, margins = least_margin(plane(SOURCE, x, y, LIMITS), SOURCE.module)
            assert (*names, END) == contour.names
            assert margins.min() > -1e-9
            named = margins[boundary.conditions, np.arange(x.size)]
            assert np.quantile(np.abs(named), 0.99) < 1e-9
            assert (
                np.abs(named).max() < 1e-3
            )  # beside the few corners whose third condition is shorter than a cell


@pytest.mark.exact
def test_names_of_the_boundaries() -> None:
    assert set(outer_contour(SOURCE).binding) == {
        "undercut of the sun",
        "undercut of the planet",
        "pointed tip of the sun",
        "planet tip in sun fillet",
        "sun tip in planet fillet",
        "contact ratio of sun and planet",
    }
    assert set(inner_contour(SOURCE).binding) == {
        "undercut of the planet",
        "pointed tip of the ring",
        "ring tip in planet fillet",
        "planet tip in ring fillet",
        "contact ratio of planet and ring",
        "tip interference of planet and ring",
    }


@pytest.mark.exact
def test_body_on_a_grid_tends_to_its_volume() -> None:
    """The body at 200³ holds what both plane contours allow, and nothing else."""
    grid = body(SOURCE, resolution=200)
    assert grid.margin.shape == (200, 200, 200)
    assert grid.volume == pytest.approx(10.80812, rel=2e-3)
    i, j, k = 60, 90, 110
    at = (np.array([grid.x1[i]]), np.array([grid.x2[j]]), np.array([grid.x3[k]]))
    outer = least_margin(outer_plane(SOURCE, at[0], at[1], LIMITS), SOURCE.module)[1].min()
    inner = least_margin(inner_plane(SOURCE, at[1], at[2], LIMITS), SOURCE.module)[1].min()
    assert grid.margin[i, j, k] == min(outer, inner)


@pytest.mark.property
@given(scale=st.floats(0.1, 10.0))
@settings(max_examples=5, deadline=None)
def test_shifts_do_not_know_the_size(scale: float) -> None:
    """All lengths times a factor: the same contour and the same line."""
    large = replace(
        SOURCE,
        module=scale * SOURCE.module,
        center_distance=scale * SOURCE.center_distance,
        cutter=replace(SOURCE.cutter, tip_diameter=scale * SOURCE.cutter.tip_diameter),
    )
    limits = Limits(tip_thickness=scale * LIMITS.tip_thickness)
    assert outer_contour(large, limits, 60).area == pytest.approx(
        outer_contour(SOURCE, steps=60).area, rel=1e-9
    )
    one, other = coaxial_line(SOURCE).stretches[0], coaxial_line(large, limits=limits).stretches[0]
    assert (other.low, other.high) == pytest.approx((one.low, one.high), abs=1e-9)
    assert (other.low_condition, other.high_condition) == (one.low_condition, one.high_condition)


@pytest.mark.exact
def test_line_needs_1_1336_without_play() -> None:
    """The printed 1.134 is x_Σ = 50 (inv α_w − inv α)/(2 tan α) = 1.13360 rounded up."""
    assert needed_sums(SOURCE) == pytest.approx((1.1335961427, 1.1335961427), abs=1e-9)
    assert coaxial_line(SOURCE).stretches[0].high == pytest.approx(1.19568, abs=1e-5)


@pytest.mark.exact
def test_ends_of_the_line_bind() -> None:
    """At each end the named margin is zero, all others positive; a little beyond, it alone fails."""
    line = coaxial_line(SOURCE)
    (stretch,) = line.stretches
    for at, name, out in (
        (stretch.low, stretch.low_condition, -1e-6),
        (stretch.high, stretch.high_condition, 1e-6),
    ):
        assert quality(planetary(SOURCE, line.shifts(at)))[name].margin == pytest.approx(0.0, abs=1e-12)
        beyond = quality(planetary(SOURCE, line.shifts(at + out)))
        assert [c.name for c in beyond.failed] == [name]


@pytest.mark.independent
@pytest.mark.parametrize("aim", ["contact_ratio", "sliding", "tips"])
def test_choice_is_the_best_of_the_line(aim: str) -> None:
    """Against all of 20001 points of the line; at the choice everything required holds."""
    line = coaxial_line(SOURCE)
    choice = choose(SOURCE, aim, line)  # type: ignore[arg-type]
    (stretch,) = line.stretches
    x1 = np.linspace(stretch.low, stretch.high, 20001)
    set_ = planetary(SOURCE, line.shifts(x1))
    sun, planet, ring = set_.tips
    if aim == "contact_ratio":
        other = np.minimum(set_.outer.contact_ratio(sun, planet), set_.inner.contact_ratio(planet, ring))
    elif aim == "tips":
        other = np.min([g.thickness_at(r) for g, r in zip(set_.gears, set_.tips, strict=True)], axis=0)
    else:
        one, two = set_.outer.sliding(sun, planet)
        other = -np.abs(one - two)
        chosen = planetary(SOURCE, choice.shifts)
        assert chosen.outer.sliding(*chosen.tips[:2]) == pytest.approx((choice.value, choice.value), abs=1e-9)
    assert choice.shifts[0] == pytest.approx(x1[other.argmax()], abs=2e-4)
    if aim != "sliding":
        assert choice.value >= other.max() - 1e-12
    assert not quality(planetary(SOURCE, choice.shifts)).failed
    assert choice.bound == ""


@pytest.mark.exact
def test_empty_line_is_refused_and_has_no_nearest() -> None:
    strict = Limits(contact_ratio=1.6)
    line = coaxial_line(SOURCE, limits=strict)
    assert line.stretches == ()
    found = planetary_faults(SOURCE, strict)
    assert "x_sun =" not in found[-1] or "center_distance" in found[-1]
    with pytest.raises(Infeasible, match=r"no shifts with x1 \+ x2 = 1\.1336 .* change the centre distance"):
        choose(SOURCE, "tips", line)


@pytest.mark.exact
def test_nearest_feasible_is_the_end_of_the_line() -> None:
    """The end is at x1 = 1.195682; advised are steps of 0.001 within it."""
    said = planetary_faults(replace(SOURCE, shifts=(1.3, -0.166, 0.968)))[-1]
    assert said.endswith("x_sun = 1.195, x_planet = -0.0614, x_ring = 1.07219")
