"""Sources §4: the 65 numbers of Table 1, the blocking contours, and every erratum with the printed form failing."""

from __future__ import annotations

import math
from dataclasses import replace
from decimal import ROUND_DOWN, ROUND_HALF_UP, Decimal

import numpy as np
import pytest

from trochoid.geometry.blocking import inner_plane, outer_plane
from trochoid.geometry.blocking_line import coaxial_line
from trochoid.geometry.planetary import PlanetarySet, planetary
from trochoid.geometry.planetary_quality import Limits, least_margin, quality
from trochoid.geometry.planetary_table import Table, table
from trochoid.kinematics.involute import inverse_involute, involute
from trochoid.kinematics.involute_measure import degrees
from trochoid.kinematics.shaper import Shaper

SOURCE = PlanetarySet((20, 30, 80), 2e-3, 52e-3, (0.5, 0.634, 1.768), Shaper(25, 0.15, 55.6e-3), planets=4)
ROLLER = 3.464e-3
SUMS = (1.134, 1.134)
PRINTED: Table = table(planetary(SOURCE), ROLLER, printed=True)
RIGHT: Table = table(planetary(SOURCE), ROLLER)

LENGTHS = {  # mm: sun, planet, ring
    "reference_diameter": ("40.000", "60.000", "160.000"),
    "tip_diameter": ("45.464", "66.000", "162.652"),
    "root_diameter": ("37.000", "57.536", "171.159"),
    "pitch_diameter": ("41.600", "62.400", "166.400"),
    "chord": ("3.417", "3.589", "5.047"),
    "chord_height": ("2.110", "2.347", "-2.244"),
    "rho_s": ("8.658", "12.170", "24.676"),
    "rho_p": ("5.126", "9.493", "39.588"),
    "span": ("16.005", "28.277", "72.559"),
    "rho_w": ("8.002", "14.138", "36.279"),
    "rho_a": ("12.788", "17.155", "31.025"),
    "roller_circle": ("42.864", "63.412", "165.034"),
    "rho_m": ("8.569", "12.778", "35.757"),
    "over_rollers": ("46.328", "66.876", "161.570"),
    "thickness": ("3.870", "4.065", "0.568"),
    "rho_l": ("3.917", "8.120", "40.697"),
    "tip_thickness": ("1.304", "1.372", "1.616"),
}
NUMBERS = {
    "span_teeth": ("3", "5", "12"),
    "least_shift": ("-0.170", "-0.755"),
    "contact_ratios": ("1.298", "1.450"),
}
ANGLES = {"roller_angle": ((28, 43, 40), (27, 14, 9), (24, 21, 6))}  # truncated
WHEELS = ("sun", "planet", "ring")


def digits(value: float, printed: str, rounding: str = ROUND_HALF_UP) -> str:
    """The value with as many decimals as printed; binary noise below 1e-9 is taken off first."""
    return str(Decimal(f"{value:.9f}").quantize(Decimal(printed), rounding))


@pytest.mark.published
@pytest.mark.parametrize(
    ("name", "wheel", "printed"),
    [(name, k, p) for name, row in (LENGTHS | NUMBERS).items() for k, p in enumerate(row)],
)
def test_table_1_by_rounding(name: str, wheel: int, printed: str) -> None:
    """Sources §4 Table 1: 51 lengths in mm, 7 numbers; with the source's planet tip and ring chord."""
    value = getattr(PRINTED, name)[wheel] * (1e3 if name in LENGTHS else 1.0)
    assert digits(value, printed) == printed


@pytest.mark.published
def test_table_1_angle_ratio_and_roller() -> None:
    """α_w = 25°22'16", u_12 = 1.50, D_r = 3.4640 mm, by rounding (the roller is 1.732 m)."""
    assert degrees(PRINTED.operating_angle) == (25, 22, 16)
    assert digits(PRINTED.ratios[0], "1.50") == "1.50"
    assert digits(1e3 * PRINTED.roller, "3.4640") == "3.4640"
    assert PRINTED.roller == pytest.approx(1.732 * SOURCE.module, rel=1e-12)


