"""Rolling bearings that the tests share."""

from __future__ import annotations

import numpy as np

from trochoid.fem.material import Material
from trochoid.fem.rolling import Rolling
from trochoid.fem.rolling_ball import BallBearing
from trochoid.fem.rolling_centrifugal import spinning
from trochoid.fem.rolling_roller import RollerRow, logarithmic
from trochoid.kinematics.types import Array

MASTA_STEEL = Material(210e9, 0.3, 7800.0)


def iso16281_ball_bearing(clearance: float = 0.0) -> BallBearing:
    """Return the deep groove bearing of the public comparison with MASTA (minzhun/ISO16281)."""
    d = 11.5e-3
    return BallBearing(7, d, 43.5e-3, 0.52 * d, 0.53 * d, 0.0, clearance, MASTA_STEEL, MASTA_STEEL)


ANGULAR_218 = BallBearing(16, 22.23e-3, 0.5 * (102.79e-3 + 147.73e-3), 11.63e-3, 11.63e-3, np.radians(40.0))
DEEP = BallBearing(9, 12.7e-3, 65e-3, 0.52 * 12.7e-3, 0.53 * 12.7e-3)
LOOSE = BallBearing(9, 12.7e-3, 65e-3, 0.52 * 12.7e-3, 0.53 * 12.7e-3, clearance=10e-6)
TIGHT = BallBearing(9, 12.7e-3, 65e-3, 0.52 * 12.7e-3, 0.53 * 12.7e-3, clearance=-5e-6)
CYLINDRICAL = RollerRow(14, 11e-3, 60e-3, 12e-3, clearance=20e-6, drop=logarithmic(11e-3, 12e-3))
PRELOADED = RollerRow(14, 11e-3, 60e-3, 12e-3, clearance=-8e-6)
TAPERED = RollerRow(17, 7.4e-3, 46e-3, 12e-3, np.radians(14.0), drop=logarithmic(7.4e-3, 12e-3, 30, 0.00045))
NEEDLE = RollerRow(24, 2.5e-3, 30e-3, 16e-3, clearance=15e-6, drop=logarithmic(2.5e-3, 16e-3))
FAST = spinning(ANGULAR_218, 1000.0)

BEARINGS: dict[str, Rolling] = {
    "angular": ANGULAR_218,
    "deep": DEEP,
    "loose": LOOSE,
    "tight": TIGHT,
    "cylindrical": CYLINDRICAL,
    "preloaded": PRELOADED,
    "tapered": TAPERED,
    "needle": NEEDLE,
    "fast": FAST,
}
SLANTED = ("angular", "tapered", "fast")  # carry axial force one way only
STRAIGHT = ("cylindrical", "preloaded", "needle")  # carry none


def displacement(name: str, parts: Array) -> Array:
    """Return a displacement (5,) of usual size from numbers between −1 and 1."""
    shift = parts * np.array([3e-5, 3e-5, 3e-5, 8e-4, 8e-4])
    return np.asarray(shift + np.array([0.0, 0.0, 3e-5 if name in SLANTED else 0.0, 0.0, 0.0]))


def passable(name: str, parts: Array, size: float) -> Array:
    """Return a load (5,) that the bearing can pass from numbers between −1 and 1."""
    load: Array = parts * size * np.array([1.0, 1.0, 1.0, 5e-3, 5e-3])
    if name in STRAIGHT:
        load[2] = 0.0
    if name in SLANTED:
        load[2] = abs(load[2]) + 4.0 * float(np.hypot(load[0], load[1]))
        load[2] += 600.0 * float(np.hypot(load[3], load[4]))
    return load
