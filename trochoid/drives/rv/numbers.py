"""Numbers with the error that two mesh levels suggest, shared by all answers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from trochoid.drives.mesh_error import Pair, sampling_error, scalar_error
from trochoid.drives.rv.stages import Stages
from trochoid.fem.rows import taken
from trochoid.results.outcome import Quantity

if TYPE_CHECKING:
    from trochoid.drives.rv.series import Series


def number(s: Stages, value: float, both: Pair[float], unit: str, model: str | None = None) -> Quantity:
    """Return a number, its error from two mesh levels, and the model that gave it (the contact model unless named)."""
    error = None if both.coarse is None else scalar_error(both.fine, both.coarse, s.difference)
    return Quantity(value, unit, error, model or s.rung)


def over_turn(s: Stages, get: Callable[[Series], float], unit: str) -> Quantity:
    """Return a number of the contacts over a turn of the crankshafts.

    Its error is that of the mesh, from every fourth position, and of few positions.
    """
    whole = s.contact.fine
    value, both = get(whole), s.contact.pair.map(get)
    coarse = both.fine if both.coarse is None else both.coarse
    few = sampling_error(get, whole, lambda m: (taken(whole, slice(start, None, m)) for start in range(m)))
    return Quantity(value, unit, scalar_error(both.fine, coarse, s.difference) + few, s.rung)
