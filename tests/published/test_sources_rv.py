"""Numbers and errata of the text on the kinematics of the 2K-V drive (Senchurin 2019; sources §1)."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from trochoid.kinematics.train import Speeds, rv_train, speeds
from trochoid.kinematics.train_motions import Motions, rv_compound, rv_inverted, superposed

A, G, F, B = NUMBERS = (12, 36, 39, 40)  # sun, planet, disc, pins
MODULE, E = Fraction(3, 2), Fraction(13, 10)  # mm; the ratios need neither
R_A, R_G = MODULE * A / 2, MODULE * G / 2
R_B = E * B / (B - F)
R_F = R_B - E
ARM = R_A + R_G  # L, sun to crank
END_A, END_B = R_F - ARM, R_F + ARM  # r_A, r_B: from the pitch point P2 to the crank ends A and B
RING_FIXED = ("ring", "sun", "carrier")


def member_speeds(choice: tuple[str, str, str] = RING_FIXED) -> tuple[Fraction, Fraction, Fraction]:
    """Speeds of planet, disc and carrier over the driving one's."""
    turn = speeds(rv_train(*NUMBERS), *choice).members
    return turn["planet"], turn["disc"], turn["carrier"]


# numbers ----------------------------------------------------------------------------------------------------


@pytest.mark.published
@pytest.mark.parametrize(
    ("choice", "ratio"),
    [
        (("ring", "sun", "carrier"), Fraction(121)),
        (("carrier", "sun", "ring"), Fraction(-120)),
        (("sun", "ring", "carrier"), Fraction(121, 120)),
    ],
)
@pytest.mark.parametrize("way", [None, rv_inverted(*NUMBERS), rv_compound(*NUMBERS, E, MODULE)])
def test_ratios_of_the_example(way: Motions | None, choice: tuple[str, str, str], ratio: Fraction) -> None:
    """Example 12/36/39/40: 121 by (5), −120 by (2), 121/120, each way."""
    found: Speeds = superposed(way, *choice) if way else speeds(rv_train(*NUMBERS), *choice)
    assert found.ratio == ratio


@pytest.mark.published
@given(a=st.integers(1, 99), g=st.integers(1, 99), f=st.integers(1, 99), more=st.integers(1, 3))
def test_formulas(a: int, g: int, f: int, more: int) -> None:
    """(2), (5), i_bh, and the speeds in tooth numbers over D = z_g z_f + (z_a + z_g)(z_b − z_f), any numbers."""
    b = f + more
    train = rv_train(a, g, f, b)
    turn = speeds(train, *RING_FIXED)
    d = g * f + (a + g) * (b - f)
    assert turn.members["planet"] == -Fraction(a * f, d)  # printed as its amount
    assert turn.members["carrier"] == turn.members["disc"] == Fraction(a * (b - f), d)
    assert turn.ratio == Fraction(d, a * (b - f)) == 1 + Fraction(g * b, a * (b - f))
    assert speeds(train, "carrier", "sun", "ring").ratio == -Fraction(g, a) * Fraction(b, b - f)
    assert speeds(train, "sun", "ring", "carrier").ratio == 1 + Fraction(a * (b - f), g * b)


@pytest.mark.published
def test_inverted_train() -> None:
    """i_eb seen from the carrier and from the disc are equal, (3): r_b/e = z_b/(z_b − z_f) = 40; i_ag is −3."""
    turn = speeds(rv_train(*NUMBERS), *RING_FIXED)
    for seen_from in ("carrier", "disc"):
        assert turn.relative("planet", seen_from) / turn.relative("ring", seen_from) == R_B / E == 40
    assert turn.relative("sun", "carrier") / turn.relative("planet", "carrier") == -3
    assert turn.relative("disc", "carrier") == 0
    # (4): i_bf seen from the crank is z_f/z_b
    assert turn.relative("ring", "planet") / turn.relative("disc", "planet") == Fraction(F, B)


# errata -----------------------------------------------------------------------------------------------------


