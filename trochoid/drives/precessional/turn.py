"""Reactions over a turn of the input shaft by all models: extremes, means, harmonics, and their check."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from trochoid.drives.precessional.casing import casing_load, closed_record, inertia_load
from trochoid.drives.precessional.elastic import Elastic
from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.reactions import Model, Reactions, reactions
from trochoid.dynamics.spectrum import harmonics
from trochoid.dynamics.wrench import Wrench
from trochoid.kinematics.spherical import rotation
from trochoid.kinematics.spherical import turn as rotated
from trochoid.kinematics.types import Array, frozen

MODELS: Mapping[str, Model] = {"rigid": "exact", "printed": "printed"}  # name in results -> model
FORCES, MOMENTS = ("R_A", "R_B", "R_O"), ("M_B", "M_3")
STEPS = 361  # 0…360° by 1°, both ends: what least, mean and largest are taken over
HARMONICS = 6  # of the sizes of reactions that are shown


@dataclass(frozen=True, eq=False, slots=True)
class Turn:
    """Reactions `over` 0…360° of the shaft, `sizes` of |R| and M over it, N and N·m; load on the casing.

    `lines` (HARMONICS,) amplitudes of each size's own harmonics, multiples of 2 z1/z2 of the shaft's speed; M_3
    has them too.  `load`, about O in the fixed frame, covers the closed record of shaft angles `crank`.
    """

    over: Reactions
    sizes: Mapping[str, Array]
    lines: Mapping[str, Array]
    crank: Array
    load: Wrench


def models(
    drive: PrecessionalDrive, speed: float, elastic: Elastic | None = None
) -> dict[str, Callable[[Array], Reactions]]:
    """Return what gives the reactions at shaft angles, by the model's name: "elastic" where joints yield."""

    def rigid(model: Model) -> Callable[[Array], Reactions]:
        return lambda crank: reactions(drive, crank, speed, model)

    found = {name: rigid(model) for name, model in MODELS.items()}
    return found if elastic is None else found | {"elastic": elastic.reactions}


def turns(drive: PrecessionalDrive, speed: float, elastic: Elastic | None = None) -> dict[str, Turn]:
    """Return the reactions by each model, at the constant speed ω_3 (rad/s) of the shaft."""
    angle = np.linspace(0.0, 2.0 * np.pi, STEPS)
    crank = closed_record(drive)
    period = drive.reaction_period * np.arange(4 * HARMONICS) / (4 * HARMONICS)
    made = {}
    for name, at in models(drive, speed, elastic).items():
        over, once = at(angle), at(period)
        sizes = {key: over.magnitude(key) for key in FORCES + MOMENTS}
        lines = {
            key: frozen(np.abs(harmonics(once.magnitude(key))[1 : HARMONICS + 1])) for key in FORCES + MOMENTS
        }
        made[name] = Turn(over, sizes, lines, crank, casing_load(at(crank)))
    return made


def residual(drive: PrecessionalDrive, speed: float, turn: Turn) -> float:
    """Load on the casing less the inertia of all members, over the largest of single forces and moments.

    Newton's and Euler's laws for the whole; what acts inside the drive cancels.  Meant for the model "rigid".
    """
    inertia = inertia_load(drive, turn.crank, speed)
    forces = max(float(np.abs(turn.sizes[key]).max()) for key in FORCES)
    size = max(forces * drive.joint, *(float(np.abs(turn.sizes[key]).max()) for key in MOMENTS))
    if forces == 0.0 or size == 0.0:
        return 0.0
    off = np.abs(turn.load.force - inertia.force).max() / forces
    return float(max(off, np.abs(turn.load.moment - inertia.moment).max() / size))


def elastic_residual(turn: Turn, elastic: Elastic) -> float:
    """Load on the casing less the inertia of all members on their yielding paths, as `residual` has it."""
    fixed = rotation(2, turn.crank)
    more = rotated(fixed, elastic.at(elastic.inertia, turn.crank).reshape(-1, 2, 3).swapaxes(0, 1))
    inertia = inertia_load(elastic.drive, turn.crank, elastic.speed)
    forces = max(float(np.abs(turn.sizes[key]).max()) for key in FORCES)
    size = max(forces * elastic.drive.joint, *(float(np.abs(turn.sizes[key]).max()) for key in MOMENTS))
    if forces == 0.0 or size == 0.0:
        return 0.0
    off = np.abs(turn.load.force - inertia.force - more[0]).max() / forces
    return float(max(off, np.abs(turn.load.moment - inertia.moment - more[1]).max() / size))
