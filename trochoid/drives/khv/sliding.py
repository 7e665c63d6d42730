"""How fast the surfaces of a contact slide past each other while the drive runs: rigid kinematics, seen from the ring.

All rates are per radian of the crank relative to the ring. Members turn about where they are under load; that
the load moves them while they turn is left out, a thousandth of the speeds.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.contact import Layout
from trochoid.drives.khv.design import Design
from trochoid.fem.pair import State, tangent_of
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Turning:
    """Velocities of a rigid member per radian of crank: of its centre (n, 2) in m/rad, and its spin in rad/rad."""

    center: Array
    velocity: Array
    spin: float

    def at(self, point: Array) -> Array:
        """Return the velocity (n, c, 2) of the member's material at points (n, c, 2)."""
        return np.asarray(
            self.velocity[..., None, :] + self.spin * tangent_of(point - self.center[..., None, :])
        )


@dataclass(frozen=True, slots=True)
class Rates:
    """Speeds (n, c) in m/rad of the disc's surface past its partner's: along its normal, and along the tangent."""

    closing: Array
    sliding: Array


def disc_turning(design: Design, motions: Layout, disc: int, motion: Array, crank: Array) -> Turning:
    """Return how a disc moves at crank angles (n,): its centre round the axis, itself backwards by a lobe a turn."""
    angle = crank + design.discs[disc].crank
    out = design.flank.eccentricity * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    center = out + motion @ motions.rows(f"disc{disc}")[:2].T
    return Turning(center, tangent_of(out), -1 / design.flank.lobes)


def partner_turning(design: Design, motions: Layout, kind: str, disc: int, motion: Array) -> Turning:
    """Return how what a disc touches moves: "ring" stands, "output" turns as the discs, "bearing" as the crank."""
    still = np.zeros((len(motion), 2))
    if kind == "ring":
        return Turning(still, still, 0.0)
    member, spin = ("output", -1 / design.flank.lobes) if kind == "output" else ("shaft", 1.0)
    return Turning(motion @ motions.rows(member, design.discs[disc].z)[:2].T, still, spin)


def rates(
    design: Design, motions: Layout, states: Mapping[str, State], motion: Array, crank: Array
) -> dict[str, Rates]:
    """Return the rates of all contacts by family ("ring0", "output0", …), at the motions (n, k) of their states."""
    found = {}
    for i in range(len(design.discs)):
        disc = disc_turning(design, motions, i, motion, crank)
        for kind in ("ring", "output", "bearing"):
            if f"{kind}{i}" not in states:
                continue
            state = states[f"{kind}{i}"]
            apart = disc.at(state.point) - partner_turning(design, motions, kind, i, motion).at(state.point)
            along = (apart * tangent_of(state.normal)).sum(axis=-1)
            found[f"{kind}{i}"] = Rates((apart * state.normal).sum(axis=-1), along)
    return found
