"""Sources §4: involute planetary set 20/30/80: Table 1, its conditions, and the blocking contours."""

from __future__ import annotations

from collections.abc import Callable

from trochoid.geometry.blocking_line import needed_sums
from trochoid.sources import planetary_case as case
from trochoid.sources.planetary_table import ROWS as TABLE_1
from trochoid.sources.planetary_table import SET, TESTS, found
from trochoid.sources.row import Erratum, Finding, Row, Source


def _claim(
    where: str,
    what: str,
    says: str,
    computed: Callable[[], Finding],
    test: str,
    reason: str = "",
    note: str = "",
) -> Row:
    return Row(where, what, (says,), computed, f"{TESTS}::{test}", how="claim", reason=reason, note=note)


_RING_WAY = "for the ring it is the other way round"
_DIRECTION = "test_conditions_of_the_ring_are_printed_the_wrong_way_round"
CONDITIONS = (
    _claim(
        "(1)",
        "coaxiality `(z1 + z2)/cos α_w12 = (z3 − z2)/cos α_w23`",
        "equal",
        case.coaxial,
        "test_coaxiality_1",
    ),
    _claim(
        "Table 1", "`R_os > R_op`", "fulfilled", lambda: case.order("rho_p", "rho_s"), _DIRECTION, _RING_WAY
    ),
    _claim(
        "Table 1", "`R_ow < R_oa`", "fulfilled", lambda: case.order("rho_w", "rho_a"), _DIRECTION, _RING_WAY
    ),
    _claim(
        "Table 1", "`R_om < R_oa`", "fulfilled", lambda: case.order("rho_m", "rho_a"), _DIRECTION, _RING_WAY
    ),
    _claim(
        "Table 1", "`R_ol < R_op`", "fulfilled", lambda: case.order("rho_l", "rho_p"), _DIRECTION, _RING_WAY
    ),
    _claim(
        "Table 1",
        "`R_ol > 0`, no undercut",
        "fulfilled",
        lambda: case.by_wheel([rho > 0.0 for rho in found().rho_l]),
        "test_claims_that_are_right",
    ),
    _claim("Table 1", "`x > x_min`", "fulfilled", case.above_least, "test_claims_that_are_right"),
    _claim(
        "Table 1",
        "`D_d + D_r > D_a`",
        "fulfilled",
        lambda: case.rollers("tip"),
        "test_rollers_reach_beyond_the_tips_and_stay_off_the_roots",
        note="it says nothing about the ring, where `D_d − D_r < D_a` counts, and holds",
    ),
    _claim(
        "Table 1",
        "`D_d − D_r < D_f`",
        "fulfilled",
        lambda: case.rollers("root"),
        "test_rollers_reach_beyond_the_tips_and_stay_off_the_roots",
        "for sun and planet it must be >, for the ring D_d + D_r < D_f",
    ),
)
CONTOURS = (
    Row(
        "text",
        "sums `x1 + x2` and `x3 − x2` of the printed shifts; computed those that mesh without play at 52 mm",
        ("1.134", "1.134"),
        lambda: needed_sums(SET),
        "tests/geometry/test_blocking.py::test_line_needs_1_1336_without_play",
    ),
    Row(
        "text",
        "lower end of the coaxial line: x1, x2, x3",
        ("−0.096", "1.23", "2.364"),
        lambda: case.end(upper=False),
        f"{TESTS}::test_lower_end_of_the_line",
    ),
    _claim(
        "check value",
        "what binds there",
        "ring tip in planet fillet",
        case.binding,
        "test_lower_end_of_the_line",
    ),
    Row(
        "text",
        "upper end: x1, x2, x3",
        ("1.15", "−0.016", "1.118"),
        lambda: case.end(upper=True),
        f"{TESTS}::test_upper_end_of_the_line_is_beyond_the_printed_one",
        reason="nothing binds at the printed end",
    ),
    _claim(
        "text",
        "the line ends at x1 = 1.15",
        "stated",
        case.upper_binds,
        "test_upper_end_of_the_line_is_beyond_the_printed_one",
        "every condition still has room there",
    ),
    Row(
        "fig. 2, check values",
        "areas of the plane contours, volume of the joint body; nodes of a grid of 0.01",
        ("2.08", "10.07", "10.77"),
        case.on_a_grid,
        f"{TESTS}::test_areas_and_volume_on_a_grid_of_0_01",
        note="`s_a` ≥ 0.4 mm, ε ≥ 1.2",
    ),
    Row(
        "fig. 2, check values",
        "the same, boundaries traced",
        ("2.08", "10.07", "10.77"),
        case.traced,
        "tests/geometry/test_blocking.py::test_areas_and_volume_of_the_source",
        reason="two of the three are a grid's",
    ),
    _claim(
        "text",
        "contact ratios of 1.2 and 1.4 can be asked for",
        "stated",
        case.aims,
        "test_contact_ratio_of_1_4_cannot_hold_for_the_outer_mesh",
        "1.4 is out of reach for sun and planet on the line",
    ),
    _claim(
        "text",
        "shifts are chosen for the largest operating pressure angle",
        "stated",
        case.largest_angle,
        "test_largest_operating_angle_is_no_aim_once_the_distance_is_given",
        "the centre distance alone decides it",
    ),
)
ERRATA = (
    Erratum(
        "Table 1",
        "`ε_23` for a planet tip of 66.159 mm",
        "the planet has one tip circle, the drawn one of 66.000 mm",
        f"{TESTS}::test_the_planet_has_one_tip_circle",
        "`ε_23`",
        lambda: (found().contact_ratios[1], found(printed=False).contact_ratios[1]),
    ),
    Erratum(
        "Table 1",
        "`R_op` of the ring for the same tip",
        "for the drawn one",
        f"{TESTS}::test_the_planet_has_one_tip_circle",
        "`R_op`, mm",
        lambda: case.right("rho_p"),
    ),
    Erratum(
        "Table 1",
        "constant chord of the ring with +x: that of the space",
        "with −x",
        f"{TESTS}::test_constant_chord_of_the_ring_needs_minus_x",
        "chord, mm",
        lambda: case.right("chord"),
    ),
    Erratum(
        "Table 1",
        "height of the chord, with +x",
        "with −x",
        f"{TESTS}::test_constant_chord_of_the_ring_needs_minus_x",
        "height, mm",
        lambda: case.right("chord_height"),
    ),
    Erratum(
        "Table 1",
        "`R_os`, with +x",
        "with −x: off the tooth, so the ring has no constant chord to measure",
        f"{TESTS}::test_constant_chord_of_the_ring_needs_minus_x",
        "`R_os`, mm",
        lambda: case.right("rho_s"),
    ),
    Erratum(
        "Table 1",
        "`R_os > R_op`, `R_ow < R_oa`, `R_om < R_oa`, `R_ol < R_op` for all wheels",
        "the ring's flank is active inward: `<`, `>`, `>`, `>`",
        f"{TESTS}::{_DIRECTION}",
    ),
    Erratum(
        "Table 1",
        "`D_d − D_r < D_f` for all wheels",
        "`>` for sun and planet, `D_d + D_r < D_f` for the ring",
        f"{TESTS}::test_rollers_reach_beyond_the_tips_and_stay_off_the_roots",
    ),
    Erratum(
        "text",
        "ranges of x in mm",
        "x counts modules",
        f"{TESTS}::test_shift_ranges_are_coefficients_not_millimetres",
        "lower end of x1, modules",
        lambda: (case.end(upper=False)[0] * 1e-3 / SET.module, case.end(upper=False)[0]),
    ),
    Erratum(
        "text",
        "the shifts give the largest operating pressure angle",
        "it follows from the centre distance alone",
        f"{TESTS}::test_largest_operating_angle_is_no_aim_once_the_distance_is_given",
    ),
    Erratum(
        "text",
        "the line of shifts ends at 1.15/−0.016/1.118",
        "it ends where the planet's tip meets the sun's fillet",
        f"{TESTS}::test_upper_end_of_the_line_is_beyond_the_printed_one",
        "upper end of x1",
        lambda: (1.15, case.end(upper=True)[0]),
    ),
    Erratum(
        "text",
        "`s_a = 0.4` without a unit; taken as modules",
        "0.4 mm",
        f"{TESTS}::test_tip_limit_means_millimetres",
        "upper end of x1",
        lambda: (case.upper_with_modules(), case.end(upper=True)[0]),
    ),
    Erratum(
        "text",
        "ε ≥ 1.4 for the meshes",
        "out of reach for sun and planet on the line",
        f"{TESTS}::test_contact_ratio_of_1_4_cannot_hold_for_the_outer_mesh",
        "largest `ε_12`",
        lambda: (1.4, case.largest_contact_ratio()),
    ),
    Erratum(
        "text",
        "indices of the inner pair: `(z2 − z1)` in its centre distance, `x_d = x2 − x1`",
        "`(z3 − z2)`, `x_d = x3 − x2`",
        f"{TESTS}::test_indices_of_the_inner_pair",
        "centre distance, mm",
        case.distance_with_printed_indices,
    ),
)
SOURCE = Source(
    4,
    "Profile shift of a 2K-H planetary set",
    "A. M. Merko, D. V. Smishko, *Choice of profile shift for a 2K-H planetary gear under given "
    "conditions* (in Russian), Siberian Federal University",
    "Teeth 20/30/80, module 2 mm, 20°, both centre distances 52 mm, shifts 0.5/0.634/1.768. All 65 numbers "
    "of Table 1 stand below, several to a line (sun, planet, ring). They come out with α_w from the given "
    "distance, with the source's second planet tip and its ring chord, and with a shaper cutter that is "
    "not printed: the numbers admit only 25 teeth, x0 = 0.15, tip diameter 55.6 mm "
    f"(`{TESTS}::test_a_cutter_with_other_numbers_does_not_give_the_ring`). Right values of the four that "
    "rest on a misprint are among the errata.",
    (*TABLE_1, *CONDITIONS, *CONTOURS),
    ERRATA,
    (
        "Three planets cannot be spaced equally, for z1 + z3 = 100; two or four can "
        "(`tests/kinematics/test_assembly.py::test_planets_assemble_by_the_phases_of_their_teeth`).",
    ),
)
