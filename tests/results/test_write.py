"""Writing results: all or nothing, whatever happens on the way."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, NoReturn

import pytest

from trochoid.kinematics.errors import TrochoidError
from trochoid.results import Outcome, Quantity, netcdf, prepare, vtk, write

FILES = ["results.json", "results.nc", "report.html", "fields.pvd"]


def _content(folder: Path) -> dict[str, str]:
    """Every file below `folder`, hidden ones too, with the hash of its content."""
    files = (path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


@pytest.fixture(scope="module")
def small(build_outcome: Callable[..., Outcome]) -> Outcome:
    return build_outcome(positions=4, frames=1, around=4, across=1, field_frames=2)


def _other(outcome: Outcome) -> Outcome:
    """The outcome of a later run: another number in every file, fewer fields."""
    assert outcome.dataset is not None
    film = outcome.films[0]
    angle, bodies = film.frames[0]
    return replace(
        outcome,
        title="another",
        quantities={"mass": Quantity(1.0, "kg")},
        dataset=outcome.dataset * 2.0,
        films=(replace(film, frames=((angle + 1.0, bodies[:1]),)),),
    )


@pytest.mark.exact
def test_all_files_are_there_and_nothing_else(small: Outcome, tmp_path: Path) -> None:
    """Contract: results.json, results.nc, report.html, *.vtu and *.pvd."""
    out = tmp_path / "deep" / "out"
    files = write(small, out)
    assert [path.name for path in files] == FILES
    vtu = {f"fields/disc_{disc}_{index:03d}.vtu" for disc in (1, 2) for index in range(2)}
    assert set(_content(out)) == set(FILES) | vtu
    assert json.loads((out / "results.json").read_text())["quantities"]["ratio"]["value"] == -19.0


@pytest.mark.exact
def test_writing_twice_gives_the_same_bytes(small: Outcome, tmp_path: Path) -> None:
    """No date and no random name in any file."""
    write(small, tmp_path / "a")
    write(small, tmp_path / "b")
    assert _content(tmp_path / "a") == _content(tmp_path / "b")


@pytest.mark.exact
def test_stale_files_go_and_foreign_files_stay(small: Outcome, tmp_path: Path) -> None:
    """The folder holds one run, and what others put there."""
    write(small, tmp_path)
    (tmp_path / "fields" / "mine.vtu").write_text("mine")
    (tmp_path / "notes.txt").write_text("mine")
    write(_other(small), tmp_path)
    assert set(_content(tmp_path)) == {*FILES, "fields/disc_1_000.vtu", "fields/mine.vtu", "notes.txt"}
    (tmp_path / "fields" / "mine.vtu").unlink()
    write(Outcome(scene={}, quantities={"ratio": Quantity(-19.0)}), tmp_path)
    assert set(_content(tmp_path)) == {"results.json", "report.html", "notes.txt"}
    assert not (tmp_path / "fields").exists()


def _at_call(number: int, error: BaseException, real: Callable[..., Any]) -> Callable[..., Any]:
    """A stand-in for `real` that raises `error` at its `number`-th call and works at all others."""
    calls = iter(range(1, 1000))

    def stand_in(*args: Any, **kwargs: Any) -> Any:
        if next(calls) == number:
            raise error
        return real(*args, **kwargs)

    return stand_in


@pytest.mark.property
@pytest.mark.parametrize("name", ["replace", "link"])
@pytest.mark.parametrize("number", range(1, 9))
def test_interrupted_while_files_move(
    small: Outcome, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, number: int
) -> None:
    """Ctrl-C at the n-th move: every file of the previous run is as it was, and no other is left."""
    write(_other(small), tmp_path)
    before = _content(tmp_path)
    with monkeypatch.context() as patch:
        patch.setattr(os, name, _at_call(number, KeyboardInterrupt(), getattr(os, name)))
        if name == "replace" or number <= 5:  # 5 files of the previous run are linked, 8 of the new one moved
            with pytest.raises(KeyboardInterrupt):
                write(small, tmp_path)
        else:
            write(small, tmp_path)
            before = _content(tmp_path)
    assert _content(tmp_path) == before
    assert netcdf.load(tmp_path / "results.nc").sizes["input_angle"] == 4
    assert len(vtk.listed_files(tmp_path / "fields.pvd")) == len(list((tmp_path / "fields").glob("*.vtu")))


@pytest.mark.property
def test_interrupted_while_stale_files_go(
    small: Outcome, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C at the second removal: the first stale file is back."""
    write(small, tmp_path)
    before = _content(tmp_path)
    monkeypatch.setattr(Path, "unlink", _at_call(2, KeyboardInterrupt(), Path.unlink))
    with pytest.raises(KeyboardInterrupt):
        write(_other(small), tmp_path)
    monkeypatch.undo()
    assert _content(tmp_path) == before


