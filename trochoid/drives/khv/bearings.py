"""The bearings of shaft and flange: stiffnesses as given, or those of rolling bearings under what they carry.

Loads and stiffnesses follow from each other. Here the discs are rigid on springs, which hardly changes what they pass
on; how far the loads of the elastic discs are from that is told with the answers.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.khv.contact import assembly, layout
from trochoid.drives.rolling import SETTLED, STEPS, Held, held
from trochoid.drives.rolling_seat import seat_levels
from trochoid.fem.position import solve_positions
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    from trochoid.drives.khv.design import Design
    from trochoid.drives.khv.series import Series
    from trochoid.drives.rolling_seat import SeatLevels

TABLES = {"shaft": "input_shaft", "output": "output_flange"}  # member -> its table
POSITIONS = 12  # over a turn of the input
FIRST = 3e8  # N/m: where loads and stiffnesses start from
ABOUT = 100.0 * SETTLED  # relative change at which they agree


@dataclass(frozen=True, eq=False, slots=True)
class Bearings:
    """Radial stiffness N/m of the bearings A and B of shaft and flange, and the rolling ones by member."""

    stiffness: dict[str, tuple[float, float]]
    rolling: dict[str, tuple[Held, Held]]


def given(design: Design) -> dict[str, tuple[float, float] | None]:
    """Return the stiffnesses that the scene gives, None where a rolling bearing has to tell."""
    found: dict[str, tuple[float, float] | None] = {}
    for member, name in TABLES.items():
        value = getattr(design.drive, name).bearing_stiffness
        found[member] = None if value is None else (value, value)
    return found


def bearings(design: Design) -> Bearings:
    """Return the bearings under their loads over a turn; raises Infeasible for one that resists nothing."""
    known = given(design)
    seats = {
        member: seat_levels(table, design.scene.materials)
        for member, name in TABLES.items()
        if (table := getattr(design.drive, name).bearing) is not None
    }
    stiffness = {member: value or (FIRST, FIRST) for member, value in known.items()}
    crank = 2.0 * np.pi * np.arange(POSITIONS) / POSITIONS * design.mesh_speed
    motions, change = layout(design, "springs"), np.inf
    for _ in range(STEPS):
        trial = replace(design, supported=stiffness)
        motion = solve_positions(assembly(trial, "springs", (), crank), resolve=False).motion
        rolling = {m: _member(trial, motions.names, motion, m, seat) for m, seat in seats.items()}
        new = stiffness | {
            m: (pair[0].radial, pair[1].radial) for m, pair in rolling.items() if known[m] is None
        }
        change = max(abs(a / b - 1.0) for m in new for a, b in zip(stiffness[m], new[m], strict=True))
        stiffness = new
        if change <= ABOUT:
            return Bearings(stiffness, rolling)
    raise NotConverged(
        f"bearings of shaft and flange: stiffness and load still change each other by {change:.1e} after {STEPS} "
        f"steps; give the bearings' radial_load, or smaller clearances"
    )


def loads(design: Design, names: tuple[str, ...], motion: Array, member: str) -> Array:
    """Return the forces (2, n, 2) of a member on its bearings A and B at motions (n, k), N."""
    from trochoid.drives.khv.contact import Layout

    rows = Layout(names, True, True)
    table = getattr(design.drive, TABLES[member])
    return np.stack(
        [
            k * motion @ rows.rows(member, z)[:2].T
            for z, k in zip(table.bearing_positions, design.supports[member], strict=True)
        ]
    )


def _member(
    design: Design, names: tuple[str, ...], motion: Array, member: str, seat: SeatLevels | None
) -> tuple[Held, Held]:
    table = getattr(design.drive, TABLES[member]).bearing
    one, two = (
        held(f"drive.{TABLES[member]}.bearing, {place}", table, force, seat, turning(design, member))
        for place, force in zip("AB", loads(design, names, motion, member), strict=True)
    )
    return one, two


def turning(design: Design, member: str) -> tuple[float, float]:
    """Return the speeds (rad/s) of the inner and the outer ring of a member's bearings."""
    name = "input" if member == "shaft" else "output"
    return float(design.speeds.members[name]) * design.crank_speed, 0.0


def under(design: Design, series: Series) -> dict[str, tuple[Held, Held]]:
    """Return the rolling bearings under the loads of solved contacts over a turn."""
    found = {}
    for member, pair in design.bearings.rolling.items():
        now = _member(design, series.names, series.motion[:-1], member, None)
        found[member] = (replace(now[0], seat=pair[0].seat), replace(now[1], seat=pair[1].seat))
    return found
