"""A folder of results that changes as a whole: all new files, or all old ones."""

from __future__ import annotations

import errno
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from trochoid.kinematics.errors import TrochoidError

_PREFIX = ".trochoid-"
_ABANDONED = 3600.0  # s after which the staging folder of a killed run is cleared away
_FULL = (errno.ENOSPC, errno.EDQUOT)
_DENIED = (errno.EACCES, errno.EPERM, errno.EROFS)


def prepare(out_dir: Path) -> None:
    """Raise TrochoidError if results cannot be written into `out_dir`, which need not exist yet."""
    with explained(out_dir):
        existing = next(
            folder for folder in (out_dir.absolute(), *out_dir.absolute().parents) if os.path.lexists(folder)
        )
        os.rmdir(tempfile.mkdtemp(prefix=_PREFIX, dir=existing))


@contextmanager
def replaced(out_dir: Path, stale: Callable[[], Sequence[Path]]) -> Iterator[Path]:
    """Yield a staging folder; when the body ends well its files move into `out_dir` and the `stale` ones go.

    Whatever is raised on the way (Ctrl-C included), the previous files are all in their places again.
    The staging folder lies inside `out_dir`, so that every move stays on one file system.
    Raises TrochoidError for what the system refuses.
    """
    created = [folder for folder in (out_dir.absolute(), *out_dir.absolute().parents) if not folder.exists()]
    done = False
    try:
        with explained(out_dir):
            out_dir.mkdir(parents=True, exist_ok=True)
            _clear_abandoned(out_dir)
            staging = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=out_dir))
            try:
                (staging / "new").mkdir()
                yield staging / "new"
                _exchange(staging / "new", out_dir, staging / "old", stale())
            finally:
                shutil.rmtree(staging, ignore_errors=True)
            done = True
    finally:
        if not done:
            with suppress(OSError):
                for folder in created:
                    folder.rmdir()


@contextmanager
def explained(out_dir: Path) -> Iterator[None]:
    """Turn what the system refuses into a TrochoidError that names the folder and says what to do."""
    try:
        yield
    except OSError as error:
        raise TrochoidError(_advice(out_dir, error)) from error


def _advice(out_dir: Path, error: OSError) -> str:
    if error.errno in _FULL:
        reason = "no space is left on its disk; free some"
    elif error.errno in (errno.ENOTDIR, errno.EEXIST):
        reason = "it, or a folder above it, is a file; move that"
    elif error.errno in _DENIED:
        reason = "permission denied; make it writable"
    else:
        reason = f"{error.strerror or error}; correct that"
    return f"cannot write results into {out_dir}: {reason}, or choose another folder with --out"


def _exchange(new: Path, out_dir: Path, old: Path, stale: Sequence[Path]) -> None:
    """Move `new` into `out_dir`, results.json last, remove `stale`; undo it all when anything is raised."""
    names = sorted(
        (path.relative_to(new) for path in new.rglob("*") if path.is_file()),
        key=lambda n: (n.name == "results.json", n),
    )
    kept: list[tuple[Path, Path | None]] = []
    try:
        for name in names:
            (out_dir / name).parent.mkdir(parents=True, exist_ok=True)
            kept.append((out_dir / name, _keep(out_dir / name, old / name)))
            os.replace(new / name, out_dir / name)
        for path in (path for path in stale if path.is_file() and path.relative_to(out_dir) not in names):
            kept.append((path, _keep(path, old / path.relative_to(out_dir))))
            path.unlink()
    except BaseException:
        _restore(kept)
        raise
    finally:
        for folder in {path.parent for path, _ in kept} - {out_dir}:
            with suppress(OSError):
                folder.rmdir()


def _keep(path: Path, copy: Path) -> Path | None:
    """Return a second name of the file at `path` (a link, or else a copy), None if there is no file."""
    if not os.path.lexists(path):
        return None
    copy.parent.mkdir(parents=True, exist_ok=True)
    try:
        os.link(path, copy)
    except OSError:
        shutil.copy2(path, copy)
    return copy


def _restore(kept: Sequence[tuple[Path, Path | None]]) -> None:
    for path, copy in reversed(kept):
        if copy is None:
            path.unlink(missing_ok=True)
        else:
            path.parent.mkdir(exist_ok=True)
            os.replace(copy, path)


def _clear_abandoned(out_dir: Path) -> None:
    for folder in out_dir.glob(f"{_PREFIX}*"):
        if time.time() - folder.stat().st_mtime > _ABANDONED:
            shutil.rmtree(folder, ignore_errors=True)
