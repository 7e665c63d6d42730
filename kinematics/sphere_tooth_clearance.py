"""Where pins may cut a sphere tooth away: the global limit of their size, and brute force over every position."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.spherical import angle_between
from trochoid.kinematics.types import Array

_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


def clear_pin_angle(tooth: SphereTooth) -> float:
    """Largest pin angle (rad) at which no pin cuts the flank anywhere, at no crank angle.

    A pin that touches at u and leaves the place u' of its path clear has tan r ≤ (1 − u·u')/(σ N·u'); the
    least over all pairs, with u' → u the local limit `undercut_angle`, is the limit.  Pairs of one half lobe
    and the path within twice that limit are searched on a grid, which is then refined about its least.
    """
    local = tooth.undercut_angle
    pitch = 2.0 * math.pi / tooth.lobes
    here = np.linspace(0.0, 0.5 * pitch, 25)
    width = pitch / 48.0
    steps = math.ceil(min(_window(tooth, here, local), math.pi) / width)
    there: Array = width * np.arange(-steps, steps + 25, dtype=np.float64)
    ratio = _opening(tooth, here, there)
    ratio[np.arctan(0.8 * ratio) > local] = math.inf
    pairs = [(float(here[i]), float(there[j])) for i, j in _hollows(ratio)]
    apart = [
        pair for pair in pairs if abs(pair[0] - pair[1]) > 3.5 * width
    ]  # nearer ones are the local limit
    return min([local, *(math.atan(_refined(tooth, p, q, width)) for p, q in apart[:8])])


def _hollows(values: Array) -> list[tuple[int, int]]:
    """Places of finite values (n, m) that no neighbour in row or column undercuts, the least first."""
    padded = np.pad(values, 1, constant_values=math.inf)
    least = np.isfinite(values)
    for near in (padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]):
        least &= values <= near
    rows, columns = np.nonzero(least)
    order = np.argsort(values[rows, columns])
    return [(int(rows[i]), int(columns[i])) for i in order]


def _refined(tooth: SphereTooth, p: float, q: float, width: float) -> float:
    """Least opening about a pair of places, by windows of half the width about the least of the one before."""
    best = math.inf
    while width > 1e-9 * math.pi / tooth.lobes:
        around = np.linspace(-0.75 * width, 0.75 * width, 9)
        ratio = _opening(tooth, p + around, q + around)
        row, column = np.unravel_index(int(np.argmin(ratio)), ratio.shape)
        best = min(best, float(ratio[row, column]))
        p, q, width = p + float(around[row]), q + float(around[column]), 0.5 * width
    return best


def _window(tooth: SphereTooth, p: Array, pin_angle: float) -> float:
    """Parameters (rad) beyond which places of the path are farther apart than twice the pin angle.

    Azimuths are so beyond 2 asin(sin r/sin(polar angle)), and no parameter is farther from its azimuth than at `p`.
    """
    nearest = min(math.sin(tooth.polar_angle - tooth.nutation), math.sin(tooth.polar_angle + tooth.nutation))
    share = math.sin(min(pin_angle, 0.5 * math.pi)) / nearest if nearest > 0.0 else 1.0
    path = tooth.center_path(p)
    lead = np.remainder(np.arctan2(path[:, 1], path[:, 0]) - p + math.pi, 2.0 * math.pi) - math.pi
    return 2.0 * math.asin(min(share, 1.0)) + 2.1 * float(np.abs(lead).max())


def _opening(tooth: SphereTooth, here: Array, there: Array) -> Array:
    """(1 − u·u')/(σ N·u') (n, m), infinite where u' lies on the other side, or so near that κ decides."""
    apart = np.remainder(here[:, None] - there + math.pi, 2.0 * math.pi) - math.pi
    thin = replace(tooth, pin_angle=0.0)
    u, side = thin.point(here), -thin.normal(here)
    away = thin.point(there)[None, :, :] - u[:, None, :]
    along = np.einsum("nmi,ni->nm", away, side)
    chord = 0.5 * np.sum(away**2, axis=-1)
    clear = (along > 0.0) & (np.abs(apart) > math.pi / (24.0 * tooth.lobes))
    return np.where(clear, chord / np.where(clear, along, 1.0), math.inf)


def penetration(tooth: SphereTooth, samples: int = 128, path_samples: int = 48) -> float:
    """How deep (rad) any pin cuts into the flank at any crank angle: brute force over points of one lobe.

    Each of `samples` flank points is compared with the whole path of the pins, of `path_samples` places per
    lobe; every minimum of the distance is refined.  0 within rounding for a flank that is an envelope.
    """
    flank = tooth.point(np.linspace(0.0, 2.0 * math.pi / tooth.lobes, samples, endpoint=False))
    count = path_samples * tooth.lobes
    q = 2.0 * math.pi * np.arange(count) / count
    near = flank @ tooth.center_path(q).T
    peak = (near >= np.roll(near, 1, axis=1)) & (near >= np.roll(near, -1, axis=1))
    row, column = np.nonzero(peak & (near >= near.max(axis=1, keepdims=True) - 1e-2 * tooth.pin_angle))
    low, high = q[column] - q[1], q[column] + q[1]
    closest = _least_angle(tooth, flank[row], low, high)
    return float(np.max(tooth.pin_angle - closest))


def _least_angle(tooth: SphereTooth, points: Array, low: Array, high: Array) -> Array:
    """Least angle (rad) between points (n, 3) and the pin path within brackets (n,): golden sections."""

    def away(t: Array) -> Array:
        square: Array = np.sum((tooth.center_path(t) - points) ** 2, axis=-1)
        return square

    a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    at_a, at_b = away(a), away(b)
    for _ in range(42):
        left = at_a < at_b
        low, high = np.where(left, low, a), np.where(left, b, high)
        kept, at_kept = np.where(left, a, b), np.where(left, at_a, at_b)
        new = np.where(left, high - _GOLDEN * (high - low), low + _GOLDEN * (high - low))
        at_new = away(new)
        a, at_a = np.where(left, new, kept), np.where(left, at_new, at_kept)
        b, at_b = np.where(left, kept, new), np.where(left, at_kept, at_new)
    return angle_between(points, tooth.center_path(np.where(at_a < at_b, a, b)))
