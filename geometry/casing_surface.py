"""How far a point is from the surface of a box casing, before anything is meshed."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from trochoid.geometry.casing_box import BoxCasing, Triple, inner_face, outer_face
from trochoid.geometry.solid_places import OFF_BODY
from trochoid.kinematics.types import Array

FINE = 60  # places along a side, and round a cylinder


def points_off(casing: BoxCasing, points: Mapping[str, Triple]) -> list[str]:
    """Return what is said of each point (m) that is off the casing's surface by more than a mesh forgives."""
    surface, found = surface_places(casing), []
    most = OFF_BODY * float(np.ptp(surface, axis=0).max())
    for name, point in points.items():
        away = surface - point
        distance = np.sqrt(np.einsum("ni,ni->n", away, away))
        i = int(np.argmin(distance))
        if distance[i] > most:
            given, near = (
                ", ".join(f"{1e3 * x + 0.0:.3g}" for x in place) for place in (point, surface[i].tolist())
            )
            found.append(
                f"casing: the point {name} at {given} mm is {1e3 * distance[i]:.3g} mm off the body; the nearest place "
                f"of its surface is near {near} mm"
            )
    return found


def surface_places(casing: BoxCasing) -> Array:
    """Return places (n, 3) all over the surface, m: of box, base plate and hollow, bosses and bores.

    Some lie within the body, where one of these goes into another.
    """
    low, high, wall = np.array(casing.low), np.array(casing.high), casing.wall
    reach = np.array([casing.flange[0], 0.0, casing.flange[1]])
    top = np.array([high[0], low[1] + casing.plate, high[2]])
    parts = [
        _box(low, high),
        _box(low + np.array([wall, casing.plate, wall]), high - wall),
        _box(low - reach, top + reach),
    ]
    for bore in casing.bores:
        ends = outer_face(casing, bore), inner_face(casing, bore)
        parts += [_tube((bore.x, bore.y), radius, ends) for radius in (bore.radius, bore.boss)]
        parts.append(_ring((bore.x, bore.y), (bore.radius, bore.boss), ends[1]))
    places = np.concatenate(parts)
    for bore in casing.bores:
        start, end = sorted((outer_face(casing, bore), inner_face(casing, bore)))
        away = np.hypot(places[:, 0] - bore.x, places[:, 1] - bore.y)
        inside = (away < (1.0 - 1e-9) * bore.radius) & (places[:, 2] >= start) & (places[:, 2] <= end)
        places = places[~inside]
    return places


def _box(low: Array, high: Array) -> Array:
    share = np.linspace(0.0, 1.0, FINE + 1)
    one, two = (x.ravel() for x in np.meshgrid(share, share))
    faces = []
    for axis in range(3):
        for end in (0.0, 1.0):
            faces.append(low + np.insert(np.stack([one, two], axis=1), axis, end, axis=1) * (high - low))
    return np.concatenate(faces)


def _tube(center: tuple[float, float], radius: float, ends: tuple[float, float]) -> Array:
    angle, z = _round(np.linspace(*ends, FINE // 4))
    return np.stack([center[0] + radius * np.cos(angle), center[1] + radius * np.sin(angle), z], axis=1)


def _ring(center: tuple[float, float], radii: tuple[float, float], z: float) -> Array:
    angle, radius = _round(np.linspace(*radii, FINE // 4))
    x, y = center[0] + radius * np.cos(angle), center[1] + radius * np.sin(angle)
    return np.stack([x, y, np.full(len(x), z)], axis=1)


def _round(along: Array) -> tuple[Array, Array]:
    angle, other = np.meshgrid(np.linspace(0.0, 2.0 * np.pi, FINE, endpoint=False), along)
    return angle.ravel(), other.ravel()