@pytest.mark.published
def test_relative_velocity_at_the_pitch_point() -> None:
    """Erratum (1): V_P1^(r) = ω_g e as printed makes the ratio 9.63; right is ω_g r_g, as (6) has it: 121."""
    planet, _, carrier = member_speeds()
    against = -planet  # (6) to (8) count ω_g against ω_a
    assert ARM * carrier + against * R_G == R_A
    assert ARM * carrier + against * E != R_A
    crank = R_F / E  # ω_g/ω_h by (7) + (8)
    right, printed = ((ARM + crank * radius) / R_A for radius in (R_G, E))
    assert right == 121
    assert printed == Fraction(289, 30)


@pytest.mark.published
def test_radii_of_the_planet_speed() -> None:
    """Erratum (2): r_a, r_b in the formula of ω_g are r_A = r_f − L and r_B = r_f + L, not those of sun and pins.

    Those make the ratio, by (6), depend on the lengths; with the ones above it is 121.9.
    """
    planet, _, _ = member_speeds()

    def formula(one: Fraction, two: Fraction) -> Fraction:
        return R_A * (one + two) / ((one + two) * R_G + (two - one) * E)

    assert formula(END_A, END_B) == -planet == Fraction(A * F, G * F + (A + G) * (B - F))
    right, printed = (ARM / (R_A - R_G * formula(*radii)) for radii in ((END_A, END_B), (R_A, R_B)))
    assert right == 121
    assert float(printed) == pytest.approx(121.854, abs=1e-3)


@pytest.mark.published
@pytest.mark.parametrize("unit", [Fraction(1), Fraction(1, 1000)])
def test_spurious_factor_of_the_carrier_speed(unit: Fraction) -> None:
    """Erratum (3): ω_h has a factor (r_a + r_g) too many; the printed ratio even changes with the unit of length."""
    a, g, f, e = (unit * length for length in (R_A, R_G, R_F, E))
    right = a * e / (f * g + (a + g) * e)
    printed = a * (a + g) * e / (f * g + (a + g) * e)
    assert right == member_speeds()[2] == Fraction(1, 121)
    assert printed == right * unit * 36 != right


@pytest.mark.published
def test_name_of_the_ring_speed_seen_from_the_disc() -> None:
    """Erratum (4): ω_f^b = ω_b^b − ω_f^b would stop the disc; the left side is ω_b^f = −ω_f^b."""
    turn = speeds(rv_train(*NUMBERS), *RING_FIXED)
    ring, disc = turn.members["ring"], turn.members["disc"]
    assert ring == 0
    assert turn.relative("ring", "disc") == ring - disc
    assert disc != ring - disc


@pytest.mark.published
def test_sign_of_the_planet_speed() -> None:
    """Erratum (5): (6) to (8) hold with ω_g counted against ω_a and ω_h, undeclared; (1) to (5) are algebraic."""
    planet, disc, carrier = member_speeds()

    def hold(fast: Fraction) -> list[bool]:
        return [
            ARM * carrier + R_G * fast == R_A,  # (6)
            disc * END_A == -ARM * carrier + E * fast,  # (7)
            disc * END_B == ARM * carrier + E * fast,  # (8)
        ]

    assert hold(-planet) == [True] * 3
    assert hold(planet) == [False] * 3
    assert (1 - carrier) / (planet - carrier) == -Fraction(G, A)  # (2), algebraic
    assert (1 - carrier) / (-planet - carrier) != -Fraction(G, A)


@pytest.mark.published
def test_ratio_of_the_textbook() -> None:
    """Sources §3 prints 1 + z2 z3/(z1 (z4 − z3)) = 118: against (5), 121, and no other fixed member agrees with it."""
    printed = 1 + Fraction(G * F, A * (B - F))
    train = rv_train(*NUMBERS)
    assert printed == 118 != speeds(train, *RING_FIXED).ratio == 121
    assert printed + speeds(train, "carrier", "sun", "ring").ratio == -2  # must be 1 for any train
