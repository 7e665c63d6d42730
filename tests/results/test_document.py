"""results.json against the contract."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from trochoid.results import Check, Outcome, Quantity, Stage, to_json


def _document(**parts: Any) -> Any:
    def refuse(word: str) -> None:
        raise AssertionError(f"{word} is no JSON")

    return json.loads(to_json(Outcome(**({"scene": {}, "quantities": {}} | parts))), parse_constant=refuse)


@pytest.mark.exact
def test_document_has_the_keys_of_the_contract(outcome: Outcome) -> None:
    """Contract, results.json: these keys and no others."""
    document = json.loads(to_json(outcome))
    assert list(document) == [
        "schema",
        "program",
        "scene",
        "quantities",
        "stages",
        "not_needed",
        "warnings",
        "checks",
    ]
    assert document["schema"] == 1
    assert document["program"]["name"] == "trochoid"
    assert document["stages"][1] == {"name": "mesh", "seconds": 0.41}
    assert document["checks"][0] == {"name": "force balance", "value": 3.2e-12, "limit": 1e-9, "ok": True}
    stiffness = document["quantities"]["torsional_stiffness"]
    assert stiffness == {"value": 101.3127, "unit": "N*m/arcmin", "error": 0.41, "model": "strips"}
    assert document["quantities"]["member_speeds"]["parts"]["input"]["speed"] == {
        "value": 1500.0,
        "unit": "rpm",
    }
    assert "value" not in document["quantities"]["member_speeds"]


@pytest.mark.exact
def test_parts_of_parts_have_no_key_between_them() -> None:
    """Contract: {"parts": {"sun": {"tip_diameter": {"value": …}}}}, whether the sun is a mapping or a quantity."""
    tip = {"tip_diameter": Quantity(45.464, "mm")}
    document = _document(quantities={"profile": Quantity(parts={"sun": Quantity(parts=tip), "ring": tip})})
    entry = {"tip_diameter": {"value": 45.464, "unit": "mm"}}
    assert document["quantities"]["profile"] == {"parts": {"sun": entry, "ring": entry}}


@pytest.mark.property
@given(st.floats(allow_nan=False, allow_infinity=False))
def test_floats_come_back_exactly(value: float) -> None:
    """Shortest repr of IEEE 754 doubles."""
    document = _document(quantities={"a": Quantity(value, "N", value)}, stages=(Stage("s", value),))
    assert document["quantities"]["a"]["value"] == value
    assert document["quantities"]["a"]["error"] == value
    assert document["stages"][0]["seconds"] == value


@pytest.mark.property
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, np.float64("nan")])
def test_what_is_not_finite_becomes_null(bad: float) -> None:
    """RFC 8259 knows no NaN; the parser of this test refuses it."""
    document = _document(
        scene={"a": bad, "b": [bad, np.array([1.0, bad])]},
        quantities={"q": Quantity(bad, "N", bad), "p": Quantity(parts={"x": Quantity(bad)})},
        checks=(Check("c", bad, 1.0, False),),
    )
    assert document["scene"] == {"a": None, "b": [None, [1.0, None]]}
    assert document["quantities"]["q"] == {"value": None, "unit": "N"}
    assert document["quantities"]["p"]["parts"]["x"]["value"] is None
    assert document["checks"][0]["value"] is None


@pytest.mark.exact
def test_numpy_scalars_are_numbers() -> None:
    """float32, int64 and bool of numpy are JSON numbers and truth values."""
    quantities = {"a": Quantity(np.float32(0.5)), "b": Quantity(np.int64(7))}  # type: ignore[arg-type]
    document = _document(quantities=quantities, checks=(Check("c", 0.0, 1.0, np.bool_(True)),))  # type: ignore[arg-type]
    assert document["quantities"] == {"a": {"value": 0.5, "unit": ""}, "b": {"value": 7, "unit": ""}}
    assert document["checks"][0]["ok"] is True


@pytest.mark.exact
def test_a_quantity_has_a_value_or_parts() -> None:
    """Contract: parts stand instead of a value."""
    with pytest.raises(ValueError, match="a value or parts, not both"):
        Quantity(1.0, parts={"a": Quantity(2.0)})
