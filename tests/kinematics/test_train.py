"""Speeds of gear trains: the constraint matrix against inverted motion and velocities of points."""

from collections.abc import Callable
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.train import (
    FRAME,
    EqualTurning,
    Pair,
    Pivot,
    Rolling,
    Train,
    khv_train,
    planetary_train,
    rv_train,
    speeds,
)

MEMBERS = ("input", "ring", "output")
CHOICES = [(a, b, c) for a in MEMBERS for b in MEMBERS for c in MEMBERS if len({a, b, c}) == 3]


@pytest.mark.published
def test_khv_ratio_of_the_textbook() -> None:
    """Sources §3: u = −z1/(z2 − z1) with the ring fixed: −19 for 19 lobes on 20 pins."""
    result = speeds(khv_train(20, 19))
    assert result.ratio == -19
    assert result.members["disc"] == result.members["output"] == Fraction(-1, 19)
    assert result.relative("disc", "input") == Fraction(-20, 19)


@pytest.mark.published
def test_ring_output_ratio() -> None:
    """With the output fixed the ring turns with the crank, 20 times slower (u + ring ratio = 1)."""
    assert speeds(khv_train(20, 19), fixed="output", driven="ring").ratio == 20


@pytest.mark.independent
@given(lobes=st.integers(1, 300), difference=st.integers(1, 4), choice=st.sampled_from(CHOICES))
def test_khv_speeds_by_inverted_motion(lobes: int, difference: int, choice: tuple[str, str, str]) -> None:
    """Willis: seen from the crank, disc and ring are an internal pair: z_c ω_c = z_p ω_p."""
    fixed, driving, driven = choice
    pins = lobes + difference
    result = speeds(khv_train(pins, lobes), fixed, driving, driven)
    assert result.members[fixed] == 0
    assert result.members[driving] == 1
    assert result.members["disc"] == result.members["output"]
    assert lobes * result.relative("disc", "input") == pins * result.relative("ring", "input")
    assert result.ratio * result.members[driven] == 1


@pytest.mark.independent
@given(lobes=st.integers(1, 300), difference=st.integers(1, 4))
def test_khv_speed_by_the_velocity_of_the_pitch_point(lobes: int, difference: int) -> None:
    """Ring fixed: the disc's centre moves at e ω and its pitch point, r_c away, rests: ω_c = −e ω/r_c."""
    pitch_radius = Fraction(lobes, difference)  # in units of e
    assert speeds(khv_train(lobes + difference, lobes)).members["disc"] == -1 / pitch_radius


@pytest.mark.published
def test_the_general_train_gives_the_rv_ratios_of_the_source() -> None:
    """Sources §1, example 12/36/39/40: 121, −120, 121/120 with ring, carrier, sun fixed."""
    train = rv_train(12, 36, 39, 40)
    assert speeds(train, "ring", "sun", "carrier").ratio == 121
    assert speeds(train, "carrier", "sun", "ring").ratio == -120
    assert speeds(train, "sun", "ring", "carrier").ratio == Fraction(121, 120)


@pytest.mark.exact
def test_the_general_train_gives_the_rv_speeds_of_the_source() -> None:
    """Sources §1: with D = z_g z_f + (z_a + z_g)(z_b − z_f), ω_g = −z_a z_f/D, ω_h = z_a (z_b − z_f)/D."""
    a, g, f, b = 14, 42, 29, 30
    d = g * f + (a + g) * (b - f)
    members = speeds(rv_train(a, g, f, b), "ring", "sun", "carrier").members
    assert members["planet"] == Fraction(-a * f, d)
    assert members["carrier"] == members["disc"] == Fraction(a * (b - f), d)


@pytest.mark.exact
def test_a_simple_planetary_set() -> None:
    """1 + z_ring/z_sun with the ring fixed, −z_ring/z_sun with the carrier fixed."""
    train = planetary_train(20, 30, 80)
    assert speeds(train, "ring", "sun", "carrier").ratio == 5
    assert speeds(train, "carrier", "sun", "ring").ratio == -4


