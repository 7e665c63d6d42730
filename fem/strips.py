"""Strips of constant pressure on a surface: their compliance in closed form.

Only the logarithm acts inside a contact; lengths in it are in metres, as in the tabulated smooth part.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from trochoid.fem.problem import Unit
from trochoid.kinematics.types import Array, frozen

STRIPS = 27  # per contact, an odd number so that one sits at the middle
REACH = 1.3  # half-widths covered on each side


def strip_centres(count: int = STRIPS) -> Array:
    """Return the strips' centres in units of the half-width covered, −1 … 1."""
    return (2 * np.arange(count) + 1.0 - count) / count


@lru_cache(maxsize=8)
def _unit(count: int) -> Array:
    """Return −∫ln|x−y|dy over unit strips, seen from the centres of unit strips."""
    d = np.abs(np.subtract.outer(np.arange(count), np.arange(count))).astype(float)
    outer, inner = d + 0.5, d - 0.5
    return frozen(1.0 - outer * np.log(outer) + inner * np.log(np.abs(inner)))


@lru_cache(maxsize=8)
def strip_unit(count: int = STRIPS) -> Unit:
    """Return the logarithm's compliance (m, m) of strips that cover a unit length together.

    Strips that cover a length b add −ln(b) to every entry, which acts on their total force alone.
    """
    return Unit.of(_unit(count) + np.log(count))


def strip_compliance(kernel: Array, width: Array, count: int = STRIPS) -> Array:
    """Return (c, m, m): displacement at a strip's centre per unit *force* on a strip, in m/N.

    `kernel` (c,) is the sum of 2/(πE') of both bodies over the face width, `width` (c,) one strip's width in
    m.
    """
    return np.asarray(kernel[:, None, None] * (_unit(count)[None] - np.log(width)[:, None, None]))


def curve_compliance(kernel: float, points: Array, width: Array) -> Array:
    """Return (m, m): logarithmic compliance between strips at `points` (m, 2) of `width` (m,) along a curve;
    the chord stands for the arc.
    """
    distance = np.linalg.norm(points[:, None] - points[None], axis=-1)
    half = 0.5 * width[None, :]
    np.fill_diagonal(distance, 0.0)
    outer, inner = distance + half, distance - half
    result = 1.0 - (outer * np.log(outer) - inner * np.log(np.abs(inner))) / width[None, :]
    return np.asarray(kernel * 0.5 * (result + result.T))
