"""Put the points of a rough boundary onto the exact one: bisection, corners where conditions change, smooth sides."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from trochoid.kinematics.types import Array, BoolArray, IntArray, frozen

Margins = Callable[[Array, Array], Array]  # x, y (n,) -> margins (k, n)


def refined(margins: Margins, good: Array, bad: Array) -> tuple[Array, IntArray, float]:
    """Boundary between the loops of points `good` and `bad` (n, 2), the region on its left.

    Returns points (m, 2), the condition that binds after each (m,), and the area within, negative for a hole.
    """
    points = _between(margins, good, bad)
    points, after = _with_corners(margins, *_split_at_changes(margins, points))
    points, after, middles, away = _with_kinks(margins, points, after)
    sides = np.roll(points, -1, axis=0) - points
    # every side is a parabola through its middle: Simpson's rule
    area = _shoelace(points) - 2.0 / 3.0 * float(np.hypot(*sides.T) @ away)
    return frozen(np.stack((points, middles), axis=1).reshape(-1, 2)), np.repeat(after, 2), area


def bisected(margins: Margins, good: Array, bad: Array) -> tuple[Array, IntArray, float]:
    """Boundary like `refined`, without corners and without more points: for pieces of a few grid cells."""
    points = _between(margins, good, bad)
    return frozen(points), np.roll(_label(margins, points), -1), _shoelace(points)


def _feasible(margins: Margins, points: Array) -> BoolArray:
    feasible: BoolArray = margins(points[:, 0], points[:, 1]).min(axis=0) >= 0.0
    return feasible


def _label(margins: Margins, points: Array) -> IntArray:
    label: IntArray = margins(points[:, 0], points[:, 1]).argmin(axis=0)
    return label


def _between(margins: Margins, good: Array, bad: Array) -> Array:
    """Points of the boundary on the straight lines from `good` to `bad` (n, 2), by bisection."""
    for _ in range(46):
        middle = 0.5 * (good + bad)
        feasible = _feasible(margins, middle)[:, None]
        good, bad = np.where(feasible, middle, good), np.where(feasible, bad, middle)
    return good


def _normals(points: Array) -> tuple[Array, Array]:
    """Middles of the sides and their unit normals into the region, (n, 2) each."""
    end = np.roll(points, -1, axis=0)
    side = end - points
    length = np.maximum(np.hypot(*side.T), 1e-300)[:, None]
    return 0.5 * (points + end), np.stack((-side[:, 1], side[:, 0]), axis=-1) / length


def _split_at_changes(margins: Margins, points: Array) -> tuple[Array, IntArray]:
    """Halve the sides over which the binding condition changes, so that short conditions between are found."""
    label = _label(margins, points)
    for _ in range(10):
        change = np.flatnonzero(label != np.roll(label, -1))
        middle, normal = (v[change] for v in _normals(points))
        length = np.hypot(*(np.roll(points, -1, axis=0) - points)[change].T)
        crossed, good, bad = _bracket(margins, middle, normal * length[:, None])
        if not crossed.any():
            break
        new = _between(margins, good, bad)
        where = change[crossed] + 1
        points, label = np.insert(points, where, new, axis=0), np.insert(label, where, _label(margins, new))
    return points, label


def _bracket(margins: Margins, middle: Array, inward: Array) -> tuple[BoolArray, Array, Array]:
    """Where the boundary next to `middle` (n, 2) lies along `inward`; far out where the region ends in a spike.

    Returns which of the n have one, and a feasible and an infeasible point for each of these.
    """
    steps = np.array([-8.0, -4.0, -2.0, -1.0, -0.5, -0.25, 0.0, 0.25, 0.5, 1.0])
    at = middle[:, None] + steps[:, None] * inward[:, None]
    inside = _feasible(margins, at.reshape(-1, 2)).reshape(at.shape[:2])
    enters = inside[:, 1:] & ~inside[:, :-1]
    crossed: BoolArray = np.asarray(np.any(enters, axis=1))
    nearest = np.where(enters, np.abs(steps[1:] + steps[:-1]), np.inf).argmin(axis=1)[crossed]
    rows = np.flatnonzero(crossed)
    return crossed, at[rows, nearest + 1], at[rows, nearest]


def _with_corners(margins: Margins, points: Array, label: IntArray) -> tuple[Array, IntArray]:
    """Insert the corners where the binding condition changes; returns points and the condition after each."""
    after, change = np.roll(label, -1), np.flatnonzero(label != np.roll(label, -1))
    if change.size == 0:
        return points, label
    one, two = label[change], after[change]
    end = np.roll(points, -1, axis=0)[change]
    start, near = 0.5 * (points[change] + end), np.hypot(*(end - points[change]).T)
    corner = _crossing(margins, start, one, two)
    found = np.hypot(*(corner - start).T) < 3.0 * near
    found &= margins(corner[:, 0], corner[:, 1]).min(axis=0) > -1e-9
    where = change[found] + 1
    return np.insert(points, where, corner[found], axis=0), np.insert(label, where, two[found])


def _crossing(margins: Margins, start: Array, one: IntArray, two: IntArray) -> Array:
    """Points (n, 2) near `start` where the margins `one` and `two` (n,) both vanish, by Newton steps."""
    at, pick, h = start.copy(), np.arange(len(start)), 1e-6
    for _ in range(8):
        value, right, up = (
            np.stack((m[one, pick], m[two, pick]), axis=-1)
            for m in (margins(*(at + shift).T) for shift in ([0.0, 0.0], [h, 0.0], [0.0, h]))
        )
        with np.errstate(all="ignore"):
            slope = np.stack((right - value, up - value), axis=-1) / h
            det = slope[:, 0, 0] * slope[:, 1, 1] - slope[:, 0, 1] * slope[:, 1, 0]
            move = (
                np.stack(
                    (
                        slope[:, 1, 1] * value[:, 0] - slope[:, 0, 1] * value[:, 1],
                        slope[:, 0, 0] * value[:, 1] - slope[:, 1, 0] * value[:, 0],
                    ),
                    axis=-1,
                )
                / det[:, None]
            )
        at = at - np.where(np.isfinite(move), np.clip(move, -0.5, 0.5), 0.0)
    return at


def _with_kinks(margins: Margins, points: Array, after: IntArray) -> tuple[Array, IntArray, Array, Array]:
    """Halve sides until their heights fall with the square of their length, which they do not about a kink.

    Returns points, the condition after each, the boundary points beside the middles, and their heights (n,).
    """
    before = np.full(len(points), np.inf)
    for _ in range(12):
        middles, away = _middles(margins, points, after)
        rough = (np.abs(away) > 0.35 * before) & (np.abs(away) > 1e-8)
        rough |= np.isinf(before)
        if not rough.any():
            break
        where = np.flatnonzero(rough) + 1
        before = np.insert(np.where(rough, np.abs(away), np.inf), where, np.abs(away[rough]))
        before = np.where(np.isinf(before), 1e300, before)
        points, after = (
            np.insert(points, where, middles[rough], axis=0),
            np.insert(after, where, after[rough]),
        )
    middles, away = _middles(margins, points, after)
    return points, after, middles, away


def _middles(margins: Margins, points: Array, after: IntArray) -> tuple[Array, Array]:
    """Boundary points beside the middles of the sides (n, 2), and how far inward of these they lie (n,)."""
    middle, normal = _normals(points)
    length = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    pick, h, away = np.arange(len(points)), 1e-6, np.zeros(len(points))
    for _ in range(5):
        at = middle + away[:, None] * normal
        value, beside = (margins(*p.T)[after, pick] for p in (at, at + h * normal))
        with np.errstate(all="ignore"):
            move = h * value / (beside - value)
        away = away - np.where(np.isfinite(move), move, 0.0)
    away = np.where(np.abs(away) < 0.2 * length, away, 0.0)
    moved: Array = middle + away[:, None] * normal
    return moved, away


def _shoelace(points: Array) -> float:
    end = np.roll(points, -1, axis=0)
    return 0.5 * float(np.sum(points[:, 0] * end[:, 1] - points[:, 1] * end[:, 0]))
