"""Outline of a toothed disc with a central bore and a ring of equal holes."""

from __future__ import annotations

import math

from trochoid.geometry.check import Walls, disc_faults, refuse, walls
from trochoid.geometry.outline import Loop, Outline, bending_breaks
from trochoid.kinematics.curve import ArcLength, Circle
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import Infeasible

_COARSER = 1.75  # facets of bore and holes against those of the flank
_FINEST = 0.125  # least share of that length which a thin wall may ask for


def disc_outline(
    profile: Cycloid,
    bore_radius: float,
    hole_count: int,
    hole_circle_radius: float,
    hole_radius: float,
    hole_angle0: float,
    facets_per_lobe: int,
) -> Outline:
    """Outline with the loops "flank", "bore", "hole0", … in the disc's frame; lengths in m, angle in rad.

    Flank facets follow arc length and curvature (`bending_breaks`), alike on all lobes; those of bore and
    holes are up to 1.75 times their mean, and no longer than the wall beside them (down to an eighth).
    Raises Infeasible.
    """
    sizes = (bore_radius, hole_count, hole_circle_radius, hole_radius, hole_angle0)
    refuse(disc_faults(profile, *sizes))
    if facets_per_lobe < 1:
        raise Infeasible(f"facets per lobe = {facets_per_lobe}; at least 1 is needed, 12 is usual")
    flank = Loop("flank", profile, breaks=bending_breaks(profile, facets_per_lobe, profile.lobes))
    length = _COARSER * ArcLength(profile).total / (facets_per_lobe * profile.lobes)
    bore_facets, hole_facets = _facets(length, walls(profile, *sizes), bore_radius, hole_radius)
    holes = [Loop("bore", Circle((0.0, 0.0), bore_radius, hole=True), bore_facets, hole_angle0)]
    for j in range(hole_count):
        angle = hole_angle0 + 2.0 * math.pi * j / hole_count
        center = (hole_circle_radius * math.cos(angle), hole_circle_radius * math.sin(angle))
        holes.append(Loop(f"hole{j}", Circle(center, hole_radius, hole=True), hole_facets, angle))
    return Outline(flank, tuple(holes))


def _facets(length: float, wall: Walls, bore_radius: float, hole_radius: float) -> tuple[int, int]:
    """Numbers of facets on the bore and on a hole, at least 12 and multiples of 4."""
    beside_bore = min(wall.hole_to_bore, wall.bore_to_flank)
    beside_hole = min(wall.hole_to_flank, wall.hole_to_bore, wall.hole_to_hole)
    counts = []
    for radius, beside in ((bore_radius, beside_bore), (hole_radius, beside_hole)):
        facet = max(min(length, beside), _FINEST * length)
        counts.append(4 * max(3, math.ceil(0.5 * math.pi * radius / facet)))
    return counts[0], counts[1]
