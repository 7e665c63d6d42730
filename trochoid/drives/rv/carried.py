"""The masses of an RV drive on the motions of its contacts: discs, crankshafts with planets, sun, and carrier or ring.

Seen from the carrier, with the sun held, the load turns the ring. Where the ring stands it is the carrier with all that
it carries that turns back, and the planets roll on the sun while it does; so the ring's rotation has their inertia.
"""

from __future__ import annotations

import numpy as np

from trochoid.drives.rv.contact import Layout
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.mass import Masses
from trochoid.dynamics.carried import Mass
from trochoid.kinematics.types import Array


def carried_masses(design: Design, motions: Layout, masses: Masses) -> tuple[Mass, ...]:
    """Return all masses on the motions: discs, then `crank_masses` of each crankshaft, sun, carrier or ring.

    That eccentrics and discs swing a little as the planets roll back is left out: (e/R)² of the rest.
    """
    count = len(motions.names)
    twist = motions.ring[2]
    none, still = np.zeros((2, count)), np.zeros(count)
    back = still if design.driven == "ring" else -twist / design.leverage
    made = []
    for i, disc in enumerate(design.discs):
        rows = motions.disc(i)
        solid = masses.disc
        made.append(
            Mass(solid.mass, np.array([0.0, 0.0, disc.z]), rows[:2], solid.axial_inertia, rows[2] + back)
        )
    for j in range(len(design.crank_places)):
        made += _crankshaft(design, motions, masses, j, back)
    held = motions.supports
    sun = np.array([0.0, 0.0, held.places[-1]])
    made.append(Mass(masses.sun.mass, sun, motions.on_all(held.sun), 0.0, still))
    spun = twist if design.driven == "ring" else back
    solid = masses.ring if design.driven == "ring" else masses.carrier
    made.append(Mass(solid.mass, np.zeros(3), none, solid.axial_inertia, spun))
    return tuple(made)


def _crankshaft(design: Design, motions: Layout, masses: Masses, j: int, back: Array) -> list[Mass]:
    """Return the masses of a crankshaft at its discs, bearings and planet; where the carrier turns `back`, with it."""
    held, table, place = motions.supports, design.drive.first_stage, design.crank_places[j]
    centers, turns = motions.on_all(held.centers[j]), motions.on_all(held.turns[j])
    rolls = (1.0 + table.z_sun / table.z_planet) * back
    spin = [masses.eccentric.axial_inertia + masses.eccentric.mass * design.flank.eccentricity**2] * (
        len(turns) - 1
    )
    spin += [0.0, 0.0, masses.planet.axial_inertia + masses.shaft.axial_inertia]
    turning = [*turns[:-1], turns[0], turns[0], turns[-1]]  # bearings are no places of torsion
    swing = np.stack([-place[1] * back, place[0] * back])
    return [
        Mass(mass, np.array([*place, z]), center + swing, inertia, turn + rolls)
        for mass, z, center, inertia, turn in zip(
            crank_masses(design, masses, held.places), held.places, centers, spin, turning, strict=True
        )
    ]


def crank_masses(design: Design, masses: Masses, places: Array) -> Array:
    """Return the mass (p,) of a crankshaft at its `places` (p,): discs, bearings, planet.

    Stretches of shaft beside the pack count at the two places next to their middles, with the same centre of mass.
    """
    discs, half = len(design.discs), 0.5 * design.pack_width
    found = np.zeros(len(places))
    found[:discs] = masses.eccentric.mass
    found[-1] = masses.planet.mass
    ends = [(min(-half, places.min()), -half), (half, max(half, places.max()))]
    length = sum(high - low for low, high in ends)
    order = np.argsort(places, kind="stable")
    for low, high in ends:
        middle, mass = 0.5 * (low + high), masses.shaft.mass * (high - low) / length
        k = int(np.clip(np.searchsorted(places[order], middle), 1, len(places) - 1))
        one, two = order[k - 1], order[k]
        gap = places[two] - places[one]
        share = float(np.clip((middle - places[one]) / gap, 0.0, 1.0)) if gap > 0.0 else 0.5
        found[one] += (1.0 - share) * mass
        found[two] += share * mass
    return found
