"""Pictures of what elasticity makes of the shocks: pin force over an index, swing of the output after the stop."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from trochoid.drives.indexer.shaken import Shaken
from trochoid.drives.indexer.words import NAMES
from trochoid.kinematics.types import Array
from trochoid.results.plot import Axis, Plot, PlotCurve

POINTS = 3000  # of a curve, at most; extremes of what lies between stay
TIME = Axis("time", "s")


def courses(shaken: Mapping[str, Shaken]) -> list[Plot]:
    """Return one picture of the pin force for each mechanism, and one of the residual vibration for all."""
    made = [_forces(NAMES[name], x) for name, x in shaken.items()]
    return [*made, _residual(shaken)]


def _forces(name: str, x: Shaken) -> Plot:
    time = x.fine.index.time
    curves = (
        PlotCurve("elastic", thinned(time, x.pin_force(x.fine))),
        PlotCurve("rigid", thinned(time, x.rigid), style="dashed"),
    )
    caption = (
        "From the start of an index, positive where the pin drives. The rigid drive's force jumps at the start; the "
        "elastic one swings about it and dies down with the damping of the scene."
    )
    return Plot(
        f"Pin force over an index: {name}", (TIME, Axis("pin force", "N")), curves, (), caption, equal=False
    )


def _residual(shaken: Mapping[str, Shaken]) -> Plot:
    last = max(_shown(x) for x in shaken.values())
    curves = []
    for name, x in shaken.items():
        dwell = x.fine.dwell
        early = dwell.time <= last
        curves.append(PlotCurve(NAMES[name], thinned(dwell.time[early], dwell.deviation[early])))
    caption = (
        "From the stop, the output's angle from where a rigid drive would rest, in the sense of the index. Friction of "
        "the output holds it in the end."
    )
    axes = (TIME, Axis("angle of the output", "rad"))
    return Plot("Residual vibration after the stop", axes, tuple(curves), (), caption, equal=False)


def _shown(x: Shaken) -> float:
    """How long (s) a vibration is worth showing."""
    last = float(x.fine.dwell.time[-1])
    return last if x.settling is None else min(1.5 * x.settling + 20.0 / x.output.frequencies[0], last)


def thinned(time: Array, value: Array) -> Array:
    """Points (n, 2) with the least and the largest value of every stretch of a long curve."""
    if len(time) <= POINTS:
        return np.stack((time, value), axis=-1)
    stretch = -(-len(time) // (POINTS // 2))
    starts = np.arange(0, len(time), stretch)
    kept = [0, len(time) - 1]
    for i in starts:
        part = value[i : i + stretch]
        kept += [int(i + part.argmin()), int(i + part.argmax())]
    order = np.unique(kept)
    return np.stack((time[order], value[order]), axis=-1)
