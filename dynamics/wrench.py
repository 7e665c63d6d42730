"""Forces and moments on a body over a record, summed as vectors about one point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, slots=True)
class Wrench:
    """Resultant `force` (n_pos, 3) in N and `moment` (n_pos, 3) in N·m about the point `about` (3,) in m.

    `gross` holds the sums of the sizes of the forces and of the moments that were summed, the largest of the
    record: what cancels inside is measured by it (see `balance_residual`).
    """

    force: Array
    moment: Array
    about: Array
    gross: tuple[float, float] = (0.0, 0.0)


def wrench(points: Array, forces: Array, about: Array | Sequence[float] = (0.0, 0.0, 0.0)) -> Wrench:
    """Sum point forces: `points` (n_load, 3) or (n_pos, n_load, 3), `forces` (n_pos, n_load, 2 or 3).

    Forces with two components lie in the plane of rotation.
    """
    center = np.asarray(about, dtype=np.float64)
    if forces.shape[-1] == 2:
        forces = np.concatenate([forces, np.zeros((*forces.shape[:-1], 1))], axis=-1)
    arms = np.broadcast_to(np.asarray(points) - center, forces.shape)
    moments = np.cross(arms, forces)
    gross = (_largest(forces), _largest(moments))
    return Wrench(frozen(forces.sum(axis=1)), frozen(moments.sum(axis=1)), frozen(center), gross)


def couple(moment: Array, about: Array | Sequence[float] = (0.0, 0.0, 0.0)) -> Wrench:
    """Return pure moments (n_pos, 3), e.g. a torque about z, as a Wrench."""
    return Wrench(frozen(np.zeros_like(moment)), frozen(moment), frozen(about))


def moved(load: Wrench, about: Array | Sequence[float]) -> Wrench:
    """Return the same loads about another point."""
    arm = load.about - np.asarray(about, dtype=np.float64)
    moment = load.moment + np.cross(np.broadcast_to(arm, load.force.shape), load.force)
    force_size, moment_size = _gross(load)
    gross = (force_size, moment_size + force_size * float(np.linalg.norm(arm)))
    return Wrench(load.force, frozen(moment), frozen(about), gross)


def total(loads: Sequence[Wrench]) -> Wrench:
    """Return the sum of loads, about the point of the first one."""
    if not loads:
        raise TrochoidError("the sum of no loads has no length: give at least one wrench")
    same = [moved(load, loads[0].about) for load in loads]
    force = np.sum([load.force for load in same], axis=0)
    moment = np.sum([load.moment for load in same], axis=0)
    sizes = np.sum([_gross(load) for load in same], axis=0)
    return Wrench(frozen(force), frozen(moment), loads[0].about, (float(sizes[0]), float(sizes[1])))


def balance_residual(loads: Sequence[Wrench]) -> float:
    """Return how far loads are from equilibrium: size of their sum over the gross size of what was summed.

    The larger of the two numbers for forces and for moments, each over the whole record; 0 where nothing
    acts.  With members' inertia forces and the negative of what they put on the casing it is Newton's and
    Euler's check.
    """
    left = total(loads)
    sums = (_largest(left.force[:, None]), _largest(left.moment[:, None]))
    return max(part / whole if whole > 0.0 else 0.0 for part, whole in zip(sums, left.gross, strict=True))


def _largest(vectors: Array) -> float:
    """Return the largest over the record of the summed sizes of vectors (n_pos, n_load, 3)."""
    return float(np.linalg.norm(vectors, axis=-1).sum(axis=-1).max(initial=0.0))


def _gross(load: Wrench) -> tuple[float, float]:
    return max(load.gross[0], _largest(load.force[:, None])), max(
        load.gross[1], _largest(load.moment[:, None])
    )
