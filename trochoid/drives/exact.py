"""What the answers of all drives share: exact numbers in the engineer's units."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from trochoid.results.outcome import Quantity

if TYPE_CHECKING:
    from trochoid.kinematics.cycloid import Cycloid

ARCMIN = math.pi / 180 / 60
RPM = 2 * math.pi / 60


def exact(values: Mapping[str, tuple[float, str]]) -> Quantity:
    """Return parts, each (value, unit), that rest on closed forms."""
    return Quantity(
        parts={name: Quantity(value, unit, 0.0, "exact") for name, (value, unit) in values.items()}
    )


def cycloid_profile(flank: Cycloid) -> dict[str, tuple[float, str]]:
    """Return the numbers of a disc's theoretical flank with their units."""
    bend = flank.curvature(np.linspace(0, np.pi / flank.lobes, 2001))
    return {
        "trochoid_ratio": (flank.trochoid_ratio, ""),
        "pitch_radius_disc": (1e3 * flank.eccentricity * flank.lobes, "mm"),
        "pitch_radius_pins": (1e3 * flank.eccentricity * flank.pins, "mm"),
        "crest_radius": (1e3 * (flank.pin_circle_radius + flank.eccentricity - flank.pin_radius), "mm"),
        "root_radius": (1e3 * (flank.pin_circle_radius - flank.eccentricity - flank.pin_radius), "mm"),
        "pin_radius_undercut_limit": (1e3 * flank.undercut_radius, "mm"),
        "least_convex_radius": (1e3 / float(bend.max()), "mm"),
        "least_concave_radius": (-1e3 / float(bend.min()), "mm"),
    }


def millimetres(length: float) -> str:
    """Return a length (m) in mm without the rounding that a conversion leaves."""
    return f"{1e3 * length:.12g}"
