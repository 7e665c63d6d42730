"""Sources §2: reactions, balance and vibration of a precessional drive.

The paper has equations and plots, no data; the numbers are those of a reference case of its class, by an independent
model.
"""

from __future__ import annotations

from trochoid.drives.precessional.balance import balance_plane, couple_lines, mean_product
from trochoid.drives.precessional.reactions import Model
from trochoid.sources import precessional_case as case
from trochoid.sources.row import Erratum, Row, Source

TESTS = "tests/published/test_sources_precessional.py"


def _reaction_rows() -> tuple[Row, ...]:
    numbers: dict[tuple[str, Model], tuple[str, str, str]] = {
        ("R_A", "exact"): ("116.21", "118.86", "121.19"),
        ("R_A", "printed"): ("118.89", "121.37", "123.55"),
        ("R_B", "exact"): ("37.96", "40.63", "42.94"),
        ("R_B", "printed"): ("40.64", "43.14", "45.30"),
        ("R_O", "exact"): ("37.96", "40.63", "42.94"),
        ("R_O", "printed"): ("40.64", "43.14", "45.30"),
        ("M_B", "exact"): ("4.847", "5.020", "5.171"),
        ("M_B", "printed"): ("5.021", "5.183", "5.324"),
    }
    return tuple(
        Row(
            "reference case",
            f"`{name}`, model *{model}*: least, mean, largest",
            printed,
            lambda name=name, model=model: case.spread(name, model),  # type: ignore[misc]
            f"{TESTS}::test_reactions",
            "N·m" if name == "M_B" else "N",
        )
        for (name, model), printed in numbers.items()
    )


