"""Slices of a line contact along its rays: those of the layers, or finer ones between which layers are interpolated."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.types import Array

GROWTH = 0.25  # of the distance from the middle: lengths of slices about a small spot


@dataclass(frozen=True, eq=False, slots=True)
class Slices:
    """Slices of a contact: their `middle` distances (s,) from O and `length` (s,), m; `inner` and `outer` (s,) ends."""

    middle: Array
    length: Array
    inner: Array
    outer: Array


def between(breaks: Array) -> Slices:
    """Return the slices between `breaks` (s+1,), m."""
    inner, outer = breaks[:-1], breaks[1:]
    return Slices(0.5 * (inner + outer), outer - inner, inner, outer)


def finer(slices: Slices, parts: int, least: float = 0.0) -> Slices:
    """Cut every slice into equal parts, and about the middle of them all into parts of the length `least` (m).

    From there they grow by GROWTH times the distance; 0 where equal parts are fine enough.
    """
    if parts == 1 and least == 0.0:
        return slices
    step = slices.inner[:, None] + slices.length[:, None] * np.arange(parts) / parts
    breaks = np.append(step.ravel(), slices.outer[-1])
    if least > 0.0:
        breaks = _graded(breaks, least)
    return between(breaks)


def _graded(breaks: Array, least: float) -> Array:
    """Return breaks no farther apart than `least` in the middle, GROWTH times the distance from it, and as before."""
    middle, half = 0.5 * (breaks[0] + breaks[-1]), 0.5 * (breaks[-1] - breaks[0])
    away = np.concatenate([[0.0], np.geomspace(0.1 * least, half, 2000)])
    size = least + GROWTH * away

    def side(sign: float) -> Array:
        given = np.interp(middle + sign * away, 0.5 * (breaks[1:] + breaks[:-1]), np.diff(breaks))
        each = 1.0 / np.minimum(size, given)
        count = np.concatenate([[0.0], np.cumsum(0.5 * (each[1:] + each[:-1]) * np.diff(away))])
        number = round(float(count[-1]) + 0.5)
        return np.asarray(np.interp(np.arange(1, number) / number * count[-1], count, away))

    return np.concatenate([breaks[:1], middle - side(-1.0)[::-1], [middle], middle + side(1.0), breaks[-1:]])


def interpolation(slices: Slices, fine: Slices) -> Array:
    """Return what turns values (s,) on slices into those (f, s) on finer ones: cubics through four middles.

    Rows add up to one, so the transpose keeps the sum of forces.
    """
    if len(slices.middle) == len(fine.middle):
        return np.eye(len(slices.middle))
    count, order = len(slices.middle), min(4, len(slices.middle))
    first = np.clip(np.searchsorted(slices.middle, fine.middle) - order // 2, 0, count - order)
    index = first[:, None] + np.arange(order)
    weight = np.zeros((len(fine.middle), count))
    np.put_along_axis(weight, index, lagrange(slices.middle[index], fine.middle), axis=1)
    return weight


def lagrange(at: Array, place: Array) -> Array:
    """Return the weights (…, m) of values at m points (…, m) for a place (…)."""
    value = np.ones_like(at)
    for i in range(at.shape[-1]):
        for j in range(at.shape[-1]):
            if i != j:
                value[..., i] *= (place - at[..., j]) / (at[..., i] - at[..., j])
    return value
