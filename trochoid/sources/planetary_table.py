"""The 65 numbers of Table 1 of sources §4, line by line as printed: sun, planet, ring."""

from __future__ import annotations

from typing import Any

from trochoid.geometry.planetary import PlanetarySet, planetary
from trochoid.geometry.planetary_table import Table, table
from trochoid.kinematics.shaper import Shaper
from trochoid.sources.row import Row

TESTS = "tests/published/test_sources_planetary.py"
# The cutter of the ring is not printed; only this one gives the printed numbers.
SET = PlanetarySet((20, 30, 80), 2e-3, 52e-3, (0.5, 0.634, 1.768), Shaper(25, 0.15, 55.6e-3), planets=4)
ROLLER = 1.732 * SET.module

# name in the library, what, printed
_LENGTHS = (
    ("reference_diameter", "reference diameter", ("40.000", "60.000", "160.000")),
    ("tip_diameter", "tip diameter", ("45.464", "66.000", "162.652")),
    ("root_diameter", "root diameter", ("37.000", "57.536", "171.159")),
    ("pitch_diameter", "operating pitch diameter", ("41.600", "62.400", "166.400")),
    ("chord", "constant chord", ("3.417", "3.589", "5.047")),
    ("chord_height", "height of the constant chord", ("2.110", "2.347", "−2.244")),
    ("rho_s", "radius of curvature at the chord `R_os`", ("8.658", "12.170", "24.676")),
    ("rho_p", "radius of curvature where the active flank ends `R_op`", ("5.126", "9.493", "39.588")),
    ("span", "span", ("16.005", "28.277", "72.559")),
    ("rho_w", "radius of curvature where the span touches `R_ow`", ("8.002", "14.138", "36.279")),
    ("rho_a", "radius of curvature at the tip `R_oa`", ("12.788", "17.155", "31.025")),
    ("roller_circle", "circle through the rollers' centres", ("42.864", "63.412", "165.034")),
    ("rho_m", "radius of curvature at the roller `R_om`", ("8.569", "12.778", "35.757")),
    ("over_rollers", "size over (ring: between) rollers", ("46.328", "66.876", "161.570")),
    ("thickness", "normal thickness", ("3.870", "4.065", "0.568")),
    ("rho_l", "radius of curvature where the involute begins `R_ol`", ("3.917", "8.120", "40.697")),
    ("tip_thickness", "thickness at the tip", ("1.304", "1.372", "1.616")),
)
_NOTES = {
    "chord": "the ring's with +x, as the source has it",
    "chord_height": "the ring's with +x",
    "rho_s": "the ring's with +x",
    "rho_p": "the ring's with the other planet tip",
}


def found(printed: bool = True) -> Table:
    """Table 1, by default with the source's planet tip and ring chord."""
    return table(planetary(SET), ROLLER, printed=printed)


def _values(name: str, scale: float = 1.0) -> Any:
    """The numbers of one line, times `scale`; counts stay whole."""
    return lambda: tuple(
        value if isinstance(value, int) else scale * value for value in getattr(found(), name)
    )


def _row(what: str, published: tuple[str, ...], computed: Any, test: str, **more: Any) -> Row:
    return Row("Table 1", what, published, computed, f"{TESTS}::{test}", **more)


def _lengths() -> tuple[Row, ...]:
    return tuple(
        _row(
            what,
            printed,
            _values(name, 1e3),
            "test_table_1_by_rounding",
            unit="mm",
            note=_NOTES.get(name, ""),
        )
        for name, what, printed in _LENGTHS
    )


ROWS = (
    _row(
        "ratio of sun and planet",
        ("1.50",),
        lambda: found().ratios[:1],
        "test_table_1_angle_ratio_and_roller",
    ),
    _row(
        "ratio of planet and ring",
        ("2.666",),
        lambda: found().ratios[1:],
        "test_table_1_ring_ratio_by_truncation",
        how="cut",
    ),
    *_lengths()[:4],
    _row(
        "operating pressure angle",
        ("25°22′16″",),
        lambda: (found().operating_angle,),
        "test_table_1_angle_ratio_and_roller",
    ),
    *_lengths()[4:8],
    _row(
        "teeth (ring: spaces) in the span",
        ("3", "5", "12"),
        _values("span_teeth"),
        "test_table_1_by_rounding",
    ),
    *_lengths()[8:11],
    _row(
        "diameter of the roller",
        ("3.4640",),
        lambda: (1e3 * found().roller,),
        "test_table_1_angle_ratio_and_roller",
        unit="mm",
        note="1.732 modules",
    ),
    _row(
        "pressure angle at the roller's centre",
        ("28°43′40″", "27°14′09″", "24°21′06″"),
        _values("roller_angle"),
        "test_table_1_roller_angles_by_truncation",
        how="cut",
    ),
    *_lengths()[11:15],
    _row(
        "least shift of sun and planet `x_min`",
        ("−0.170", "−0.755"),
        _values("least_shift"),
        "test_table_1_by_rounding",
    ),
    *_lengths()[15:],
    _row(
        "contact ratios",
        ("1.298", "1.450"),
        _values("contact_ratios"),
        "test_table_1_by_rounding",
        note="the second with the other planet tip",
    ),
)
