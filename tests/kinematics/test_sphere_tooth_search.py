"""The nearest sphere tooth that can be made: it can be made, and brute force finds nothing nearer."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.kinematics.sphere_cases import EXAMPLES, tooth
from trochoid.kinematics.sphere_tooth import Carrier, SphereTooth
from trochoid.kinematics.sphere_tooth_checks import (
    largest_nutation,
    nutation_limit,
    overlap_angle,
    sphere_tooth_faults,
)
from trochoid.kinematics.sphere_tooth_clearance import clear_pin_angle, penetration
from trochoid.kinematics.sphere_tooth_search import nearest_feasible, pin_limit, pin_limit_map

WANTED = (
    tooth(15, 14, 70.0, 9.0, 2.5),  # undercut
    tooth(15, 14, 70.0, 12.0, 2.5),  # pins overlap too
    tooth(15, 14, 70.0, 5.0, 9.0),  # beyond the range of nutation
    tooth(15, 14, 50.0, 5.0, 2.5, -1),
    tooth(14, 15, 60.0, 13.0, 2.5, 1, "satellite"),
)


def change(wanted: SphereTooth, found: SphereTooth) -> float:
    """Root of the sum of squares of the logarithms of the angles' ratios."""
    ratios = (
        found.nutation / wanted.nutation,
        found.polar_angle / wanted.polar_angle,
        found.pin_angle / wanted.pin_angle,
    )
    return math.hypot(*(math.log(ratio) for ratio in ratios))


def least_by_brute_force(wanted: SphereTooth, around: float, margin: float = 0.02) -> float:
    """Least change on a grid of nutation and polar angles, 21 by 21, with the largest pin that each allows."""
    least = math.inf
    steps = np.exp(np.linspace(-around, around, 21))
    for polar in wanted.polar_angle * steps[wanted.polar_angle * steps <= 0.5 * math.pi]:
        for nutation in wanted.nutation * steps:
            trial = replace(wanted, nutation=float(nutation), polar_angle=float(polar))
            if nutation > (1.0 - margin) * largest_nutation(trial):
                continue
            pin = (1.0 - margin) * min(clear_pin_angle(trial), overlap_angle(trial))
            if pin > 0.0:
                least = min(least, change(wanted, replace(trial, pin_angle=min(pin, wanted.pin_angle))))
    return least


@pytest.mark.independent
@pytest.mark.parametrize("wanted", WANTED, ids=lambda each: f"{each.pins}/{each.lobes} {each.side}")
def test_nothing_nearer_by_brute_force(wanted: SphereTooth) -> None:
    """It can be made, no pin penetrates, and the change is that of a fine grid or less (within the rounding)."""
    found = nearest_feasible(wanted)
    assert not sphere_tooth_faults(found)
    assert penetration(found) < 1e-12
    assert (found.pins, found.lobes, found.side, found.pins_on) == (
        wanted.pins,
        wanted.lobes,
        wanted.side,
        wanted.pins_on,
    )
    own = change(wanted, found)
    assert own <= least_by_brute_force(wanted, 1.05 * own) + 2e-3
    for angle in (found.nutation, found.polar_angle, found.pin_angle):
        assert 1e3 * math.degrees(angle) == pytest.approx(round(1e3 * math.degrees(angle)), abs=1e-6)


@pytest.mark.exact
def test_a_tooth_that_can_be_made_stays() -> None:
    """Nothing is changed where nothing must be."""
    for each in EXAMPLES:
        assert nearest_feasible(each) is each


@pytest.mark.property
@given(
    pins=st.integers(4, 80),
    more=st.sampled_from((-1, 1)),
    side=st.sampled_from((-1, 1)),
    on=st.sampled_from(("ring", "satellite")),
    angles=st.tuples(st.floats(0.01, 20.0), st.floats(1.0, 90.0), st.floats(0.01, 89.9)),
)
@settings(max_examples=15, deadline=None)
def test_any_request_leads_to_a_tooth(
    pins: int, more: int, side: int, on: Carrier, angles: tuple[float, float, float]
) -> None:
    """Whatever angles are asked for, what is proposed has no fault and no larger nutation or pin than possible."""
    nutation, polar, pin = (math.radians(angle) for angle in angles)
    found = nearest_feasible(SphereTooth(pins, pins + more, polar, pin, nutation, side, on))
    assert not sphere_tooth_faults(found)
    assert found.pin_angle <= pin_limit(found)
    assert found.nutation < largest_nutation(found)


@pytest.mark.exact
def test_map_is_the_limit_of_each_place() -> None:
    """The map's entries are the least of undercut and overlap, 0 where the path has loops."""
    base = WANTED[0]
    nutation, polar = np.radians([1.0, 2.5, 9.0]), np.radians([60.0, 70.0])
    found = pin_limit_map(base, nutation, polar)
    assert found.shape == (2, 3)
    for i, a in enumerate(polar):
        for j, x in enumerate(nutation):
            each = replace(base, nutation=float(x), polar_angle=float(a))
            expected = 0.0 if x > largest_nutation(each) else min(clear_pin_angle(each), overlap_angle(each))
            assert found[i, j] == expected
    assert found[0, 2] == found[1, 2] == 0.0
    assert math.degrees(found[1, 1]) == pytest.approx(8.50875, abs=5e-6)


@pytest.mark.property
@pytest.mark.parametrize(("pin", "polar"), [(5.0, 70.0), (8.0, 80.0), (0.5, 50.0), (2.0, 90.0)])
def test_nutation_limit_is_where_this_pin_cuts_the_flank(pin: float, polar: float) -> None:
    """Just below the limit the tooth can be made, just above it cannot, by undercut or by cusps."""
    tooth = SphereTooth(15, 14, math.radians(polar), math.radians(pin), math.radians(1.0), side=1)
    limit = nutation_limit(tooth)
    assert tooth.nutation < limit <= largest_nutation(tooth)
    assert not sphere_tooth_faults(replace(tooth, nutation=(1.0 - 1e-5) * limit))
    assert sphere_tooth_faults(replace(tooth, nutation=(1.0 + 1e-5) * limit))


@pytest.mark.property
@pytest.mark.parametrize("pins_on", ["ring", "satellite"])
@pytest.mark.parametrize("share", [0.0, 1e-14, 1e-12, 1e-10, 1e-9, 1e-8, 5e-8])
def test_a_nutation_within_rounding_of_its_range_is_out_of_it(share: float, pins_on: Carrier) -> None:
    """There the curvature of the path is 0/0; the refusal is that of the range."""
    thin = SphereTooth(15, 14, 1.2, 1e-4, 0.01, side=1, pins_on=pins_on)
    (fault,) = sphere_tooth_faults(replace(thin, nutation=(1.0 - share) * largest_nutation(thin)))
    assert "out of range" in fault


@pytest.mark.property
def test_a_pin_thinner_than_rounding_has_no_penetration() -> None:
    """The flank is then the path itself, found again within the root of rounding, which is where squares are flat."""
    assert -1e-7 < penetration(SphereTooth(15, 14, 1.2, 1e-300, 0.04, side=1)) < 1e-12
