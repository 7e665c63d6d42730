"""Tables of rolling bearings and their seats: what is read, and each kind of fault with what would be right."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from trochoid.faults import SceneFaults
from trochoid.scene import load

EXAMPLES = Path(__file__).parents[2] / "examples"
SIZES = "bore=20, outside=42, width=12"
PLAIN = f'kind="cylindrical", {SIZES}'
BALL = f'kind="deep_groove", {SIZES}'


@pytest.mark.exact
def test_tables_in_si() -> None:
    """Millimetres, degrees and newtons; what is left out has its default, in every kind of drive."""
    seat = '{thickness=6, width=20, material="steel", supports=3, support_angle=30}'
    given = f'{{{PLAIN}, clearance=-0.01, radial_load="2 kN", dynamic_rating=15000, seat={seat}}}'
    for name, place in (
        ("cycloid", "drive.input_shaft.bearing"),
        ("cycloid", "drive.output_flange.bearing"),
        ("rv", "drive.crankshaft.bearing"),
        ("planetary", "drive.planet.bearing"),
    ):
        found = load(EXAMPLES / f"{name}.toml", [f"{place}={given}"]).drive
        for part in place.split(".")[1:]:
            found = getattr(found, part)
        assert (found.bore, found.clearance, found.radial_load) == (0.02, pytest.approx(-1e-5), 2000.0)
        assert (found.inner_groove, found.outer_groove, found.contamination) == (0.52, 0.53, 0.5)
        assert (found.seat.thickness, found.seat.supports) == (0.006, 3)
        assert found.axial_load == 0.0
        assert not found.centrifugal


@pytest.mark.property
@pytest.mark.parametrize(
    ("table", "said"),
    [
        (
            'kind="deep_groove", bore=20',
            "needs outside, width too, or for an inner geometry of its own elements",
        ),
        (
            'kind="cylindrical", elements=12, element_diameter=6, pitch_diameter=31',
            "of its own element_length",
        ),
        ('kind="ball"', 'need one of "deep_groove", "angular_contact", "cylindrical", "needle", "tapered"'),
        (f"{SIZES}", "missing"),
        (
            f"{BALL}, inner_groove=0.5",
            "no ball of half a diameter's radius fits such a groove; need more than 0.5",
        ),
        (f"{BALL}, outer_groove=0.3", "outer_groove = 0.3 ball diameters"),
        (f"{PLAIN}, inner_groove=0.54", 'kind = "cylindrical" has no inner_groove; take it away'),
        (f"{PLAIN}, centrifugal=true", 'kind = "cylindrical" has no centrifugal'),
        (f"{PLAIN}, axial_load=500", 'kind = "cylindrical" has no axial_load'),
        (f"{PLAIN}, contact_angle=15", 'kind = "cylindrical" has no contact_angle'),
        (f"{BALL}, element_length=5, straight_rollers=true", "has no element_length, straight_rollers"),
        (f'kind="tapered", {SIZES}', "carries nothing without an axial load; give axial_load above 0 N"),
        (f"{PLAIN}, pitch_diameter=50", "need a value between bore = 20 mm and outside = 42 mm"),
        ('kind="needle", bore=20, outside=18, width=9', "need more than bore = 20 mm"),
        (f"{PLAIN}, viscosity_ratio=1.2", "viscosity_ratio needs fatigue_load too"),
        (f"{PLAIN}, fatigue_load=900", "fatigue_load needs viscosity_ratio too"),
        (f"{PLAIN}, viscosity_ratio=0.05, fatigue_load=900", "of 0.1 or more"),
        (f"{PLAIN}, radial_load=0", "need a force greater than 0"),
        (f"{PLAIN}, elements=2", "need a whole number from 3 to 200"),
        (f"{BALL}, seat={{thickness=5}}", "seats serve cylindrical and needle bearings"),
        (
            'kind="needle", elements=20, element_diameter=3, element_length=10, pitch_diameter=30, seat={thickness=5}',
            "the seat needs outside, width too: the outer ring is part of it",
        ),
        (f"{PLAIN}, seat={{thickness=0}}", "need a length greater than 0"),
        (f"{PLAIN}, seat={{thickness=5, supports=18}}", "18 supports of 20 deg meet; give supports = 0"),
        (f'{PLAIN}, seat={{thickness=5, material="brass"}}', 'no material "brass"'),
        (f"{PLAIN}, seat={{thick=5}}", "thickness"),
    ],
)
@pytest.mark.parametrize("place", ["cycloid drive.input_shaft.bearing", "precessional drive.bearing_b"])
def test_faults_say_what_is_allowed(place: str, table: str, said: str) -> None:
    """Once through a table of its own, once through one that may give stiffnesses instead."""
    name, key = place.split()
    if name == "precessional" and "missing" in said:
        said = "no stiffness; need radial_stiffness, or the kind of a rolling bearing"
    with pytest.raises(SceneFaults, match=re.escape(said)):
        load(EXAMPLES / f"{name}.toml", [f"{key}={{{table}}}"])


@pytest.mark.property
def test_seat_of_a_material_of_ones_own() -> None:
    """A material that the scene adds may hold a bearing."""
    alloy = "materials.alloy={youngs_modulus=70000, poissons_ratio=0.33, density=2700}"
    table = f'drive.planet.bearing={{{PLAIN}, seat={{thickness=5, material="alloy"}}}}'
    found = load(EXAMPLES / "planetary.toml", [alloy, table])
    assert found.materials[found.drive.planet.bearing.seat.material].youngs_modulus == 70e9


@pytest.mark.property
@pytest.mark.parametrize(
    ("name", "line"),
    [("cycloid", "bearing_stiffness = 300000\n"), ("rv", "bearing_stiffness = 250000\n")],
)
def test_members_stand_on_something(name: str, line: str) -> None:
    """Neither a number nor a rolling bearing is a fault that names both."""
    from trochoid.scene import read

    text = (EXAMPLES / f"{name}.toml").read_text()
    assert line in text
    with pytest.raises(
        SceneFaults, match="no stiffness of its bearings; need bearing_stiffness, or a rolling bearing"
    ):
        read(text.replace(line, "", 1), [])


@pytest.mark.property
def test_life_needs_a_rolling_bearing() -> None:
    """Springs do not wear: the fault names the tables in which a rolling bearing may stand."""
    springs = [f"drive.{name}={{radial_stiffness=100000}}" for name in ("bearing_a", "bearing_b")]
    said = r'"bearing_life" needs a rolling bearing.*"drive\.bearing_a", "drive\.bearing_b"'
    with pytest.raises(SceneFaults, match=said):
        load(EXAMPLES / "precessional.toml", [*springs, 'ask.quantities=["bearing_life"]'])
    with pytest.raises(SceneFaults, match="the bearings C are behind the joint O and carry the output shaft"):
        load(EXAMPLES / "precessional.toml", [f"drive.bearing_c={{{PLAIN}}}"])


@pytest.mark.property
def test_planet_stands_on_the_usual_stiffness_without_a_bearing() -> None:
    """No table: 200 N/µm as ever; with one and no number, what the bearing has; with both, the number."""
    from trochoid.scene import read

    text = (EXAMPLES / "planetary.toml").read_text()
    text = re.sub(r"bearing_stiffness = 200000\n|\[drive.planet.bearing\]\n(\w+ = .*\n)+", "", text)
    asked = 'ask.quantities=["bearing_loads"]'
    table = f"drive.planet.bearing={{{PLAIN}}}"
    number = "drive.planet.bearing_stiffness=5e5"
    found = [
        read(text, [asked, *extra]).drive.planet.bearing_stiffness
        for extra in ((), (table,), (table, number))
    ]
    assert found == [2e8, None, 5e8]
