"""The errors a user may meet; every message says what was given, what is allowed, what to do."""

from __future__ import annotations


class TrochoidError(Exception):
    """Base of all errors that are reported to a user without a traceback."""


class SceneError(TrochoidError):
    """The scene or the command line is wrong."""


class Infeasible(TrochoidError):
    """The geometry cannot be built; the message names the limit and the nearest feasible value."""


class NotConverged(TrochoidError):
    """A solver did not converge; the message says where and what to try. `row`: which of many side by side."""

    def __init__(self, message: str, row: int | None = None) -> None:
        """Keep the number beside the message."""
        super().__init__(message)
        self.row = row
