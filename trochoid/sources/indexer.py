"""Sources §5: spherical planetary-pin indexing mechanisms and the Geneva wheel beside them."""

from __future__ import annotations

from trochoid.kinematics.geneva import geneva
from trochoid.kinematics.indexer_synthesis import by_pin
from trochoid.sources import indexer_case as case
from trochoid.sources.row import Erratum, Finding, Row, Source

TESTS = "tests/published/test_sources_indexer.py"
ROWS = (
    Row(
        "text",
        "Geneva wheel, `ψ_Σ` = 90°: B and C",
        ("2.00", "5.53"),
        lambda: case.pair(geneva(90.0 * case.DEGREE)),
        f"{TESTS}::test_geneva_constants",
    ),
    Row(
        "check value",
        "its C, to more digits",
        ("5.52974528736",),
        lambda: case.pair(geneva(90.0 * case.DEGREE))[1:],
        f"{TESTS}::test_geneva_constants",
    ),
    Row(
        "text",
        "indexer, i = 4, k = 0.25, `ψ_Σ` = 90°: B and C",
        ("1.71", "4.77"),
        case.at_quarter,
        f"{TESTS}::test_indexer_constants",
        reason="they belong to no mechanism of this kind with k = 1/4; the hypocycloid from cusp to cusp alone serves",
    ),
    Row(
        "check value",
        "B and C of that cusp",
        ("1.55947", "4.91856"),
        lambda: case.pair(case.cusp()),
        f"{TESTS}::test_indexer_constants",
    ),
    Row(
        "check value",
        "where B is the printed one: k, ρ, B, C",
        ("0.2902", "0.527", "1.7100", "4.7952"),
        case.where_printed_velocity_is,
        f"{TESTS}::test_where_the_printed_velocity_is_met",
    ),
    Row(
        "text",
        "some k has B = 1.71 and C = 4.77 together, i = 4",
        ("stated",),
        case.nearest_to_printed_pair,
        f"{TESTS}::test_printed_pair_has_no_mechanism",
        how="claim",
        reason="none along the family of near hypotrochoids",
    ),
    Row(
        "text",
        "both less than the Geneva wheel's by a factor",
        ("1.2", "1.2"),
        lambda: tuple(
            a / b for a, b in zip(case.pair(geneva(90.0 * case.DEGREE)), case.pair(case.cusp()), strict=True)
        ),
        f"{TESTS}::test_both_constants_below_the_geneva_wheels",
        reason="so for the printed B and C; these are the cusp's",
    ),
    Row(
        "text",
        "largest ω falls from `ψ_Σ` = 120° to 60° by a factor",
        ("1.7",),
        lambda: (case.from_120_to_60("velocity"),),
        f"{TESTS}::test_ratios_from_120_to_60_degrees",
        reason="cusps with i = 4; the text does not say which mechanism",
    ),
    Row(
        "text",
        "largest ε, by a factor",
        ("2.25",),
        lambda: (case.from_120_to_60("acceleration"),),
        f"{TESTS}::test_ratios_from_120_to_60_degrees",
        reason="cusps with i = 4; the text does not say which mechanism",
    ),
    Row(
        "text",
        "soft shock, by a factor",
        ("3",),
        lambda: (case.from_120_to_60("start"),),
        f"{TESTS}::test_ratios_from_120_to_60_degrees",
        how="above",
        reason="cusps with i = 4; the text does not say which mechanism",
    ),
    Row(
        "check value",
        "the three for cusps, i = 4",
        ("1.974", "2.077", "2.268"),
        lambda: tuple(case.from_120_to_60(name) for name in ("velocity", "acceleration", "start")),
        f"{TESTS}::test_ratios_from_120_to_60_degrees",
    ),
    Row(
        "text",
        "smaller swings have smaller peaks of power as well",
        ("stated",),
        lambda: Finding(
            f"by {case.from_120_to_60('power'):.2f} from 120° to 60°", case.from_120_to_60("power") > 1.0
        ),
        f"{TESTS}::test_peaks_fall_with_the_swing",
        how="claim",
    ),
    Row(
        "text",
        "k = 1/i from 0.2 to 0.5",
        ("stated",),
        case.shares,
        f"{TESTS}::test_range_of_durations",
        how="claim",
        note="right for cusps",
    ),
    Row(
        "text",
        "k = 1/i in general",
        ("stated",),
        case.share_is_the_ratio,
        f"{TESTS}::test_duration_is_not_the_ratio",
        how="claim",
        reason="k = 1/i forces ρ = 1, but for one shaft angle; other ρ have other k",
    ),
    Row(
        "check value",
        "that shaft angle, `cos D = cot(π/i) cot ψ0`, i = 4, `ψ_Σ` = 120°",
        ("54.7356",),
        case.inner_exception,
        f"{TESTS}::test_the_one_exception",
        "°",
    ),
    Row(
        "text",
        "k of spherical Geneva wheels",
        ("0.5",),
        case.geneva_shares,
        f"{TESTS}::test_geneva_duration",
        how="claim",
        reason="only with shafts at 90°",
    ),
    Row(
        "text",
        "k = 0.25 at 90° is that of the outer Geneva wheel",
        ("0.25",),
        lambda: (geneva(90.0 * case.DEGREE, 1e-6).duration,),
        f"{TESTS}::test_quarter_is_the_plane_geneva_wheel",
        note="of the plane one with four slots",
    ),
    Row(
        "text",
        "there always is a soft shock",
        ("stated",),
        case.always_soft_shock,
        f"{TESTS}::test_soft_shock_is_no_must",
        how="claim",
        reason="hypo near, i = 4, k = 0.5, γ = 47.77587°, β = 2.77587° has none",
    ),
    Row(
        "text",
        "no hard shock where `|ẏ/ẋ| = tan ψ0` at both ends",
        ("stated",),
        case.no_hard_shock,
        f"{TESTS}::test_condition_without_hard_shock",
        how="claim",
    ),
    Row(
        "text",
        "all else alike, B, C and power are much less than a Geneva wheel's",
        ("stated",),
        case.worse_at_half,
        f"{TESTS}::test_equal_duration_needs_another_ratio",
        how="claim",
        reason="not for every indexer, at the Geneva wheel's k = 0.5",
    ),
    Row(
        "text",
        "peak of power",
        ("much less",),
        case.power,
        f"{TESTS}::test_power_and_place_of_the_peak",
        how="claim",
    ),
    Row(
        "text",
        "the largest ε is farther from the middle",
        ("stated",),
        case.place_of_peak,
        f"{TESTS}::test_power_and_place_of_the_peak",
        how="claim",
    ),
    Row(
        "text",
        "no soft shock in the middle",
        ("stated",),
        case.middle,
        f"{TESTS}::test_power_and_place_of_the_peak",
        how="claim",
    ),
    Row(
        "text",
        "swing of an output that turns to and fro over two branches of the path, at most",
        ("30",),
        None,
        unit="°",
        reason="mechanisms over two branches are not in the program",
    ),
    Row(
        "fig. 3",
        "ω, ε and N over the index",
        ("plots",),
        None,
        reason="the figures are not in the text at hand",
    ),
)
_PHI = 0.3
ERRATA = (
    Erratum(
        "(4)",
        "the last cos",
        "sin; but that alone does not mend it",
        f"{TESTS}::test_4_as_printed_starts_at_45_degrees",
        "ψ at φ = 0 for every input, °",
        lambda: (case.angle_4(case.curtate(0.2902), 0.0), case.angle(case.curtate(0.2902), 0.0)),
    ),
    Erratum(
        "(4)",
        "its denominator, from the ellipse (2)",
        "`(i + s cos γ) cot γ − ρ sin γ cos θ` at D = 90°",
        f"{TESTS}::test_4_needs_another_denominator",
        "ψ at φ = 0.3 rad, the sine put right, °",
        lambda: (case.angle_4(case.curtate(0.2902), _PHI, "sin"), case.angle(case.curtate(0.2902), _PHI)),
    ),
    Erratum(
        "(3)",
        "lengths (X, Y) beside ratios (ρ)",
        "ratios only",
        f"{TESTS}::test_3_as_printed_mixes_lengths_with_ratios",
        "change of ψ at φ = 0.3 rad when the sphere is doubled, °",
        lambda: (case.angle_3(case.oblique(), _PHI, 2.0) - case.angle_3(case.oblique(), _PHI, 1.0), 0),
    ),
    Erratum(
        "(3)",
        "one δ for the shaft angle and the arm's: `i + cos δ`",
        "`i + s cos γ`",
        f"{TESTS}::test_3_as_printed_has_one_angle_for_two",
        "factor of sin φ, D = 90°",
        lambda: case.numerator(case.curtate(0.2902)),
    ),
    Erratum(
        "(2)",
        "the pin on an ellipse with the half axis `r sin δ` and `x = r sin φ`: no place for the pin beyond "
        "φ = δ",
        "the pin's path is a spherical epi- or hypotrochoid",
        f"{TESTS}::test_ellipse_2_has_no_point_beyond_the_arm",
    ),
    Erratum(
        "text",
        "transport speed `v_e = h ω_1`",
        "`h ω_4`",
        f"{TESTS}::test_transport_speed_is_the_wheels",
        "over `R ω_1` at φ = 0.3 rad",
        lambda: case.speed_at(case.curtate(0.2902), _PHI),
    ),
    Erratum(
        "text",
        "transport acceleration `h φ̈`, zero at a constant speed of the drive",
        "`h ε_4`",
        f"{TESTS}::test_transport_acceleration_is_the_wheels",
        "over `R ω_1²` at φ = 0.3 rad",
        lambda: case.acceleration_at(case.curtate(0.2902), _PHI),
    ),
    Erratum(
        "text",
        "B = 1.71 and C = 4.77 at i = 4",
        "1.71 goes with another C, and with another k than 1/i",
        f"{TESTS}::test_where_the_printed_velocity_is_met",
        "C with that B",
        lambda: (4.77, case.where_printed_velocity_is()[3]),
    ),
    Erratum(
        "text",
        "k = 1/i in general",
        "one parameter is free: k or ρ",
        f"{TESTS}::test_duration_is_not_the_ratio",
        "k for i = 4, ρ = 0.527",
        lambda: (0.25, by_pin(case.TASK, 0.527)[0].indexer.duration),
    ),
    Erratum(
        "text",
        "k = 0.5 for spherical Geneva wheels",
        "`tan φ0 = 1/(cos D tan ψ0)`",
        f"{TESTS}::test_geneva_duration",
        "k with shafts at 60°",
        lambda: (0.5, geneva(90.0 * case.DEGREE, 60.0 * case.DEGREE).duration),
    ),
    Erratum(
        "text",
        "a soft shock always",
        "not where the acceleration is zero at the start",
        f"{TESTS}::test_soft_shock_is_no_must",
    ),
)
SOURCE = Source(
    5,
    "Spherical planetary-pin mechanisms",
    "I. V. Nadezhdin, *Kinematic analysis of spherical planetary-pin mechanisms* (in Russian), Rybinsk",
    "A pin on a bevel planet turns a slotted wheel: k share of a turn in which the wheel moves, i turns of "
    "the planet, `ψ_Σ` swing, D angle between the shafts (90° unless said), ρ = 1 for a path with cusps, "
    "`B = max|ω| T/ψ_Σ`, `C = max|ε| T²/ψ_Σ`. The text does not say which path its numbers are for.",
    ROWS,
    ERRATA,
    (
        "The author's conditions on the path hold for curtate hypotrochoids; the hypocycloid from cusp to "
        "cusp serves although its pin is nearest to the wheel's axis at the ends "
        f"(`{TESTS}::test_conditions_on_the_path`).",
        "(3) corrected, for any shaft angle and both kinds of path: "
        f"`{TESTS}::test_corrected_3_is_the_motion`.",
    ),
)
