"""Stress and displacement of every disc at one position."""

from __future__ import annotations

import numpy as np

from trochoid.drives.disc_field import DiscState, Pose, disc_state
from trochoid.drives.khv.bodies import Level
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.series import FAMILIES, solve_at
from trochoid.fem.position import Contact
from trochoid.fem.stress import Press, pressed

__all__ = ["DiscState", "disc_states", "presses"]


def disc_states(design: Design, rung: str, level: Level, angle: float) -> tuple[DiscState, ...]:
    """Solve one position and return every disc's state there."""
    contact = solve_at(design, rung, level.elastic, angle)
    return tuple(_state(design, level, contact, angle, i) for i in range(len(design.discs)))


def _state(design: Design, level: Level, contact: Contact, angle: float, i: int) -> DiscState:
    disc = design.discs[i]
    crank = angle * design.mesh_speed + disc.crank
    turn = -crank / design.flank.lobes + disc.lead
    center = design.flank.eccentricity * np.array([np.cos(crank), np.sin(crank)])
    motion = contact.motion[3 * i : 3 * i + 3]
    pressing = presses(design, contact, i, turn + float(motion[2]))
    return disc_state(level.bodies[disc.body], pressing, Pose(center, turn, disc.z, motion), angle)


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
