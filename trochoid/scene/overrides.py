"""Single values of a scene replaced from outside: --set drive.pins=24, --ask ratio."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

from trochoid.faults import Fault, Key, dotted, quoted, shown


@dataclass(frozen=True, slots=True)
class Override:
    """A value to put at `key`; `label` says in a fault where it came from."""

    key: Key
    value: Any
    label: str


def parse(text: str) -> Override | Fault:
    """Return the override that "a.b=value" means, or its fault; the value is TOML, else a plain text."""
    label = "--set " + text.replace("\n", "\\n")
    name, equals, value = text.partition("=")
    key = _key(name)
    if not equals or key is None:
        return Fault(
            (),
            'need KEY=VALUE with a dotted key, e.g. drive.pins=24 or "operation.input_speed=157 rad/s"',
            label,
        )
    return Override(key, _value(value), label)


def apply(raw: dict[str, Any], overrides: Iterable[Override]) -> tuple[dict[str, Any], list[Fault]]:
    """Return a copy of the raw scene with the overrides put in, and what could not be put in."""
    changed, faults = deepcopy(raw), []
    for override in overrides:
        problem = _put(changed, override.key, deepcopy(override.value))
        if problem:
            faults.append(Fault((), problem, override.label))
    return changed, faults


def _key(name: str) -> Key | None:
    try:
        table: Any = tomllib.loads(f"{name} = 0")
    except (ValueError, RecursionError):
        return None
    parts: list[str | int] = []
    while isinstance(table, dict):
        if len(table) != 1:
            return None
        part, table = next(iter(table.items()))
        parts.append(int(part) if part.isdecimal() else part)
    return tuple(parts) if table == 0 else None


def _value(text: str) -> Any:
    try:
        table = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        return text.strip()
    return table["value"] if len(table) == 1 else text.strip()


def _put(raw: dict[str, Any], key: Key, value: Any) -> str | None:
    """Put the value in its place; return what stands in the way, if anything does."""
    place: Any = raw
    for depth, part in enumerate(key):
        last = depth == len(key) - 1
        if isinstance(place, dict):
            part = str(part)
            if last:
                place[part] = value
            else:
                place = place.setdefault(part, {})
        elif isinstance(place, list):
            if not isinstance(part, int) or part >= len(place):
                return _no_entry(key[:depth], part, len(place))
            if last:
                place[part] = value
            else:
                place = place[part]
        else:
            return f"{dotted(key[:depth])} is {shown(place)}, which has no {quoted(str(part))}"
    return None


def _no_entry(key: Key, part: str | int, count: int) -> str:
    if count == 0:
        return f"{dotted(key)} is empty: there is no entry {part}"
    have = "1 entry, number 0" if count == 1 else f"{count} entries, numbers 0 to {count - 1}"
    return f"{dotted(key)} has {have}; there is no {quoted(str(part))}"
