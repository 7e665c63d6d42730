"""Columns of numbers as a .csv file."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any


def write_table(path: Path, columns: Mapping[str, Any]) -> str:
    """Write columns of any lengths under their names, the whole file or nothing; return what was written."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(columns)
    longest = max(len(values) for values in columns.values())
    for row in range(longest):
        table.writerow([repr(float(v[row])) if row < len(v) else "" for v in columns.values()])
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        part.write_text(text.getvalue(), encoding="utf-8")
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
    return f"{len(columns)} columns of up to {longest} points"
