"""All indexers of the swing, ratio and shafts of a scene, whatever their k: where the chosen one stands among them."""

from __future__ import annotations

import math

import numpy as np

from trochoid.drives.indexer.design import GENEVA, Design, task
from trochoid.kinematics.indexer_measure import similarity
from trochoid.kinematics.indexer_roots import roots_by_duration
from trochoid.kinematics.indexer_synthesis import assess
from trochoid.kinematics.types import Array
from trochoid.results.plot import Axis, Plot, PlotCurve

STEPS = 199
MOST = 4.0  # of the chosen one's C: what is worse is left out


def family(design: Design) -> Plot:
    """Return C over k of every mechanism that serves, by train and place of the pin."""
    asked = task(design.drive)
    k = np.linspace(0.005, 0.995, STEPS)
    roots = roots_by_duration(0.5 * asked.swing, math.pi * k, asked.planet, asked.shaft_angle)
    found = assess(roots, asked)
    chosen = similarity(design.indexer).acceleration
    good = (found.fault == 0) & (found.cost < MOST * chosen)
    roots, cost = roots.take(good), found.cost[good]
    epi, far = roots.ratio > 0.0, np.cos(roots.phase) * roots.arm > 0.0
    labels = [
        f"k {t / math.pi:.3f}, ρ {p:.4g}, γ {g:.4g}°, C {c:.4g}"
        for t, p, g, c in zip(roots.half_turn, roots.pin_ratio, np.degrees(roots.arm), cost, strict=True)
    ]
    curves = []
    for kind, of_kind in (("hypo", ~epi), ("epi", epi)):
        for place, there in (("near", ~far), ("far", far)):
            which = np.flatnonzero(of_kind & there)
            if which.size:
                points = np.stack((roots.half_turn[which] / math.pi, cost[which]), axis=-1)
                name = f"{kind} {place}"
                curves.append(PlotCurve(name, points, style="points", labels=tuple(labels[i] for i in which)))
    curves.append(_point("chosen", design.indexer.duration, chosen))
    if GENEVA in design.mechanisms:
        wheel = design.mechanisms[GENEVA]
        curves.append(_point("Geneva wheel", wheel.duration, similarity(wheel).acceleration))
    caption = (
        "Every point is an indexer without hard shock for the same swing, ratio and shafts that serves; "
        "k in steps of 0.005."
    )
    axes = (Axis("relative turning time k"), Axis("C = max|ε| T²/ψ"))
    return Plot("Choice of the relative turning time", axes, tuple(curves), (), caption, equal=False)


def _point(name: str, k: float, value: float) -> PlotCurve:
    place: Array = np.array([[k, value]])
    return PlotCurve(name, place, style="points", labels=(f"{name}: k {k:.4g}, C {value:.4g}",))
