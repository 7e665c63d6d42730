"""Whether the error estimated from two mesh levels is the true one, against a mesh twice finer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

import trochoid
from benchmarks import disc
from benchmarks.run import SCENE
from benchmarks.table import Row, Table
from trochoid.drives.choosing import COARSEST
from trochoid.drives.khv.estimate import position_errors
from trochoid.drives.khv.series import Series
from trochoid.kinematics.types import Array

# the first two are those that a run begins with; the third gives the true error of the second
LEVELS = (COARSEST, 2 * COARSEST, 4 * COARSEST)
ENOUGH, FACTOR = 0.95, 20.0


def measure() -> list[Table]:
    """Judge the estimate on one disc and on the whole example."""
    discs = [_of_disc(disc.turn(level, 0)) for level in LEVELS]
    stages = trochoid.Run(trochoid.load(str(SCENE), ["ask.positions=60"])).stages
    drives = [_of_drive(stages.series(stages.level(level))) for level in LEVELS]
    return [
        _judged("error estimate, disc with its bore held", discs),
        _judged("error estimate, drive", drives),
    ]


def _of_disc(found: disc.Turn) -> dict[str, Array]:
    force = found.force.max(axis=1)
    return {"rotation": found.rotation, "stiffness": found.stiffness, "largest pin force": force}


def _of_drive(found: Series) -> dict[str, Array]:
    return {
        "twist": found.twist[:-1],
        "stiffness": found.torsional_stiffness[:-1],
        "largest ring-pin force": found.ring.force[:-1].max(axis=(1, 2)),
        "largest output-pin force": found.output.force[:-1].max(axis=(1, 2)),
        "largest pressure": found.ring.pressure[:-1].max(axis=(1, 2)),
    }


def _judged(title: str, levels: Sequence[Mapping[str, Array]]) -> Table:
    coarse, fine, finest = levels
    rows: list[Row] = []
    for name, value in fine.items():
        estimate, true = position_errors(value, coarse[name]), np.abs(value - finest[name])
        brackets = float(np.mean(estimate >= true))
        close = float(np.mean(estimate <= FACTOR * true))
        excess = float(np.sqrt(np.mean(estimate**2) / np.mean(true**2)))
        rows.append(Row(f"{name}: true error", float(true.max() / np.abs(value).max())))
        rows.append(Row(f"{name}: estimate / true error, rms", excess, "", FACTOR))
        rows.append(Row(f"{name}: share bracketed", brackets, "", ENOUGH, at_least=True))
        rows.append(Row(f"{name}: share within {FACTOR:g} times", close, "", ENOUGH, at_least=True))
    how = f"{LEVELS[1]} facets per lobe, estimated with {LEVELS[0]}, true against {LEVELS[2]}; 60 positions"
    return Table(title, how, tuple(rows))
