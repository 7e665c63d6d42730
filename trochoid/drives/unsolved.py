"""What is said of a position that was not solved: its input angle, and motions by the names of their members."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from trochoid.kinematics.errors import NotConverged

_NUMBERED = re.compile(r"\bmotion (\d+)\b")


def unsolved(fault: NotConverged, angle: float, names: Sequence[str], hint: str = "") -> NotConverged:
    """Return the fault of a position at an input `angle` (rad), `names` those of the motions that it numbers."""

    def named(found: re.Match[str]) -> str:
        number = int(found[1])
        return f"motion {names[number]}" if number < len(names) else found[0]

    return NotConverged(
        f"at input angle {math.degrees(angle):.6g}°: {_NUMBERED.sub(named, str(fault))}{hint}", fault.row
    )
