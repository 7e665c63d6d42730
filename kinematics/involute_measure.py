"""What is measured on one involute gear: constant chord, span over teeth, size over rollers (GOST 16532, 19274)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute import Gear, inverse_involute, involute


@dataclass(frozen=True, slots=True)
class Chord:
    """Constant chord, its height from the tip, radius of curvature of the flank at its ends, m."""

    length: Any
    height: Any
    curvature_radius: Any


@dataclass(frozen=True, slots=True)
class Span:
    """Span over `teeth` (teeth, or spaces of a ring) and the radius of curvature where it touches, m."""

    teeth: int
    length: float
    curvature_radius: float


@dataclass(frozen=True, slots=True)
class OverPins:
    """Rollers of `diameter` in opposite spaces: pressure angle and circle of centres, contact, size; m, rad."""

    diameter: float
    pressure_angle: float
    center_diameter: float
    curvature_radius: float
    size: float


def constant_chord(gear: Gear, tip_radius: Any) -> Chord:
    """Chord of a tooth between the points that the unshifted rack touches, m.

    A ring's tooth gets thinner with x, so its chord is m(π/2 cos²α − x sin 2α); sources §4 prints +x.
    """
    alpha, side = gear.pressure_angle, gear.side
    # s cos²α with s the thickness at the reference circle
    length = gear.thickness * math.cos(alpha) ** 2
    height = side * (tip_radius - gear.pitch_radius) - 0.5 * length * math.tan(alpha)
    bend = gear.pitch_radius * math.sin(alpha) + side * 0.5 * length / math.cos(alpha)
    return Chord(length, height, bend)


def span(gear: Gear, teeth: int | None = None) -> Span:
    """Span over `teeth`; by default over as many as make it touch near the circle m(z/2 + x).

    Raises Infeasible where no span of at least one tooth and less than half the gear exists.
    """
    z, x, alpha = gear.teeth, float(gear.shift), gear.pressure_angle
    inv = float(involute(alpha))
    if teeth is None:
        cosine = z * math.cos(alpha) / (z + 2.0 * x) if z + 2.0 * x > 0.0 else 2.0
        if cosine > 1.0:
            least = -0.5 * z * (1.0 - math.cos(alpha))
            raise Infeasible(f"shift {x:g} of {z} teeth: a span needs a shift above {least:.4g}")
        touch = math.tan(math.acos(cosine))
        teeth = max(1, round(z / math.pi * (touch - 2.0 * x * math.tan(alpha) / z - inv) + 0.5))
    reach = math.pi * (teeth - 0.5) + 2.0 * x * math.tan(alpha) + z * inv
    length = gear.module * math.cos(alpha) * reach
    return Span(teeth, length, 0.5 * length)


def over_pins(gear: Gear, diameter: float) -> OverPins:
    """Size over (ring: between) rollers of `diameter` (m); raises Infeasible when they do not rest on flanks."""
    side, base = gear.side, gear.base_radius
    inv = float(side * (diameter / (2.0 * base) - gear.base_angle))
    if inv <= 0.0:
        limit = 2.0 * base * float(gear.base_angle)
        word = "smaller" if gear.internal else "larger"
        raise Infeasible(f"rollers of {1e3 * diameter:.6g} mm: take them {word} than {1e3 * limit:.6g} mm")
    angle = float(inverse_involute(inv))
    center = 2.0 * base / math.cos(angle)
    bend = base * math.tan(angle) - side * 0.5 * diameter
    across = center if gear.teeth % 2 == 0 else center * math.cos(0.5 * math.pi / gear.teeth)
    return OverPins(diameter, angle, center, bend, across + side * diameter)


def degrees(angle: float) -> tuple[int, int, int]:
    """Degrees, minutes and whole seconds of an angle (rad), seconds rounded."""
    total = int(np.rint(math.degrees(angle) * 3600.0))
    return total // 3600, total // 60 % 60, total % 60
