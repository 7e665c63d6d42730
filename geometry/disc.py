"""Outline of a toothed disc with a central bore and a ring of equal holes."""

from __future__ import annotations

import math

from trochoid.geometry.check import Holes, Walls, disc_faults, refuse, walls, window_faults, window_walls
from trochoid.geometry.outline import Loop, Outline, bending_breaks
from trochoid.kinematics.curve import ArcLength, Circle
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import Infeasible

_COARSER = 1.75  # facets of bore and holes against those of the flank
_FINEST = 0.125  # least share of that length which a thin wall may ask for
_FIRST, _FEWEST = 4, 12  # facets per lobe from which levels double; facets of a circle


def disc_outline(
    profile: Cycloid,
    bore_radius: float,
    hole_count: int,
    hole_circle_radius: float,
    hole_radius: float,
    hole_angle0: float,
    facets_per_lobe: int,
    windows: Holes | None = None,
) -> Outline:
    """Outline with the loops "flank", "bore", "hole0", …, "window0", … in the disc's frame; lengths in m, angle in rad.

    Flank facets follow arc length and curvature (`bending_breaks`), alike on all lobes; those of bore and
    holes are up to 1.75 times their mean, and with 8 facets per lobe no longer than the wall beside them (down
    to an eighth). Twice the facets per lobe halve every facet, so that the error of a coarse mesh can be told
    from that of a fine one.
    Raises Infeasible.
    """
    sizes = (bore_radius, hole_count, hole_circle_radius, hole_radius, hole_angle0)
    bearing_holes = Holes(hole_count, hole_circle_radius, hole_radius, hole_angle0)
    refuse(disc_faults(profile, *sizes) + window_faults(profile, bore_radius, bearing_holes, windows))
    if facets_per_lobe < 1:
        raise Infeasible(f"facets per lobe = {facets_per_lobe}; at least 1 is needed, 12 is usual")
    flank = Loop("flank", profile, breaks=bending_breaks(profile, facets_per_lobe, profile.lobes))
    first = _first_level(facets_per_lobe)
    length = _COARSER * ArcLength(profile).total / (first * profile.lobes)
    counts = _facets(length, walls(profile, *sizes), bore_radius, hole_radius)
    bore_facets, hole_facets = (max(_FEWEST, count * facets_per_lobe // first) for count in counts)
    holes = [Loop("bore", Circle((0.0, 0.0), bore_radius, hole=True), bore_facets, hole_angle0)]
    holes += _loops("hole", bearing_holes, hole_facets)
    if windows is not None:
        wall = window_walls(profile, bore_radius, bearing_holes, windows)
        count = _facets(length, wall, bore_radius, windows.radius)[1]
        holes += _loops("window", windows, max(_FEWEST, count * facets_per_lobe // first))
    return Outline(flank, tuple(holes))


def _loops(name: str, ring: Holes, facets: int) -> list[Loop]:
    loops = []
    for j in range(ring.count):
        angle = ring.angle0 + 2.0 * math.pi * j / ring.count
        center = (ring.circle_radius * math.cos(angle), ring.circle_radius * math.sin(angle))
        loops.append(Loop(f"{name}{j}", Circle(center, ring.radius, hole=True), facets, angle))
    return loops


def _first_level(facets_per_lobe: int) -> int:
    """Level from which this one follows by doubling."""
    while facets_per_lobe % 2 == 0 and facets_per_lobe >= 2 * _FIRST:
        facets_per_lobe //= 2
    return facets_per_lobe


def _facets(length: float, wall: Walls, bore_radius: float, hole_radius: float) -> tuple[int, int]:
    """Numbers of facets on the bore (a multiple of 4) and on a hole (even) on the first level."""
    beside_bore = min(wall.hole_to_bore, wall.bore_to_flank)
    beside_hole = min(wall.hole_to_flank, wall.hole_to_bore, wall.hole_to_hole)
    counts = []
    for radius, beside, whole in ((bore_radius, beside_bore, 4), (hole_radius, beside_hole, 2)):
        facet = max(min(length, 2.0 * beside), _FINEST * length)
        counts.append(whole * math.ceil(2.0 * math.pi * radius / (whole * facet)))
    return counts[0], counts[1]
