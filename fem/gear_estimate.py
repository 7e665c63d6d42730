"""Discretisation error of a gear mesh, from two levels of facets per flank (half as many on the coarser).

Forces, transmission error and stiffness converge with nearly the second order of the facet length; half of the
difference between two levels is reported as the error of the finer one, as everywhere. Numbers at one position may
agree by chance: each is given no less than the root mean square over all positions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.gear_path import Path
from trochoid.kinematics.types import Array, frozen

SHARE = 0.5  # of the difference between levels


@dataclass(frozen=True, slots=True)
class PathError:
    """Estimated errors (n,) of a path's `error` in m and `stiffness` in N/m, and of the largest `force` in N and
    `pressure` in Pa of each position.
    """

    error: Array
    stiffness: Array
    force: Array
    pressure: Array


def path_error(fine: Path, coarse: Path) -> PathError:
    """Return the estimated discretisation errors of the finer of two paths at the same positions."""
    return PathError(
        spread(fine.error, coarse.error),
        spread(fine.stiffness, coarse.stiffness),
        spread(fine.force.max(axis=1), coarse.force.max(axis=1)),
        spread(fine.pressure.max(axis=1), coarse.pressure.max(axis=1)),
    )


def spread(fine: Array, coarse: Array) -> Array:
    """Return the estimated error (n,) of a number on the finer level at each position."""
    difference = np.abs(fine - coarse)
    return frozen(SHARE * np.maximum(difference, np.sqrt(np.mean(difference**2))))
