"""Vibration velocity of the casing by all that the indexer puts on it in a turn of the arm, and its zone.

The elastic drive shakes it where there is a march, else the rigid one; beside it the rigid one, the one without
inertia, and the spherical Geneva wheel on the same shafts at the same speed of the arm.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

from trochoid.drives.casing import Shaken as ShakenCasing
from trochoid.drives.indexer.casing_loads import MOST, Cycle, elastic_cycle, lines_for, rigid_cycle
from trochoid.drives.indexer.design import GENEVA, INDEXER
from trochoid.drives.indexer.forces import Forces
from trochoid.drives.indexer.shaken import Shaken
from trochoid.drives.mesh_error import Pair
from trochoid.drives.vibration import RIGID, SLOW, CasingVibration, Load, shaken
from trochoid.dynamics.vibration import Vibration
from trochoid.scene.drive_indexer import IndexerScene

ELASTIC = "elastic"
SAMPLED = (
    "ask.positions"  # what warnings of sampled records speak of: these records are not sampled at positions
)


@dataclass(frozen=True, eq=False, slots=True)
class Loads:
    """Cycles by what they are with or without, that with most in it first; `lines` multiples of `base` (Hz)."""

    cycles: Mapping[str, Cycle]
    base: float
    lines: int

    @property
    def best(self) -> str:
        """The model of the first cycle."""
        return next(iter(self.cycles))

    @property
    def residual(self) -> float:
        """Largest difference of all places together and the torque on the wheel, relative."""
        return max(cycle.residual() for cycle in self.cycles.values())


def casing_loads(forces: Mapping[str, Forces], shaken: Mapping[str, Shaken] | None) -> Pair[Loads]:
    """Return what the drives put on the casing; where they are marched also by steps twice as long."""
    fine = _loads(forces, shaken, False)
    return Pair(fine, None if shaken is None else _loads(forces, shaken, True))


def _loads(forces: Mapping[str, Forces], shaken: Mapping[str, Shaken] | None, coarse: bool) -> Loads:
    ours = forces[INDEXER]
    rigid = rigid_cycle(ours)

    def marched(found: Mapping[str, Shaken], name: str) -> Cycle:
        return elastic_cycle(found[name], found[name].coarse if coarse else None)

    cycles = {RIGID: rigid} if shaken is None else {ELASTIC: marched(shaken, INDEXER), RIGID: rigid}
    cycles[SLOW] = rigid_cycle(replace(ours, load=replace(ours.load, inertia=0.0)))
    if GENEVA in forces:
        cycles[GENEVA] = rigid_cycle(forces[GENEVA]) if shaken is None else marched(shaken, GENEVA)
    base = ours.load.speed / (2.0 * math.pi)
    return Loads(cycles, base, lines_for(base))


def casing_vibration(scene: IndexerScene, loads: Loads, casing: ShakenCasing) -> CasingVibration:
    """Shake the casing on its mounts with all loads on it."""
    found = {
        name: Load(each.whole(loads.lines), partial(each.records, loads.lines))
        for name, each in loads.cycles.items()
    }
    speed = scene.operation.input_speed
    driven = speed * scene.drive.swing_angle / (2.0 * math.pi)  # the wheel's mean
    made = shaken(scene, casing, found, loads.base, (speed, driven))
    return made.said(_warned)


def _warned(found: Vibration) -> Vibration:
    """Say how far the record's lines reach, where that is not the whole band; it is not sampled at positions."""
    kept = tuple(said for said in found.warnings if SAMPLED not in said)
    top, base = found.band[1], float(found.frequencies[0])
    if found.resolved_to + base > top:
        return replace(found, warnings=kept)
    said = (
        f"the record has {len(found.frequencies)} harmonics of the arm's speed, {found.resolved_to:.4g} Hz of "
        f"{top:.4g} Hz, and no more are taken: what soft shocks excite above is missing from the vibration; "
        f"from operation.input_speed = {math.ceil(600.0 * top / MOST) / 10.0:g} rpm on the whole band is covered"
    )
    return replace(found, warnings=(said, *kept))
