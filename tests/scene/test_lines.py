from __future__ import annotations

import tomllib
from typing import Any

import pytest

from trochoid.faults import Key
from trochoid.scene.lines import key_lines
from trochoid.starter import starter

ODD = '''a.b = 1
"x y".'c' = { d = 1, "e" = [1,
2, { f = 3 }] }
[t]
[[t.list]]
[[t.list]]
p = [ # comment
  # another
  1,
  2]
[t.list.under]
q = """
x = 3
"""
[[t.list.deep]]
r = 1
[[t.list.deep]]
r = 2
[u."é"]
v = 1
'''


def keys(value: Any, key: Key = ()) -> list[Key]:
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [key, *(inner for part, item in items for inner in keys(item, (*key, part)))]


@pytest.mark.independent
@pytest.mark.parametrize("text", [ODD, starter("khv")], ids=["odd", "starter"])
def test_every_key_has_a_line(text: str) -> None:
    """The keys that tree-sitter's grammar gives are those of the standard library's parser."""
    assert set(key_lines(text)) == set(keys(tomllib.loads(text)))


@pytest.mark.exact
def test_lines_are_where_the_keys_stand() -> None:
    """Counted by hand."""
    lines = key_lines(ODD)
    expected: dict[Key, int] = {
        ("a", "b"): 1,
        ("x y", "c", "d"): 2,
        ("x y", "c", "e", 0): 2,
        ("x y", "c", "e", 1): 3,
        ("x y", "c", "e", 2, "f"): 3,
        ("t",): 4,
        ("t", "list"): 5,
        ("t", "list", 1): 6,
        ("t", "list", 1, "p", 0): 9,
        ("t", "list", 1, "p", 1): 10,
        ("t", "list", 1, "under", "q"): 12,
        ("t", "list", 1, "deep", 1, "r"): 18,
        ("u", "é", "v"): 20,
    }
    assert {key: lines[key] for key in expected} == expected
