"""Numbers and units as text."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from trochoid.results import Quantity, text

_SUPERSCRIPTS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


def _read(shown: str) -> float:
    """The number that a reader takes from what is shown."""
    mantissa, _, power = shown.replace("−", "-").partition("×10")
    return float(mantissa) * 10.0 ** int(power.translate(_SUPERSCRIPTS) or 0)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("value", "error", "shown"),
    [
        (101.3127, 0.41, ("101.31", "0.41")),
        (512.8, 21.0, ("513", "21")),
        (6408.7, 137.0, ("6409", "137")),
        (-19.0, 0.0, ("−19", "")),
        (0.0371, 0.0004, ("0.03710", "0.00040")),
        (3.5e8, 2.1e5, ("3.5000×10⁸", "0.0021×10⁸")),
        (0.0, 0.02, ("0.000", "0.020")),
        (5.0, None, ("5", "")),
        ("A", 0.1, ("A", "")),
        (None, 0.1, ("none", "")),
        (math.nan, 1.0, ("not finite", "")),
    ],
)
def test_value_and_error_share_their_last_digit(
    value: float | str | None, error: float | None, shown: tuple[str, str]
) -> None:
    """Two significant digits of the error (Guide to the Expression of Uncertainty in Measurement, 7.2.6)."""
    assert text.value_and_error(value, error) == shown


@pytest.mark.property
@given(st.floats(-1e12, 1e12), st.floats(1e-9, 1e6))
def test_rounding_stays_within_the_error(value: float, error: float) -> None:
    """What is shown differs from the value by less than a tenth of the error, or by 1e-8 of the value."""
    shown, margin = text.value_and_error(value, error)
    assert abs(_read(shown) - value) <= max(0.06 * error, 1e-8 * abs(value))
    if margin:
        assert _read(margin) == pytest.approx(error, rel=0.06, abs=1e-8 * abs(value))


@pytest.mark.property
@given(st.floats(-1e300, 1e300))
def test_numbers_keep_their_digits(value: float) -> None:
    """Five significant digits of any number, integers below a million whole."""
    assert _read(text.number(value)) == pytest.approx(value, rel=6e-5, abs=1e-300)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("unit", "pretty"),
    [
        ("N*m/arcmin", "N·m/arcmin"),
        ("kg*m**2", "kg·m²"),
        ("kg*m^2", "kg·m²"),
        ("um", "µm"),
        ("deg", "°"),
        ("", ""),
        ("drum", "drum"),
        ("kg/(N*m)", "kg/(N·m)"),
    ],
)
def test_units_get_their_signs(unit: str, pretty: str) -> None:
    """Signs of ISO 80000-1."""
    assert text.pretty_unit(unit) == pretty


@pytest.mark.exact
def test_sentences_read_well() -> None:
    """A space before a unit, none before a degree sign (ISO 80000-1, 7.1.4)."""
    assert text.sentence(Quantity(101.3127, "N*m/arcmin", 0.41)) == "101.31 ± 0.41 N·m/arcmin"
    assert text.sentence(Quantity(12.5, "deg")) == "12.5°"
    assert text.sentence(Quantity(20)) == "20"


@pytest.mark.property
@given(st.text(alphabet="abc ±·µ²³°−×10⁻⁹", max_size=30))
def test_plain_text_is_ascii(words: str) -> None:
    """Any stream can show it."""
    assert re.fullmatch(r"[\x00-\x7f]*", text.plain(words))


@pytest.mark.exact
def test_plain_powers_are_readable_numbers() -> None:
    """3.2×10⁻¹² becomes 3.2e-12."""
    assert text.plain("3.2×10⁻¹²") == "3.2e-12"
