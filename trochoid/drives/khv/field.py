"""Stress and displacement of every disc at one position."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.bodies import Level
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.series import FAMILIES, solve_at
from trochoid.fem.pair import rotation
from trochoid.fem.position import Contact
from trochoid.fem.stress import Press, pressed
from trochoid.fem.stress_field import StressField, stress_field
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, slots=True)
class DiscState:
    """One disc at one input angle: its stress field in its own frame, and its place.

    `points` (n, 3) unloaded nodes in the ring's frame, `displacement` (n, 2) from there: elastic and rigid
    motion together; `turn` angle of the body's frame.
    """

    angle: float
    field: StressField
    points: Array
    displacement: Array
    turn: float


def disc_states(design: Design, rung: str, level: Level, angle: float) -> tuple[DiscState, ...]:
    """Solve one position and return every disc's state there."""
    contact = solve_at(design, rung, level.elastic, angle)
    return tuple(_state(design, level, contact, angle, i) for i in range(len(design.discs)))


def _state(design: Design, level: Level, contact: Contact, angle: float, i: int) -> DiscState:
    disc = design.discs[i]
    crank = angle * design.mesh_speed + disc.crank
    turn = -crank / design.flank.lobes + disc.lead
    center = design.flank.eccentricity * np.array([np.cos(crank), np.sin(crank)])
    field = stress_field(
        level.bodies[disc.body], presses(design, contact, i, turn + float(contact.motion[3 * i + 2]))
    )
    turned = rotation(turn)
    points = field.points @ turned.T + center
    offset = points - center
    x, y, spin = contact.motion[3 * i : 3 * i + 3]
    rigid = np.array([x, y]) + spin * np.stack([-offset[:, 1], offset[:, 0]], axis=-1)
    placed = np.column_stack([points, np.full(len(points), disc.z)])
    return DiscState(angle, field, frozen(placed), frozen(field.displacement @ turned.T + rigid), turn)


def presses(design: Design, contact: Contact, i: int, turn: float) -> list[Press]:
    """Return all contacts of disc i as line loads in its own frame."""
    pins, first = design.drive.output_pins.count, design.discs[i].first_hole
    found = []
    for kind in FAMILIES:
        touch = contact.touches[f"{kind}{i}"]
        holes = [f"hole{(j + first) % pins}" for j in range(len(touch.force))]
        edges = {"ring": ["flank"] * len(holes), "bearing": ["bore"] * len(holes)}.get(kind, holes)
        found += pressed(touch, edges, turn, design.drive.face_width)
    return found
