"""Refuse bodies that cannot be made or assembled: the reason, the limit and the nearest feasible value."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from trochoid.kinematics.curve import foot_point
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Walls:
    """Least material (m) between the parts of a disc: negative where they break into each other.

    Infinite where there is nothing to break into.
    """

    hole_to_flank: float
    hole_to_bore: float
    hole_to_hole: float
    bore_to_flank: float

    @property
    def least(self) -> float:
        """The thinnest of them, m."""
        return min(self.hole_to_flank, self.hole_to_bore, self.hole_to_hole, self.bore_to_flank)


@dataclass(frozen=True, slots=True)
class Holes:
    """Equal round holes, evenly spaced on a circle about the centre; lengths in m, angle of the first in rad."""

    count: int
    circle_radius: float
    radius: float
    angle0: float = 0.0

    @property
    def centers(self) -> Array:
        """Centres (count, 2), m."""
        angles = self.angle0 + 2.0 * math.pi * np.arange(self.count) / self.count
        return self.circle_radius * np.stack((np.cos(angles), np.sin(angles)), axis=-1)


def root_radius(profile: Cycloid) -> float:
    """Radius R − e − r (m) of the circle through the bottoms of the valleys."""
    return profile.pin_circle_radius - profile.eccentricity - profile.pin_radius


def walls(
    profile: Cycloid,
    bore_radius: float,
    hole_count: int,
    hole_circle_radius: float,
    hole_radius: float,
    hole_angle0: float = 0.0,
) -> Walls:
    """Wall thicknesses of a disc with a bore and a ring of equal holes; lengths in m, angle in rad."""
    bore_to_flank = root_radius(profile) - bore_radius
    if hole_count == 0:
        return Walls(math.inf, math.inf, math.inf, bore_to_flank)
    angles = hole_angle0 + 2.0 * math.pi * np.arange(hole_count) / hole_count
    centers = hole_circle_radius * np.stack((np.cos(angles), np.sin(angles)), axis=-1)
    between = 2.0 * hole_circle_radius * math.sin(math.pi / hole_count) if hole_count > 1 else math.inf
    return Walls(
        float(-_distance(profile, centers).max() - hole_radius),
        hole_circle_radius - hole_radius - bore_radius,
        between - 2.0 * hole_radius,
        bore_to_flank,
    )


def _distance(profile: Cycloid, points: Array) -> Array:
    """Signed distance (m) of points from the flank, negative inside."""
    t = 2.0 * math.pi * np.arange(32 * profile.lobes) / (32 * profile.lobes)
    away = np.linalg.norm(points[:, None, :] - profile.point(t), axis=-1)
    return foot_point(profile, points, t[away.argmin(axis=1)])[1]


def disc_faults(
    profile: Cycloid,
    bore_radius: float,
    hole_count: int,
    hole_circle_radius: float,
    hole_radius: float,
    hole_angle0: float = 0.0,
) -> tuple[str, ...]:
    """Reasons why bore and holes do not fit into a feasible profile; empty when they do."""
    root = root_radius(profile)
    faults = []
    if not 0.0 < bore_radius < root:
        faults.append(
            f"bore radius {_mm(bore_radius)}: it must lie between 0 and the root circle, {_mm(root)}"
        )
    if hole_count and not hole_radius > 0.0:
        faults.append(f"hole radius {_mm(hole_radius)}: it must be positive")
    if hole_count and not 0.0 < hole_circle_radius < root:
        given = f"hole circle radius {_mm(hole_circle_radius)}"
        faults.append(f"{given}: it must lie between 0 and the root circle, {_mm(root)}")
    if faults or hole_count == 0:
        return tuple(faults)
    wall = walls(profile, bore_radius, hole_count, hole_circle_radius, hole_radius, hole_angle0)
    return _broken(wall, hole_circle_radius, hole_radius)


def _broken(wall: Walls, circle: float, radius: float) -> tuple[str, ...]:
    """Name the walls that holes of `radius` on a `circle` break, with the hole radius that just would not."""
    faults = []
    for place, value, share, other in (
        ("the flank", wall.hole_to_flank, 1.0, "a smaller hole circle"),
        ("the bore", wall.hole_to_bore, 1.0, "a larger hole circle or a smaller bore"),
        ("each other", wall.hole_to_hole, 0.5, "fewer holes or a larger hole circle"),
    ):
        if value > 0.0:
            continue
        limit = radius + share * value
        advice = f"a hole radius smaller than {_mm(limit)} or {other}" if limit > 0.0 else other
        given = f"holes of radius {_mm(radius)} on a circle of radius {_mm(circle)}"
        faults.append(f"{given} break into {place} by {_mm(-value)}; take {advice}")
    return tuple(faults)


def window_walls(profile: Cycloid, bore_radius: float, holes: Holes, windows: Holes) -> Walls:
    """Walls of windows beside the bearing holes of a disc; `hole_to_hole` is the least to any other hole."""
    own = walls(profile, bore_radius, windows.count, windows.circle_radius, windows.radius, windows.angle0)
    apart = np.linalg.norm(windows.centers[:, None] - holes.centers[None], axis=-1).min(initial=math.inf)
    beside = float(apart) - windows.radius - holes.radius
    return replace(own, hole_to_hole=min(own.hole_to_hole, beside))


def window_faults(
    profile: Cycloid, bore_radius: float, holes: Holes, windows: Holes | None
) -> tuple[str, ...]:
    """Reasons why windows do not fit between flank, bore and bearing holes; empty when they do."""
    if windows is None:
        return ()
    root = root_radius(profile)
    if not 0.0 < windows.circle_radius < root:
        given = f"window circle radius {_mm(windows.circle_radius)}"
        return (f"{given}: it must lie between 0 and the root circle, {_mm(root)}",)
    wall = window_walls(profile, bore_radius, holes, windows)
    faults = []
    for place, value in (
        ("the flank", wall.hole_to_flank),
        ("the bore", wall.hole_to_bore),
        ("a neighbouring hole", wall.hole_to_hole),
    ):
        if value > 0.0:
            continue
        limit = windows.radius + value
        advice = f"; take them smaller than {_mm(limit)}" if limit > 0.0 else "; move them"
        given = f"windows of radius {_mm(windows.radius)} on a circle of radius {_mm(windows.circle_radius)}"
        faults.append(f"{given} break into {place} by {_mm(-value)}{advice}")
    return tuple(faults)


def output_pin_faults(hole_radius: float, roller_radius: float, eccentricity: float) -> tuple[str, ...]:
    """Reasons why rollers cannot orbit in their holes: a hole must hold roller and eccentricity."""
    need = roller_radius + eccentricity
    if roller_radius > 0.0 and hole_radius >= need * (1.0 - 1e-12):
        return ()
    given = f"rollers of radius {_mm(roller_radius)} in holes of radius {_mm(hole_radius)}"
    limit = hole_radius - eccentricity
    advice = f", or the rollers at most {_mm(limit)}" if limit > 0.0 else ""
    return (f"{given}: the holes need at least roller radius + eccentricity = {_mm(need)}{advice}",)


def stack_faults(positions: Sequence[float], face_width: float) -> tuple[str, ...]:
    """Reasons why discs of `face_width` centred at axial `positions` (m) collide."""
    if not face_width > 0.0:
        return (f"face width {_mm(face_width)}: a positive width is needed",)
    faults = []
    for low, high in pairwise(sorted(positions)):
        if high - low < face_width * (1.0 - 1e-12):
            given = f"discs of width {_mm(face_width)} centred at {_mm(low)} and {_mm(high)} collide"
            faults.append(f"{given}; move them {_mm(face_width)} apart or make them {_mm(high - low)} wide")
    return tuple(faults)


def bearing_faults(bore_radius: float, rollers: int, roller_radius: float) -> tuple[str, ...]:
    """Reasons why rollers that run directly in the bore do not fit side by side."""
    if rollers < 3 or not roller_radius > 0.0:
        return (
            f"{rollers} bearing rollers of radius {_mm(roller_radius)}: take at least 3 of positive radius",
        )
    pitch = math.sin(math.pi / rollers)
    limit = bore_radius * pitch / (1.0 + pitch)
    if roller_radius < limit:
        return ()
    given = f"{rollers} rollers of radius {_mm(roller_radius)} overlap in a bore of radius {_mm(bore_radius)}"
    most = _most_rollers(bore_radius, roller_radius)
    return (f"{given}; take them smaller than {_mm(limit)}" + (f", or at most {most}" if most >= 3 else ""),)


def _most_rollers(bore: float, roller: float) -> int:
    pitch = bore - roller
    return math.ceil(math.pi / math.asin(roller / pitch)) - 1 if pitch > roller else 1


def refuse(faults: Iterable[str]) -> None:
    """Raise Infeasible with all the given reasons, one on a line; do nothing when there are none."""
    reasons = tuple(faults)
    if reasons:
        raise Infeasible("\n".join(reasons))


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"
