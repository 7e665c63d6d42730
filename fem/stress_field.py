"""The stress field to look at: the mesh itself, and near each contact its triangles cut down to the
contact's size.

Cut triangles have nodes of their own; the fields on them come from the same state, so nothing is interpolated
across a peak.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.fem.body import Body
from trochoid.fem.hertz import max_shear, out_of_plane, von_mises
from trochoid.fem.stress import Press, State, basis, sample, solve_state
from trochoid.fem.stress_peak import Measure, Peak, Spot, depth, highest
from trochoid.kinematics.types import Array, BoolArray, IntArray, frozen

CUTS = 9  # at the most: a triangle is halved that often
NODES = np.array([[0, 0], [1, 0], [0, 1], [0.5, 0], [0.5, 0.5], [0, 0.5]])
CHILDREN = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (4, 5, 3))  # of a triangle, by its six nodes


@dataclass(frozen=True, slots=True)
class StressField:
    """Fields on quadratic triangles.

    `points` (n, 2) m, `triangles` (6, m), `displacement` (n, 2) m, `stress` (n, 4) xx, yy, zz, xy, `von_mises`
    (n,) and `max_shear` (n,) Pa, half the largest difference of principal stresses. The peaks of both have a node.
    """

    points: Array
    triangles: IntArray
    displacement: Array
    stress: Array
    von_mises: Array
    max_shear: Array
    von_mises_peak: Peak
    max_shear_peak: Peak


def stress_field(body: Body, presses: Sequence[Press]) -> StressField:
    """Return the field of a body under contacts."""
    state, mesh = solve_state(body, presses), body.mesh
    whole, elements, corners = _cut(state)
    for spot in _highest(state, elements, corners):
        elements, corners = _with_node(elements, corners, spot)
    everywhere = np.arange(mesh.triangles.shape[1])
    _, moved, stressed = sample(state, everywhere, np.broadcast_to(basis(NODES), (len(everywhere), 6, 6)))
    fine, fine_moved, fine_stressed = sample(state, elements, basis(_six(corners)))
    count = len(mesh.points)
    triangles = np.concatenate(
        [mesh.triangles[:, whole], count + np.arange(6 * len(elements)).reshape(-1, 6).T], axis=1
    )
    points = np.concatenate([mesh.points, fine.reshape(-1, 2)])
    displacement = np.concatenate([_averaged(body, moved), fine_moved.reshape(-1, 2)])
    stress = np.concatenate([_averaged(body, stressed), fine_stressed.reshape(-1, 3)])
    fields = [measure(stress) for measure in _measures(body)]
    used = np.unique(triangles)
    peaks = [_peak(body, points, values, used) for values in fields]
    full = np.column_stack([stress[:, 0], stress[:, 1], out_of_plane(stress, body.plane), stress[:, 2]])
    triangles.setflags(write=False)
    return StressField(
        frozen(points),
        triangles,
        frozen(displacement),
        frozen(full),
        frozen(fields[0]),
        frozen(fields[1]),
        *peaks,
    )


def _measures(body: Body) -> tuple[Measure, Measure]:
    return lambda stress: von_mises(stress, body.plane), lambda stress: max_shear(stress, body.plane)


def _highest(state: State, elements: IntArray, corners: Array) -> list[Spot]:
    """Return the highest place of each measure in the cut triangles (k,) with reference corners (k, 3, 2)."""
    if len(elements) == 0:
        return []
    six = _six(corners)
    points, _, stress = sample(state, elements, basis(six))
    size = np.linalg.norm(points[:, :3] - np.roll(points[:, :3], 1, axis=1), axis=-1).max(axis=1)
    nodes = np.repeat(elements, 6), six.reshape(-1, 2)
    return [
        highest(state, measure, *nodes, measure(stress).ravel(), np.repeat(size, 6))
        for measure in _measures(state.body)
    ]


def _with_node(elements: IntArray, corners: Array, spot: Spot) -> tuple[IntArray, Array]:
    """Divide the triangle that holds a place into three about it, so that it is a node."""
    of = np.flatnonzero(elements == spot.element)
    if len(of) == 0:
        return elements, corners
    first, sides = (
        corners[of, 0],
        np.stack([corners[of, 1], corners[of, 2]], axis=-1) - corners[of, 0, :, None],
    )
    share = np.linalg.solve(sides, (spot.reference - first)[..., None])[..., 0]
    least = np.minimum(share.min(axis=1), 1 - share.sum(axis=1))
    cut = of[int(np.argmax(least))]
    parts = np.tile(corners[cut], (3, 1, 1))
    parts[np.arange(3), np.arange(3)] = spot.reference
    area = np.linalg.det(np.stack([parts[:, 1] - parts[:, 0], parts[:, 2] - parts[:, 0]], axis=1))
    parts = parts[area > 1e-6 * area.sum()]  # on a side there are two, at a corner one
    return (
        np.concatenate([np.delete(elements, cut), np.full(len(parts), spot.element)]),
        np.concatenate([np.delete(corners, cut, axis=0), parts]),
    )


def _peak(body: Body, points: Array, values: Array, used: IntArray) -> Peak:
    top = used[int(np.argmax(values[used]))]
    return Peak(float(values[top]), int(top), frozen(points[top]), depth(body.mesh, points[top]))


def _cut(state: State) -> tuple[BoolArray, IntArray, Array]:
    """Return which elements stay whole, and the parts of the cut ones: elements (k,) and reference corners
    (k, 3, 2).
    """
    mesh = state.body.mesh
    elements = np.arange(mesh.triangles.shape[1])
    corners = np.broadcast_to(NODES[:3], (len(elements), 3, 2)).copy()
    coarse = _too_coarse(state, elements, corners)
    whole = ~coarse
    done: list[tuple[IntArray, Array]] = [(elements[:0], corners[:0])]
    elements, corners = elements[coarse], corners[coarse]
    for _ in range(CUTS):
        if len(elements) == 0:
            break
        six = _six(corners)
        corners = np.concatenate([six[:, child] for child in CHILDREN])
        elements = np.tile(elements, 4)
        coarse = _too_coarse(state, elements, corners)
        done.append((elements[~coarse], corners[~coarse]))
        elements, corners = elements[coarse], corners[coarse]
    done.append((elements, corners))
    return whole, np.concatenate([e for e, _ in done]), np.concatenate([c for _, c in done])


def _too_coarse(state: State, elements: IntArray, corners: Array) -> BoolArray:
    """Mark triangles longer than most of their distance from a contact, unless they are finer than it."""
    mesh = state.body.mesh
    places = basis(corners) @ mesh.points[mesh.triangles.T[elements]]  # (k, 3, 2)
    size = np.linalg.norm(places - np.roll(places, 1, axis=1), axis=-1).max(axis=1)
    coarse = np.zeros(len(elements), dtype=bool)
    for press, load in zip(state.presses, state.loads, strict=True):
        distance = np.linalg.norm(places.mean(axis=1) - load.point, axis=-1)
        coarse |= size > np.maximum(0.8 * distance, 0.5 * press.half_width)
    return coarse


def _six(corners: Array) -> Array:
    """Return reference coordinates (k, 6, 2) of the nodes of straight sub-triangles (k, 3, 2)."""
    return np.concatenate([corners, 0.5 * (corners[:, [0, 1, 0]] + corners[:, [1, 2, 2]])], axis=1)


def _averaged(body: Body, values: Array) -> Array:
    """Average element values (m, 6, c) at each node (n, c)."""
    nodes = body.mesh.triangles.T
    total = np.zeros((len(body.mesh.points), values.shape[-1]))
    np.add.at(total, nodes, values)
    return np.asarray(total / np.bincount(nodes.ravel(), minlength=len(total))[:, None])
