"""What the mechanisms and their faults are called."""

from __future__ import annotations

from trochoid.kinematics.indexer_synthesis import Fault, Solution

SAME_TIME = "geneva_wheel_in_same_time"
NAMES = {"indexer": "indexer", "geneva_wheel": "Geneva wheel", SAME_TIME: "Geneva wheel in the same time"}

FAULT_WORDS: dict[Fault, str] = {
    "": "serves",
    "swing": "turns by another angle",
    "reverses": "turns back on its way",
    "returns": "pin comes back in the dwell",
}


def name_of(solution: Solution) -> str:
    """Return as in "hypo near"."""
    return f"{solution.kind} {solution.place}"


def path_words(solution: Solution) -> str:
    """Return what the pin's path is, as in "near hypotrochoid, 4 loops"."""
    path = solution.indexer.path
    lobes = round(abs(path.ratio))
    if solution.cusp or abs(path.pin_ratio - 1.0) < 1e-9:
        shape = f"{lobes} cusps"
    elif path.pin_ratio > 1.0:
        shape = f"{lobes} loops"
    else:
        shape = f"{lobes} waves"
    return f"{solution.kind}trochoid, pin {solution.place} in mid-index, {shape}"
