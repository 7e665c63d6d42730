"""results.json: the numbers that scripts rely on."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from importlib import metadata
from typing import Any

from trochoid.results.outcome import Outcome, Parts, Quantity

SCHEMA = 1


def to_json(outcome: Outcome) -> str:
    """Return the text of results.json; floats round-trip exactly, what is not finite becomes null."""
    return json.dumps(document(outcome), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def document(outcome: Outcome) -> dict[str, Any]:
    """Return results.json as plain dictionaries, lists, numbers and strings."""
    return {
        "schema": SCHEMA,
        "program": {"name": "trochoid", "version": version()},
        "scene": _plain(outcome.scene),
        "quantities": {name: _quantity(found) for name, found in outcome.quantities.items()},
        "stages": [{"name": stage.name, "seconds": _plain(stage.seconds)} for stage in outcome.stages],
        "not_needed": list(outcome.not_needed),
        "warnings": list(outcome.warnings),
        "checks": [
            {"name": c.name, "value": _plain(c.value), "limit": _plain(c.limit), "ok": bool(c.ok)}
            for c in outcome.checks
        ],
    }


def version() -> str:
    """Return the version of the installed program."""
    try:
        return metadata.version("trochoid")
    except metadata.PackageNotFoundError:
        return "unknown"


def _parts(parts: Parts) -> dict[str, Any]:
    return {name: _part(part) for name, part in parts.items()}


def _part(part: Quantity | Parts) -> dict[str, Any]:
    """Return a part; one that only has parts of its own is these, as deep as it goes, without a key for them."""
    if not isinstance(part, Quantity):
        return _parts(part)
    entry = _quantity(part)
    return entry["parts"] if list(entry) == ["parts"] else entry


def _quantity(quantity: Quantity) -> dict[str, Any]:
    entry: dict[str, Any] = (
        {"value": _plain(quantity.value)} if quantity.parts is None else {"parts": _parts(quantity.parts)}
    )
    if quantity.parts is None or quantity.unit:
        entry["unit"] = quantity.unit
    optional = {"error": _plain(quantity.error), "model": quantity.model, "note": quantity.note}
    return entry | {key: value for key, value in optional.items() if value is not None}


def _plain(value: Any) -> Any:
    """Return `value` in the types of JSON: arrays as lists, numpy scalars as numbers, the rest as text."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple, set, frozenset)):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if value is None or isinstance(value, (bool, int, str)) else str(value)
