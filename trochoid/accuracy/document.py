"""accuracy.json: the study for scripts."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

from trochoid.accuracy.study import Check, Choice, Cost, Error, Judged, Study
from trochoid.results.document import version

SCHEMA = 1


def to_json(study: Study) -> str:
    """Return the text of accuracy.json; what is not finite becomes null."""
    return json.dumps(_finite(document(study)), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def document(study: Study) -> dict[str, Any]:
    """Return accuracy.json as plain dictionaries, lists, numbers and strings."""
    reference = study.reference
    return {
        "schema": SCHEMA,
        "program": {"name": "trochoid", "version": version()},
        "scene": study.scene,
        "tolerance": study.tolerance,
        "budget": study.budget,
        "level_unit": study.unit,
        "rungs": [{"name": rung.name, "what": rung.what, "meshed": rung.meshed} for rung in study.rungs],
        "reference": {"rung": reference.step.rung, "level": reference.step.level, "error": reference.error},
        "steps": [_step(judged) for judged in study.steps],
        "choice": None if study.choice is None else _choice(study.choice),
        "check": None if study.check is None else _check(study.check),
        "remarks": list(study.remarks),
    }


def _step(judged: Judged) -> dict[str, Any]:
    step = judged.step
    return {
        "rung": step.rung,
        "level": step.level,
        "seconds": step.seconds,
        "stages": dict(step.stages),
        "error": judged.error,
        "worst": judged.worst,
        "estimated": judged.estimated,
        "quantities": {
            name: {
                **_error(judged.errors.get(name)),
                "parts": {path: {"value": value, "unit": unit} for path, (value, unit) in parts.items()},
            }
            for name, parts in step.numbers.items()
        },
    }


def _error(error: Error | None) -> dict[str, Any]:
    return {"error": None, "worst": None} if error is None else {"error": error.size, "worst": error.part}


def _choice(choice: Choice) -> dict[str, Any]:
    pick = choice.pick
    return {
        "rung": pick.rung,
        "level": pick.level,
        "named_by_scene": pick.named,
        "error": choice.judged.error,
        "estimate": pick.estimate,
        "estimate_of": pick.of,
        "seconds": choice.judged.step.seconds,
        "run_seconds": choice.run_seconds,
        "run_levels": list(pick.levels),
        "tenth": None if choice.tenth is None else _cost(choice.tenth),
    }


def _cost(cost: Cost) -> dict[str, Any]:
    return {
        "error": cost.error,
        "rung": cost.rung,
        "level": cost.level,
        "seconds": cost.seconds,
        "measured": cost.measured,
    }


def _check(check: Check) -> dict[str, Any]:
    return {
        "what": check.what,
        "seconds": check.seconds,
        "quantities": {name: _error(error) for name, error in check.errors.items()},
    }


def _finite(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if value is None or isinstance(value, (bool, int, float, str)) else str(value)
