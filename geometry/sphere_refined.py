"""Facets of a flank that resolve narrow contacts: for comparison only, a mesh for one position."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from trochoid.geometry.sphere_outline import bent_breaks
from trochoid.geometry.sphere_rim import RimShape
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Focus:
    """A contact at the flank parameter `place`: `facets` of the width `facet` (rad) about it."""

    place: float
    facet: float
    facets: int


def refined_breaks(
    shape: RimShape, first_tooth: int, teeth: int, facets: int, foci: tuple[Focus, ...], slope: float = 0.35
) -> Array:
    """Return the breaks of a row of teeth with `facets` each, growing by `slope` times the distance from the foci.

    Raises Infeasible where foci overlap or lie beyond the row.
    """
    arc = ArcLength(shape.tooth)
    start = shape.start + first_tooth * shape.pitch
    lobe = bent_breaks(shape.tooth, shape.start, shape.start + shape.pitch, facets)
    lobe_s = arc.length(lobe)
    size, center = np.diff(lobe_s), 0.5 * (lobe_s[1:] + lobe_s[:-1]) - lobe_s[0]
    length = float(lobe_s[-1] - lobe_s[0])
    low = float(arc.length(start))
    windows = sorted((float(arc.length(f.place)) - low, 0.5 * f.facet * f.facets, f) for f in foci)
    stops = [0.0, *(x for s, w, _ in windows for x in (s - w, s + w)), teeth * length]
    if np.any(np.diff(stops) <= 0.0):
        raise Infeasible("contacts to resolve overlap, or lie beyond the row of teeth")
    breaks = [np.array([0.0])]
    for number, (a, b) in enumerate(pairwise(stops)):
        if number % 2:
            breaks.append(np.linspace(a, b, windows[number // 2][2].facets + 1)[1:])
            continue
        s = np.unique(np.concatenate([np.linspace(a, b, 4001), a + _near(a, b), b - _near(a, b)]))
        wanted = np.interp(np.mod(s, length), center, size, period=length)
        for at, half, focus in windows:
            wanted = np.minimum(wanted, focus.facet + slope * np.maximum(0.0, np.abs(s - at) - half))
        count = np.concatenate([[0.0], np.cumsum(np.diff(s) * 0.5 * (1 / wanted[1:] + 1 / wanted[:-1]))])
        pieces = max(1, round(float(count[-1])))
        breaks.append(np.append(np.interp(np.arange(1, pieces) / pieces * count[-1], count, s), b))
    parameters: Array = arc.parameter(low + np.concatenate(breaks))
    parameters[0], parameters[-1] = start, start + teeth * shape.pitch
    return parameters


def _near(a: float, b: float) -> Array:
    return np.geomspace(1e-6, 1.0, 2000) * 0.5 * (b - a)
