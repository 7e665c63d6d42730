"""Brute force for gears: how deep points lie in the material of a cut gear, and tools as clouds of points."""

from __future__ import annotations

import math

import numpy as np

from trochoid.kinematics.involute_cut import Cut
from trochoid.kinematics.involute_pair import Pair
from trochoid.kinematics.rack import Rack
from trochoid.kinematics.shaper import Shaper
from trochoid.kinematics.types import Array, ComplexArray


def depth(cut: Cut, points: ComplexArray) -> Array:
    """How far (m, along the circle) points lie inside the material of a gear without tips; −∞ where it has none."""
    gear, side = cut.gear, cut.gear.side
    radius, pitch = np.abs(points), 2.0 * math.pi / gear.teeth
    away = np.abs(np.mod(np.angle(points) + 0.5 * pitch, pitch) - 0.5 * pitch)
    start = math.hypot(gear.base_radius, cut.start)
    on_involute = side * (radius - start) >= 0.0
    flank = gear.flank_angle(np.where(on_involute, np.maximum(radius, gear.base_radius), start))
    in_fillet = ~on_involute & (side * (radius - cut.root_radius) >= 0.0)
    flank[in_fillet] = _fillet_angle(cut, radius[in_fillet])
    inside: Array = radius * (away - flank)
    beyond_root = side * (cut.root_radius - radius)
    return np.where(beyond_root > 0.0, np.maximum(beyond_root, inside), inside)


def _fillet_angle(cut: Cut, radius: Array) -> Array:
    """Polar angle of the fillet at `radius`, by bisection along its roll."""
    low, high = np.full(radius.shape, cut.fillet.root), np.full(radius.shape, cut.fillet.end)
    for _ in range(54):
        middle = 0.5 * (low + high)
        nearer_root = cut.gear.side * (np.abs(cut.fillet.point(middle)) - radius) < 0.0
        low, high = np.where(nearer_root, middle, low), np.where(nearer_root, high, middle)
    return np.angle(cut.fillet.point(0.5 * (low + high)))


def rack_tooth(rack: Rack, shift: float, above: float, count: int = 60) -> ComplexArray:
    """Points of a rack tooth, both sides: depth from the gear's pitch line + i·(position along it), m.

    `above` (modules) is how far its flanks reach above the rack's reference line.
    """
    m, alpha, rho = rack.module, rack.pressure_angle, rack.rounding
    center = rack.tip_height - rho
    half = 0.25 * math.pi - center * math.tan(alpha) - rho / math.cos(alpha)
    turn = np.linspace(0.0, 0.5 * math.pi - alpha, count)
    tip = np.linspace(0.0, half, count) - 1j * rack.tip_height
    round_ = half + rho * np.sin(turn) - 1j * (center + rho * np.cos(turn))
    level = np.linspace(-rack.straight, above, count)
    flank = 0.25 * math.pi + level * math.tan(alpha) + 1j * level
    right = np.concatenate((tip, round_, flank))
    both = np.concatenate((right, -right.conj()))
    return np.asarray(m * (shift + both.imag + 1j * both.real))


def shaper_tooth(pair: Pair, shaper: Shaper, count: int = 60) -> ComplexArray:
    """Points of a shaper tooth on its own x axis, both sides, m: flank, round (or sharp) corner and tip circle."""
    tool, rho, tip = pair.first, shaper.rounding, 0.5 * shaper.tip_diameter
    base = tool.base_radius
    along = math.sqrt((tip - rho) ** 2 - base**2)
    half_tooth = math.pi / tool.teeth

    def on_flank(tangent: Array) -> ComplexArray:
        radius = np.hypot(base, tangent)
        return np.asarray(radius * np.exp(1j * (half_tooth - tool.flank_angle(radius))))

    foot = on_flank(np.array([along + rho]))[0]
    normal = 1j * np.exp(1j * (np.angle(foot) - math.atan2(along + rho, base)))  # away from the tooth
    center = foot - rho * normal
    first, last = np.angle(center), np.angle(normal)
    parts = [
        on_flank(np.linspace(0.0, along + rho, count)),
        center + rho * np.exp(1j * np.linspace(first, last, count)),
        tip * np.exp(1j * np.linspace(0.0, first, count)),
    ]
    half = np.concatenate(parts)
    return np.concatenate((half, half.conj()))


def roll_rack(tooth: ComplexArray, pitch_radius: float, roll: Array) -> ComplexArray:
    """Carry rack points into the gear's frame at the rolls (n,); shape (n, points)."""
    phi = roll[:, None]
    return np.asarray(np.exp(1j * phi) * (pitch_radius + tooth - 1j * pitch_radius * phi))


def roll_shaper(tooth: ComplexArray, pair: Pair, roll: Array) -> ComplexArray:
    """Carry points of a shaper into the gear's frame at the rolls (n,); shape (n, points)."""
    tool, work = (float(radius) for radius in pair.pitch_radii)
    phi, side = roll[:, None], pair.side
    place = float(pair.center_distance) * np.exp(1j * phi)
    return np.asarray(place - side * tooth * np.exp(1j * phi * (1.0 + side * work / tool)))
