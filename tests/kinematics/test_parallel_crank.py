"""Output pins that carry, and discs that are one part, by counting."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.parallel_crank import (
    LoadedPins,
    distinct_discs,
    identical_disc_faults,
    loaded_at,
    loaded_output_pins,
    output_pin_forces,
)


@pytest.mark.published
@pytest.mark.parametrize(
    ("count", "found"), [(8, LoadedPins(4.0, 4, 4, 3, 8)), (7, LoadedPins(3.5, 3, 4, 3, 14))]
)
def test_loaded_output_pins_of_the_textbook(count: int, found: LoadedPins) -> None:
    """Sources §3: n/2 of an even number (n/2 − 1 at isolated instants), (n ± 1)/2 of an odd one."""
    assert loaded_output_pins(count) == found


@pytest.mark.exact
@pytest.mark.parametrize("count", range(3, 25))
def test_loaded_output_pins_over_the_turn(count: int) -> None:
    """By counting pins on the pushing side: times in 1/(4n) of a turn, with no rounding."""
    steps = 4 * count
    between = [loaded_at(count, Fraction(2 * k + 1, 2 * steps)) for k in range(steps)]
    at = [loaded_at(count, Fraction(k, steps)) for k in range(steps)]
    pins = loaded_output_pins(count)
    assert {pins.least, pins.most} == set(between)
    assert between.count(pins.least) == steps // len(set(between))  # half the time each, or always
    assert Fraction(sum(between), steps) == Fraction(pins.mean)
    in_line = [
        k
        for k in range(steps)
        if any((2 * (k * count + steps * j)) % (steps * count) == 0 for j in range(count))
    ]
    assert len(in_line) == pins.instants
    assert {at[k] for k in in_line} == {pins.in_line}


@pytest.mark.exact
@given(count=st.integers(3, 30), angle=st.floats(-7.0, 7.0))
def test_output_pin_forces(count: int, angle: float) -> None:
    """They make up the torque, only push, and are those that carry by the count."""
    force = output_pin_forces(206.0, 0.04, count, angle)
    gamma = angle + 2.0 * math.pi * np.arange(count) / count
    assert 0.04 * float(force @ np.sin(gamma)) == pytest.approx(206.0, rel=1e-12)
    assert force.min() >= 0.0
    pins = loaded_output_pins(count)
    carrying = int(np.count_nonzero(force > 1e-9 * force.max()))
    assert min(pins.least, pins.in_line) <= carrying <= pins.most


@pytest.mark.exact
@given(
    discs=st.integers(1, 4),
    lobes=st.integers(3, 60),
    difference=st.integers(1, 3),
    holes=st.integers(3, 16),
)
def test_distinct_discs_by_turning_them(discs: int, lobes: int, difference: int, holes: int) -> None:
    """Disc i is disc 0 if some whole number of lobes turns its holes onto the other's."""
    bodies: list[Fraction] = []
    for i in range(discs):
        lead = Fraction(i * difference, discs * lobes)
        if not any(
            ((lead - body - Fraction(turned, lobes)) * holes).denominator == 1
            for body in bodies
            for turned in range(lobes)
        ):
            bodies.append(lead)
    assert distinct_discs(discs, lobes + difference, lobes, holes) == len(bodies)


@pytest.mark.published
@given(discs=st.integers(2, 4), pins=st.integers(2, 30), holes=st.integers(2, 8))
def test_what_is_enough_for_identical_discs(discs: int, pins: int, holes: int) -> None:
    """Sources §3: n | z_p and n | z_w are enough, whatever the multiples."""
    assert distinct_discs(discs, discs * pins, discs * pins - 1, discs * holes) == 1


@pytest.mark.exact
@given(discs=st.integers(2, 4), lobes=st.integers(3, 60), holes=st.integers(3, 16))
def test_advice_for_identical_discs_works(discs: int, lobes: int, holes: int) -> None:
    """Each number that the sentence names makes the discs one part."""
    for fault in identical_disc_faults(discs, lobes + 1, lobes, holes):
        advice = fault.split("; take ")[1]
        less, fewer = advice.split(" holes, or ")
        for number in map(int, less.split(" or ")):
            assert not identical_disc_faults(discs, lobes + 1, lobes, number)
        assert not identical_disc_faults(int(fewer.split()[0]), lobes + 1, lobes, holes)


@pytest.mark.exact
def test_two_pins_are_refused() -> None:
    """In line with the eccentricity neither of two could carry."""
    with pytest.raises(Infeasible, match="2 output pins: at least 3 are needed"):
        loaded_output_pins(2)