@pytest.mark.published
@pytest.mark.parametrize("wheel", range(3))
def test_table_1_roller_angles_by_truncation(wheel: int) -> None:
    """The three roller angles have their seconds cut off; rounded they would be 41, 10 and 7."""
    d, m, s = ANGLES["roller_angle"][wheel]
    seconds = math.degrees(PRINTED.roller_angle[wheel]) * 3600.0
    assert math.floor(seconds) == 3600 * d + 60 * m + s
    assert degrees(PRINTED.roller_angle[wheel]) == (d, m, s + 1)


@pytest.mark.published
def test_table_1_ring_ratio_by_truncation() -> None:
    """u_23 = 2.666 is 80/30 with its digits cut off."""
    assert digits(PRINTED.ratios[1], "2.666", ROUND_DOWN) == "2.666"
    assert digits(PRINTED.ratios[1], "2.666") == "2.667"


@pytest.mark.published
def test_table_1_has_65_numbers() -> None:
    """17 rows of three lengths, the teeth of the spans, x_min, ε; u, α_w, D_r, three roller angles."""
    count = sum(len(row) for row in (LENGTHS | NUMBERS | ANGLES).values())
    assert count + 2 + 1 + 1 == 65


# errata -----------------------------------------------------------------------------------------------------


@pytest.mark.published
def test_the_planet_has_one_tip_circle() -> None:
    """Erratum: ε_23 and ρ_p3 are printed for a planet tip of 66.159; the drawn one, 66.000, gives others."""
    set_ = planetary(SOURCE)
    assert digits(2e3 * set_.planet_tip_for_ring, "66.159") == "66.159"
    assert digits(2e3 * set_.tips[1], "66.000") == "66.000"
    assert digits(RIGHT.contact_ratios[1], "1.4244") == "1.4244"
    assert digits(RIGHT.contact_ratios[1], "1.450") != "1.450"
    assert digits(1e3 * RIGHT.rho_p[2], "39.4356") == "39.4356"
    assert digits(1e3 * RIGHT.rho_p[2], "39.588") != "39.588"


@pytest.mark.published
def test_constant_chord_of_the_ring_needs_minus_x() -> None:
    """Erratum: +x gives the chord of the space; right is 0.5012, height −1.4172, ρ_s 27.0949 mm.

    The chord of the tooth even lies off it: ρ_s is inside the tip's and beyond the tooth's thickness at d.
    """
    for name, right in (("chord", "0.5012"), ("chord_height", "-1.4172"), ("rho_s", "27.0949")):
        assert digits(1e3 * getattr(RIGHT, name)[2], right) == right
        assert digits(1e3 * getattr(RIGHT, name)[2], LENGTHS[name][2]) != LENGTHS[name][2]
    assert RIGHT.rho_s[2] < RIGHT.rho_a[2]  # nearer to the centre than the tip: off the tooth
    assert PRINTED.chord[2] > 8.0 * PRINTED.thickness[2]  # a chord wider than the tooth that it spans


@pytest.mark.published
@pytest.mark.parametrize(
    ("printed", "low", "high"),
    [
        ("R_os > R_op", "rho_s", "rho_p"),
        ("R_ow < R_oa", "rho_a", "rho_w"),
        ("R_om < R_oa", "rho_a", "rho_m"),
        ("R_ol < R_op", "rho_p", "rho_l"),
    ],
)
def test_conditions_of_the_ring_are_printed_the_wrong_way_round(printed: str, low: str, high: str) -> None:
    """Erratum: "fulfilled" is printed for all three wheels; for the ring the printed inequality is false."""
    ring = {name: getattr(PRINTED, name)[2] for name in (low, high)}
    assert ring[low] < ring[high], printed
    for wheel in (0, 1):  # as printed it holds for sun and planet
        assert getattr(PRINTED, low)[wheel] > getattr(PRINTED, high)[wheel], printed


