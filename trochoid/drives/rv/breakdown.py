"""Where a drive yields: the tangent compliance at the output, split among its parts.

A unit of torque on the ring moves everything by `softness` and changes the contact forces by dF. What each part stores
then, dF·dδ, is its share of the compliance; the shares add up to the whole, because the tangent problem is linear.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from trochoid.drives.rv.contact import Layout
from trochoid.drives.rv.supports import PARTS as LINEAR
from trochoid.fem.coupling import coupling
from trochoid.fem.moving import wandering
from trochoid.fem.newton import Point, turning
from trochoid.fem.pair import FlankPair, HolePair, State
from trochoid.fem.position import Assembly, Contact, Family
from trochoid.kinematics.types import Array

PARTS = ("ring_pins", "discs", "arm_bearings", *LINEAR, "turning_levers", "wandering_contacts")


def compliance_parts(
    problem: Assembly, motions: Layout, contact: Contact, softness: Array, sides: Mapping[str, float]
) -> Array:
    """Return the shares (n, parts) of the ring's compliance in rad/(N·m), in the order of PARTS.

    `ring_pins` and `arm_bearings`: the contacts down to a depth of one pin or roller diameter in the disc, with what
    lies on their other side; `discs`: the rest of the discs; `turning_levers`: forces that turn with the members;
    `wandering_contacts`: what contacts yield more where the load moves them, and round `sides` under more of it (see
    `moving`), which is beside the tangent compliance that the other parts add up to. nan where nothing resists.
    """
    touches = [contact.touches[family.name] for family in problem.families]
    states, forces = tuple(t.state for t in touches), tuple(t.force for t in touches)
    deep = np.concatenate([_deep(problem, f) for f in problem.families])
    bare = [
        replace(f.seated(s), round_side=0.0 * f.round_side)
        for f, s in zip(problem.families, states, strict=True)
    ]
    discs = coupling(problem.bodies, bare)
    local = np.concatenate(
        [_local(f, s, p) for f, s, p in zip(problem.families, states, forces, strict=True)], axis=1
    )
    arms, force = np.concatenate([s.arms for s in states], axis=1), np.concatenate(forces, axis=1)
    pins = np.concatenate(
        [
            np.full(f.shape[1], x.name.startswith("ring"))
            for f, x in zip(forces, problem.families, strict=True)
        ]
    )
    turned = turning(problem, Point(states, forces, contact.motion))
    wandered = wandering(problem, contact, softness, sides)
    result = np.full((len(softness), len(PARTS)), np.nan)
    for n, step in enumerate(softness):
        if np.isnan(step).any():
            continue
        touching = np.flatnonzero(force[n] > 0)
        near = local[n, touching] + deep[touching]
        through = discs[n][np.ix_(touching, touching)] - np.diag(deep[touching])
        change = np.linalg.solve(through + np.diag(near), arms[n, touching] @ step)
        own, body = change * near * change, float(change @ through @ change)
        on_pins = float(own[pins[touching]].sum())
        held = motions.of_cranks(step)
        linear = [float(held @ motions.supports.stiffness[part] @ held) for part in LINEAR]
        result[n] = [
            on_pins,
            body,
            float(own.sum()) - on_pins,
            *linear,
            float(step @ turned[n] @ step),
            wandered[n],
        ]
    return result


def _local(family: Family, state: State, force: Array) -> Array:
    """Return the tangent compliance (n, c) of contacts alone, m/N; anything where nothing presses."""
    slope = family.law_at(state).approach(np.where(force > 0, force, 1.0))[1]
    return np.asarray(slope + family.round_side)


def _deep(problem: Assembly, family: Family) -> Array:
    """Return what (c,) of a contact's logarithm lies deeper in the disc than the diameter of pin or roller, m/N.

    It counts from a depth of one metre; negative, since discs are smaller.
    """
    pair = family.pair
    assert isinstance(pair, (FlankPair, HolePair))
    assert pair.seat is not None
    body = problem.bodies[pair.seat.body]
    radius = pair.flank.pin_radius if isinstance(pair, FlankPair) else pair.roller_radius
    return np.full(len(family.kernel), body.compliance.kernel / body.width * np.log(2 * radius))
