"""Stiffness of the teeth of sun and planet as ISO 6336-1 estimates it."""

from __future__ import annotations

import math

from trochoid.kinematics.involute_pair import Pair

SOLID, CALCULATED = 1.0, 0.8  # C_R of solid wheels; C_M, what is measured over what theory gives
LIGHT = 1e5  # N/m: below this line load stiffness falls with its fourth root


def single_stiffness(pair: Pair) -> float:
    """Return the single stiffness c' of a spur pair in N/m² (method B): force per deflection and width at one tooth.

    q' is the series of ISO 6336-1 for external gears with tooth numbers and shifts of both.
    """
    one, two = pair.first, pair.second
    z1, z2, x1, x2 = one.teeth, two.teeth, float(one.shift), float(two.shift)
    q = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 - 0.11654 * x1 / z1
    q += -0.00193 * x2 - 0.24188 * x2 / z2 + 0.00529 * x1**2 + 0.00182 * x2**2
    height = one.addendum + one.clearance
    rack = (1.0 + 0.5 * (1.2 - height)) * (1.0 - 0.02 * (20.0 - math.degrees(one.pressure_angle)))
    return 1e9 * CALCULATED * SOLID * rack / q


def mean_stiffness(pair: Pair, contact_ratio: float) -> float:
    """Return c_γα = c'(0.75 ε_α + 0.25) in N/m², the mean over the path of contact for ε_α ≥ 1.2."""
    return single_stiffness(pair) * (0.75 * contact_ratio + 0.25)


def light(line_load: float) -> float:
    """Return the share of the stiffness that is left under a line load (N/m): (F/b/100)^¼ below 100 N/mm."""
    return float(min(1.0, (max(line_load, 1e-3 * LIGHT) / LIGHT) ** 0.25))
