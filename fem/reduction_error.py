"""What a reduction costs: natural frequencies of the free body by its few coordinates against all of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import csc_matrix

from trochoid.fem.linear_solver import factorise
from trochoid.fem.reduction import Reduced, joined, spread
from trochoid.fem.solid_modes import lowest_modes
from trochoid.kinematics.types import Array, frozen

FREE = 6  # motions of a free body that strain nothing


@dataclass(frozen=True, slots=True)
class ReductionError:
    """Elastic natural frequencies (m,) of the free body with its rigid interfaces, Hz: of the `full` model and of the
    `reduced` one, which are above them.
    """

    full: Array
    reduced: Array

    @property
    def relative(self) -> Array:
        """Reduced over full, less one, (m,)."""
        return np.asarray(self.reduced / self.full - 1.0)


def reduction_error(reduced: Reduced, count: int | None = None, solver: str | None = None) -> ReductionError:
    """Compare the lowest `count` elastic frequencies; None: those up to half of what the reduction keeps, at least one.

    It factors the whole model once more.  Raises NotConverged.
    """
    squares = eigh(reduced.stiffness, reduced.mass, eigvals_only=True)[FREE:]
    hertz = np.sqrt(np.maximum(squares, 0.0)) / (2.0 * np.pi)
    wanted = max(1, int((hertz <= 0.5 * reduced.upper).sum())) if count is None else min(count, len(hertz))
    join = joined(reduced.body, reduced.interfaces)
    stiffness = csc_matrix(join.T @ reduced.body.stiffness @ join)
    mass = csc_matrix(join.T @ spread(reduced.body.mass) @ join)
    shift = -float(
        squares[0]
    )  # far enough below the free motions for the factor, near enough for few iterations
    solve = factorise(csc_matrix(stiffness - shift * mass), solver)
    full, _ = lowest_modes(mass, solve, FREE + wanted, shift)
    return ReductionError(frozen(full[FREE:]), frozen(hertz[:wanted]))
