"""Sizes of force, gap and stiffness of a contact problem, that residuals are measured by."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.fem.equalities import Step
from trochoid.fem.problem import Problem
from trochoid.kinematics.types import Array

NOTHING = 1e-12  # of the stiffness that a contact gives a motion


@dataclass(frozen=True, slots=True)
class Scale:
    """Sizes per position: `force`, `gap`, `stiffness`, `far` (n,), the last a step that no contact could resist;
    `motion` (n, k): what of each kind moves a contact by one unit of length.
    """

    force: Array
    gap: Array
    stiffness: Array
    far: Array
    motion: Array


def force_size(scale: Scale, problem: Problem, forces: Sequence[Array]) -> Array:
    """Return the largest load on the motions, or what the contacts carry if that is more, (n,) in N."""
    carried = np.zeros_like(scale.motion)
    for group, force in zip(problem.groups, forces, strict=True):
        arms, pressed = np.abs(group.arms), np.abs(force)
        if arms.shape[2] == 1:
            pressed = pressed.sum(axis=2, keepdims=True)
        carried += np.einsum("ncmk,ncm->nk", arms, pressed)
    return np.asarray(np.maximum(scale.force, (carried * scale.motion).max(axis=1, initial=0.0)))


def force_rounding(problem: Problem, step: Step) -> Array:
    """Return what rounding alone may leave of the equations of the motions, (n, k) in N: m ε of the sum of all m terms'
    sizes, as of any sum of products. Stiff springs between members that move together have large terms that cancel.
    """
    terms = np.abs(problem.load) + (np.abs(problem.springs) @ np.abs(step.motion)[..., None])[..., 0]
    count = 1 + problem.load.shape[1]
    for group, force in zip(problem.groups, step.forces, strict=True):
        pressed = np.abs(force)
        if group.arms.shape[2] == 1:
            pressed = pressed.sum(axis=2, keepdims=True)
        terms = terms + np.einsum("ncmk,ncm->nk", np.abs(group.arms), pressed)
        count += force.shape[1] * force.shape[2]
    return np.asarray(count * np.finfo(np.float64).eps * terms)


def gap_size(scale: Scale, problem: Problem, step: Step) -> Array:
    """Return the length (n,) that w is small against: the largest |g − R a|."""
    largest = scale.gap
    for group in problem.groups:
        apart = np.where(np.isfinite(group.gap), np.abs(group.gap - group.closing(step.motion)), 0.0)
        largest = np.maximum(largest, apart.max(axis=(1, 2), initial=0.0))
    return largest


def scales(problem: Problem) -> tuple[Scale, Array]:
    """Return the sizes, and the first proximal springs (n, k): soft enough that the load closes every gap."""
    count = len(problem.load)
    own = np.concatenate([g.diagonal.reshape(count, -1) for g in problem.groups], axis=1)
    arms = np.stack([np.abs(g.arms).max(axis=(1, 2), initial=0.0) for g in problem.groups]).max(axis=0)
    typical = _median(own)
    lever = _levers(arms, np.einsum("nkk->nk", problem.springs), typical)
    unit = 1.0 / np.where(lever > 0, lever, 1.0)
    gaps = np.concatenate([g.gap.reshape(count, -1) for g in problem.groups], axis=1)
    finite = np.isfinite(gaps)
    some = finite.any(axis=1)
    top, low = np.where(finite, gaps, -np.inf).max(axis=1), np.where(finite, gaps, np.inf).min(axis=1)
    force = np.abs(problem.load * unit).max(axis=1, initial=0.0)
    bounds = [
        np.where(np.isfinite(b), np.abs(b), 0.0)
        for g in problem.groups
        for b in (g.lower, g.upper)
        if b is not None
    ]
    for bound in bounds:
        force = np.maximum(force, bound.max(axis=(1, 2), initial=0.0))
    gap = np.maximum(np.where(some, np.maximum(np.abs(top), np.abs(low)), 0.0), typical * force)
    force = np.where(force == 0.0, np.where(gap > 0, gap / typical, 1.0), force)
    gap = np.where(gap == 0.0, typical * force, gap)
    distance = 10 * (gap + typical * force)
    far = 1e3 * (gap + own.max(axis=1, initial=0.0) * force)
    kappa = (force / distance)[:, None] / unit**2
    return Scale(force, gap, 1 / typical, far, unit), kappa


def _median(own: Array) -> Array:
    """Return the median (n,) of the positive entries (n, s); one where there is none."""
    if (own > 0).all() and own.shape[1]:
        return np.asarray(np.median(own, axis=1))
    return np.array([np.median(row[row > 0]) if np.any(row > 0) else 1.0 for row in own])


def _levers(arms: Array, springs: Array, typical: Array) -> Array:
    """Return each motion's largest arm (n, k); where contacts have none, what its spring suggests beside others.

    A spring that is nothing beside contacts of the compliance `typical` (n,) is rounding, and suggests nothing.
    """
    held = (springs > NOTHING * arms**2 / typical[:, None]) & (arms > 0)
    if not held.any():
        return arms
    square = np.divide(arms**2, springs, out=np.full_like(arms, np.nan), where=held)
    beside = np.zeros(len(arms))
    some = held.any(axis=1)
    beside[some] = np.nanmedian(square[some], axis=1)
    return np.asarray(np.maximum(arms, np.sqrt(np.maximum(springs, 0.0) * beside[:, None])))
