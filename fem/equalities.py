"""The linear step of the contact problem: who touches is given, forces and motions are wanted.

Touching strips have w = 0, the others keep the force of the bound that they rest on. Each contact's block is eliminated
on its own, p = L⁻¹(R a − g − s) with s what all contacts together press it open by; what is left couples only contact
totals t and motions a:

    (I + 1ᵀL⁻¹1 S) t − 1ᵀL⁻¹R a = t₀ − 1ᵀL⁻¹g,      s = S t,
    (RᵀL⁻¹R + K + κ) a − RᵀL⁻¹1 S t = F + κ a₀ + RᵀL⁻¹g − Rᵀp₀,

where p₀, t₀ belong to the strips at bounds and κ are the proximal springs to a₀ (see `complementarity`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.fem.problem import Alike, Group, Problem, Solution
from trochoid.kinematics.types import Array, BoolArray, IntArray


@dataclass(frozen=True, slots=True)
class Step:
    """Forces per group (n, c, m), motion (n, k) and openings w per group (n, c, m)."""

    forces: tuple[Array, ...]
    motion: Array
    opening: tuple[Array, ...]


@dataclass(frozen=True, slots=True)
class Held:
    """Who touches (n, c, m) per group, and the forces (n, c, m) of the others; None where these are zero."""

    touching: tuple[BoolArray, ...]
    forces: tuple[Array | None, ...]


def solve_held(problem: Problem, held: Held, anchor: Array, kappa: Array) -> Step:
    """Solve with w = 0 where strips touch; `anchor` (n, k) and `kappa` (n, k) are the proximal springs."""
    parts = [_eliminated(g, a, f) for g, a, f in zip(problem.groups, held.touching, held.forces, strict=True)]
    stiffness = problem.springs + _diagonal(kappa) + sum(p.stiffness for p in parts)
    load = problem.load + kappa * anchor + sum(p.load for p in parts)
    one, rest, arms = (np.concatenate([getattr(p, name) for p in parts], axis=1) for name in _TOTALS)
    total, motion = _totals(problem.coupling, one, rest, arms, stiffness, load)
    return opened(
        problem, _forces(problem, parts, split(problem, _times(problem.coupling, total)), motion), motion
    )


def opened(problem: Problem, forces: Sequence[Array], motion: Array) -> Step:
    """Return a step with these forces and motions, and the openings that follow."""
    total = np.concatenate([f.sum(axis=2) for f in forces], axis=1)
    shares = split(problem, _times(problem.coupling, total))
    opening = tuple(
        g.pressed(p) + g.gap + s[..., None] - g.closing(motion)
        for g, p, s in zip(problem.groups, forces, shares, strict=True)
    )
    return Step(tuple(forces), motion, opening)


def missing(problem: Problem, step: Step) -> Array:
    """Return F − Rᵀp − K a, (n, k)."""
    carried = _times(problem.springs, step.motion)
    for group, force in zip(problem.groups, step.forces, strict=True):
        carried = carried + group.load(force)
    return np.asarray(problem.load - carried)


def tangents(problem: Problem, solution: Solution) -> Array:
    """Return the stiffness (n, k, k) that touching strips and springs give the motions, in N/m; symmetric."""
    parts = [_eliminated(g, a, None) for g, a in zip(problem.groups, solution.active, strict=True)]
    one, _, arms = (np.concatenate([getattr(p, name) for p in parts], axis=1) for name in _TOTALS)
    order = _touching_first(one)
    one, arms = np.take_along_axis(one, order, 1), np.take_along_axis(arms, order[..., None], 1)
    inner = _chosen(problem.coupling, order)
    system = np.eye(one.shape[1]) + one[..., None] * inner
    through = arms.transpose(0, 2, 1) @ inner @ np.linalg.solve(system, arms)
    stiffness = problem.springs + sum(p.stiffness for p in parts) - through
    return np.asarray(0.5 * (stiffness + stiffness.transpose(0, 2, 1)))


def split(problem: Problem, contacts: Array) -> list[Array]:
    """Cut a value per contact (n, C) into groups."""
    counts = [g.gap.shape[1] for g in problem.groups]
    return np.split(contacts, np.cumsum(counts)[:-1], axis=1)


@dataclass(frozen=True, slots=True)
class _Part:
    """A group without its strips: `inverse` L⁻¹1 and `gap` L⁻¹(g + L p₀) (n, c, m), `arms` L⁻¹R where arms differ from
    strip to strip, `fixed` p₀; sums per contact (n, c) and what it brings to the motions.
    """

    inverse: Array
    gap: Array
    arms: Array | None
    fixed: Array | None
    one: Array
    rest: Array
    levers: Array
    stiffness: Array
    load: Array


_TOTALS = ("one", "rest", "levers")


def _eliminated(group: Group, touching: BoolArray, fixed: Array | None) -> _Part:
    gap = group.gap if fixed is None else group.gap + group.pressed(fixed)
    alike = group.arms.shape[2] == 1
    right = [np.where(touching, gap, 0.0), touching.astype(np.float64)]
    columns = np.stack(right, axis=-1)
    if not alike:
        columns = np.concatenate([columns, np.where(touching[..., None], group.arms, 0.0)], axis=-1)
    solved = _inverse_times(group, touching, columns)
    free, inverse = solved[..., 0], solved[..., 1]
    one = inverse.sum(axis=2)
    load = group.load(free)
    rest = -free.sum(axis=2)
    if fixed is not None:
        load, rest = load - group.load(fixed), rest + fixed.sum(axis=2)
    if alike:
        arm = group.arms[:, :, 0]
        levers = one[..., None] * arm
        return _Part(inverse, free, None, fixed, one, rest, levers, levers.transpose(0, 2, 1) @ arm, load)
    arms = solved[..., 2:]
    stiffness = np.einsum("ncmk,ncml->nkl", group.arms, arms)
    return _Part(inverse, free, arms, fixed, one, rest, arms.sum(axis=2), stiffness, load)


def _inverse_times(group: Group, touching: BoolArray, columns: Array) -> Array:
    """Return L⁻¹ times columns (n, c, m, r) on the touching strips, zero elsewhere."""
    strips = touching.shape[2]
    if strips == 1:
        own = group.diagonal
        return np.asarray(columns / np.where(touching, own, 1.0)[..., None])
    result = np.zeros_like(columns)
    some = touching.any(axis=2)
    chosen = touching[some]
    if isinstance(group.local, Alike):
        first, last = chosen.argmax(axis=1), strips - 1 - chosen[:, ::-1].argmax(axis=1)
        whole = last - first + 1 == chosen.sum(axis=1)
        answer = np.empty((len(chosen), *columns.shape[2:]))
        unit = group.local.unit
        answer[whole] = unit.windows[first[whole], last[whole]] @ columns[some][whole]
        answer[~whole] = np.linalg.solve(_on(chosen[~whole], unit.matrix), columns[some][~whole])
        result[some] = answer / group.local.factor[some][:, None, None]
    else:
        result[some] = np.linalg.solve(_on(chosen, group.local[some]), columns[some])
    return result


def _on(touching: BoolArray, matrix: Array) -> Array:
    """Return matrices (b, m, m) on the touching rows and columns, the identity elsewhere."""
    return np.where(touching[:, :, None] & touching[:, None], matrix, np.eye(touching.shape[1]))


def _forces(problem: Problem, parts: Sequence[_Part], shares: Sequence[Array], motion: Array) -> list[Array]:
    found = []
    for group, part, share in zip(problem.groups, parts, shares, strict=True):
        if part.arms is None:
            force = part.inverse * (group.closing(motion) - share[..., None]) - part.gap
        else:
            force = (
                np.matmul(part.arms, motion[:, None, :, None])[..., 0]
                - part.gap
                - part.inverse * share[..., None]
            )
        found.append(force if part.fixed is None else force + part.fixed)
    return found


def _totals(
    coupling: Array, one: Array, rest: Array, arms: Array, stiffness: Array, load: Array
) -> tuple[Array, Array]:
    """Solve for totals (n, C) and motions (n, k), of which totals that do not touch are known."""
    order = _touching_first(one)
    count, positions = order.shape[1], len(one)
    inside = np.take_along_axis(one, order, 1)
    lever = np.take_along_axis(arms, order[..., None], 1)
    inner = _chosen(coupling, order)
    known = np.where(one == 0.0, rest, 0.0)  # totals of contacts that rest on bounds altogether
    if known.any():
        pushed = _times(coupling, known)
        rest = rest - one * pushed
        load = load + np.einsum("nck,nc->nk", arms, pushed)
    size = np.sqrt(np.abs(np.einsum("nkk->nk", stiffness)))
    # motions are measured in the length that their stiffness gives them: radians and metres weigh alike
    scale = 1.0 / np.where(size == 0.0, 1.0, size)
    system = np.empty((positions, count + len(load[0]), count + len(load[0])))
    system[:, :count, :count] = np.eye(count) + inside[..., None] * inner
    system[:, :count, count:] = -lever * scale[:, None]
    system[:, count:, :count] = -(lever * scale[:, None]).transpose(0, 2, 1) @ inner
    system[:, count:, count:] = stiffness * scale[:, None] * scale[..., None]
    right = np.concatenate(
        [np.where(inside == 0.0, 0.0, np.take_along_axis(rest, order, 1)), load * scale], axis=1
    )
    answer = _solve(system, right[..., None])[..., 0]
    total = known
    np.put_along_axis(total, order, answer[:, :count] + np.take_along_axis(known, order, 1), 1)
    return total, answer[:, count:] * scale


def _solve(matrices: Array, right: Array) -> Array:
    """Solve linear systems; singular ones, which rounding makes, in the sense of least squares."""
    try:
        return np.asarray(np.linalg.solve(matrices, right))
    except np.linalg.LinAlgError:
        return np.asarray([np.linalg.lstsq(m, r)[0] for m, r in zip(matrices, right, strict=True)])


def _touching_first(one: Array) -> IntArray:
    """Return the contacts of each position (n, most), those that touch first; the rest of the columns is left out."""
    most = int((one != 0.0).sum(axis=1).max(initial=0))
    return np.argsort(one == 0.0, axis=1, kind="stable")[:, :most]


def _chosen(coupling: Array, order: IntArray) -> Array:
    rows = np.arange(len(order))[:, None, None]
    return np.asarray(coupling[rows, order[:, :, None], order[:, None]])


def _times(matrices: Array, vectors: Array) -> Array:
    return np.asarray(np.matmul(matrices, vectors[..., None])[..., 0])


def _diagonal(values: Array) -> Array:
    return values[..., None] * np.eye(values.shape[-1])
