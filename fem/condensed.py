"""Displacements at few places under loads that touch few nodes, without solving for the whole body each time.

The body is cut into parts of nearly equal size. What is inside a part is eliminated once, which leaves a small system
for the borders between parts. A load then costs a solution of the one or two parts that it touches and of the borders:
for many loads on a fine mesh that grows with their number, where whole solutions grow with its square.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix

from trochoid.fem.body import Body
from trochoid.fem.linear_solver import BLOCK, Solve, factorise
from trochoid.kinematics.types import Array, IntArray

PART = 4000  # degrees of freedom of a part: a smaller one has more border, a larger one costs more per load


def displaced(body: Body, seen: Sequence[csc_matrix], load: csc_matrix, mean: Array) -> list[Array]:
    """Return what each set of measures (2n, m) reads of the displacement under each `load` (2n, c), as (m, c).

    A free body is balanced by inertia relief and its mean motion removed; `mean` (3, c) adds to that motion's
    integrals what the nodes do not know of. What a set reads does not depend on the other sets, to the last bit.
    """
    held = through(body, seen, load)
    if body.relief is None:
        return held
    r = body.relief
    weighed = body.solve(r.weighted)  # under the nodal loads of the rigid accelerations
    total = np.linalg.solve(r.gram, (load.T @ r.modes).T)
    motion = (load.T @ weighed).T - r.weighted.T @ weighed @ total + mean
    rigid = np.linalg.solve(r.gram, motion)
    return [h - s.T @ weighed @ total - s.T @ r.modes @ rigid for h, s in zip(held, seen, strict=True)]


def through(body: Body, seen: Sequence[csc_matrix], load: csc_matrix, size: int | None = None) -> list[Array]:
    """Return seenᵀ K⁻¹ load (m, c) of each set with the body's supports; `size` as PART, which None means."""
    parts = _parts(body, max(1, round(body.size / (size or PART))))
    borders = parts.borders
    sets, load = [csr_matrix(s) for s in seen], csr_matrix(load)
    results = [np.zeros((s.shape[1], load.shape[1])) for s in sets]
    pull = load[borders].toarray(order="F")
    views, stiffness = [], np.zeros((len(borders),) * 2)
    for elements in parts.elements:
        part = _eliminated(body, elements, parts)
        watches = [_watch(s[part.inner].tocsc()) for s in sets]
        views.append((part.border, [(w.rows, w.measures @ part.reach) for w in watches]))
        _inside(part, watches, load[part.inner].tocsc(), results, pull)
        stiffness[np.ix_(part.border, part.border)] += part.stiffness
    if len(borders):
        solve = factorise(csc_matrix(stiffness), body.solver)
        for start in range(0, pull.shape[1], BLOCK):
            chosen = slice(start, start + BLOCK)
            moved = solve(pull[:, chosen])
            for i, result in enumerate(results):
                result[:, chosen] += sets[i][borders].T @ moved
                for border, view in views:
                    rows, reach = view[i]
                    result[rows, chosen] += reach @ moved[border]
    return results


@dataclass(frozen=True, slots=True)
class Watch:
    """The measures of a set that see the inside of a part: their `rows` in the result, and themselves (r, i)."""

    rows: IntArray
    measures: csr_matrix


def _watch(seen: csc_matrix) -> Watch:
    rows = np.flatnonzero(np.diff(seen.indptr))
    return Watch(rows, seen[:, rows].T)


@dataclass(frozen=True, slots=True)
class Parts:
    """A body cut up: the `elements` of each part, the degrees of freedom on `borders` (g,), and for all degrees of
    freedom (2n,) their `number` among these, −1 elsewhere.
    """

    elements: tuple[IntArray, ...]
    borders: IntArray
    number: IntArray


@dataclass(frozen=True, slots=True)
class Part:
    """One part: its degrees of freedom `inner` (i,), its `border` (b,) by number, the solution inside with the border
    held, inner displacements `reach` (i, b) per unit of the border's, and the `stiffness` (b, b) that it gives these.
    """

    inner: IntArray
    border: IntArray
    solve: Solve
    reach: Array
    stiffness: Array


def _parts(body: Body, count: int) -> Parts:
    label = _cut(body.parts.centroids, count)
    first, last = np.full(body.size, count), np.full(body.size, -1)
    np.minimum.at(first, body.parts.dofs, label[:, None])
    np.maximum.at(last, body.parts.dofs, label[:, None])
    borders = np.flatnonzero((first < last) & ~body.fixed)
    number = np.full(body.size, -1)
    number[borders] = np.arange(len(borders))
    return Parts(tuple(np.flatnonzero(label == i) for i in range(count)), borders, number)


def _cut(points: Array, count: int) -> IntArray:
    """Number points (m, 2) by part: halve the largest part's points across its longer side until there are `count`."""
    label = np.zeros(len(points), dtype=np.intp)
    for new in range(1, count):
        members = np.flatnonzero(label == np.bincount(label).argmax())
        side = int(np.argmax(np.ptp(points[members], axis=0)))
        label[members[np.argsort(points[members, side], kind="stable")[len(members) // 2 :]]] = new
    return label


def _eliminated(body: Body, elements: IntArray, parts: Parts) -> Part:
    dofs, local = np.unique(body.parts.dofs[elements], return_inverse=True)
    local = local.reshape(-1, 12)
    rows, columns = np.repeat(local, 12, axis=1).ravel(), np.tile(local, (1, 12)).ravel()
    matrix = csc_matrix((body.parts.stiffness[elements].ravel(), (rows, columns)), shape=(len(dofs),) * 2)
    on_border = parts.number[dofs] >= 0
    inner, border = np.flatnonzero(~on_border & ~body.fixed[dofs]), np.flatnonzero(on_border)
    solve = factorise(matrix[inner][:, inner], body.solver)
    across = matrix[inner][:, border]
    reach = -solve(across.toarray(order="F")) if len(border) else np.zeros((len(inner), 0))
    stiffness = matrix[border][:, border].toarray() + across.T @ reach
    return Part(dofs[inner], parts.number[dofs[border]], solve, reach, 0.5 * (stiffness + stiffness.T))


def _inside(
    part: Part, watches: Sequence[Watch], load: csc_matrix, results: Sequence[Array], pull: Array
) -> None:
    """Add what loads inside a part do with its border held: to what is read there, and as a pull on the border."""
    felt = np.flatnonzero(np.diff(load.indptr))
    pull[np.ix_(part.border, felt)] += (load[:, felt].T @ part.reach).T
    if not any(len(w.rows) for w in watches):
        return
    for start in range(0, len(felt), BLOCK):
        columns = felt[start : start + BLOCK]
        inside = part.solve(load[:, columns].toarray(order="F"))
        for watch, result in zip(watches, results, strict=True):
            result[np.ix_(watch.rows, columns)] += watch.measures @ inside
