"""Plane outlines of thin housings and bearing rings: a round wall about the bore, held at feet or all round."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from trochoid.geometry.outline import Loop, Outline, graded_breaks
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.errors import Infeasible

FEWEST = 48  # facets of a bore
FINEST = 1 / 30  # of the usual facet: those where a support ends
ACROSS = 4  # facets of the bore that a wall is thick, at the least


def usual_facets(bore_radius: float, wall: float) -> int:
    """Return how many facets a bore needs beside a wall of this thickness; half as many are the coarser level."""
    return max(FEWEST, 2 * math.ceil(ACROSS * math.pi * bore_radius / wall))


def ring_outline(
    bore_radius: float, wall: float, facets: int, held: Sequence[tuple[float, float]] = ()
) -> Outline:
    """Return a ring with the loops "outer" and "bore", lengths in m.

    `held`: arcs of the outer edge from … to in rad, which become its sides "held0", "held1", … (feet, bolts); the
    whole edge is "outer" (a flange, a stiff frame). `facets` are those of the bore; the outer edge has as many, but
    facets end where arcs do. Raises Infeasible.
    """
    if not (np.isfinite([bore_radius, wall]).all() and bore_radius > 0.0 and wall > 0.0):
        raise Infeasible(
            f"seat: bore radius and wall must be positive and finite, given {1e3 * bore_radius:.6g} mm and "
            f"{1e3 * wall:.6g} mm"
        )
    bore = Loop("bore", Circle((0.0, 0.0), bore_radius, hole=True), facets)
    outer = Circle((0.0, 0.0), bore_radius + wall)
    if not held:
        return Outline(Loop("outer", outer, facets), (bore,))
    arcs = [(low % (2.0 * math.pi), high - low) for low, high in held]
    _fail_if_overlapping(arcs)
    sides = {f"held{i}": (low, low + span) for i, (low, span) in enumerate(arcs)}
    ends, length = (
        np.array([e for low, span in arcs for e in (low, low + span)]),
        outer.radius * 2.0 * math.pi / facets,
    )
    breaks = graded_breaks(outer, ends, FINEST * length, length)  # where a support ends stress has no bound
    return Outline(Loop("outer", outer, breaks=breaks, sides=sides), (bore,))


def _fail_if_overlapping(arcs: Sequence[tuple[float, float]]) -> None:
    ordered = sorted(arcs)
    following = [low for low, _ in ordered[1:]] + [ordered[0][0] + 2.0 * math.pi]
    for (low, span), limit in zip(ordered, following, strict=True):
        if not 0.0 < span <= limit - low + 1e-12:
            raise Infeasible(
                f"seat: the held arc from {math.degrees(low):.6g}° over {math.degrees(span):.6g}° must be positive and "
                f"end before the next one at {math.degrees(limit % (2.0 * math.pi)):.6g}°"
            )
