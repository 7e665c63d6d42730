"""The program and its terminal: progress, signals, closed pipes, and errors that nobody foresaw."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress


def one_thread() -> None:
    """Keep linear algebra to one thread: its matrices are small, and thread pools that meet are ten times slower.

    Must come before numpy is loaded; a number of threads that the user has set stays.
    """
    for pool in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS"):
        os.environ.setdefault(pool, "1")


@contextmanager
def progress() -> Iterator[Callable[[str], None]]:
    """Yield what announces a stage: a status line on a terminal, nothing in a pipe."""
    if not sys.stderr.isatty():
        yield lambda stage: None
        return
    from rich.console import Console
    from rich.markup import escape

    with Console(stderr=True).status("starting") as status:
        yield lambda stage: status.update(escape(stage))


@contextmanager
def stoppable() -> Iterator[None]:
    """Let a termination signal end the program as Ctrl-C does, so that half-written results go away."""

    def stop(number: int, frame: object) -> None:
        raise KeyboardInterrupt

    try:
        before = signal.signal(signal.SIGTERM, stop)
    except ValueError:  # not in the main thread
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def flush() -> None:
    """Write out what is left in the buffer now, where it can still be noticed that nobody reads it."""
    if sys.stdout is not None:
        sys.stdout.flush()


def forget_stdout() -> None:
    """Send what is left in the buffer nowhere: the interpreter would complain about the closed pipe."""
    with suppress(OSError, ValueError, AttributeError):
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, sys.stdout.fileno())
        os.close(null)


def defect(error: Exception) -> str:
    """Return what to say about an error that nobody foresaw; its traceback goes to a file."""
    import tempfile
    import traceback

    text = f"trochoid: a defect of the program ({type(error).__name__}: {error})"
    try:
        with tempfile.NamedTemporaryFile(
            "w", prefix="trochoid-", suffix=".txt", delete=False, encoding="utf-8"
        ) as file:
            traceback.print_exception(error, file=file)
    except OSError:
        return text
    return f"{text}; please report it with {file.name}"
