"""Follow a curve of solutions of equations with one parameter, round its folds (pseudo-arclength)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import islice, pairwise
from typing import Protocol

import numpy as np

from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array

MOST = 4000  # points of one curve
NUDGE = 1e-6


class Equations(Protocol):
    """Equations at one value of the parameter: the residual of unknowns with its slopes, and the Jacobian of these."""

    def residual(self, unknowns: Array) -> tuple[Array, Array]:
        """Return the residual, shaped as the unknowns, and slopes for the Jacobian."""
        ...

    def jacobian(self, slope: Array) -> Array:
        """Return the derivative of the flat residual by the flat unknowns."""
        ...


Made = Callable[[float], Equations]


def curve(
    made: Made, unknowns: Array, begin: float, towards: float, step: float
) -> Iterator[tuple[float, Array]]:
    """Yield (parameter, unknowns) along the curve through `unknowns` at `begin`, at first `towards` a value.

    `step` is the length between points, in shares of the unknowns and of the larger value; at most MOST points.
    Raises NotConverged where the curve is lost.
    """
    size = max(float(np.abs(unknowns).max()), 1e-300)
    reach = max(abs(begin), abs(towards))
    shape = unknowns.shape

    def residual(point: Array) -> Array:
        return np.asarray(
            made(reach * point[-1]).residual(size * point[:-1].reshape(shape))[0].ravel() / size
        )

    def slopes(point: Array) -> Array:
        equations = made(reach * point[-1])
        value, slope = equations.residual(size * point[:-1].reshape(shape))
        ahead = residual(np.append(point[:-1], point[-1] + NUDGE)) - value.ravel() / size
        return np.column_stack([equations.jacobian(slope), ahead / NUDGE])

    point = np.append(unknowns.ravel() / size, begin / reach)
    tangent = np.append(np.zeros(len(point) - 1), np.sign(towards - begin))
    length = step
    for _ in range(MOST):
        yield reach * float(point[-1]), size * point[:-1].reshape(shape)
        tangent = _tangent(slopes(point), tangent)
        while (moved := _corrected(residual, slopes, point + length * tangent, tangent)) is None:
            length *= 0.5
            if length < 1e-4 * step:
                raise NotConverged(f"the curve of solutions was lost at {reach * point[-1]:.6g}")
        point, length = moved, min(1.5 * length, step)


def crossings(made: Made, unknowns: Array, begin: float, at: float, step: float) -> Iterator[Array]:
    """Yield guesses of the unknowns wherever the curve comes to the value `at`."""
    for (before, low), (after, high) in pairwise(islice(curve(made, unknowns, begin, at, step), MOST)):
        if (before - at) * (after - at) <= 0.0:
            yield low + (at - before) / (after - before) * (high - low)


def _tangent(slopes: Array, before: Array) -> Array:
    """Return the unit tangent, on the side of the one before."""
    tangent = np.linalg.solve(np.vstack([slopes, before]), np.append(np.zeros(len(slopes)), 1.0))
    return np.asarray(tangent / np.linalg.norm(tangent))


def _corrected(
    residual: Callable[[Array], Array], slopes: Callable[[Array], Array], guess: Array, tangent: Array
) -> Array | None:
    """Return the point of the curve in the plane across the tangent at `guess`, None where Newton fails."""
    point = guess
    for _ in range(12):
        error = np.append(residual(point), tangent @ (point - guess))
        if float(np.abs(error).max()) <= 1e-10 * max(1.0, float(np.abs(point).max())):
            return point
        point = point - np.linalg.solve(np.vstack([slopes(point), tangent]), error)
    return None
