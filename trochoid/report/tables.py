"""Quantities and scene as tiles and tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from trochoid.results import text
from trochoid.results.outcome import Parts, Quantity

_TILE = 4  # parts that still fit into a tile
_WIDE = 6  # columns that still fit beside each other
_HALF = 42  # characters that fit side by side into half of the page
_LONG = 140  # characters of a remark that is too long for a tile
_WORST = "worst"  # the number of each thing that is its headline
_ALONE = 3  # parts with which a thing by itself has a table of its own
Leaf = tuple[str, Quantity]
Group = tuple[str, Mapping[str, Quantity]]


@dataclass(frozen=True, slots=True)
class Number:
    """A value as shown, with the name that it has among its like."""

    name: str
    value: str
    error: str
    unit: str


@dataclass(frozen=True, slots=True)
class Tile:
    """A headline: one large number, or a few; `more` is a remark too long to stand in it."""

    name: str
    numbers: tuple[Number, ...]
    model: str
    notes: tuple[str, ...]
    more: str = ""


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

    @property
    def wide(self) -> bool:
        """Whether its columns need the whole width of the page."""
        if not self.head:
            return False
        lines = [("", self.head), *((row.name, row.cells) for row in self.rows)]
        columns = zip(*((name, *cells) for name, cells in lines), strict=False)
        return len(self.head) > 2 or sum(max(map(len, column)) for column in columns) > _HALF


def tiles_of(quantities: Mapping[str, Quantity]) -> list[Tile]:
    """Return the quantities that are one value or a few, and the worst of each thing of others."""
    made = []
    for name, quantity in quantities.items():
        if _fits(quantity):
            made.append(_tile(name, quantity))
        elif (worst := _worst(quantity)) is not None:
            made.append(_tile(f"{name} · {_WORST}", worst))
    return made


def tables_of(quantities: Mapping[str, Quantity]) -> list[Table]:
    """Return the other quantities; where several things have the same parts, a row per thing, or a column per thing
    where the parts are many; a thing with parts of its own has a table of its own.
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


def _worst(quantity: Quantity) -> Quantity | None:
    """Return the worst of each thing, of many things the largest alone; None where nothing is called so."""
    things = {name: _inner(part) for name, part in (quantity.parts or {}).items() if not _is_leaf(part)}
    found = {name: part[_WORST] for name, part in things.items() if _WORST in part}
    leaves = {name: leaf for name, leaf in found.items() if isinstance(leaf, Quantity) and leaf.parts is None}
    if not leaves or len(leaves) < len(found):
        return None
    if len(leaves) > _TILE:
        sizes = {name: leaf.value for name, leaf in leaves.items() if isinstance(leaf.value, float)}
        most = max(sizes, key=lambda name: sizes[name], default=next(iter(leaves)))
        leaves = {most: leaves[most]}
    return Quantity(
        parts={name: replace(leaf, note=None) for name, leaf in leaves.items()}, model=quantity.model
    )


def _tile(name: str, quantity: Quantity) -> Tile:
    leaves = list(_leaves(quantity.parts)) if quantity.parts is not None else [("", quantity)]
    notes = [f"{text.label(part)}: {leaf.note}" for part, leaf in leaves if part and leaf.note]
    model = quantity.model or _shared_model(leaves)
    said = (*([quantity.note] if quantity.note else []), *notes)
    long = len("; ".join(said)) > _LONG
    numbers = tuple(_number(part, leaf) for part, leaf in leaves)
    return Tile(text.label(name), numbers, model, () if long else said, "; ".join(said) if long else "")


def _number(name: str, quantity: Quantity) -> Number:
    value, error = text.value_and_error(quantity.value, quantity.error)
    return Number(text.label(name), value, error, text.pretty_unit(quantity.unit))


def _tables(name: str, quantity: Quantity) -> list[Table]:
    """Return the tables of a quantity: one for groups that are alike, one for a group by itself, one for the rest."""
    made: list[Table] = []
    for run in _runs(list(_groups(quantity.parts or {}))):
        model = quantity.model or _shared_model([leaf for _, group in run for leaf in group.items()])
        if len(run) > 1:
            made.append(_grid(name, run, model))
            continue
        path, group = run[0]
        alone = bool(path) and len(group) >= _ALONE
        rows = tuple(
            _row(
                leaf if alone or not path else f"{path} · {text.spoken(leaf)}",
                entry,
                "" if model else entry.model,
            )
            for leaf, entry in group.items()
        )
        title = text.label(f"{name} · {path}") if alone else text.label(name)
        if made and not alone and not made[-1].head and made[-1].title == title and made[-1].model == model:
            made[-1] = replace(made[-1], rows=made[-1].rows + rows)
        else:
            made.append(Table(title, rows, (), model))
    if not made:
        return []
    note = "; ".join(filter(None, (made[-1].note, quantity.note)))
    return [*made[:-1], replace(made[-1], note=note)]


def _grid(name: str, run: Sequence[Group], model: str) -> Table:
    """Return groups with the same keys as rows, or as columns where the keys are many."""
    keys = list(run[0][1])
    names = [text.label(path) for path, _ in run]
    if len(keys) > _WIDE:
        rows = [
            Row(text.label(key), tuple(_cell(group[key], "") for _, group in run), _shared_note(run, key))
            for key in keys
        ]
        return Table(text.label(name), tuple(rows), tuple(names), model)
    units = {key: _shared_unit([group[key] for _, group in run]) for key in keys}
    head = tuple(f"{text.label(key)} ({units[key]})" if units[key] else text.label(key) for key in keys)
    rows = [
        Row(label, tuple(_cell(group[key], units[key]) for key in keys))
        for label, (_, group) in zip(names, run, strict=True)
    ]
    said = [f"{text.label(key)}: {note}" for key in keys if (note := _shared_note(run, key))]
    return Table(text.label(name), tuple(rows), head, model, "; ".join(said))


def _shared_note(run: Sequence[Group], key: str) -> str:
    """Return the remark on a number that all things have."""
    notes = {group[key].note or "" for _, group in run}
    return notes.pop() if len(notes) == 1 else ""


def _groups(parts: Parts, path: str = "") -> Iterator[Group]:
    """Yield the values that stand together among nested parts, with the path to them ("" for the outermost)."""
    loose: dict[str, Quantity] = {}
    for name, part in parts.items():
        if isinstance(part, Quantity) and part.parts is None:
            loose[name] = part
            continue
        if loose:
            yield path, loose
            loose = {}
        yield from _groups(_inner(part), f"{path} · {text.spoken(name)}" if path else name)
    if loose:
        yield path, loose


def _runs(groups: Sequence[Group]) -> list[list[Group]]:
    """Return neighbouring groups with the same keys together."""
    runs: list[list[Group]] = []
    for path, group in groups:
        if path and runs and runs[-1][-1][0] and list(runs[-1][-1][1]) == list(group):
            runs[-1].append((path, group))
        else:
            runs.append([(path, group)])
    return runs


def _row(path: str, leaf: Quantity, model: str | None) -> Row:
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


def _inner(part: Quantity | Parts) -> Parts:
    return (part.parts or {}) if isinstance(part, Quantity) else part


def _is_leaf(part: Quantity | Parts) -> bool:
    return isinstance(part, Quantity) and part.parts is None


def _shared_unit(column: Sequence[Quantity]) -> str:
    """Return the unit that all of a column have, which its head then names; else nothing."""
    units = {part.unit for part in column}
    return text.pretty_unit(units.pop()) if len(units) == 1 else ""


def _cell(part: Quantity, named: str) -> str:
    """Return the value, without its unit where the column's head has `named` it."""
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
