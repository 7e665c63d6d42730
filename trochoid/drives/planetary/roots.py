"""Largest tension in the fillets of the loaded teeth of sun, planets and ring."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.planetary.bodies import Level
from trochoid.drives.planetary.contact import assembly
from trochoid.drives.planetary.design import Design
from trochoid.drives.planetary.series import Series
from trochoid.fem.gear_pair import GearPair
from trochoid.fem.gear_root import Loaded, RootTable, largest, pair_loads, root_stress, root_table
from trochoid.kinematics.train import Speeds
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, slots=True)
class Roots:
    """Largest tension (n,) in Pa among the teeth of each wheel that carry at each position; planets (n, N)."""

    sun: Array
    planet: Array
    ring: Array


def roots(design: Design, turning: Speeds, level: Level, series: Series) -> Roots:
    """Read the stress of all loaded teeth; each feels all forces on its wheel."""
    problem = assembly(design, turning, level, series.load, series.angle)
    planets, pairs = len(series.places), {f.name: f.pair for f in problem.families}
    wheels_on = ("sun", "ring", *(f"planet{i}" for i in range(planets)))
    on: dict[str, list[Loaded]] = {name: [] for name in wheels_on}
    for i in range(planets):
        for name, force, wheels in (
            (f"sun{i}", series.sun.force[:, i], ("sun", f"planet{i}")),
            (f"ring{i}", series.ring.force[:, i], (f"planet{i}", "ring")),
        ):
            pair = pairs[name]
            assert isinstance(pair, GearPair)
            state = pair.at(series.motion)
            for second, wheel in enumerate(wheels):
                on[wheel].append(pair_loads(pair, state, force, bool(second)))
    tables = [root_table(wheel.body) for wheel in level.wheels]
    width = design.drive.face_width
    return Roots(
        frozen(_most(tables[0], on["sun"], width)),
        frozen(np.stack([_most(tables[1], on[f"planet{i}"], width) for i in range(planets)], axis=1)),
        frozen(_most(tables[2], on["ring"], width)),
    )


def _most(table: RootTable, loaded: list[Loaded], width: float) -> Array:
    """Return the largest tension (n,) among the teeth that carry."""
    found = []
    for part in loaded:
        tooth = part.number if part.hand > 0 else part.number - 1
        for c in np.flatnonzero(part.force.max(axis=0) > 0.0):
            stress = largest(root_stress(table, loaded, tooth[:, c], width))
            found.append(np.where(part.force[:, c] > 0.0, stress, 0.0))
    if not found:  # a planet that nothing loads
        return np.zeros(len(loaded[0].force))
    return np.asarray(np.max(found, axis=0))
