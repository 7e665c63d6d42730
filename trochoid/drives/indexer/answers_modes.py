"""Answer about natural frequencies over the index and in the dwell, the spherical Geneva wheel's beside."""

from __future__ import annotations

import math

from trochoid.drives.indexer.modes import Modes
from trochoid.drives.indexer.pin import Pair
from trochoid.drives.indexer.stages import Stages
from trochoid.results.outcome import Parts, Quantity

UNLOADED = "nothing presses the pin: no contact to hold the wheel"


def natural_frequencies(s: Stages) -> Quantity:
    """Frequencies of wheel and load on pin contact and shaft, frozen positions; in the dwell locked and free."""
    rows: dict[str, Parts | Quantity] = {
        name: _rows(s.modes[name], pair) if name in s.modes else Quantity("unloaded", note=UNLOADED)
        for name, pair in s.pairs.items()
    }
    lock = "given" if s.scene.drive.wheel.lock_stiffness else "as stiff as the pin at the end of the index"
    return Quantity(
        parts=rows,
        note=f"output alone, the arm turns at a given speed; index: on the pin, dwell: on the lock ({lock}), or free",
    )


def _rows(x: Modes, pair: Pair) -> Parts:
    row: dict[str, Quantity] = {}
    for i in range(x.index.shape[1]):
        over, share = x.index[:, i], x.parts[:, i]
        error = None if pair.doubt is None else 0.5 * pair.doubt  # √k; less where the shaft shares the mode
        for key, at in (("least", int(over.argmin())), ("largest", int(over.argmax()))):
            off = None if error is None else error * share[at] * float(over[at])
            name = f"mode_{i + 1}_{key}_in_index"
            row[name] = Quantity(float(over[at]), "Hz", off, "frozen")
            row[f"{name}_at"] = Quantity(math.degrees(float(x.angle[at])), "deg", None, "frozen")
        row[f"mode_{i + 1}_pin_share_of_energy"] = Quantity(float(share.mean()), "", None, "frozen")
    for i, value in enumerate(x.locked):
        row[f"mode_{i + 1}_locked_in_dwell"] = Quantity(float(value), "Hz", None, "frozen")
    for i, value in enumerate(x.free):
        if value > 0.0:
            row[f"mode_{i + 1}_free_in_dwell"] = Quantity(float(value), "Hz", None, "frozen")
        else:
            row[f"mode_{i + 1}_free_in_dwell"] = Quantity("turns freely", model="exact")
    return row
