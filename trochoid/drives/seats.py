"""Where a drive presses its casing: wrenches by the names of its places, brought to the bores that hold these."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from trochoid.dynamics.wrench import Wrench, balance_residual, moved, total
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, frozen

Triple = tuple[float, float, float]
NOTHING = 1e-12  # of the largest load, what rounding leaves of none


def on_bores(
    loads: Mapping[str, Wrench], bores: Mapping[str, Triple], holds: Mapping[str, Sequence[str]]
) -> dict[str, Wrench]:
    """Return what bores with these middles (m) feel, which hold the places of `loads` by name.

    One bore takes the whole of a place that it holds; two share it as two bearings of a rigid shaft do. Raises
    Infeasible for a load that no bore holds, and for two bores of one place side by side.
    """
    parts: dict[str, list[Wrench]] = {name: [] for name in bores}
    largest = max(load.gross[0] for load in loads.values())
    for place, load in loads.items():
        held = [name for name, places in holds.items() if place in places]
        if len(held) == 1:
            parts[held[0]].append(load)
        elif len(held) == 2:
            for name, share in zip(held, _shared(load, place, *(bores[name] for name in held)), strict=True):
                parts[name].append(share)
        elif np.abs(load.force).max(initial=0.0) > NOTHING * largest or load.moment.any():
            raise Infeasible(
                f'casing: "{place}" is pressed with up to {np.linalg.norm(load.force, axis=1).max():.4g} N, and no '
                f"bore holds it; put it into the holds of one of the [[casing.bores]] {', '.join(bores)}"
            )
    return {name: total(each) for name, each in parts.items() if each}


def seats_residual(loads: Mapping[str, Wrench], whole: Wrench) -> float:
    """Return how far the sum of loads by name is from the resultant, relative to what was summed."""
    return balance_residual([*loads.values(), Wrench(-whole.force, -whole.moment, whole.about)])


def _shared(load: Wrench, place: str, first: Triple, second: Triple) -> tuple[Wrench, Wrench]:
    """Return the shares of two bores: by moments across the line between them, half of what acts along it."""
    way = np.subtract(second, first)
    length = float(np.linalg.norm(way))
    if not length > 0.0:
        raise Infeasible(f'casing: two bores in one place hold "{place}": let one of them hold it')
    at = moved(load, first)
    along: Array = way / length
    pull, twist = ((vectors @ along)[:, None] * along for vectors in (at.force, at.moment))
    far = np.cross(at.moment, along) / length + 0.5 * pull
    half = frozen(0.5 * twist)
    # sizes of what was summed go with the load: the shares are of it
    return (
        Wrench(frozen(at.force - far), half, frozen(first), at.gross),
        Wrench(frozen(far), half, frozen(second), at.gross),
    )
