"""Inner geometry assumed from boundary dimensions, where a maker's is not known: stiffness to perhaps 20 %.

The proportions are rules of thumb that hit common catalogue bearings within a few per cent in element size and
within one in number; no drawing stands behind them.  Whoever prints a result says that it is assumed.
"""

from __future__ import annotations

import numpy as np

from trochoid.fem.rolling_ball import BallBearing
from trochoid.fem.rolling_roller import RollerRow, logarithmic
from trochoid.kinematics.errors import Infeasible

SLENDER = (1.03, 6.0)  # outside over bore: ISO 15's diameter series and thin-section bearings lie within
FLAT = (0.2, 4.0)  # width over the ring section (D − d)/2 of ISO 15's width series
FLAT_NEEDLE = (0.5, 16.0)  # of needle bearings, drawn cups among them
MOST = 200  # elements
OWN = (
    "no such bearing is made, and none is assumed; mend the sizes, or give the inner geometry in their place"
)


def assumed_ball_bearing(
    bore: float, outside: float, width: float, contact_angle: float = 0.0, clearance: float = 0.0
) -> BallBearing:
    """Return a ball bearing of assumed inner geometry for a bore, outside diameter and width in m.

    Assumed: pitch diameter (d + D)/2; balls of 0.30 (D − d), at most 0.70 B; grooves 0.52 and 0.53 of the ball
    diameter (ISO 281); deep groove: as many balls as can be filled in from one side over 196° (Conrad);
    angular contact: balls 1.1 diameters apart.
    """
    pitch = _pitch(bore, outside, width)
    ball = min(0.30 * (outside - bore), 0.70 * width)
    half = float(np.arcsin(ball / pitch))
    filled = 1.0 + np.radians(196.0) / (2.0 * half)
    balls = _few(int(filled), ball, pitch) if contact_angle == 0.0 else _spaced(ball, pitch, 1.1)
    return BallBearing(balls, ball, pitch, 0.52 * ball, 0.53 * ball, contact_angle, clearance)


def assumed_roller_bearing(bore: float, outside: float, width: float, clearance: float = 0.0) -> RollerRow:
    """Return a cylindrical roller bearing of assumed inner geometry for a bore, outside diameter and width in m.

    Assumed: pitch diameter (d + D)/2; rollers of 0.27 (D − d), at most 0.70 B, effectively 0.55 B long, 1.2
    diameters apart, with the logarithmic profile of ISO/TS 16281.
    """
    pitch = _pitch(bore, outside, width)
    roller, length = min(0.27 * (outside - bore), 0.70 * width), 0.55 * width
    rollers = _spaced(roller, pitch, 1.2)
    return RollerRow(rollers, roller, pitch, length, clearance=clearance, drop=logarithmic(roller, length))


def assumed_needle_bearing(bore: float, outside: float, width: float, clearance: float = 0.0) -> RollerRow:
    """Return a needle roller bearing of assumed inner geometry; `bore`: of the shaft or inner ring's raceway, m.

    Assumed: needles run on the bore; their diameter is 0.35 (D − d), effectively 0.75 B long, 1.15 diameters
    apart, with the logarithmic profile of ISO/TS 16281 for long rollers.
    """
    _pitch(bore, outside, width, FLAT_NEEDLE)
    needle, length = 0.35 * (outside - bore), 0.75 * width
    pitch = bore + needle
    needles = _spaced(needle, pitch, 1.15)
    return RollerRow(needles, needle, pitch, length, clearance=clearance, drop=logarithmic(needle, length))


def assumed_tapered_bearing(
    bore: float, outside: float, width: float, contact_angle: float = float(np.radians(14.0))
) -> RollerRow:
    """Return a tapered roller bearing of assumed inner geometry for a bore, outside diameter and width T in m.

    Assumed: pitch diameter (d + D)/2 at the rollers' middle; mean roller diameter 0.23 (D − d), effectively
    0.60 T/cos α long, 1.1 diameters apart; contact angle 14° (series 302, 303: 11° to 16°) if not given; the
    logarithmic profile of ISO/TS 16281 for tapered rollers.
    """
    pitch = _pitch(bore, outside, width)
    roller = 0.23 * (outside - bore)
    length = 0.60 * width / float(np.cos(contact_angle))
    drop = logarithmic(roller, length, factor=0.00045)
    return RollerRow(_spaced(roller, pitch, 1.1), roller, pitch, length, contact_angle, drop=drop)


def _pitch(bore: float, outside: float, width: float, flat: tuple[float, float] = FLAT) -> float:
    """Return the pitch diameter (d + D)/2; refuses sizes that are not those of a bearing."""
    if not (0.0 < bore < outside < np.inf and 0.0 < width < np.inf):
        raise Infeasible(
            f"bearing: boundary dimensions must be 0 < bore < outside and width > 0, given bore {bore} m, outside "
            f"{outside} m, width {width} m"
        )
    section = 0.5 * (outside - bore)
    for what, ratio, (low, high), size, unit in (
        ("outside", outside / bore, SLENDER, bore, "bore"),
        ("width", width / section, flat, section, "(outside − bore)/2"),
    ):
        if not low <= ratio <= high:
            raise Infeasible(
                f"bearing: bore {1e3 * bore:.6g} mm, outside {1e3 * outside:.6g} mm, width {1e3 * width:.6g} mm: with "
                f"that {unit} the {what} of a bearing lies between {1e3 * low * size:.4g} and "
                f"{1e3 * high * size:.4g} mm; {OWN}"
            )
    return 0.5 * (bore + outside)


def _spaced(diameter: float, pitch: float, spacing: float) -> int:
    return max(3, _few(int(np.pi / np.arcsin(spacing * diameter / pitch)), diameter, pitch))


def _few(count: int, diameter: float, pitch: float) -> int:
    if count > MOST:
        raise Infeasible(
            f"bearing: {count} elements of {1e3 * diameter:.4g} mm on a circle of {1e3 * pitch:.6g} mm, more than "
            f"{MOST}: {OWN}"
        )
    return count
