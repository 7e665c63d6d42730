"""Slices of a line contact along its rays: those of the layers, or finer ones between which layers are interpolated."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.types import Array


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


def finer(slices: Slices, parts: int) -> Slices:
    """Cut every slice into equal parts."""
    if parts == 1:
        return slices
    step = slices.inner[:, None] + slices.length[:, None] * np.arange(parts) / parts
    return between(np.append(step.ravel(), slices.outer[-1]))


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
