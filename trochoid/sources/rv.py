"""Sources §1: speeds of the 2K-V drive.  The text has formulas only; the numbers are those for 12/36/39/40."""

from __future__ import annotations

from fractions import Fraction

from trochoid.kinematics.train import Speeds, rv_train, speeds
from trochoid.kinematics.train_motions import rv_compound, rv_inverted, superposed
from trochoid.sources.row import Erratum, Row, Source

TESTS = "tests/published/test_sources_rv.py"
A, G, F, B = TEETH = (12, 36, 39, 40)  # sun, planet, disc, pins
MODULE, E = Fraction(3, 2), Fraction(13, 10)  # mm; no speed depends on them, misprinted ones do
R_A, R_G = MODULE * A / 2, MODULE * G / 2
R_B = E * B / (B - F)
R_F, ARM = R_B - E, R_A + R_G


def _turning() -> Speeds:
    return speeds(rv_train(*TEETH), "ring", "sun", "carrier")


def _three_ways(fixed: str, driving: str, driven: str) -> tuple[Fraction, ...]:
    """Ratio by the constraint matrix, by inverted motion, by velocities of a compound motion."""
    motions = (rv_inverted(*TEETH), rv_compound(*TEETH, E, MODULE))
    made = [speeds(rv_train(*TEETH), fixed, driving, driven)]
    made += [superposed(each, fixed, driving, driven) for each in motions]
    return tuple(each.ratio for each in made)


def _from_disc_and_carrier() -> tuple[Fraction, ...]:
    turn = _turning()
    return tuple(turn.relative("planet", at) / turn.relative("ring", at) for at in ("carrier", "disc"))


def _ratio(fast: Fraction) -> Fraction:
    """(6) solved for ω_a/ω_h with ω_g/ω_a = fast."""
    return ARM / (R_A - R_G * fast)


def _with_slip_radius(radius: Fraction) -> Fraction:
    """ω_a/ω_h of (6)–(8) with this radius in V_P1^(r)."""
    return (ARM + R_F / E * radius) / R_A


def _planet_formula(one: Fraction, two: Fraction) -> Fraction:
    return R_A * (one + two) / ((one + two) * R_G + (two - one) * E)


def _carrier_formula(factor: Fraction) -> Fraction:
    return R_A * factor * E / (R_F * R_G + ARM * E)


ROWS = (
    Row(
        "(5)",
        "ratio, ring fixed",
        ("121",),
        lambda: _three_ways("ring", "sun", "carrier"),
        f"{TESTS}::test_ratios_of_the_example",
        note="by matrix, inverted motion, compound motion alike",
    ),
    Row(
        "(2)",
        "ratio, carrier fixed",
        ("−120",),
        lambda: _three_ways("carrier", "sun", "ring"),
        f"{TESTS}::test_ratios_of_the_example",
        note="three ways alike",
    ),
    Row(
        "check value",
        "ratio, sun fixed",
        ("121/120",),
        lambda: _three_ways("sun", "ring", "carrier"),
        f"{TESTS}::test_ratios_of_the_example",
        note="three ways alike",
    ),
    Row(
        "(3)",
        "ring pins over their excess, `z_b/(z_b − z_f)`: crank to ring seen from carrier and from disc",
        ("40",),
        _from_disc_and_carrier,
        f"{TESTS}::test_inverted_train",
    ),
    Row(
        "(2)",
        "sun to planet seen from the carrier, `−z_g/z_a`",
        ("−3",),
        lambda: (_turning().relative("sun", "carrier") / _turning().relative("planet", "carrier"),),
        f"{TESTS}::test_inverted_train",
    ),
    Row(
        "(4)",
        "ring to disc seen from the crank, `z_f/z_b`",
        ("39/40",),
        lambda: (_turning().relative("ring", "planet") / _turning().relative("disc", "planet"),),
        f"{TESTS}::test_inverted_train",
    ),
    Row(
        "after (8)",
        "planet over sun, `z_a z_f/(z_g z_f + (z_a + z_g)(z_b − z_f))`, against it",
        ("39/121",),
        lambda: (-_turning().members["planet"],),
        f"{TESTS}::test_formulas",
    ),
    Row(
        "after (8)",
        "carrier and disc over sun, `z_a (z_b − z_f)/(…)`",
        ("1/121",),
        lambda: (_turning().members["carrier"], _turning().members["disc"]),
        f"{TESTS}::test_formulas",
    ),
)

ERRATA = (
    Erratum(
        "before (6)",
        "velocity of the pitch point relative to the planet's centre `ω_g e`",
        "`ω_g r_g`, as (6) has it",
        f"{TESTS}::test_relative_velocity_at_the_pitch_point",
        "ratio by (6) to (8)",
        lambda: (float(_with_slip_radius(E)), _with_slip_radius(R_G)),
    ),
    Erratum(
        "after (8)",
        "`r_a`, `r_b` of sun and pins in the formula of `ω_g`",
        "`r_A = r_f − L`, `r_B = r_f + L`, `L = r_a + r_g`",
        f"{TESTS}::test_radii_of_the_planet_speed",
        "ratio by (6)",
        lambda: (float(_ratio(_planet_formula(R_A, R_B))), _ratio(_planet_formula(R_F - ARM, R_F + ARM))),
    ),
    Erratum(
        "after (8)",
        "a factor `r_a + r_g` in the formula of `ω_h`: the ratio changes with the unit of length",
        "`ω_a r_a e/(r_f r_g + (r_a + r_g) e)`",
        f"{TESTS}::test_spurious_factor_of_the_carrier_speed",
        "`ω_h/ω_a`, lengths in mm",
        lambda: (_carrier_formula(ARM), _carrier_formula(Fraction(1))),
    ),
    Erratum(
        "before (3)",
        "`ω_f^b = ω_b^b − ω_f^b`, which would stop the disc",
        "the left side is `ω_b^f`",
        f"{TESTS}::test_name_of_the_ring_speed_seen_from_the_disc",
        "disc over sun",
        lambda: (_turning().members["ring"] / 2, _turning().members["disc"]),
    ),
    Erratum(
        "(6)–(8)",
        "no word on signs: `ω_g` algebraic, as in (1) to (5)",
        "(6) to (8) count `ω_g` against `ω_a` and `ω_h`",
        f"{TESTS}::test_sign_of_the_planet_speed",
        "right side of (6) over its left side",
        lambda: (float(_right_side_of_6(1)), _right_side_of_6(-1)),
    ),
)


def _right_side_of_6(sign: int) -> Fraction:
    turn = _turning().members
    return (ARM * turn["carrier"] + sign * R_G * turn["planet"]) / R_A


SOURCE = Source(
    1,
    "Kinematics of the 2K-V drive",
    "L. P. Senchurin, *On the kinematics of the planetary 2K-V drive* (in Russian), 2019, doi 10.5862/TMM.44.1",
    "Letters as there: sun a, planet g, disc f, pins b, carrier h. The text has formulas and no example; "
    "their numbers are for teeth 12/36/39/40. For other numbers the formulas are compared with the "
    "constraint matrix in `tests/published/test_sources_rv.py::test_formulas`.",
    ROWS,
    ERRATA,
)
