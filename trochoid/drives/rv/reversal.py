"""Lost motion: how far the output goes, with the input held, between small torques to either side."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.rv.bodies import Level
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.series import solve_series, turn_angles
from trochoid.kinematics.types import Array, frozen

SHARE = 0.03  # of the output torque, to either side
HELD = 7  # input angles; odd, so that few of them are alike


@dataclass(frozen=True, slots=True)
class Reversal:
    """At held input angles (n,): width (n,) between both twists of the driven member, and the part of it that the play
    of the first stage adds; rad.
    """

    angle: Array
    width: Array
    first_stage: float

    @property
    def total(self) -> Array:
        """Lost motion (n,) with the play of the first stage."""
        return np.asarray(self.width + self.first_stage)


def reversal(design: Design, rung: str, level: Level) -> Reversal:
    """Solve both sides at a few angles over a turn of the crankshafts. Raises NotConverged."""
    angle = np.linspace(0.0, turn_angles(design, 1)[-1], HELD, endpoint=False)
    torque = SHARE * design.ring_torque
    one, other = (solve_series(design, rung, level, angle, sign * torque) for sign in (1.0, -1.0))
    width = (one.twist - other.twist) / design.leverage
    return Reversal(frozen(angle), frozen(width), first_stage_play(design))


def first_stage_play(design: Design) -> float:
    """Return the play of the teeth (rad) as an angle of the driven member with the sun held; 0 without clearance.

    A play j on the pitch circle r lets the sun turn by j/r, and the ring, seen from the carrier, by 1/(i − 1) of that.
    """
    table, c = design.drive.first_stage, design.drive.cycloid
    if not design.scene.has("clearance"):
        return 0.0
    free = table.backlash / float(design.first.pair.pitch_radii[0])
    return free * table.z_sun * (c.pins - c.lobes) / (table.z_planet * c.pins) / design.leverage
