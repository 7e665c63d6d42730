"""What cannot be made or assembled is refused, with a reason and a value that would do."""

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.geometry.check import (
    bearing_faults,
    disc_faults,
    output_pin_faults,
    refuse,
    root_radius,
    stack_faults,
    walls,
)
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import Infeasible

EXAMPLE = Cycloid(20, 19, 0.08, 0.005, 0.0025)


@pytest.mark.independent
@given(circle=st.floats(0.03, 0.07), phase=st.floats(0.0, 6.0), count=st.integers(1, 12))
@settings(max_examples=30, deadline=None)
def test_walls_are_the_least_distances(circle: float, phase: float, count: int) -> None:
    """Brute force over densely sampled flank and hole centres."""
    flank = EXAMPLE.point(np.linspace(0.0, 2.0 * math.pi, 19 * 1200))
    angle = phase + 2.0 * math.pi * np.arange(count) / count
    centers = circle * np.stack((np.cos(angle), np.sin(angle)), axis=-1)
    wall = walls(EXAMPLE, 0.02, count, circle, 0.004, phase)
    away = np.linalg.norm(centers[:, None] - flank, axis=-1).min()
    assert away - 0.004 - 1e-6 < wall.hole_to_flank < away - 0.004 + 1e-15
    assert wall.hole_to_bore == pytest.approx(circle - 0.024, abs=1e-15)
    if count > 1:
        apart = np.linalg.norm(centers - centers[:1], axis=-1)[1:].min()
        assert wall.hole_to_hole == pytest.approx(apart - 0.008, abs=1e-15)
    assert wall.bore_to_flank == pytest.approx(np.linalg.norm(flank, axis=-1).min() - 0.02, abs=1e-15)
    assert wall.least == min(wall.hole_to_flank, wall.hole_to_bore, wall.hole_to_hole, wall.bore_to_flank)


@pytest.mark.exact
def test_the_example_disc_is_feasible() -> None:
    """Issue 2's disc has no fault; its walls are positive."""
    assert disc_faults(EXAMPLE, 0.025, 8, 0.052, 0.01) == ()
    assert walls(EXAMPLE, 0.025, 8, 0.052, 0.01).least > 0.01
    assert root_radius(EXAMPLE) == pytest.approx(0.0725)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("bore", "count", "circle", "hole", "message"),
    [
        (0.0725, 8, 0.052, 0.01, "bore radius 72.5 mm: it must lie between 0 and the root circle, 72.5 mm"),
        (0.0, 0, 0.0, 0.0, "bore radius 0 mm"),
        (0.025, 8, 0.052, 0.0, "hole radius 0 mm: it must be positive"),
        (0.025, 8, 0.073, 0.01, "hole circle radius 73 mm: it must lie between 0 and the root circle"),
        (0.025, 8, 0.066, 0.01, r"break into the flank by .*; take a hole radius smaller than 6\."),
        (0.025, 8, 0.034, 0.01, "break into the bore by 1 mm; take a hole radius smaller than 9 mm"),
        (0.025, 20, 0.052, 0.01, "break into each other by .*; take a hole radius smaller than 8.13459 mm"),
        (0.045, 8, 0.044, 0.01, "break into the bore by 11 mm; take a larger hole circle or a smaller bore"),
    ],
)
def test_discs_that_cannot_be_made(bore: float, count: int, circle: float, hole: float, message: str) -> None:
    """Issue 2: holes that break into the flank, the bore or each other, a bore beyond the root circle."""
    with pytest.raises(Infeasible, match=message):
        refuse(disc_faults(EXAMPLE, bore, count, circle, hole))


@pytest.mark.property
@given(circle=st.floats(0.03, 0.07), hole=st.floats(0.002, 0.03), count=st.integers(3, 16))
@settings(max_examples=40, deadline=None)
def test_the_hole_radius_that_is_advised_is_feasible(circle: float, hole: float, count: int) -> None:
    """Just below the least of the advised radii no fault is left, just above it one is."""
    faults = disc_faults(EXAMPLE, 0.02, count, circle, hole)
    radii = [
        float(r) for fault in faults for r in re.findall(r"hole radius smaller than ([0-9.e-]+) mm", fault)
    ]
    if radii and len(radii) == len(faults):
        best = 1e-3 * min(radii)
        assert disc_faults(EXAMPLE, 0.02, count, circle, best * (1.0 - 1e-5)) == ()
        assert disc_faults(EXAMPLE, 0.02, count, circle, best * (1.0 + 1e-5)) != ()


@pytest.mark.exact
def test_rollers_must_circle_in_their_holes() -> None:
    """A hole of roller radius + e just does; a smaller one is refused with both ways out."""
    assert output_pin_faults(0.0075 + 0.0025, 0.0075, 0.0025) == ()
    (fault,) = output_pin_faults(0.009, 0.0075, 0.0025)
    assert "roller radius + eccentricity = 10 mm, or the rollers at most 6.5 mm" in fault
    assert "at most" not in output_pin_faults(0.002, 0.0075, 0.0025)[0]


@pytest.mark.exact
def test_discs_must_not_collide() -> None:
    """Neighbours need their width between centres, in any order of listing."""
    assert stack_faults([0.006, -0.006], 0.01) == ()
    assert stack_faults([0.0, 0.01, 0.02], 0.01) == ()
    faults = stack_faults([0.008, 0.0, 0.017], 0.01)
    assert len(faults) == 2
    assert "centred at 0 mm and 8 mm collide; move them 10 mm apart or make them 8 mm wide" in faults[0]
    assert "positive width" in stack_faults([0.0], 0.0)[0]


@pytest.mark.property
@given(rollers=st.integers(3, 60), roller=st.floats(1e-4, 0.02))
def test_bearing_rollers_fit_side_by_side(rollers: int, roller: float) -> None:
    """No fault exactly when neighbours keep a distance; the advised number fits, one more does not."""
    faults = bearing_faults(0.025, rollers, roller)
    fits = 2.0 * (0.025 - roller) * math.sin(math.pi / rollers) > 2.0 * roller
    assert (faults == ()) is fits
    if faults and (most := re.search(r"at most (\d+)", faults[0])):
        assert bearing_faults(0.025, int(most[1]), roller) == ()
        assert bearing_faults(0.025, int(most[1]) + 1, roller) != ()


@pytest.mark.exact
def test_all_reasons_are_given_at_once() -> None:
    """One line each; none, no error."""
    refuse(())
    with pytest.raises(Infeasible, match=r"^first\nsecond$"):
        refuse(("first", "second"))
