"""Stress and displacement of cycloid discs at one position, whatever drive they are in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.fem.body import Body
from trochoid.fem.pair import rotation
from trochoid.fem.stress import Press
from trochoid.fem.stress_field import StressField, stress_field
from trochoid.kinematics.types import Array, frozen
from trochoid.results.film import Field


@dataclass(frozen=True, slots=True)
class DiscState:
    """One disc at one input angle: its stress field in its own frame, and its place.

    `points` (n, 3) unloaded nodes in the frame of the contacts, `displacement` (n, 2) from there: elastic and rigid
    motion together; `turn` angle of the body's frame.
    """

    angle: float
    field: StressField
    points: Array
    displacement: Array
    turn: float


@dataclass(frozen=True, slots=True)
class Pose:
    """Where a disc is: `center` (2,) and axial place `z` in m, `turn` of the body's frame in rad; `motion` (3,) is its
    elastic x, y (m) and rotation (rad) from there.
    """

    center: Array
    turn: float
    z: float
    motion: Array


def disc_state(body: Body, presses: Sequence[Press], pose: Pose, angle: float) -> DiscState:
    """Return the state of a disc under contacts that are given in its own frame, at an input angle in rad."""
    field = stress_field(body, presses)
    turned = rotation(pose.turn)
    points = field.points @ turned.T + pose.center
    offset = points - pose.center
    x, y, spin = pose.motion
    rigid = np.array([x, y]) + spin * np.stack([-offset[:, 1], offset[:, 0]], axis=-1)
    placed = np.column_stack([points, np.full(len(points), pose.z)])
    return DiscState(angle, field, frozen(placed), frozen(field.displacement @ turned.T + rigid), pose.turn)


def disc_field(name: str, state: DiscState, turn: float) -> Field:
    """Return a disc's displacement and stress at its axial place; `turn` (rad) of the contacts' frame."""
    points = np.column_stack([turned(state.points[:, :2], turn), state.points[:, 2]])
    data = {
        "displacement": frozen(turned(state.displacement, turn)),
        "stress": frozen(turned_stress(state.field.stress, state.turn + turn)),
        "von_mises": state.field.von_mises,
        "max_shear": state.field.max_shear,
    }
    return Field(name, frozen(points), state.field.triangles, data)


def turned(vectors: Array, angle: float) -> Array:
    """Turn plane vectors (..., 2) by an angle in rad."""
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(vectors @ np.array([[c, s], [-s, c]]))


def turned_stress(stress: Array, angle: float) -> Array:
    """Return stress (n, 4) xx, yy, zz, xy of a body turned by an angle (rad) in the axes that it is turned from."""
    xx, yy, zz, xy = stress.T
    c, s = np.cos(angle), np.sin(angle)
    x = c * c * xx + s * s * yy - 2 * c * s * xy
    y = s * s * xx + c * c * yy + 2 * c * s * xy
    return np.column_stack([x, y, zz, c * s * (xx - yy) + (c * c - s * s) * xy])
