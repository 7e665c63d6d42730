"""The indexer of a scene: the task that it sets, all that solve it, the one chosen, the Geneva wheel beside it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.geneva import geneva
from trochoid.kinematics.indexer import Indexer
from trochoid.kinematics.indexer_design import synthesise
from trochoid.kinematics.indexer_limits import Wish
from trochoid.kinematics.indexer_synthesis import Solution, Task, by_duration, by_pin
from trochoid.scene.drive_indexer import IndexerDrive, IndexerScene

INDEXER, GENEVA = "indexer", "geneva_wheel"
SHOWN = {INDEXER: "indexer", GENEVA: "Geneva wheel"}


@dataclass(frozen=True, slots=True)
class Design:
    """The drive, the speed of the arm (rad/s), every solution of its task in either train, and the one chosen.

    `mechanisms`: the indexer, and beside it the spherical Geneva wheel on the same shafts with the same swing,
    where there is one (below 180°).
    """

    drive: IndexerDrive
    speed: float
    solutions: tuple[Solution, ...]
    chosen: Solution
    mechanisms: Mapping[str, Indexer]

    @property
    def indexer(self) -> Indexer:
        """The mechanism that was chosen."""
        return self.chosen.indexer

    @property
    def turns(self) -> int:
        """+1 where the wheel turns about its axis o as the arm about z, −1 where against it."""
        return -self.indexer.sense

    @property
    def slots(self) -> int:
        """How many slots a swing apart have room on the wheel."""
        return math.floor(2.0 * math.pi / self.drive.swing_angle + 1e-9)

    @property
    def closes(self) -> bool:
        """Whether whole swings make a turn, so that the wheel may index on and on in one sense."""
        return abs(2.0 * math.pi / self.drive.swing_angle - self.slots) < 1e-9

    @property
    def pin_angle(self) -> float:
        """Angle (rad) of the pin's radius as seen from the centre of the sphere."""
        return self.drive.pin_radius / self.drive.sphere_radius


def task(drive: IndexerDrive) -> Task:
    """Return what the scene asks of the mechanism."""
    return Task(drive.swing_angle, drive.ratio, drive.axis_angle)


def wish(drive: IndexerDrive) -> Wish:
    """Return which of the solutions the scene asks for."""
    return Wish(drive.relative_turning_time, drive.pin_ratio, drive.train, drive.place)


def _refused(drive: IndexerDrive, found: tuple[Solution, ...]) -> Solution:
    """Raise Infeasible with what binds, the nearest swing, and what serves in its place."""
    try:
        return synthesise(task(drive), wish(drive), lambda other, x: _has_room(drive, other, x))
    except Infeasible as refusal:
        others = dict.fromkeys(f'train = "{x.kind}", place = "{x.place}"' for x in found if not x.fault)
        if not others:
            raise
        raise Infeasible(f"{refusal}; all else the same, {' or '.join(others)} serves") from None


def _has_room(drive: IndexerDrive, other: Task, solution: Solution) -> bool:
    """Whether pin and wheel of the scene go with a solution for another swing."""
    from trochoid.drives.indexer.feasible import faults
    from trochoid.kinematics.indexer_slot import slot

    turned = drive.model_copy(update={"swing_angle": other.swing})
    made = Design(turned, 1.0, (solution,), solution, {INDEXER: solution.indexer})
    return not faults(made, slot(solution.indexer))


def design(scene: IndexerScene) -> Design:
    """Synthesise the indexer; raises Infeasible with what binds and the nearest swing that has a solution."""
    drive = scene.drive
    asked, wanted = task(drive), wish(drive)
    if drive.relative_turning_time is not None:
        found = by_duration(asked, drive.relative_turning_time)
    else:
        assert drive.pin_ratio is not None
        found = by_pin(asked, drive.pin_ratio)
    serving = [x for x in found if not x.fault and x.kind == wanted.kind and wanted.place in (None, x.place)]
    chosen = serving[0] if serving else _refused(drive, found)
    mechanisms = {INDEXER: chosen.indexer}
    if drive.swing_angle < np.nextafter(math.pi, 0.0):
        mechanisms[GENEVA] = geneva(drive.swing_angle, drive.axis_angle)
    return Design(drive, scene.operation.input_speed, found, chosen, mechanisms)
