"""What catalogues read off the torque-twist loop of a drive whose input is held.

The middle of the loop is the mean of its two branches at the same torque. *Lost motion* is the width of the middle
between +3 % and −3 % of the rated torque. *Backlash* is the width of the loop at zero torque: the play, by which its
middle jumps there, and the hysteresis, by which its branches are apart. *Stiffness* comes from two straight lines
through the middle, from 3 % to 50 % and from 50 % to 100 %, each the mean of both directions of the torque.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.load_path import LOST, NEAR, LoadPath
from trochoid.kinematics.types import Array

HALF = 0.5  # share of the torque where the two lines meet


@dataclass(frozen=True, slots=True)
class Torsion:
    """Numbers of the loops at n held input angles, at the driven member; each (n,).

    Angles in rad; `lower` and `upper` line in N·m/rad; `loss` of a cycle in J: the area of the loop. `wind_up` is the
    middle of the loop at the rated torque, half the way between both directions. `open` is how far the loop misses its
    beginning after a cycle, and `unmet` by how much its area misses what friction took, in J: steps of the path.
    """

    lost_motion: Array
    backlash: Array
    play: Array
    hysteresis: Array
    lower: Array
    upper: Array
    loss: Array
    wind_up: Array
    open: Array
    unmet: Array


def torsion(path: LoadPath, torque: float) -> Torsion:
    """Read the loops of a path whose full torque is `torque` in N·m."""
    share, fall, rise = path.share[path.falling], path.twist[:, path.falling], path.twist[:, path.rising]
    rise = rise[:, ::-1]  # at the same torques as the falling branch

    def both(values: Array, part: float) -> tuple[Array, Array]:
        place = [int(np.argmin(np.abs(share - sign * part))) for sign in (1, -1)]
        return values[:, place[0]], values[:, place[1]]

    def width(part: float) -> Array:
        above, below = both(0.5 * (fall + rise), part)
        return np.asarray(above - below)

    def line(low: float, high: float) -> Array:
        return np.asarray(2 * (high - low) * torque / (width(high) - width(low)))

    apart = both(fall - rise, NEAR)
    area = np.abs(np.trapezoid(fall - rise, torque * share, axis=1))
    return Torsion(
        width(LOST),
        both(fall, NEAR)[0] - both(rise, NEAR)[1],
        width(NEAR),
        0.5 * (apart[0] + apart[1]),
        line(LOST, HALF),
        line(HALF, 1.0),
        area,
        0.5 * width(1.0),
        np.abs(fall[:, 0] - rise[:, 0]),
        np.abs(area - (path.lost[:, -1] - path.lost[:, path.falling.start])),
    )


def middle(path: LoadPath) -> Array:
    """Return the mean twist (m,) of both branches and all angles, at the torques of the falling branch."""
    fall, rise = path.twist[:, path.falling], path.twist[:, path.rising][:, ::-1]
    return np.asarray(0.5 * (fall + rise).mean(axis=0))