ROWS = (
    Row(
        "(2), (9)",
        "ratio `1/(1 − z1/z2)` for teeth 15/14",
        ("−14",),
        lambda: (case.DRIVE.nutation.ratio,),
        "tests/kinematics/test_nutation.py::test_ratio",
    ),
    *_reaction_rows(),
    Row(
        "reference case",
        "`M_3`, model *exact*: least, largest",
        ("−0.004571", "0.004571"),
        lambda: case.torque_range("exact"),
        f"{TESTS}::test_torque_and_static_balance",
        "N·m",
    ),
    Row(
        "reference case",
        "`M_3`, model *printed*: least, largest",
        ("−0.004571", "0.004571"),
        lambda: case.torque_range("printed"),
        f"{TESTS}::test_torque_and_static_balance",
        "N·m",
    ),
    Row(
        "reference case",
        "radius of the counterweight by static balance",
        ("26.46",),
        lambda: (1e3 * case.DRIVE.counterweight.radius,),
        f"{TESTS}::test_torque_and_static_balance",
        "mm",
    ),
    Row(
        "reference case",
        "plane of full balance H, model *exact*",
        ("68.716",),
        lambda: (1e3 * balance_plane(case.DRIVE),),
        f"{TESTS}::test_torque_and_static_balance",
        "mm",
    ),
    Row(
        "reference case",
        "the same, model *printed*",
        ("69.988",),
        lambda: (1e3 * balance_plane(case.DRIVE, "printed"),),
        f"{TESTS}::test_torque_and_static_balance",
        "mm",
    ),
    Row(
        "reference case",
        "H with `I_3yz` = 0, as the case says",
        ("68.716",),
        lambda: (1e3 * balance_plane(case.BARE),),
        f"{TESTS}::test_product_of_inertia_that_the_numbers_need",
        "mm",
        reason="H, M_B and v need I_3yz = 3.480e-5 kg·m², which is m3·y3·72.5 mm",
    ),
    Row(
        "reference case",
        "velocity of the free casing, model *exact*",
        ("0.858",),
        lambda: (case.velocity(),),
        f"{TESTS}::test_vibration_velocity",
        "mm/s rms",
    ),
    Row(
        "reference case",
        "the same, model *printed*",
        ("0.688",),
        lambda: (case.velocity(model="printed"),),
        f"{TESTS}::test_vibration_velocity",
        "mm/s rms",
    ),
    Row(
        "reference case",
        "with the counterweight at H",
        ("0.148",),
        lambda: (case.velocity(case.at_plane_of_balance()),),
        f"{TESTS}::test_vibration_velocity",
        "mm/s rms",
    ),
    Row(
        "reference case",
        "on mounts",
        ("1.33",),
        lambda: (case.velocity(casing=case.MOUNTED),),
        f"{TESTS}::test_vibration_velocity",
        "mm/s rms",
    ),
    Row(
        "reference case",
        "without counterweight, the casing's centre 80 mm from O",
        ("15.3",),
        lambda: (case.without_counterweight(0.08),),
        f"{TESTS}::test_vibration_without_counterweight",
        "mm/s rms",
        note="the place is fitted, the case does not give it",
    ),
    Row(
        "reference case",
        "the same, the centre at O",
        ("15.3",),
        lambda: (case.without_counterweight(0.0),),
        f"{TESTS}::test_vibration_without_counterweight",
        "mm/s rms",
        reason="a force needs the place of the casing's centre; all other velocities are of a couple and do not",
    ),
    Row(
        "reference case",
        "`R_B/(√2 ω m)` alone over the velocity",
        ("9",),
        lambda: (case.from_one_support() / case.velocity(),),
        f"{TESTS}::test_erratum_velocity_from_one_support",
    ),
    Row(
        "closed form",
        "error of the satellite's mean couple when (2) is taken with its sign",
        ("−141",),
        lambda: (100.0 * (case.mean_couple(1.0) / case.mean_couple(-1.0) - 1.0),),
        f"{TESTS}::test_erratum_sign_of_the_relative_speed",
        "%",
    ),
    Row(
        "closed form",
        "mean couple of the satellite `ω_3² s (c (I_m − I_z) + q I_z)`, printed `ω_3² s q I_m`",
        ("stated",),
        case.mean_couples,
        f"{TESTS}::test_erratum_no_euler_terms",
        how="claim",
    ),
    Row(
        "closed form",
        "what no counterweight balances: amplitude `ω_3² s |I_x − I_y|/2 · |2q − c|`",
        ("stated",),
        case.remaining,
        f"{TESTS}::test_harmonics_and_period",
        how="claim",
    ),
    Row(
        "closed form",
        "the reactions repeat every `π z2/z1` of the shaft",
        ("stated",),
        case.period,
        f"{TESTS}::test_harmonics_and_period",
        how="claim",
    ),
    Row(
        "closed form",
        "lines of the load in the fixed frame over `ω_3`: 1, `2q − 1`, `2q + 1`",
        ("1", "8/7", "22/7"),
        lambda: tuple(abs(line.order) for line in couple_lines(case.DRIVE, case.SPEED)[:3]),
        f"{TESTS}::test_harmonics_and_period",
    ),
    Row(
        "closed form",
        "the line at `ω_3` is `m5 r5 ω_3 |z5 − H| d_z/(√2 J)`, nearly all of v",
        ("nearly all",),
        case.main_line,
        f"{TESTS}::test_main_line_in_closed_form",
        how="claim",
    ),
    Row(
        "closed form",
        "`Y_A` of the models differs by `ω_3² s (c − q)(I_z − I_y cos²f − I_x sin²f)/(OA·c)`",
        ("stated",),
        case.models_apart,
        f"{TESTS}::test_erratum_no_euler_terms",
        how="claim",
    ),
    Row(
        "(10)–(24)",
        "with full static balance the printed equations make `R_B` = `R_O`",
        ("equal",),
        case.alike_under_static_balance,
        f"{TESTS}::test_static_balance_makes_two_reactions_alike",
        how="claim",
    ),
    Row(
        "text, figs. 6, 7",
        "reactions of the СО-170 drive, and a vibration velocity within that of other products",
        ("plots",),
        None,
        reason="the text gives no masses, no dimensions and no measured velocity",
    ),
)
ERRATA = (
    Erratum(
        "(2), (3)",
        "`ω_2r = ω_3 z1/z2` taken with its sign into `ω × Jω`",
        "(2) prints a modulus, (9) has the sign: `ω_2r = −q ω_3`",
        f"{TESTS}::test_erratum_sign_of_the_relative_speed",
        "mean couple of the satellite about x3, N·m",
        lambda: (case.mean_couple(1.0), case.mean_couple(-1.0)),
    ),
    Erratum(
        "(5), (6)",
        "`M = Jε`, without the Euler terms",
        "`M = Jε + ω × Jω`",
        f"{TESTS}::test_erratum_no_euler_terms",
        "mean couple of the satellite about x3, N·m",
        lambda: (
            -(case.SPEED**2) * mean_product(case.DRIVE, "printed"),
            -(case.SPEED**2) * mean_product(case.DRIVE),
        ),
    ),
    Erratum(
        "after (24)",
        '"nine equations with nine unknowns", and `Z_O` in (25)',
        "eleven of each, all of them needed; `Z_O` is not among them",
        f"{TESTS}::test_erratum_eleven_equations",
    ),
    Erratum(
        "(26)",
        "`M_B = √(M_B² + M_B² + M_B²)`",
        "`√(M_Bx² + M_By²)`",
        f"{TESTS}::test_erratum_moment_of_the_support",
        "mean over a turn, N·m",
        case.moment_of_support,
    ),
    Erratum(
        "(20)",
        "`+ Φ_3 − Φ*` with both algebraic, as (15) and (16) have them",
        "`Φ*` is a modulus",
        f"{TESTS}::test_erratum_counterweight_force_is_a_modulus",
        "force on the casing under static balance, N",
        case.forces_on_casing,
    ),
    Erratum(
        "(17), (18)",
        "`I_yz` as in a tensor of inertia, `−∫yz dm`",
        "`+∫yz dm`",
        f"{TESTS}::test_erratum_sign_of_the_products_of_inertia",
        "plane of balance H, mm",
        lambda: (case.plane_with_product(-1.0), case.plane_with_product(1.0)),
    ),
    Erratum(
        "(5), (6)",
        "`I_2x`, `I_2y` without a word on where; taken about the satellite's own centre",
        "about O",
        f"{TESTS}::test_erratum_moments_of_inertia_about_the_centre_of_precession",
        "mean `R_A` of the printed model, N",
        case.own_centre,
    ),
    Erratum(
        "(10)–(14)",
        "no moment about OA and no tooth force",
        "the teeth carry the moment about OA",
        f"{TESTS}::test_erratum_moment_about_oa_and_tooth_force",
        "its amplitude, N·m",
        case.missing_moment,
    ),
    Erratum(
        "after fig. 5",
        "the vibration velocity follows from the reactions of the supports: `R_B/(√2 ω m)`",
        "the vector sum counts; under static balance a couple remains, and the casing rocks",
        f"{TESTS}::test_erratum_velocity_from_one_support",
        "velocity, mm/s rms",
        lambda: (case.from_one_support(), case.velocity()),
    ),
)
SOURCE = Source(
    2,
    "Reactions of a precessional drive",
    "A. T. Skoibeda, S. N. Khatetovsky, P. N. Gromyko, V. L. Yurkova, *Determining dynamic reactions in "
    "precessional transmission with its moving links being statically balanced* (in Russian)",
    "The paper has equations and plots, no data. The numbers are those of a reference case with assumed "
    "masses, by an independent model: 1430 rpm, teeth 15/14, nutation 2.5°, OA 45, OB 110 mm; satellite 2 "
    "kg at 40 mm, (5.3, 5.1, 3.6)e-3 kg·m² about O; shaft 1.2 kg, 0.4 mm off; counterweight 0.15 kg at 75 "
    "mm from O; casing 25 kg, 0.25 kg·m², measured 80 mm off; mounts 4e5 N/m, 300 N·s/m, 2e3 N·m/rad, 2 "
    "N·m·s/rad. *printed* is the paper's model, *exact* Newton's and Euler's. Means are plain averages of "
    "361 samples with both ends of the turn.",
    ROWS,
    ERRATA,
    (
        "The cos θ in (14) looks like a misprint and is none: it stands on both sides and cancels "
        f"(`{TESTS}::test_no_erratum_cosine_in_14`).",
    ),
)
