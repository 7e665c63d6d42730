"""All files of one run."""

from __future__ import annotations

from pathlib import Path

from trochoid.results.document import to_json
from trochoid.results.folder import replaced
from trochoid.results.outcome import Outcome

FILES = ("results.json", "results.nc", "report.html")


def write(outcome: Outcome, out_dir: Path) -> tuple[Path, ...]:
    """Write results.json, report.html and, where there is something for them, results.nc and films.

    Returns the files, without the .vtu ones that a .pvd opens. What only a previous run had is removed;
    the folder holds one run. Raises TrochoidError when it cannot be written; it is then as it was.
    """
    out_dir = Path(out_dir)
    with replaced(out_dir, lambda: stale_files(out_dir)) as staging:
        _write_into(outcome, staging)
        names = [name for name in FILES if (staging / name).is_file()]
        names += [f"{film.name}.pvd" for film in outcome.films]
    return tuple(out_dir / name for name in names)


def stale_files(out_dir: Path) -> tuple[Path, ...]:
    """Return what a previous run left in `out_dir`."""
    from trochoid.results import vtk

    return (*(out_dir / name for name in FILES), *vtk.saved(out_dir))


def _write_into(outcome: Outcome, folder: Path) -> None:
    if outcome.dataset is not None:
        from trochoid.results import netcdf

        netcdf.save(outcome.dataset, folder / "results.nc")
    if outcome.films:
        from trochoid.results import vtk

        for film in outcome.films:
            vtk.save(film, folder)
    from trochoid.report import render

    (folder / "report.html").write_text(render(outcome), encoding="utf-8")
    (folder / "results.json").write_text(to_json(outcome), encoding="utf-8")
