"""Numbers with the error that two mesh levels suggest, shared by all answers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.khv.estimate import scalar_error
from trochoid.drives.khv.stages import Stages
from trochoid.drives.mesh_error import Pair, sampling_error
from trochoid.fem.rows import taken
from trochoid.results.outcome import Quantity

if TYPE_CHECKING:
    from trochoid.drives.khv.series import Series


def number(s: Stages, pair: Pair[float], unit: str, model: str | None = None) -> Quantity:
    """Return a number, its error, and the model that gave it (the contact model unless named)."""
    error = None if pair.coarse is None else scalar_error(pair.fine, pair.coarse, s.difference)
    return Quantity(pair.fine, unit, error, model or s.rung)


def over_turn(s: Stages, get: Callable[[Series], float], unit: str) -> Quantity:
    """Return a number of the contacts over a turn; its error is that of the mesh and of few positions."""
    found = number(s, Pair(s.contact.fine, s.contact.coarse).map(get), unit)
    if found.error is None:
        return found
    few = sampling_error(get, s.contact.fine, lambda stride: _thinned(s.contact.fine, stride))
    return replace(found, error=found.error + few)


def _thinned(series: Series, stride: int) -> Iterator[Series]:
    """Yield every so-manieth position of a turn, from each of the first on; a last one stands for the first of them."""
    count = len(series.angle) - 1
    for start in range(stride) if count >= stride else ():
        rows = np.arange(start, count, stride)
        yield taken(series, np.append(rows, rows[0] if start else count))
