"""What drives say of their natural modes: who moves, how a mode is called, the Campbell diagram."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.types import Array, ComplexArray
from trochoid.results.plot import Axis, Plot, PlotCurve

NAMED = 0.2  # share of the energy from which a motion is named
REACH = 3.0  # times the highest line, up to where modes are drawn
CLOSE = 0.1  # how near, relative, a line comes to a frequency to be called near
AXES = (Axis("input speed", "rad/s"), Axis("frequency", "Hz"))


@dataclass(frozen=True, slots=True)
class Mode:
    """A natural mode: `frequency` Hz, the `shares` of its energy by motion, largest first, and how it `turns`."""

    frequency: float
    shares: Mapping[str, float]
    turns: str = ""

    @property
    def words(self) -> str:
        """What moves, as in "satellite tilting 71 %, casing across z 24 %; forward"."""
        named = [f"{name} {100.0 * share:.0f} %" for name, share in self.shares.items() if share >= NAMED]
        largest = next(iter(self.shares.items()))
        text = ", ".join(named) or f"{largest[0]} {100.0 * largest[1]:.0f} %"
        return f"{text}; {self.turns}" if self.turns else text


def shares(energy: Array, names: Sequence[str]) -> dict[str, float]:
    """Return the share of each name in the energies (n,) of the coordinates that bear it, largest first."""
    whole: dict[str, float] = {}
    for name, part in zip(names, energy, strict=True):
        whole[name] = whole.get(name, 0.0) + float(part)
    total = sum(whole.values()) or 1.0
    return {name: whole[name] / total for name in sorted(whole, key=lambda name: -whole[name])}


def heard(
    across: ComplexArray, weight: Array, along: ComplexArray, other: Array, own: float, speed: float
) -> tuple[float, str]:
    """Return the frequency (Hz) at which the fixed frame hears most of a mode of a frame that turns, and its sense.

    The frame turns with `speed` (rad/s), the mode has `own` Hz there: motions `across` its axis (a, 2) and `along` or
    about it (b,), with their masses.  x + iy turns once more with the frame, so half of it moves up, half of it down.
    """
    turn = speed / (2.0 * np.pi)
    x, y = across.T
    up, down = (0.5 * float((weight * np.abs(x + sign * 1j * y) ** 2).sum()) for sign in (1.0, -1.0))
    if float((other * np.abs(along) ** 2).sum()) >= max(up, down):
        return own, ""
    if up >= down:
        return turn + own, "forward"
    return abs(turn - own), "forward" if turn > own else "backward"


def campbell_plot(
    speeds: Array,
    rows: Sequence[Sequence[float] | Array],
    lines: Mapping[str, float],
    operating: float,
    caption: str,
    reach: float = REACH,
) -> Plot:
    """Draw frequencies (Hz) for each of the input `speeds` (p,), rad/s, with the `lines` of given orders of the speed.

    Modes that begin beyond `reach` times the highest line are left out. The dashed upright line is the speed of
    operation.
    """
    count = min(len(row) for row in rows)
    frequencies = np.array([row[:count] for row in rows]).reshape(len(rows), count)
    most = reach * max(lines.values(), default=1.0) * float(speeds[-1]) / (2.0 * np.pi)
    frequencies = frequencies[:, frequencies[0] <= most]
    top = float(np.nanmax(frequencies)) if frequencies.size else 0.0
    highest = max(top, operating * max(lines.values(), default=1.0) / (2.0 * np.pi))
    modes = [
        PlotCurve(f"mode {i + 1}", np.column_stack([speeds, line]), group="natural frequencies")
        for i, line in enumerate(frequencies.T)
    ]
    orders = [
        PlotCurve(name, _ray(order, float(speeds[-1]), 1.05 * highest), group=name, style="dashed")
        for name, order in lines.items()
    ]
    at = np.array([[operating, 0.0], [operating, 1.05 * highest]])
    mark = PlotCurve("speed of operation", at, group="speed of operation", style="dashed")
    return Plot("Campbell diagram", AXES, (*modes, *orders, mark), (), caption, equal=False)


def _ray(order: float, fastest: float, highest: float) -> Array:
    """Return the line of an order of the speed up to the end of the picture."""
    end = min(fastest, 2.0 * np.pi * highest / order) if order > 0.0 else fastest
    return np.array([[0.0, 0.0], [end, order * end / (2.0 * np.pi)]])
