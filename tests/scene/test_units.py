from __future__ import annotations

import math
import subprocess
import sys
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from trochoid.scene import units
from trochoid.scene.reading import read
from trochoid.scene.units import FAMILIES, Family

FOOT, POUND, GRAVITY = 0.3048, 0.45359237, 9.80665  # exact by definition, NIST SP 811 (2008), appendix B.8


@pytest.mark.exact
@pytest.mark.parametrize(
    ("text", "family", "si"),
    [
        ("64 mm", units.LENGTH, 0.064),
        ("64mm", units.LENGTH, 0.064),
        ("0.25 in", units.LENGTH, 0.25 * FOOT / 12),
        ("5 um", units.LENGTH, 5e-6),
        ("5 µm", units.LENGTH, 5e-6),
        ("-1.5e1 cm", units.LENGTH, -0.15),
        ("180 deg", units.ANGLE, math.pi),
        ("180°", units.ANGLE, math.pi),
        ("60 arcmin", units.ANGLE, math.pi / 180),
        ("2 rad", units.ANGLE, 2.0),
        ("400 N*m", units.TORQUE, 400.0),
        ("400 Nm", units.TORQUE, 400.0),
        ("400 N·m", units.TORQUE, 400.0),
        ("0.4 kNm", units.TORQUE, 400.0),
        ("1 lbf*ft", units.TORQUE, POUND * GRAVITY * FOOT),
        ("1500 rpm", units.SPEED, 50 * math.pi),
        ("25 rev/s", units.SPEED, 50 * math.pi),
        ("157 rad/s", units.SPEED, 157.0),
        ("210 GPa", units.STRESS, 210e9),
        ("210000 N/mm^2", units.STRESS, 210e9),
        ("500 g", units.MASS, 0.5),
        ("0.25 kg*m^2", units.INERTIA, 0.25),
        ("0.25 kg·m²", units.INERTIA, 0.25),
        ("7.85 g/cm^3", units.DENSITY, 7850.0),
        ("3e8 N/m", units.STIFFNESS, 3e8),
        ("300 kN/mm", units.STIFFNESS, 3e8),
        ("0.2 N*s/mm", units.DAMPING, 200.0),
    ],
)
def test_text_with_unit_is_si(text: str, family: Family, si: float) -> None:
    """Definitions of the units, NIST SP 811 (2008), appendix B.8."""
    assert read(text, family) == pytest.approx(si, rel=4e-16)


@pytest.mark.exact
@given(st.floats(-1e12, 1e12))
def test_bare_number_is_the_nearest_float(number: float) -> None:
    """Millimetres and megapascals in rational arithmetic, rounded once."""
    assert read(number, units.LENGTH) == float(Fraction(number) / 1000)
    assert read(number, units.STRESS) == float(Fraction(number) * 10**6)


@pytest.mark.property
@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.noun)
@given(number=st.floats(-1e9, 1e9))
def test_default_unit_may_be_written_or_left_out(family: Family, number: float) -> None:
    """A bare number and the same number with the default unit are one value; `from_si` inverts it."""
    si = read(number, family)
    assert read(f"{number!r} {family.unit}", family) == si
    assert family.from_si(si) == pytest.approx(number, rel=1e-15, abs=1e-300)


@pytest.mark.property
@pytest.mark.parametrize("wanted", FAMILIES, ids=lambda family: family.noun)
@pytest.mark.parametrize("given_family", FAMILIES, ids=lambda family: family.noun)
def test_other_dimension_is_refused_by_name(wanted: Family, given_family: Family) -> None:
    """Each kind of quantity refuses every other and names both; all of them have different dimensions."""
    text = f"3 {given_family.si}"
    if wanted is given_family:
        assert read(text, wanted) == 3.0
        return
    with pytest.raises(ValueError, match="need") as caught:
        read(text, wanted)
    assert f"({given_family.noun})" in str(caught.value)
    assert wanted.name in str(caught.value)


@pytest.mark.property
@pytest.mark.parametrize("text", ["25 Hz", "25 1/s", "25 1/min", "25 kg"])
def test_turns_per_second_are_not_guessed(text: str) -> None:
    """25 Hz could mean 25 turns or 25 rad per second: neither is taken."""
    with pytest.raises(ValueError, match="need a rotational speed"):
        read(text, units.SPEED)


@pytest.mark.property
@pytest.mark.parametrize(
    "value",
    [
        True,
        None,
        [],
        {},
        "",
        "64",
        "mm",
        "6,4 mm",
        "64 mm + 1 in",
        "9**9**9**9 mm",
        "64 furlngs",
        "64 mm)",
        "1e999 mm",
        math.inf,
        -math.inf,
        math.nan,
        10**400,
    ],
)
def test_what_is_no_length_is_refused(value: object) -> None:
    """What is not one finite number with at most one unit is refused with what to write instead."""
    with pytest.raises(ValueError, match=r"need a (length in mm, e\.g\. 64|finite number)"):
        read(value, units.LENGTH)


@pytest.mark.property
@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.noun)
def test_what_is_larger_than_anything_is_refused(family: Family) -> None:
    """Sizes beyond 1e20 in SI, whose squares and products would be no numbers."""
    for value in (1e300, -1e300, f"1.01e20 {family.si}", f"-1e21 {family.si}"):
        with pytest.raises(ValueError, match=f"need {family.name} of at most 1e\\+20"):
            read(value, family)
    assert read(f"9.9e19 {family.si}", family) == pytest.approx(9.9e19, rel=1e-12)


@pytest.mark.property
@given(text=st.text(max_size=30) | st.text("0123456789.eE+-*/^ mkgN()", max_size=30))
def test_any_text_is_read_or_refused(text: str) -> None:
    """Whatever is written, the answer is a finite number or a ValueError."""
    try:
        assert math.isfinite(read(text, units.LENGTH))
    except ValueError as error:
        assert "need a" in str(error)  # noqa: PT017


@pytest.mark.property
def test_pint_is_imported_only_for_foreign_units() -> None:
    """Numbers and default units cost no import of pint."""
    program = """if True:
        import sys
        from trochoid.scene import reading, units
        reading.read("64 mm", units.LENGTH), reading.read(3, units.ANGLE)
        assert "pint" not in sys.modules
        reading.read("1 in", units.LENGTH)
        assert "pint" in sys.modules"""
    subprocess.run([sys.executable, "-c", program], check=True)
