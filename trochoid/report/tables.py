"""Quantities and scene as tiles and tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from trochoid.results import text
from trochoid.results.outcome import Parts, Quantity

_TILE = 4  # parts that still fit into a tile
_WIDE = 6  # columns that still fit beside each other
Leaf = tuple[str, Quantity]


@dataclass(frozen=True, slots=True)
class Number:
    """A value as shown, with the name that it has among its like."""

    name: str
    value: str
    error: str
    unit: str


@dataclass(frozen=True, slots=True)
class Tile:
    """A headline: one large number, or a few."""

    name: str
    numbers: tuple[Number, ...]
    model: str
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Row:
    """A row of a table: its name, its cells, and a remark."""

    name: str
    cells: tuple[str, ...]
    note: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """A table with a heading; `head` names the columns where there is more than one."""

    title: str
    rows: tuple[Row, ...]
    head: tuple[str, ...] = ()
    model: str = ""
    note: str = ""


def tiles_of(quantities: Mapping[str, Quantity]) -> list[Tile]:
    """Return the quantities that are one value or a few."""
    return [_tile(name, quantity) for name, quantity in quantities.items() if _fits(quantity)]


def tables_of(quantities: Mapping[str, Quantity]) -> list[Table]:
    """Return the other quantities; where several things have the same parts, a row per thing, or a column per thing
    where these are many; things with other parts have tables of their own.
    """
    return [
        table
        for name, quantity in quantities.items()
        if not _fits(quantity)
        for table in _tables(name, quantity)
    ]


def scene_tables(scene: Mapping[str, Any]) -> list[Table]:
    """Return one table per table of the scene, keys with dots below that."""
    tables, loose = [], []
    for name, entry in scene.items():
        if isinstance(entry, (Mapping, list)) and entry:
            tables.append(Table(name, tuple(Row(key, (value,)) for key, value in _keys(entry))))
        else:
            loose.append(Row(name, (_literal(entry),)))
    return [*([Table("", tuple(loose))] if loose else []), *tables]


def _fits(quantity: Quantity) -> bool:
    parts = quantity.parts
    return parts is None or (len(parts) <= _TILE and all(_is_leaf(part) for part in parts.values()))


def _tile(name: str, quantity: Quantity) -> Tile:
    leaves = list(_leaves(quantity.parts)) if quantity.parts is not None else [("", quantity)]
    notes = [f"{text.label(part)}: {leaf.note}" for part, leaf in leaves if part and leaf.note]
    model = quantity.model or _shared_model(leaves)
    return Tile(
        text.label(name),
        tuple(_number(part, leaf) for part, leaf in leaves),
        model,
        (*([quantity.note] if quantity.note else []), *notes),
    )


def _number(name: str, quantity: Quantity) -> Number:
    value, error = text.value_and_error(quantity.value, quantity.error)
    return Number(text.label(name), value, error, text.pretty_unit(quantity.unit))


def _tables(name: str, quantity: Quantity) -> list[Table]:
    """Return one table of a quantity, or one for each run of parts that are alike, where there are such runs."""
    runs: list[dict[str, Quantity | Parts]] = []
    for key, part in (quantity.parts or {}).items():
        alike = runs and _shared_columns([*map(_inner, runs[-1].values()), _inner(part)])
        if alike or (runs and not _columns(runs[-1]) and not _columns({key: part, "": part})):
            runs[-1][key] = part
        else:
            runs.append({key: part})
    if not any(_columns(run) for run in runs):
        return [_table(name, quantity)]
    tables = [_table(name, replace(quantity, parts=run, note=None)) for run in runs]
    return [*tables[:-1], replace(tables[-1], note=quantity.note or "")]


def _columns(parts: Parts) -> tuple[str, ...]:
    return _shared_columns([_inner(part) for part in parts.values()])


def _table(name: str, quantity: Quantity) -> Table:
    parts = quantity.parts or {}
    leaves = list(_leaves(parts))
    model = quantity.model or _shared_model(leaves)
    groups = [(key, _inner(part)) for key, part in parts.items()]
    columns = _shared_columns([group for _, group in groups])
    if len(columns) > _WIDE:
        rows = [Row(text.label(c), tuple(_cell(group[c], "") for _, group in groups)) for c in columns]
        return Table(
            text.label(name), tuple(rows), tuple(text.label(k) for k, _ in groups), model, quantity.note or ""
        )
    units = {column: _shared_unit([group[column] for _, group in groups]) for column in columns}
    head = tuple(f"{text.label(c)} ({units[c]})" if units[c] else text.label(c) for c in columns)
    if columns:
        rows = [Row(text.label(k), tuple(_cell(group[c], units[c]) for c in columns)) for k, group in groups]
    else:
        rows = [_row(path, leaf, "" if model else leaf.model or "") for path, leaf in leaves]
    return Table(text.label(name), tuple(rows), head, model, quantity.note or "")


def _row(path: str, leaf: Quantity, model: str) -> Row:
    return Row(text.label(path), (text.sentence(leaf),), " · ".join(filter(None, (model, leaf.note))))


def _leaves(parts: Parts, path: str = "") -> Iterator[Leaf]:
    """Yield the values among nested parts with the path to each."""
    for name, part in parts.items():
        here = f"{path} · {text.spoken(name)}" if path else name
        if isinstance(part, Quantity) and part.parts is None:
            yield here, part
        else:
            yield from _leaves(_inner(part), here)


def _shared_model(leaves: Sequence[Leaf]) -> str:
    models = {leaf.model for _, leaf in leaves}
    return models.pop() or "" if len(models) == 1 else ""


def _shared_columns(groups: Sequence[Parts]) -> tuple[str, ...]:
    """Return the keys of `groups` when all have the same ones and these are values; else nothing."""
    if len(groups) < 2 or not groups[0] or any(list(group) != list(groups[0]) for group in groups):
        return ()
    return tuple(groups[0]) if all(_is_leaf(part) for group in groups for part in group.values()) else ()


def _inner(part: Quantity | Parts) -> Parts:
    return (part.parts or {}) if isinstance(part, Quantity) else part


def _is_leaf(part: Quantity | Parts) -> bool:
    return isinstance(part, Quantity) and part.parts is None


def _shared_unit(column: Sequence[Quantity | Parts]) -> str:
    """Return the unit that all of a column have, which its head then names; else nothing."""
    units = {part.unit for part in column if isinstance(part, Quantity)}
    return text.pretty_unit(units.pop()) if len(units) == 1 else ""


def _cell(part: Quantity | Parts, named: str) -> str:
    """Return the value, without its unit where the column's head has `named` it."""
    if not isinstance(part, Quantity):
        return ""
    return text.sentence(replace(part, unit="") if named else part)


def _keys(entry: Any, path: str = "") -> Iterator[tuple[str, str]]:
    if isinstance(entry, Mapping) and entry:
        for key, item in entry.items():
            yield from _keys(item, f"{path}.{key}" if path else str(key))
    elif isinstance(entry, list) and any(isinstance(item, Mapping) for item in entry):
        for index, item in enumerate(entry, start=1):
            yield from _keys(item, f"{path} {index}".strip())
    else:
        yield path, _literal(entry)


def _literal(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_literal, value))}]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return "–" if value is None else text.number(value, 8)
