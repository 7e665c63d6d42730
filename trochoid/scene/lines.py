"""Where each key of a TOML text is written; imported only when there is a fault to place."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from typing import TypeAlias

import tree_sitter_toml
from tree_sitter import Language, Node, Parser

from trochoid.faults import Key

Lines: TypeAlias = dict[Key, int]


def key_lines(text: str) -> Lines:
    """Return the line (from 1) of every table, key and list entry; the first of several for one key."""
    root = Parser(Language(tree_sitter_toml.language())).parse(text.encode()).root_node
    lines: Lines = {(): 1}
    counts: dict[Key, int] = {}
    for node in root.named_children:
        if node.type == "pair":
            _add_pair(lines, (), node)
        elif node.type in ("table", "table_array_element"):
            key = _header(lines, counts, node)
            for pair in node.named_children[1:]:
                if pair.type == "pair":
                    _add_pair(lines, key, pair)
    return lines


def _header(lines: Lines, counts: dict[Key, int], node: Node) -> Key:
    """Return the key of a table header, with the numbers of list entries around it, and note its line."""
    key: Key = ()
    parts = list(_parts(node.named_children[0]))
    for depth, part in enumerate(parts):
        key = (*key, part)
        lines.setdefault(key, _line(node))
        last = depth == len(parts) - 1
        if last and node.type == "table_array_element":
            counts[key] = counts.get(key, -1) + 1
        if key in counts:
            key = (*key, counts[key])
            lines.setdefault(key, _line(node))
    return key


def _add_pair(lines: Lines, table: Key, pair: Node) -> None:
    name, value = pair.named_children[0], pair.named_children[-1]
    key = table
    for part in _parts(name):
        key = (*key, part)
        lines.setdefault(key, _line(pair))
    _add_value(lines, key, value)


def _add_value(lines: Lines, key: Key, value: Node) -> None:
    if value.type == "inline_table":
        for pair in value.named_children:
            if pair.type == "pair":
                _add_pair(lines, key, pair)
    elif value.type == "array":
        entries = [entry for entry in value.named_children if entry.type != "comment"]
        for index, entry in enumerate(entries):
            lines.setdefault((*key, index), _line(entry))
            _add_value(lines, (*key, index), entry)


def _parts(name: Node) -> Iterator[str]:
    if name.type == "dotted_key":
        for child in name.named_children:
            yield from _parts(child)
        return
    text = (name.text or b"").decode()
    yield next(iter(tomllib.loads(f"{text} = 0"))) if name.type == "quoted_key" else text


def _line(node: Node) -> int:
    return node.start_point[0] + 1