@pytest.mark.published
def test_rollers_reach_beyond_the_tips_and_stay_off_the_roots() -> None:
    """Erratum: "D_d − D_r < D_f" is false for sun and planet; it is >, and for the ring D_d + D_r < D_f."""
    circle, root, tip = (
        np.array(getattr(PRINTED, n)) for n in ("roller_circle", "root_diameter", "tip_diameter")
    )
    assert not np.any(circle[:2] - ROLLER < root[:2])
    assert np.all(circle[:2] - ROLLER > root[:2])
    assert circle[2] + ROLLER < root[2]
    assert np.all(circle[:2] + ROLLER > tip[:2])
    assert circle[2] - ROLLER < tip[2]


@pytest.mark.published
def test_shift_ranges_are_coefficients_not_millimetres() -> None:
    """Erratum: the ranges of x are printed in mm; as lengths (x/m) the ends would not be where anything binds."""
    line = coaxial_line(SOURCE, SUMS)
    assert line.stretches[0].low == pytest.approx(-0.0961, abs=5e-5)
    as_length = planetary(SOURCE, line.shifts(-0.0961e-3 / SOURCE.module))
    assert quality(as_length)["ring tip in planet fillet"].margin > 1e-5


@pytest.mark.published
def test_largest_operating_angle_is_no_aim_once_the_distance_is_given() -> None:
    """Erratum: α_w follows from a_w alone and is the same all along the line."""
    line = coaxial_line(SOURCE, SUMS)
    angles = planetary(SOURCE, line.shifts(np.linspace(-0.09, 1.19, 50))).outer.operating_angle
    assert np.ptp(angles) == 0.0


@pytest.mark.published
def test_lower_end_of_the_line() -> None:
    """Sources §4: x1 = −0.0961, x2 = 1.2301, x3 = 2.3641, bound by the ring's tip in the planet's fillet."""
    line = coaxial_line(SOURCE, SUMS)
    (stretch,) = line.stretches
    assert line.shifts(stretch.low) == pytest.approx((-0.0961, 1.2301, 2.3641), abs=5e-5)
    assert stretch.low_condition == "ring tip in planet fillet"


@pytest.mark.published
def test_upper_end_of_the_line_is_beyond_the_printed_one() -> None:
    """Erratum: 1.15/−0.016/1.118 binds nothing; the end is 1.1957/−0.0617/1.0723, planet tip in sun fillet."""
    line = coaxial_line(SOURCE, SUMS)
    (stretch,) = line.stretches
    assert line.shifts(stretch.high) == pytest.approx((1.1957, -0.0617, 1.0723), abs=5e-5)
    assert stretch.high_condition == "planet tip in sun fillet"
    printed = quality(planetary(SOURCE, (1.15, -0.016, 1.118)))
    assert not printed.failed
    required = [c for c in printed.conditions if c.required and "root" not in c.name]
    assert min(float(c.margin) / (SOURCE.module if c.unit == "m" else 1.0) for c in required) > 0.015


@pytest.mark.published
def test_tip_limit_means_millimetres() -> None:
    """Erratum: s_a ≥ 0.4 must mean 0.4 mm; 0.4 modules would end the line at 0.954, below the printed 1.15."""
    (stretch,) = coaxial_line(SOURCE, SUMS, Limits(tip_thickness=0.4 * SOURCE.module)).stretches
    assert stretch.high == pytest.approx(0.954, abs=5e-4)
    assert stretch.high_condition == "pointed tip of the sun"


@pytest.mark.published
def test_contact_ratio_of_1_4_cannot_hold_for_the_outer_mesh() -> None:
    """Erratum: ε ≥ 1.4 is asked for; on the line ε_12 is at most 1.303."""
    line = coaxial_line(SOURCE, SUMS)
    x1 = np.linspace(line.stretches[0].low, line.stretches[0].high, 20001)
    set_ = planetary(SOURCE, line.shifts(x1))
    assert np.max(set_.outer.contact_ratio(*set_.tips[:2])) == pytest.approx(1.303, abs=5e-4)
    assert coaxial_line(SOURCE, SUMS, Limits(contact_ratio=1.4)).stretches == ()


