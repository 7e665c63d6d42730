"""Numbers with the error that two mesh levels suggest, shared by all answers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from trochoid.drives.khv.estimate import scalar_error
from trochoid.drives.khv.stages import Stages
from trochoid.drives.mesh_error import Pair
from trochoid.results.outcome import Quantity

if TYPE_CHECKING:
    from trochoid.drives.khv.series import Series


def number(s: Stages, pair: Pair[float], unit: str, model: str | None = None) -> Quantity:
    """Return a number, its error, and the model that gave it (the contact model unless named)."""
    error = None if pair.coarse is None else scalar_error(pair.fine, pair.coarse, s.difference)
    return Quantity(pair.fine, unit, error, model or s.rung)


def over_turn(s: Stages, get: Callable[[Series], float], unit: str) -> Quantity:
    """Return a number of the contacts over a turn."""
    return number(s, Pair(s.contact.fine, s.contact.coarse).map(get), unit)
