"""Spherical Geneva wheel: a pin on a crank in place of a planet's, the yardstick for indexers.

The pin enters along the slot, so at φ0 the pin's circle touches the slot's great circle (sources §5):

    sin β = sin ψ0 sin D,   tan φ0 = 1/(cos D tan ψ0),

φ0 below 90° for D < 90° (as an outer Geneva drive), above for D > 90° (as an inner one).
"""

from __future__ import annotations

import math

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.indexer import Indexer
from trochoid.kinematics.spherical_trochoid import SphericalTrochoid


def geneva(swing: float, shaft_angle: float = 0.5 * math.pi) -> Indexer:
    """Geneva wheel that turns by `swing` (ψ_Σ = 2π/slots, rad), its shafts at D (rad).  Raises Infeasible."""
    if not 0.0 < swing < math.pi:
        raise Infeasible(
            f"a Geneva wheel with a swing of {math.degrees(swing):g}°; take more than 0° and less than 180°, "
            "so three slots or more"
        )
    if not 0.0 < shaft_angle < math.pi:
        raise Infeasible(
            f"shaft angle {math.degrees(shaft_angle):g}°: the shafts must cross; take 0° to 180°, both excluded"
        )
    half = 0.5 * swing
    pin = math.asin(math.sin(half) * math.sin(shaft_angle))
    turn = math.atan2(math.cos(half), math.cos(shaft_angle) * math.sin(half))
    # no planet: a pin on its arm, whatever the ratio
    return Indexer(SphericalTrochoid(pin, 0.0, 2.0), shaft_angle, turn)
