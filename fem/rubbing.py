"""Rubbing contacts as data, and the problems that friction makes of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from trochoid.fem import complementarity as lcp
from trochoid.fem.coulomb import Whole
from trochoid.kinematics.types import Array, IntArray

T = TypeVar("T", bound=np.generic)


@dataclass(frozen=True, slots=True)
class Rubbing:
    """Contacts (c, m) with friction: `normal` strips, `tangential` strips on the same places, and the coefficient.

    The tangential group's arms are how fast motions slide the second body's surface along t past the first's (minus
    `pair.sliding`), its gap is the slip that is given (0: none); it has no bounds of its own. No positions' axis.
    """

    normal: lcp.Group
    tangential: lcp.Group
    friction: float


@dataclass(frozen=True, slots=True)
class System:
    """Rubbing contacts in order, `coupling` (2C, 2C) between totals in m/N (all normal ones first), `springs` (k, k)
    in N/m and `load` (k,).
    """

    contacts: tuple[Rubbing, ...]
    coupling: Array
    springs: Array
    load: Array


def side_by_side(system: System, slip: Sequence[Array], sense: IntArray | None, size: float = 0.0) -> Whole:
    """Put all strips side by side; the tangential gap counts from the slip before the step, `size` see Whole."""
    parts = [x.normal for x in system.contacts] + [x.tangential for x in system.contacts]
    sizes = [g.gap.size for g in parts]
    matrix, at = np.zeros((sum(sizes), sum(sizes))), 0
    contact = np.concatenate([np.repeat(np.arange(g.gap.shape[0]), g.gap.shape[1]) for g in parts])
    first = np.cumsum([0] + [g.gap.shape[0] for g in parts])[:-1]
    contact = contact + np.repeat(first, sizes)
    for group in parts:
        strips = group.gap.shape[1]
        for local in _local(group):
            matrix[at : at + strips, at : at + strips] = local
            at += strips
    matrix += system.coupling[np.ix_(contact, contact)]
    gap = np.concatenate([flat([g.gap for g in parts[: len(slip)]]), _tangential_gap(system, slip)])
    arms = np.concatenate(
        [np.broadcast_to(g.arms, (*g.gap.shape, g.arms.shape[-1])).reshape(g.gap.size, -1) for g in parts]
    )
    friction = np.repeat([x.friction for x in system.contacts], sizes[: len(slip)])
    none = np.zeros(len(friction), dtype=np.intp)
    friction, sense = (friction, none) if sense is None else (friction * np.abs(sense), sense)
    return Whole(matrix, gap, arms, system.springs, system.load, friction, sense, size)


def bounded(system: System, slip: Sequence[Array], bound: Array) -> lcp.Problem:
    """Return the contact problem in which friction has given bounds (m,); contacts without friction have none of it."""
    tangential, groups, at = list[lcp.Group](), [x.normal for x in system.contacts], 0
    chosen = [np.arange(sum(g.gap.shape[0] for g in groups))]
    contact = len(chosen[0])
    for item, old in zip(system.contacts, slip, strict=True):
        shape = item.normal.gap.shape
        if item.friction > 0:
            most = bound[at : at + item.normal.gap.size].reshape(shape)
            gap = item.tangential.gap - old
            tangential.append(replace(item.tangential, gap=gap, lower=-most, upper=most))
            chosen.append(np.arange(contact, contact + shape[0]))
        contact, at = contact + shape[0], at + item.normal.gap.size
    index = np.concatenate(chosen)
    coupling = system.coupling[np.ix_(index, index)]
    return lcp.Problem((*groups, *tangential), coupling, system.springs, system.load)


def dragged(system: System, force: Array) -> lcp.Problem:
    """Return the normal contact problem under given friction forces (m,)."""
    groups = [x.normal for x in system.contacts]
    count = sum(g.gap.shape[0] for g in groups)
    pulls = shaped(system, force)
    total = system.coupling[:count, count:] @ np.concatenate([q.sum(axis=1) for q in pulls])
    load, at, moved = system.load, 0, []
    for item, pull in zip(system.contacts, pulls, strict=True):
        arms = np.broadcast_to(item.tangential.arms, (*pull.shape, len(load)))
        load = load - np.einsum("cmk,cm->k", arms, pull)
        opened = total[at : at + len(pull), None]
        moved.append(replace(item.normal, gap=item.normal.gap + opened))
        at += len(pull)
    return lcp.Problem(tuple(moved), system.coupling[:count, :count], system.springs, load)


def zeros(system: System) -> tuple[Array, ...]:
    """Return zero for all strips, (c, m) per group."""
    return tuple(np.zeros(x.normal.gap.shape) for x in system.contacts)


def shaped(system: System, values: NDArray[T]) -> tuple[NDArray[T], ...]:
    """Cut values of all strips (m,) into groups (c, m)."""
    ends = np.cumsum([x.normal.gap.size for x in system.contacts])[:-1]
    cut = np.split(values, ends)
    return tuple(v.reshape(x.normal.gap.shape) for v, x in zip(cut, system.contacts, strict=True))


def flat(parts: Sequence[NDArray[T]]) -> NDArray[T]:
    """Put values of groups (c, m) side by side (m,)."""
    return np.concatenate([p.ravel() for p in parts])


def _local(group: lcp.Group) -> Array:
    if isinstance(group.local, lcp.Alike):
        return np.asarray(group.local.factor[:, None, None] * group.local.unit.matrix)
    return group.local


def _tangential_gap(system: System, slip: Sequence[Array]) -> Array:
    return flat([x.tangential.gap - s for x, s in zip(system.contacts, slip, strict=True)])
