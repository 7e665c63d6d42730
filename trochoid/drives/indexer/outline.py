"""The wheel as drawn: rim, slots with round bottoms, and the way from its frame onto the sphere and into the plane."""

from __future__ import annotations

import math

import numpy as np

from trochoid.drives.indexer.design import Design
from trochoid.drives.indexer.feasible import slot_length
from trochoid.kinematics.indexer import Indexer
from trochoid.kinematics.indexer_slot import Slot
from trochoid.kinematics.types import Array

ALONG, ROUND, RIM = 12, 13, 24  # points of a slot's side, of its bottom, and of the rim between two slots


def outline(design: Design, slot: Slot) -> Array:
    """Closed outline (n, 3) of the wheel on the unit sphere, its axis along z and the slot of the pin towards x."""
    r, rim = design.pin_angle, slot.farthest
    length = design.drive.wheel.slot_length or slot_length(design, slot)
    bottom = rim - length / design.drive.sphere_radius + r
    mouth = math.acos(max(-1.0, min(1.0, math.cos(rim) / math.cos(r))))  # of the slot's side on the rim
    side = np.linspace(mouth, bottom, ALONG)[:-1]
    turn = np.linspace(0.0, math.pi, ROUND)
    down = _beside(side, r)
    end = _beside(np.full(ROUND, bottom), r * np.cos(turn), -r * np.sin(turn))
    one = np.concatenate((down, end, down[::-1] * [1.0, -1.0, 1.0]))
    edge = math.atan2(float(one[0, 1]), float(one[0, 0]))
    swing, pieces = design.drive.swing_angle, []
    for k in range(design.slots):
        # slots follow each other against the sense in which one is run through
        azimuth = -k * swing
        gap = (swing if k < design.slots - 1 else 2.0 * math.pi - k * swing) - 2.0 * edge
        rest = azimuth - edge - np.linspace(0.0, 1.0, RIM)[1:-1] * gap
        pieces += [turned(one, azimuth), _at(np.full(RIM - 2, rim), rest)]
    return np.concatenate(pieces)


def turned(points: Array, angle: float) -> Array:
    """Points (n, 3) turned about z."""
    c, s = math.cos(angle), math.sin(angle)
    round_z: Array = points @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return round_z


def to_space(points: Array, indexer: Indexer) -> Array:
    """Points (n, 3) of the frame whose z is the wheel's axis and whose x is w, in the fixed frame."""
    c, s = math.cos(indexer.shaft_angle), math.sin(indexer.shaft_angle)
    space: Array = points @ np.array([[-c, 0.0, s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    return space


def to_wheel(points: Array, indexer: Indexer) -> Array:
    """Inverse of `to_space`."""
    c, s = math.cos(indexer.shaft_angle), math.sin(indexer.shaft_angle)
    back: Array = points @ np.array([[-c, 0.0, s], [0.0, 1.0, 0.0], [s, 0.0, c]]).T
    return back


def flat(points: Array, radius: float) -> Array:
    """Points (..., 3) of the wheel's frame as seen along its axis (..., 2): true distances from it."""
    across = np.hypot(points[..., 0], points[..., 1])
    scale = radius * np.arctan2(across, points[..., 2]) / np.where(across > 0.0, across, 1.0)
    plane: Array = points[..., :2] * scale[..., None]
    return plane


def _at(reach: Array, azimuth: Array) -> Array:
    return np.stack(
        (np.sin(reach) * np.cos(azimuth), np.sin(reach) * np.sin(azimuth), np.cos(reach)), axis=-1
    )


def _beside(reach: Array, aside: Array | float, beyond: Array | float = 0.0) -> Array:
    """Points `aside` (rad) of the middle of the slot at `reach`, and `beyond` it along the slot."""
    distance = np.hypot(aside, beyond) + 0.0 * reach
    share = np.divide(np.sin(distance), distance, out=np.ones_like(distance), where=distance > 0.0)
    along = np.stack((np.cos(reach), np.zeros_like(reach), -np.sin(reach)), axis=-1)
    middle = _at(reach, np.zeros_like(reach))
    step = np.zeros_like(middle)
    step[:, 1] = aside
    step += np.asarray(beyond + 0.0 * reach)[:, None] * along
    return np.cos(distance)[:, None] * middle + share[:, None] * step
