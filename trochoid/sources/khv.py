"""Sources §3: the textbook on planetary-cycloid drives, and the classical hand calculation of their pin forces.

The public part of the textbook has few numbers; those of the hand calculation (rigid disc, equal springs) are by an
independent model.
"""

from __future__ import annotations

from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.parallel_crank import loaded_output_pins
from trochoid.sources import khv_case as case
from trochoid.sources.row import Erratum, Row, Source

NUMBERS, ERRATA_TESTS = "tests/published/test_numbers_khv.py", "tests/published/test_errata_khv.py"
SPRINGS = "tests/published/test_sources_khv.py"
ROWS = (
    Row(
        "1.2",
        "ratio `−z1/(z2 − z1)`, 19 lobes on 20 pins",
        ("−19",),
        lambda: case.ratios(19),
        "tests/kinematics/test_train.py::test_khv_ratio_of_the_textbook",
        note="the number of lobes, as printed for a difference of one",
    ),
    Row(
        "1.4, fig. 5",
        "ratio of the geared motor with two discs, its amount",
        ("33",),
        lambda: (-case.ratios(33)[0],),
        f"{SPRINGS}::test_ratios_of_the_textbook",
        note="33 lobes on 34 pins",
    ),
    Row(
        "1.1",
        "ratios of one stage, their amounts",
        ("3", "191"),
        lambda: tuple(-u for u in case.ratios(3, 191)),
        f"{SPRINGS}::test_ratios_of_the_textbook",
        note="3 lobes on 4 pins to 191 on 192",
    ),
    Row(
        "1.1",
        "pins in mesh for a difference of one",
        ("about half",),
        case.half_of_the_pins,
        f"{NUMBERS}::test_half_of_the_pins_can_carry",
        how="claim",
    ),
    Row(
        "1.1",
        "mass over output torque",
        ("0.02", "0.05"),
        lambda: (case.specific_mass(),),
        f"{NUMBERS}::test_specific_mass_of_the_example",
        "kg/(N·m)",
        how="inside",
        note="`examples/cycloid.toml` with its casing",
    ),
    Row(
        "1.1",
        "efficiency",
        ("0.80", "0.97"),
        lambda: (case.efficiency(),),
        f"{SPRINGS}::test_efficiency_of_the_example",
        how="inside",
        note="the same drive, rigid discs; 0.05 at pins and rollers, none in bearings and seals",
    ),
    Row("1.1", "life", ("50 000",), None, unit="h", reason="no model of wear or fatigue"),
    Row(
        "1.1", "overload", ("500",), None, unit="%", reason="no limits of strength are given to compare with"
    ),
    Row(
        "1.2",
        "the 2K-V drive is more efficient, and locks itself",
        ("stated",),
        None,
        reason="the losses of its involute stage are not in the program",
    ),
    Row(
        "1.3",
        "hole of the parallel crank `D_o = d_b + 2e`, for rollers of 13 mm and e 2.5 mm: diameter",
        ("18",),
        lambda: (2e3 * case.example().hole_radius,),
        f"{NUMBERS}::test_hole_of_the_parallel_crank",
        "mm",
    ),
    Row(
        "1.3",
        "output pins",
        ("3", "12"),
        None,
        how="inside",
        reason="a range of custom; any number from 3 on is accepted",
    ),
    Row(
        "1.3",
        "`z_p/2` and `z_p/2 − 1` output pins carry by turns",
        ("stated",),
        case.loaded_as_printed,
        f"{ERRATA_TESTS}::test_number_of_loaded_output_pins",
        how="claim",
        reason="an even number has half of them, always but for instants; see the errata",
    ),
    Row(
        "1.2",
        "the number of pins must be even and a multiple of the number of discs",
        ("stated",),
        case.rule_for_discs,
        f"{ERRATA_TESTS}::test_number_of_pins_for_several_discs",
        how="claim",
        reason="neither needed nor enough; see the errata",
    ),
    Row(
        "hand calculation",
        "largest pin force, N; pins that carry",
        ("405.469", "20"),
        case.largest_and_count,
        f"{SPRINGS}::test_unmodified_flank",
    ),
    Row(
        "hand calculation",
        "force on the eccentric",
        ("6408.7",),
        lambda: case.on_eccentric()[1:],
        f"{ERRATA_TESTS}::test_bearing_force_needs_the_output_pins",
        "N",
    ),
    Row(
        "hand calculation",
        "the same if the output pins are forgotten",
        ("4391.4",),
        lambda: case.on_eccentric()[:1],
        f"{ERRATA_TESTS}::test_bearing_force_needs_the_output_pins",
        "N",
        note="a trap rather than an erratum: the disc is then not in balance",
    ),
    Row(
        "hand calculation",
        "its tangential part is `T/(e z_c)`",
        ("stated",),
        case.tangential,
        f"{ERRATA_TESTS}::test_bearing_force_needs_the_output_pins",
        how="claim",
    ),
    Row(
        "hand calculation",
        "ΔR −0.02, Δr +0.01 mm, 2e5 N/mm, exact gaps: largest force, N; pins that carry",
        ("1045.1", "6"),
        lambda: case.largest_and_count("exact"),
        f"{SPRINGS}::test_modified_flank",
    ),
    Row(
        "hand calculation",
        "the same with gaps to first order",
        ("1043.6",),
        lambda: case.largest_and_count("first order")[:1],
        f"{SPRINGS}::test_modified_flank",
        "N",
    ),
    Row(
        "cycloidgen 7.2.0",
        "largest pin force, R 50, r 4, e 1.5 mm, 12 pins, 2.5 N·m",
        ("49.859",),
        lambda: (float(case.pin_forces(Cycloid(12, 11, 0.050, 0.004, 0.0015), 0.0, 2.5).max()),),
        f"{NUMBERS}::test_peak_pin_force_of_another_program",
        "N",
        note="release note of another program",
    ),
    Row(
        "hand calculation",
        "`F_max ≈ 4T/(K R z_c)`",
        ("about",),
        case.approximate_largest,
        f"{SPRINGS}::test_largest_force_in_closed_form",
        how="claim",
    ),
    Row(
        "hand calculation",
        "rotational stiffness `k (e z_c)² z_p/4`",
        ("stated",),
        case.approximate_stiffness,
        f"{SPRINGS}::test_closed_form_of_the_stiffness",
        how="claim",
    ),
    Row(
        "hand calculation",
        "the pin forces repeat every 360°/z_p of the crank",
        ("stated",),
        case.period,
        f"{SPRINGS}::test_pin_forces_repeat",
        how="claim",
    ),
    Row(
        "closed form",
        "largest pin radius without undercut, the flank of the hand calculation",
        ("stated",),
        case.undercut_limit,
        "tests/kinematics/test_cycloid.py::test_undercut_limit_is_the_least_radius_of_curvature",
        how="claim",
    ),
)
ERRATA = (
    Erratum(
        "1.2",
        "ratio of the 2K-V drive `1 + z2 z3/(z1 (z4 − z3))`",
        "`1 + z2 z4/(z1 (z4 − z3))`: the crank's speed must be taken relative to the carrier",
        f"{ERRATA_TESTS}::test_ratio_of_the_2k_v_drive",
        "ratio for 12/36/39/40",
        case.ratio_of_2k_v,
    ),
    Erratum(
        "1.2",
        "the number of pins must be even and a multiple of the number of discs",
        "n equal discs want holes and lobes that suit: n dividing `z_p` and the number of output pins is "
        "enough; two discs on 21 pins with 8 output pins, and three on 20 with 9, are equal too; two on 20 "
        "with 7 are not",
        f"{ERRATA_TESTS}::test_number_of_pins_for_several_discs",
    ),
    Erratum(
        "1.3",
        "`z_p/2` and `z_p/2 − 1` output pins carry by turns",
        "an even number n has n/2, and n/2 − 1 only at the instants when two pins stand in line with the "
        "eccentricity; an odd one has (n ± 1)/2, half the time each",
        f"{ERRATA_TESTS}::test_number_of_loaded_output_pins",
        "fewest of 8 pins, but for instants",
        lambda: (8 // 2 - 1, loaded_output_pins(8).least),
    ),
)
SOURCE = Source(
    3,
    "Planetary-cycloid drives",
    "M. V. Fomin, *Planetary-cycloid drives* (in Russian), Bauman MSTU 2009, ISBN 978-5-7038-3309-4, the "
    "part that is public",
    "The hand calculation is the classical one (rigid disc, equal springs) for `z_p` 40, R 64, r 3, e 1.3 "
    "mm, 206 N·m per disc, 12 output pins on 40 mm, at the crank angle 0.2 rad; its numbers are those of "
    "an independent model. `T` torque of a disc, `K = e z_p/R`, `k` stiffness of a contact.",
    ROWS,
    ERRATA,
)
