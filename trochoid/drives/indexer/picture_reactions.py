"""Pictures of reactions by model over a turn, of their harmonics, and of natural frequencies over the cycle."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from trochoid.drives.indexer.modes import Modes
from trochoid.drives.indexer.picture_shaken import thinned
from trochoid.drives.indexer.reactions import Turn
from trochoid.drives.indexer.words import NAMES
from trochoid.results.plot import Axis, Plot, PlotCurve

SHOWN = ("input_torque", "wheel_torque")
FORCES = ("wheel_bearing_force", "planet_bearing_force")
STYLES = {"rigid": "dashed", "elastic": "line"}
LEAST = 1e-4  # of the largest line, below which harmonics are not drawn


def reaction_plots(found: Mapping[str, Mapping[str, Turn]]) -> list[Plot]:
    """Return forces over an index by model for each mechanism, and the harmonics of the input torque."""
    made = []
    for name, models in found.items():
        made.append(_forces(NAMES[name], models))
    return [*made, _harmonics(found)]


def _forces(name: str, models: Mapping[str, Turn]) -> Plot:
    curves = []
    for model, turn in models.items():
        series = turn.series(turn.state)
        for key in (*FORCES, *turn.shafts.names):
            points = thinned(turn.angle, np.abs(series[key]))
            curves.append(PlotCurve(f"{_said(key)}, {model}", points, style=STYLES[model]))
    caption = (
        "Sizes over an index; in the dwell pin and slot are apart and all are zero. Rigid: Newton and Euler; elastic: "
        "with the pin force of the march, contact and bending of wheel and pin, shaft and play."
    )
    axes = (Axis("input angle from the middle of the index", "rad"), Axis("force", "N"))
    return Plot(f"Reactions by model: {name}", axes, tuple(curves), (), caption, equal=False)


def _harmonics(found: Mapping[str, Mapping[str, Turn]]) -> Plot:
    curves = []
    for name, models in found.items():
        for model, turn in models.items():
            lines = turn.lines["input_torque"]
            order = np.arange(1, len(lines))
            shown = lines[1:] > LEAST * lines[1:].max(initial=0.0)
            last = int(np.flatnonzero(shown)[-1]) + 1 if shown.any() else 1
            points = np.stack([order, lines[1:]], axis=-1)[:last]
            curves.append(PlotCurve(f"{NAMES[name]}, {model}", points, style=STYLES[model]))
    caption = (
        "Amplitudes of the input torque over a whole turn, dwell and all. Elastic lines rise where a multiple of the "
        "arm's speed meets a natural frequency."
    )
    axes = (Axis("multiple of the arm's speed"), Axis("input torque", "N*m"))
    return Plot("Harmonics of the input torque", axes, tuple(curves), (), caption, equal=False)


def frequencies(found: Mapping[str, Modes]) -> Plot:
    """Return the natural frequencies of the output over the turn of the arm."""
    curves = []
    for name, x in found.items():
        half = float(x.angle[-1])
        rest = np.array([half, 2.0 * math.pi - half])
        for i in range(x.index.shape[1]):
            group = f"{NAMES[name]}, mode {i + 1}"
            # a gap where the pin carries next to nothing
            jumps = np.flatnonzero(np.diff(x.angle) > 1.5 * np.diff(x.angle).min()) + 1
            for part in np.split(np.arange(len(x.angle)), jumps):
                points = np.stack([x.angle[part], x.index[part, i]], axis=-1)
                curves.append(PlotCurve(f"{group} on the pin", points, group))
            points = np.stack([rest, np.full(2, x.locked[i])], axis=-1)
            curves.append(PlotCurve(f"{group} on the lock", points, f"{group} on the lock", "dashed"))
    caption = (
        "Wheel and load at frozen positions: in the index on the pin's contact under the force of the rigid drive, "
        "left out where the pin carries less than 1 % of its largest force; dashed: in the dwell on the lock."
    )
    axes = (Axis("input angle from the middle of the index", "rad"), Axis("natural frequency", "Hz"))
    return Plot("Natural frequencies over the cycle", axes, tuple(curves), (), caption, equal=False)


def _said(key: str) -> str:
    return key.replace("_", " ")
