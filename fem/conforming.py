"""Conforming contact: a pin in its hole, a roller in its bore. The surfaces touch over an arc on which the
normals turn and neither body is a half-plane any more, so that all strips act on each other through the whole
compliance of both bodies.

Strip on strip, the logarithm is integrated over the strip, along the chord. S is taken at the strips' centres,
and its kink at x = y (see `compliance`) is averaged over the strip itself: a quarter of its width.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.fem.complementarity import Group
from trochoid.fem.compliance import Compliance, Surface, surface_weights
from trochoid.fem.strips import curve_compliance
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Face:
    """A body's surface under m strips: their centres' arc length `place` (m,) and `points` (m, 2), both in m."""

    compliance: Compliance
    surface: Surface
    place: Array
    points: Array


def face_compliance(face: Face, width: Array) -> Array:
    """Return (m, m) in 1/Pa: normal displacement at strips' centres per unit line load on strips of `width` (m,)."""
    smooth = face.compliance.smooth(surface_weights(face.surface, face.place), face.points)
    smooth[np.diag_indices_from(smooth)] += face.surface.kink * width / 4
    return curve_compliance(face.compliance.kernel, face.points, width) + smooth


def conforming_group(
    faces: Sequence[Face], width: Array, face_width: float, gap: Array, arms: Array
) -> Group:
    """Return the strips of one conforming contact as a block of the contact problem, with no coupling left to add.

    `width` (m,) of the strips along the arc, `face_width` of the bodies, `gap` (m,), all in m; `arms` (m, k):
    how fast each gap closes per unit motion, along the normal at that strip.
    """
    local = sum((face_compliance(face, width) for face in faces), start=np.zeros((len(width),) * 2))
    return Group(local[None] / face_width, gap[None], arms[None])
