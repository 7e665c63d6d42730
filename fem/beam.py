"""Round stepped shafts as beams: what they resist at a few places, in bending and in torsion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from trochoid.fem.material import Material
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, slots=True)
class Step:
    """A stretch of a shaft from `low` to `high` with its radius, all in m."""

    low: float
    high: float
    radius: float


@dataclass(frozen=True, slots=True)
class Shaft:
    """Stiffness of a free shaft at n places: `bending` (n, n) in N/m on the deflections in one plane, slopes being
    free, and `torsion` (n, n) in N·m/rad on the rotations.
    """

    bending: Array
    torsion: Array


def shaft(steps: Sequence[Step], places: Sequence[float], material: Material) -> Shaft:
    """Condense a shaft, whose steps follow each other, on the given axial places (m); Timoshenko's beam.

    Raises Infeasible for a place beyond the shaft.
    """
    ends = [steps[0].low, *(step.high for step in steps)]
    tolerance = 1e-9 * (ends[-1] - ends[0])
    for place in places:
        if not ends[0] - tolerance <= place <= ends[-1] + tolerance:
            raise Infeasible(
                f"place {1e3 * place:.6g} mm is beyond the shaft from {1e3 * ends[0]:.6g} to {1e3 * ends[-1]:.6g} mm"
            )
    nodes = _merged(sorted([*ends, *places]), tolerance)
    count = len(nodes)
    bending, torsion = np.zeros((2 * count, 2 * count)), np.zeros((count, count))
    for i, (low, high) in enumerate(pairwise(nodes)):
        middle = 0.5 * (low + high)
        radius = next(step.radius for step in steps if step.low <= middle <= step.high)
        bend, twist = _element(high - low, radius, material)
        bending[2 * i : 2 * i + 4, 2 * i : 2 * i + 4] += bend
        torsion[i : i + 2, i : i + 2] += twist
    at = [int(np.argmin(np.abs(np.array(nodes) - place))) for place in places]
    return Shaft(frozen(condensed(bending, [2 * i for i in at])), frozen(condensed(torsion, at)))


def condensed(stiffness: Array, kept: Sequence[int]) -> Array:
    """Return a stiffness on some of its coordinates, the others being free (static condensation)."""
    rest = [i for i in range(len(stiffness)) if i not in set(kept)]
    keep = list(kept)
    if not rest:
        return np.asarray(stiffness[np.ix_(keep, keep)])
    inner = np.linalg.solve(stiffness[np.ix_(rest, rest)], stiffness[np.ix_(rest, keep)])
    made = stiffness[np.ix_(keep, keep)] - stiffness[np.ix_(keep, rest)] @ inner
    return np.asarray(0.5 * (made + made.T))


def _merged(places: list[float], tolerance: float) -> list[float]:
    nodes = places[:1]
    for place in places[1:]:
        if place - nodes[-1] > tolerance:
            nodes.append(place)
    return nodes


def _element(length: float, radius: float, material: Material) -> tuple[Array, Array]:
    """Return bending (4, 4) on deflection and slope at both ends, and torsion (2, 2), of a round stretch.

    Shear coefficient 6(1 + ν)/(7 + 6ν) (Cowper 1966).
    """
    nu, modulus = material.poissons_ratio, material.youngs_modulus
    shear, area = modulus / (2 * (1 + nu)), math.pi * radius**2
    inertia, coefficient = 0.25 * area * radius**2, 6 * (1 + nu) / (7 + 6 * nu)
    phi = 12 * modulus * inertia / (coefficient * shear * area * length**2)
    a, b = length, length**2
    unit = np.array(
        [
            [12, 6 * a, -12, 6 * a],
            [6 * a, (4 + phi) * b, -6 * a, (2 - phi) * b],
            [-12, -6 * a, 12, -6 * a],
            [6 * a, (2 - phi) * b, -6 * a, (4 + phi) * b],
        ]
    )
    bend = modulus * inertia / ((1 + phi) * length**3) * unit
    twist = shear * 2 * inertia / length * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return bend, twist
