"""What a load also moves: contacts along their surfaces, to other curvatures and to where bodies yield otherwise.

The tangent stiffness of a contact takes its compliances for fixed while the arms turn. As a load grows, contacts wander
along the flanks, and yield more or less there under the force that they already carry: they open by o per unit of
load. With dF the change of the forces, the work dF·o is what the compliance under that load has beside the tangent's
(first order; what is left is the square of it: 1e-5 of the compliance where this is 3e-3).
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from trochoid.fem.assembly import Assembly, Contact
from trochoid.fem.coupling import coupling
from trochoid.fem.pair import State
from trochoid.kinematics.types import Array

NOTHING: Mapping[str, float] = MappingProxyType({})
STEP = 1e-3  # of a typical motion of the contacts under load: how far they are moved on
RESISTED = 1e-6  # of the load: what may be left of it when nothing resists


def softness(stiffness: Array, row: int) -> Array:
    """Return the motions (n, k) per unit of load on motion `row`, from tangents (n, k, k); nan where none resists.

    Motions that nothing feels stay where they are.
    """
    found = np.full(stiffness.shape[:2], np.nan)
    unit = np.zeros(stiffness.shape[1])
    unit[row] = 1.0
    for i, one in enumerate(stiffness):
        size = np.sqrt(np.maximum(np.diag(one), 0.0))
        if size[row] == 0.0:
            continue
        scale = np.divide(1.0, size, out=np.zeros_like(size), where=size > 0)
        unitless, load = one * np.outer(scale, scale), unit * scale
        answer, *_ = np.linalg.lstsq(unitless, load, rcond=1e-13)
        if np.abs(unitless @ answer - load).max() <= RESISTED * load[row]:
            found[i] = answer * scale
    return found


def wandering(
    assembly: Assembly, contact: Contact, step: Array, sides: Mapping[str, float] = NOTHING
) -> Array:
    """Return the compliance (n,) that wandering contacts add to the tangent's, along the motions `step` (n, k) per unit
    of load; 0 where that is nan.

    `sides`: by families, how their round sides change per unit of load (m/N), where these are taken at a typical load.
    """
    if not assembly.follow:
        return np.zeros(len(step))
    step = np.nan_to_num(step)
    touches = [contact.touches[f.name] for f in assembly.families]
    states, forces = [t.state for t in touches], [t.force for t in touches]
    arms, force = (np.concatenate(x, axis=1) for x in ([s.arms for s in states], forces))
    before, slope, through = _compliances(assembly, states, forces)
    closing = np.abs(np.einsum("nck,nk->nc", arms, step)).max(axis=1, initial=0.0)
    size = np.abs(np.einsum("nck,nk->nc", arms, contact.motion)).max(axis=1, initial=0.0)
    part = np.divide(STEP * size, closing, out=np.zeros_like(size), where=closing > 0)
    there = contact.motion + part[:, None] * step
    moved = [f.pair.at(there, s.parameter) for f, s in zip(assembly.families, states, strict=True)]
    after, _, elsewhere = _compliances(assembly, moved, forces)
    opened = after - before + np.matmul(elsewhere - through, force[..., None])[..., 0]
    grown = [sides.get(f.name, 0.0) * p for f, p in zip(assembly.families, forces, strict=True)]
    opened = opened + part[:, None] * np.concatenate(grown, axis=1)
    found = np.zeros(len(step))
    for n in np.flatnonzero(part):
        at = np.flatnonzero(force[n] > 0)
        change = np.linalg.solve(through[n][np.ix_(at, at)] + np.diag(slope[n, at]), arms[n, at] @ step[n])
        found[n] = change @ opened[n, at] / part[n]
    return found


def _compliances(assembly: Assembly, states: list[State], forces: list[Array]) -> tuple[Array, Array, Array]:
    """Return how far contacts yield by themselves (n, C) in m and the slope of that in m/N, anything where nothing
    presses, and what they yield to each other (n, C, C), m/N.
    """
    own = [
        f.law_at(s).approach(np.where(p > 0.0, p, 1.0))
        for f, s, p in zip(assembly.families, states, forces, strict=True)
    ]
    seated = [f.seated(s) for f, s in zip(assembly.families, states, strict=True)]
    approach, slope = (np.concatenate(x, axis=1) for x in zip(*own, strict=True))
    return approach, slope, coupling(assembly.bodies, seated)
