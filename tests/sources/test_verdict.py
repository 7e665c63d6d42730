"""Reading, comparing and judging printed numbers."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from trochoid.sources.numeral import numeral
from trochoid.sources.row import Erratum, Finding, How, Row, Value
from trochoid.sources.verdict import State, both_forms, judged


@pytest.mark.exact
@pytest.mark.parametrize(
    ("printed", "computed", "text", "difference", "same"),
    [
        ("2.00", 1.9999999999999998, "2.0000", 0.0, True),
        ("5.53", 5.52974528736, "5.5297", -0.00025471264, True),
        ("5.53", 5.524, "5.5240", -0.006, False),
        ("2.25", 2.245, "2.2450", -0.005, True),  # half is rounded up, as by hand
        ("−0.0961", -0.09613, "−0.096130", -0.00003, True),
        ("0.0", -0.001, "−0.001", -0.001, True),
        ("121/120", Fraction(121, 120), "121/120", 0.0, True),
        ("121/120", Fraction(122, 120), "61/60", 1 / 120, False),
        ("−19", Fraction(-19), "−19", 0.0, True),
        ("25°22′16″", math.radians(25 + 22 / 60 + 16.41 / 3600), "25°22′16.41″", 0.41, True),
        ("27°14′09″", math.radians(27 + 14 / 60 + 9.60 / 3600), "27°14′09.60″", 0.60, False),
    ],
)
def test_numerals(printed: str, computed: Value, text: str, difference: float, same: bool) -> None:
    """As one would do it by hand."""
    read = numeral(printed)
    assert read.text(computed) == text
    assert read.difference(computed) == pytest.approx(difference, abs=1e-8)
    assert read.same_digits(computed) is same


@pytest.mark.property
@given(value=st.floats(-1e4, 1e4), decimals=st.integers(0, 4))
def test_a_number_has_the_digits_of_its_own_print(value: float, decimals: int) -> None:
    """Printed with any digits and read again, a number is reproduced, and within half of the last digit."""
    printed = f"{value:.{decimals}f}".replace("-", "−")
    tie = math.isclose(abs(value) * 10**decimals % 1.0, 0.5, abs_tol=1e-6)
    assert tie or numeral(printed).same_digits(value)
    assert abs(numeral(printed).difference(value)) <= 0.5 * 10**-decimals * (1 + 1e-9)


def row(published: tuple[str, ...], values: tuple[Value, ...], how: How = "rounded", reason: str = "") -> Row:
    return Row("text", "number", published, lambda: values, "tests/x.py::test_x", how=how, reason=reason)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("given_row", "state", "verdict"),
    [
        (row(("2.66",), (8 / 3,)), "unexplained", "unexplained difference"),
        (row(("2.66",), (8 / 3,), reason="cut off"), "differs", "differs: cut off"),
        (row(("2.66",), (8 / 3,), "cut"), "same", "to the printed digits, the rest cut off"),
        (row(("2.67",), (8 / 3,), reason="?"), "unexplained", "reproduced, though it should differ: ?"),
        (row(("121",), (Fraction(121),) * 3), "same", "exactly"),
        (row(("121",), (Fraction(121), Fraction(120))), "unexplained", "unexplained difference"),
        (row(("1", "2"), (1.0, 2.4)), "same", "to the printed digits"),
        (row(("1", "2"), (1.0, 2.6)), "unexplained", "unexplained difference"),
        (row(("0.80", "0.97"), (0.85,), "inside"), "same", "inside"),
        (row(("0.80", "0.97"), (0.98,), "inside"), "unexplained", "unexplained difference"),
        (row(("3",), (2.3,), "above", reason="no"), "differs", "differs: no"),
        (row(("3",), (math.nan,)), "unexplained", "unexplained difference"),
        (row(("3",), (math.nan,), "above"), "unexplained", "unexplained difference"),
    ],
)
def test_verdicts(given_row: Row, state: State, verdict: str) -> None:
    """Every way of comparing, reproduced and not, with a reason and without."""
    found = judged(given_row)
    assert (found.state, found.verdict) == (state, verdict)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("true", "reason", "state"),
    [(True, "", "same"), (False, "why", "differs"), (False, "", "unexplained"), (True, "why", "unexplained")],
)
def test_claims(true: bool, reason: str, state: State) -> None:
    """A claim that is false needs a reason, one that is true must not have one."""
    claim = Row("text", "claim", ("stated",), lambda: Finding("shown", true), how="claim", reason=reason)
    assert judged(claim).state == state


@pytest.mark.exact
def test_what_is_not_computed_says_so() -> None:
    """It stands on the page with its reason."""
    found = judged(Row("text", "overload", ("500",), None, reason="no limits"))
    assert (found.state, found.verdict, found.computed) == ("not computed", "not computed: no limits", "–")


@pytest.mark.exact
def test_both_forms_of_an_erratum() -> None:
    """Fractions stay fractions; what is left of a zero is zero."""
    gives = Erratum("(1)", "a", "b", "t", "angle, °", lambda: (45.0, 1e-15))
    assert both_forms(gives) == ("45", "0")
    assert both_forms(Erratum("(1)", "a", "b", "t", "ratio", lambda: (Fraction(-36, 121), 4.0))) == (
        "−36/121",
        "4",
    )
    assert both_forms(Erratum("(1)", "a", "b", "t")) == ("", "")