@pytest.mark.independent
@given(teeth=st.tuples(*[st.integers(5, 90)] * 3), difference=st.integers(1, 3), arm=st.fractions(2, 9))
@settings(max_examples=40, deadline=None)
def test_two_cranks_make_the_disc_turn_with_the_carrier(
    teeth: tuple[int, int, int], difference: int, arm: Fraction
) -> None:
    """Revolutes and rolling pairs alone: with crankshafts on both sides of the sun no coupling need be assumed."""
    sun, planet, lobes = teeth
    pins = lobes + difference
    first = arm * sun / (sun + planet)
    pairs: tuple[Pair, ...] = (
        *(Pivot(FRAME, member) for member in ("sun", "ring", "carrier")),
        *(Pivot("carrier", name, side * arm) for name, side in (("planet", 1), ("opposite", -1))),
        *(Rolling("sun", name, side * first) for name, side in (("planet", 1), ("opposite", -1))),
        *(Pivot(name, "disc", side * arm + 1) for name, side in (("planet", 1), ("opposite", -1))),
        Rolling("disc", "ring", Fraction(pins, difference)),
    )
    real = Train(("sun", "planet", "opposite", "disc", "ring", "carrier"), pairs)
    for choice in (("ring", "sun", "carrier"), ("carrier", "sun", "ring"), ("sun", "planet", "disc")):
        found = speeds(real, *choice)
        assert found.members["planet"] == found.members["opposite"]
        simple = speeds(rv_train(sun, planet, lobes, pins), *choice)
        assert found.ratio == simple.ratio
        assert all(found.members[member] == turn for member, turn in simple.members.items())


@pytest.mark.exact
@given(teeth=st.tuples(*[st.integers(9, 90)] * 4), rings=st.tuples(*[st.integers(1, 90)] * 2))
def test_stepped_planets_and_two_rings(teeth: tuple[int, int, int, int], rings: tuple[int, int]) -> None:
    """Wolfrom's 3K set: i = (1 + z_b/z_a)/(1 − z_b z_f/(z_g z_e)) from sun to second ring, first ring fixed."""
    a, g, f, _ = teeth
    b, e = g + rings[0], f + rings[1]
    pairs: tuple[Pair, ...] = (
        *(Pivot(FRAME, member) for member in ("sun", "ring", "second", "carrier")),
        Pivot("carrier", "planet", Fraction(1)),
        Rolling("sun", "planet", Fraction(a, a + g)),
        Rolling("planet", "ring", Fraction(b, b - g)),
        Rolling("planet", "second", Fraction(e, e - f)),
    )
    train = Train(("sun", "planet", "ring", "second", "carrier"), pairs)
    assert speeds(train, "ring", "sun", "carrier").ratio == 1 + Fraction(b, a)
    slip = 1 - Fraction(b * f, g * e)
    if slip == 0:
        with pytest.raises(TrochoidError, match="driven = second stands still"):
            speeds(train, "ring", "sun", "second")
    else:
        assert speeds(train, "ring", "sun", "second").ratio == (1 + Fraction(b, a)) / slip


@pytest.mark.exact
@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: khv_train(20, 20), "take lobes = 19 or less, or pins = 21 or more"),
        (lambda: rv_train(12, 36, 40, 39), "take lobes = 38 or less, or pins = 41 or more"),
        (lambda: rv_train(0, 36, 39, 40), "sun = 0: a wheel has at least 1 tooth"),
        (lambda: rv_train(12, 36, 1, 1), "needs fewer teeth; take pins = 2 or more"),
        (lambda: planetary_train(20, 30, 30), "take planet = 29 or less, or ring = 31 or more"),
        (lambda: planetary_train(20, -1, 30), "planet = -1: a wheel has at least 1 tooth"),
    ],
)
def test_teeth_that_make_no_train_are_refused(make: Callable[[], Train], message: str) -> None:
    """The message names the nearest numbers that do."""
    with pytest.raises(Infeasible, match=message):
        make()


@pytest.mark.exact
@pytest.mark.parametrize(
    ("choice", "message"),
    [
        (("ring", "input", "ring"), "three different members"),
        (
            ("rim", "input", "output"),
            "'rim' is no member of this train; its members are input, disc, ring, output",
        ),
        (("output", "disc", "ring"), "driving = disc stands still when output is fixed"),
        (("output", "input", "disc"), "driven = disc stands still when output is fixed"),
    ],
)
def test_choices_that_cannot_work_are_refused(choice: tuple[str, str, str], message: str) -> None:
    """The message says which member and what else there is."""
    with pytest.raises(TrochoidError, match=message):
        speeds(khv_train(20, 19), *choice)


@pytest.mark.exact
def test_locked_and_loose_trains_are_refused() -> None:
    """A second coupling locks the drive; without the mesh two freedoms are left."""
    khv = khv_train(20, 19)
    locked = Train(khv.members, (*khv.pairs, EqualTurning("disc", "ring")))
    with pytest.raises(TrochoidError, match="fixing ring locks the train"):
        speeds(locked)
    loose = Train(khv.members, tuple(pair for pair in khv.pairs if not isinstance(pair, Rolling)))
    with pytest.raises(TrochoidError, match="fixing ring leaves 2 freedoms"):
        speeds(loose)