@pytest.mark.published
def test_indices_of_the_inner_pair() -> None:
    """Erratum: a_w has (z2 − z1) and x_d = x2 − x1 for planet and ring; 10.4 mm and 0.134 for 52 mm and 1.134."""
    inner = planetary(SOURCE).inner
    z1, z2, z3 = SOURCE.teeth
    x1, x2, x3 = SOURCE.shifts

    def distance(teeth: int) -> float:
        return 0.5 * SOURCE.module * teeth * math.cos(SOURCE.pressure_angle) / math.cos(angle)

    # the pressure angle that the shifts ask for, without play: inv α_w = inv α + 2 x_d tan α/z_d
    def asked(shift: float, teeth: int) -> float:
        tangent = math.tan(SOURCE.pressure_angle)
        return float(inverse_involute(float(involute(SOURCE.pressure_angle)) + 2.0 * shift * tangent / teeth))

    angle = asked(x3 - x2, z3 - z2)
    assert distance(z3 - z2) == pytest.approx(52e-3, abs=1e-6)
    assert distance(z2 - z1) == pytest.approx(10.4e-3, abs=1e-6)
    assert angle == pytest.approx(float(inner.operating_angle), abs=1e-4)
    angle = asked(x2 - x1, z3 - z2)
    assert distance(z3 - z2) < 50.3e-3


@pytest.mark.published
def test_claims_that_are_right() -> None:
    """Table 1, "fulfilled": R_ol > 0 for all three, x > x_min for sun and planet; x_min = 1 − (z/2) sin²α."""
    assert all(rho > 0.0 for rho in PRINTED.rho_l)
    for x, low, teeth in zip(SOURCE.shifts, PRINTED.least_shift, SOURCE.teeth, strict=False):
        assert x > low
        assert low == pytest.approx(1.0 - 0.5 * teeth * math.sin(SOURCE.pressure_angle) ** 2, abs=1e-12)


@pytest.mark.published
def test_coaxiality_1() -> None:
    """Condition (1): (z1 + z2)/cos α_w12 = (z3 − z2)/cos α_w23; the printed shifts miss it by 4e-4 modules only."""
    set_ = planetary(SOURCE)
    sides = [pair.teeth / math.cos(pair.operating_angle) for pair in (set_.outer, set_.inner)]
    assert sides[0] == pytest.approx(sides[1], rel=1e-14)
    assert abs(float(set_.outer.backlash)) < 1e-6


@pytest.mark.published
def test_areas_and_volume_on_a_grid_of_0_01() -> None:
    """Sources §4: areas 2.08 and 10.07, volume 10.77 count the nodes of a grid of step 0.01 through 0.

    Traced exactly they are 2.0870, 10.0670 and 10.8081 (tests/geometry/test_blocking.py).
    """
    limits, h = Limits(), 0.01
    x = np.arange(-200, 301) * h
    x3 = np.arange(-200, 801) * h
    a, b = np.meshgrid(x, x, indexing="ij")
    c, d = np.meshgrid(x, x3, indexing="ij")
    outer = least_margin(outer_plane(SOURCE, a, b, limits), SOURCE.module)[1].min(axis=0) >= 0.0
    inner = least_margin(inner_plane(SOURCE, c, d, limits), SOURCE.module)[1].min(axis=0) >= 0.0
    assert digits(outer.sum() * h**2, "2.08") == "2.08"
    assert digits(inner.sum() * h**2, "10.07") == "10.07"
    assert digits(float(outer.sum(axis=0) @ inner.sum(axis=1)) * h**3, "10.77") == "10.77"


@pytest.mark.published
def test_a_cutter_with_other_numbers_does_not_give_the_ring() -> None:
    """The unprinted cutter: d_f3 and ρ_l3 single out z0 = 25, x0 = 0.15, d_a0 = 55.6 among its neighbours."""
    for cutter in (Shaper(24, 0.15, 53.6e-3), Shaper(26, 0.15, 57.6e-3), Shaper(25, 0.14, 55.6e-3)):
        other = table(planetary(replace(SOURCE, cutter=cutter)), ROLLER)
        found = (digits(1e3 * other.root_diameter[2], "171.159"), digits(1e3 * other.rho_l[2], "40.697"))
        assert found != ("171.159", "40.697")