@pytest.mark.property
@pytest.mark.parametrize(
    "where", ["trochoid.results.netcdf.save", "trochoid.results.vtk.save_body", "trochoid.report.render"]
)
@pytest.mark.parametrize(
    "error", [KeyboardInterrupt(), OSError(errno.ENOSPC, "No space left on device"), ValueError("x")]
)
def test_failure_while_files_are_made(
    small: Outcome, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, where: str, error: BaseException
) -> None:
    """Nothing of the previous run is touched before all new files are complete."""
    write(small, tmp_path)
    before = _content(tmp_path)

    def fail(*_: Any) -> NoReturn:
        raise error

    monkeypatch.setattr(where, fail)
    expected = TrochoidError if isinstance(error, OSError) else type(error)
    with pytest.raises(expected, match="no space is left" if isinstance(error, OSError) else None):
        write(_other(small), tmp_path)
    assert _content(tmp_path) == before


@pytest.mark.property
def test_a_failed_first_run_leaves_no_folder(
    small: Outcome, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Folders made for the results go again."""
    monkeypatch.setattr(os, "replace", _at_call(3, KeyboardInterrupt(), os.replace))
    with pytest.raises(KeyboardInterrupt):
        write(small, tmp_path / "a" / "b")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.property
def test_files_without_links_are_copied(
    small: Outcome, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """File systems that know no hard links (FAT): the previous files survive all the same."""

    def refuse(*_: Any) -> NoReturn:
        raise OSError(errno.EPERM, "Operation not permitted")

    write(small, tmp_path)
    before = _content(tmp_path)
    monkeypatch.setattr(os, "link", refuse)
    monkeypatch.setattr(os, "replace", _at_call(4, KeyboardInterrupt(), os.replace))
    with pytest.raises(KeyboardInterrupt):
        write(_other(small), tmp_path)
    assert _content(tmp_path) == before


@pytest.mark.exact
@pytest.mark.parametrize("call", [prepare, lambda out: write(Outcome({}, {}), out)], ids=["prepare", "write"])
@pytest.mark.parametrize("below", ["", "deeper"])
def test_out_folder_that_is_a_file(tmp_path: Path, call: Callable[[Path], None], below: str) -> None:
    """The message names the folder and what to do."""
    file = tmp_path / "out"
    file.write_text("mine")
    with pytest.raises(
        TrochoidError, match=r"out.*is a file; move that, or choose another folder with --out"
    ):
        call(file / below if below else file)
    assert file.read_text() == "mine"


@pytest.mark.exact
@pytest.mark.parametrize("call", [prepare, lambda out: write(Outcome({}, {}), out)], ids=["prepare", "write"])
@pytest.mark.parametrize(
    ("number", "words"),
    [
        (errno.EACCES, "permission denied; make it writable"),
        (errno.EROFS, "permission denied; make it writable"),
        (errno.ENOSPC, "no space is left on its disk"),
        (errno.EIO, "Input/output error"),
    ],
)
def test_folder_that_the_system_refuses(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, call: Callable[[Path], None], number: int, words: str
) -> None:
    """Read-only folder, full disk, broken disk: folder, reason and advice in one line."""

    def refuse(*_: Any, **__: Any) -> NoReturn:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(tempfile, "mkdtemp", refuse)
    with pytest.raises(TrochoidError) as caught:
        call(tmp_path / "out")
    message = str(caught.value)
    assert str(tmp_path / "out") in message
    assert words in message
    assert "--out" in message
    assert "\n" not in message
    monkeypatch.undo()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.exact
@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write anywhere")
def test_read_only_folder(tmp_path: Path) -> None:
    """The same with a real folder."""
    tmp_path.chmod(0o500)
    try:
        with pytest.raises(TrochoidError, match="permission denied"):
            prepare(tmp_path / "out")
    finally:
        tmp_path.chmod(0o700)


@pytest.mark.exact
def test_prepare_leaves_no_trace(tmp_path: Path) -> None:
    """It only asks."""
    prepare(tmp_path / "a" / "b")
    prepare(tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.exact
def test_leftovers_of_killed_runs_go(tmp_path: Path) -> None:
    """A staging folder an hour old is cleared away; a fresh one may belong to a run that is still writing."""
    for name, age in (("old", 7200), ("new", 60)):
        folder = tmp_path / f".trochoid-{name}"
        (folder / "new").mkdir(parents=True)
        past = os.stat(folder).st_mtime - age
        os.utime(folder, (past, past))
    write(Outcome({}, {}), tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {".trochoid-new", "report.html", "results.json"}


@pytest.mark.property
def test_numbers_alone_load_nothing_heavy(tmp_path: Path) -> None:
    """`--ask ratio` must be quick: writing its results loads no plotting, mesh or array library."""
    code = """if True:
        import io, sys, pathlib
        from trochoid import results
        run = results.Outcome({}, {"ratio": results.Quantity(-19.0)})
        results.prepare(pathlib.Path(sys.argv[1]))
        results.show(run, results.write(run, pathlib.Path(sys.argv[1])), io.StringIO())
        heavy = {"scipy", "gmsh", "skfem", "pyvista", "vtk", "pint", "plotly", "xarray", "pandas", "meshio"}
        print(sorted(heavy & set(sys.modules)))
    """
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path)], capture_output=True, text=True, timeout=60
    )
    assert done.stdout.strip() == "[]", done.stderr
    assert len((tmp_path / "report.html").read_text()) < 100_000
