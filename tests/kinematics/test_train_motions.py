"""Three ways to the speeds of a train agree exactly: constraint matrix, inverted motion, compound motion."""

from fractions import Fraction
from itertools import permutations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.train import Speeds, Train, khv_train, planetary_train, rv_train, speeds
from trochoid.kinematics.train_motions import (
    Motions,
    khv_compound,
    khv_inverted,
    planetary_compound,
    planetary_inverted,
    rv_compound,
    rv_inverted,
    superposed,
)

TEETH = st.integers(1, 400)
LENGTH = st.fractions(Fraction(1, 50), 50)
Choice = tuple[str, str, str]


def outcome(way: Train | Motions, choice: Choice) -> Speeds | str:
    """Speeds, or why there are none."""
    try:
        return speeds(way, *choice) if isinstance(way, Train) else superposed(way, *choice)
    except TrochoidError as error:
        return str(error)


def agree(train: Train, *ways: Motions) -> None:
    """Every ordered choice of three members: equal fractions, or the same refusal."""
    refused = 0
    for fixed, driving, driven in permutations(train.members, 3):
        expected = outcome(train, (fixed, driving, driven))
        for way in ways:
            assert outcome(way, (fixed, driving, driven)) == expected
        refused += isinstance(expected, str)
    assert refused < len(train.members) ** 3 / 4


@pytest.mark.independent
@given(lobes=TEETH, difference=st.integers(1, 5), eccentricity=LENGTH)
@settings(max_examples=40, deadline=None)
def test_khv(lobes: int, difference: int, eccentricity: Fraction) -> None:
    """K-H-V with any member fixed, driving, driven; the eccentricity drops out."""
    pins = lobes + difference
    agree(khv_train(pins, lobes), khv_inverted(pins, lobes), khv_compound(pins, lobes, eccentricity))


@pytest.mark.independent
@given(teeth=st.tuples(TEETH, TEETH, TEETH), difference=st.integers(1, 5), lengths=st.tuples(LENGTH, LENGTH))
@settings(max_examples=40, deadline=None)
def test_rv(teeth: tuple[int, int, int], difference: int, lengths: tuple[Fraction, Fraction]) -> None:
    """2K-V (sources §1) with any member fixed, driving, driven; eccentricity and module drop out."""
    sun, planet, lobes = teeth
    numbers = (sun, planet, lobes, lobes + difference)
    agree(rv_train(*numbers), rv_inverted(*numbers), rv_compound(*numbers, *lengths))


@pytest.mark.independent
@given(sun=TEETH, planet=TEETH, more=TEETH, distance=LENGTH)
@settings(max_examples=40, deadline=None)
def test_planetary(sun: int, planet: int, more: int, distance: Fraction) -> None:
    """2K-H with any member fixed, driving, driven, whether or not the reference circles fit."""
    numbers = (sun, planet, planet + more)
    agree(planetary_train(*numbers), planetary_inverted(*numbers), planetary_compound(*numbers, distance))


@pytest.mark.property
@given(teeth=st.tuples(TEETH, TEETH, TEETH), difference=st.integers(1, 5))
def test_swapping_the_fixed_member(teeth: tuple[int, int, int], difference: int) -> None:
    """i_ah with b fixed and i_ab with h fixed sum to 1; i_ab i_ba = 1; i_bh with a fixed = 1 − 1/i_ab."""
    sun, planet, lobes = teeth
    train = rv_train(sun, planet, lobes, lobes + difference)
    ring_fixed = speeds(train, "ring", "sun", "carrier").ratio
    carrier_fixed = speeds(train, "carrier", "sun", "ring").ratio
    assert ring_fixed + carrier_fixed == 1
    assert speeds(train, "carrier", "ring", "sun").ratio * carrier_fixed == 1
    assert speeds(train, "sun", "ring", "carrier").ratio == 1 - 1 / carrier_fixed
    assert speeds(train, "ring", "carrier", "sun").ratio * ring_fixed == 1


@pytest.mark.exact
def test_the_same_choices_are_refused() -> None:
    """All ways refuse with one message; the members named are the train's."""
    for way in (khv_train(20, 19), khv_inverted(20, 19), khv_compound(20, 19)):
        assert outcome(way, ("output", "disc", "ring")) == (
            "driving = disc stands still when output is fixed; choose another member"
        )
        assert "'rim' is no member of this train; its members are input, disc, ring, output" in str(
            outcome(way, ("rim", "input", "output"))
        )
