"""The files of a study: accuracy.json, accuracy.svg and accuracy.html."""

from __future__ import annotations

from pathlib import Path

from trochoid.accuracy.document import to_json
from trochoid.accuracy.page import render
from trochoid.accuracy.plot import svg
from trochoid.accuracy.study import Study
from trochoid.results.folder import replaced

FILES = ("accuracy.json", "accuracy.svg", "accuracy.html")


def write(study: Study, out_dir: Path) -> tuple[Path, ...]:
    """Write the files, all or none; a run's results in the same folder stay.

    Raises TrochoidError when the folder cannot be written; it is then as it was.
    """
    with replaced(out_dir, tuple) as staging:
        for name, text in zip(FILES, (to_json(study), svg(study), render(study)), strict=True):
            (staging / name).write_text(text, encoding="utf-8")
    return tuple(out_dir / name for name in FILES)
