"""Boundaries of the blocking contours as entries of a dataset; shifts are in modules."""

from __future__ import annotations

import numpy as np

from trochoid.drives.entries import Entries, entry, named
from trochoid.drives.planetary.stages import Stages
from trochoid.geometry.blocking_contour import Contour


def blocking_entries(stages: Stages) -> Entries:
    """Return, of the contour of each mesh, the points of its boundary, what binds after each, and lengths by condition.

    Boundaries stand one after the other; `_boundary` tells which one a point is of.
    """
    found = stages.blocking
    return {**_contour(found.outer, "sun_and_planet"), **_contour(found.inner, "planet_and_ring")}


def _contour(contour: Contour, mesh: str) -> Entries:
    if not contour.boundaries:
        return {}
    points = np.concatenate([b.points for b in contour.boundaries])
    which = np.repeat(np.arange(len(contour.boundaries)), [len(b.points) for b in contour.boundaries])
    after = np.concatenate([np.roll(b.points, -1, axis=0) for b in contour.boundaries])
    binding = np.concatenate([b.conditions for b in contour.boundaries])
    sides = np.hypot(*(after - points).T)
    lengths = np.bincount(binding, weights=sides, minlength=len(contour.names))
    point, condition, words = f"{mesh}_point", f"{mesh}_condition", mesh.replace("_", " ")
    return {
        condition: named(condition, contour.names, "condition"),
        "shift": named("shift", ("first gear", "second gear"), "shift of"),
        f"{mesh}_boundary_points": entry((point, "shift"), points, "", f"boundary of the contour, {words}"),
        f"{mesh}_boundary": entry((point,), which, "", "which boundary a point is of"),
        f"{mesh}_boundary_binding": entry((point,), binding, "", "condition that binds after a point"),
        f"{mesh}_boundary_length": entry((condition,), lengths, "", "length of boundary of a condition"),
    }
