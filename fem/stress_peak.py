"""Where a stress is largest: from the best node of the cut triangles on finer and finer grids, up to the surface."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.fem.locate import located, round_element
from trochoid.fem.stress import State, basis, sample
from trochoid.geometry.mesh import Mesh
from trochoid.kinematics.types import Array, IntArray

GRIDS = 4  # each four times finer than the one before
REACH = 4  # points of a grid on each side of its middle
NEAR = 0.95  # of the largest node: contacts below it are not looked at
CONTACTS = 4  # looked at, at the most

Measure = Callable[[Array], Array]  # stress (..., 3) xx, yy, xy to a number (...)


@dataclass(frozen=True, slots=True)
class Peak:
    """Largest `value` of a stress in Pa, its `node` and `place` (2,) in m, and the `depth` in m below the surface."""

    value: float
    node: int
    place: Array
    depth: float


@dataclass(frozen=True, slots=True)
class Spot:
    """A place in an element: its number, reference coordinates (2,), place (2,) in m, and the value there."""

    element: int
    reference: Array
    place: Array
    value: float


def highest(
    state: State, measure: Measure, elements: IntArray, reference: Array, values: Array, size: Array
) -> Spot:
    """Return the highest place near the best of the sampled ones.

    Samples: `elements` (k,), `reference` coordinates (k, 2), `values` (k,) of the measure and the `size` (k,) in m
    of their triangles. The best of each contact is followed, when it is not far below the best of all.
    """
    mesh = state.body.mesh
    places = (basis(reference)[:, None] @ mesh.points[mesh.triangles.T[elements]])[:, 0]
    loaded = np.array([load.point for load in state.loads]).reshape(-1, 2)
    good = np.flatnonzero(values >= NEAR * values.max())
    nearest = np.linalg.norm(places[good, None] - loaded, axis=-1).argmin(axis=1)
    order = np.argsort(-values[good], kind="stable")
    first = order[np.sort(np.unique(nearest[order], return_index=True)[1])][:CONTACTS]
    found = []
    for i in good[first]:
        spot = Spot(int(elements[i]), reference[i], places[i], float(values[i]))
        found.append(_climbed(state, measure, spot, float(size[i]) / REACH))
    return max(found, key=lambda spot: spot.value)


def depth(mesh: Mesh, place: Array) -> float:
    """Return the distance in m of a place (2,) from the nearest edge of the body."""
    facets = np.concatenate([*mesh.edges.values()], axis=1)
    close = np.linalg.norm(_edge_points(mesh, facets, 9) - place, axis=-1).min(axis=1)
    best = facets[:, np.argsort(close)[:4]]
    return float(np.linalg.norm(_edge_points(mesh, best, 4001) - place, axis=-1).min())


def _edge_points(mesh: Mesh, facets: IntArray, count: int) -> Array:
    """Return points (k, count, 2) on quadratic facets (3, k)."""
    x = np.linspace(0.0, 1.0, count)
    shape = np.stack([(1 - x) * (1 - 2 * x), x * (2 * x - 1), 4 * x * (1 - x)], axis=-1)
    return np.asarray(shape @ mesh.points[facets.T])


def _climbed(state: State, measure: Measure, spot: Spot, spacing: float) -> Spot:
    """Follow a place to the highest near it; `spacing` in m is the first grid's."""
    steps = np.arange(-REACH, REACH + 1.0)
    grid = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    for _ in range(GRIDS):
        near = round_element(state.body.mesh, spot.element)
        elements, reference = located(state.body.mesh, near, spot.place + spacing * grid)
        points, _, stress = sample(state, elements, basis(reference)[:, None])
        values = measure(stress[:, 0])
        best = int(np.argmax(values))
        if values[best] > spot.value:
            spot = Spot(int(elements[best]), reference[best], points[best, 0], float(values[best]))
        spacing /= REACH
    return spot
