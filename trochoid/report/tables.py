"""Quantities and scene as tiles and tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from trochoid.results import text
from trochoid.results.outcome import Parts, Quantity


@dataclass(frozen=True, slots=True)
class Tile:
    """A headline number."""

    name: str
    value: str
    error: str
    unit: str
    model: str
    note: str


@dataclass(frozen=True, slots=True)
class Table:
    """A table with a heading; cells are text, the first column names the row."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""


def tiles_of(quantities: Mapping[str, Quantity]) -> list[Tile]:
    """Return the quantities that are one value."""
    return [_tile(name, quantity) for name, quantity in quantities.items() if quantity.parts is None]


def tables_of(quantities: Mapping[str, Quantity]) -> list[Table]:
    """Return a table per quantity with parts; where several things have the same parts, a row per thing."""
    return [
        _table(name, quantity, quantity.parts)
        for name, quantity in quantities.items()
        if quantity.parts is not None
    ]


def scene_tables(scene: Mapping[str, Any]) -> list[Table]:
    """Return one table per table of the scene, keys with dots below that."""
    tables, loose = [], []
    for name, entry in scene.items():
        if isinstance(entry, (Mapping, list)) and entry:
            tables.append(Table(name, ("key", "value"), tuple(_leaves(entry))))
        else:
            loose.append((name, _literal(entry)))
    return [*([Table("", ("key", "value"), tuple(loose))] if loose else []), *tables]


def _tile(name: str, quantity: Quantity) -> Tile:
    value, error = text.value_and_error(quantity.value, quantity.error)
    return Tile(
        text.label(name),
        value,
        error,
        text.pretty_unit(quantity.unit),
        quantity.model or "",
        quantity.note or "",
    )


def _table(name: str, quantity: Quantity, parts: Parts) -> Table:
    note = " · ".join(filter(None, (quantity.model and f"model: {quantity.model}", quantity.note)))
    inner = [part if not isinstance(part, Quantity) else part.parts for part in parts.values()]
    columns = _shared_columns(inner)
    if columns:
        rows = tuple(
            (text.label(key), *(_cell(part[c]) for c in columns))
            for key, part in zip(parts, inner, strict=True)
            if part
        )
        return Table(text.label(name), ("", *map(text.label, columns)), rows, note)
    return Table(text.label(name), ("", "value"), tuple(_rows(parts)), note)


def _shared_columns(parts: Sequence[Parts | None]) -> tuple[str, ...]:
    """Return the keys of `parts` when all have the same ones and these are values; else nothing."""
    first = parts[0] if parts else None
    if not first or any(part is None or list(part) != list(first) for part in parts):
        return ()
    leaves = (leaf for part in parts if part for leaf in part.values())
    return tuple(first) if all(isinstance(leaf, Quantity) and leaf.parts is None for leaf in leaves) else ()


def _rows(parts: Parts, path: str = "") -> Iterator[tuple[str, str]]:
    for name, part in parts.items():
        here = f"{path} · {name.replace('_', ' ')}" if path else text.label(name)
        if isinstance(part, Quantity) and part.parts is None:
            yield here, _cell(part)
        else:
            yield from _rows((part.parts or {}) if isinstance(part, Quantity) else part, here)


def _cell(part: Quantity | Parts) -> str:
    return text.sentence(part) if isinstance(part, Quantity) else ""


def _leaves(entry: Any, path: str = "") -> Iterator[tuple[str, str]]:
    if isinstance(entry, Mapping) and entry:
        for key, item in entry.items():
            yield from _leaves(item, f"{path}.{key}" if path else str(key))
    elif isinstance(entry, list) and any(isinstance(item, Mapping) for item in entry):
        for index, item in enumerate(entry, start=1):
            yield from _leaves(item, f"{path} {index}".strip())
    else:
        yield path, _literal(entry)


def _literal(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_literal, value))}]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return "–" if value is None else text.number(value, 8)
