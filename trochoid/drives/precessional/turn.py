"""Reactions over a turn of the input shaft by both models: extremes, means, harmonics, and their check."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from trochoid.drives.precessional.casing import casing_load, closed_record, inertia_load
from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.reactions import Model, Reactions, reactions
from trochoid.dynamics.spectrum import harmonics
from trochoid.dynamics.wrench import Wrench
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


def turns(drive: PrecessionalDrive, speed: float) -> dict[str, Turn]:
    """Return the reactions by each model, at the constant speed ω_3 (rad/s) of the shaft."""
    angle = np.linspace(0.0, 2.0 * np.pi, STEPS)
    crank = closed_record(drive)
    period = drive.reaction_period * np.arange(4 * HARMONICS) / (4 * HARMONICS)
    made = {}
    for name, model in MODELS.items():
        over, once = (reactions(drive, a, speed, model) for a in (angle, period))
        sizes = {key: over.magnitude(key) for key in FORCES + MOMENTS}
        lines = {
            key: frozen(np.abs(harmonics(once.magnitude(key))[1 : HARMONICS + 1])) for key in FORCES + MOMENTS
        }
        made[name] = Turn(over, sizes, lines, crank, casing_load(reactions(drive, crank, speed, model)))
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
