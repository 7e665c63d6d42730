"""Answers about rolling bearings: how wrong a rigid ring is at the eccentric; shaft and flange; safety and life."""

from __future__ import annotations

import numpy as np

from trochoid.drives.khv.bearings import TABLES, turning
from trochoid.drives.khv.numbers import number
from trochoid.drives.khv.seat import SeatStiffness
from trochoid.drives.khv.series import Series
from trochoid.drives.khv.stages import Stages
from trochoid.drives.mesh_error import Pair
from trochoid.drives.rolling import Held, rollers_under
from trochoid.drives.rolling_answers import life_parts, noted, stiffness_parts, with_errors
from trochoid.results.outcome import Parts, Quantity

NAMES = {"shaft": "input_shaft", "output": "output_flange"}


def rigid_ring(s: Stages) -> dict[str, Quantity]:
    """Return how much stiffer along its load the eccentric bearing is on a rigid ring than on the disc's bore."""
    if s.bearing.fine.elastic is None:
        return {}
    series = s.contact.fine
    push = -(series.ring.resultant[0, 0] + series.output.resultant[0, 0])

    def wrong(found: SeatStiffness) -> float:
        soft = found.rigid if found.elastic is None else found.elastic
        hard, yielding = (float(push @ k[:2, :2] @ push) for k in (found.rigid, soft))
        return 100.0 * (hard / yielding - 1.0) if yielding > 0.0 else float("nan")

    pair: Pair[float] = s.bearing.map(wrong)
    return {"rigid_ring_over_flexible": number(s, pair, "%")} if np.isfinite(pair.fine) else {}


def supports(s: Stages) -> dict[str, Parts]:
    """Return the stiffness of the rolling bearings of shaft and flange, by place."""
    parts: dict[str, Parts] = {}
    for member, pair in s.rolling.items():
        used = s.design.supports[member]
        for place, now, k in zip("AB", pair, used, strict=True):
            given = getattr(s.design.drive, TABLES[member]).bearing_stiffness is not None
            off = None if given else abs(now.radial / k - 1.0)
            parts[f"{NAMES[member]}_{place}"] = noted(stiffness_parts(now, off), now)
    return parts


def bearing_life(s: Stages) -> Quantity:
    """Safety and life of the eccentric bearings by their rollers' loads in elastic bores, and of shaft and flange."""
    parts: dict[str, Quantity | Parts] = {}
    speed = s.design.mesh_speed * s.design.crank_speed * (1.0 + 1.0 / s.design.flank.lobes)
    both = Pair(s.contact.fine, s.contact.coarse)
    for i in range(len(s.design.discs)):
        levels = both.map(lambda x, i=i: life_parts(_eccentric(s, x, i), speed, inner_turns=False))  # type: ignore[misc]
        parts[f"eccentric_{i + 1}"] = with_errors(levels, s.difference)
    for member, pair in s.rolling.items():
        inner, outer = turning(s.design, member)
        for place, found in zip("AB", pair, strict=True):
            # the shaft's load goes round with it; what comes through the pins stands still as the flange turns
            lives = life_parts(found, inner - outer, inner_turns=member == "output")
            parts[f"{NAMES[member]}_{place}"] = lives
    note = (
        "over a turn; the eccentric's rollers as they share the load in the disc's bore, shaft and flange on rigid "
        "rings; L10r by ISO/TS 16281, a_ISO where lubrication is given"
    )
    return Quantity(parts=parts, note=note)


def _eccentric(s: Stages, series: Series, disc: int) -> Held:
    """Return the eccentric bearing of a disc under the roller loads of a turn."""
    from trochoid.fem.rolling_roller import RollerRow
    from trochoid.scene.rolling import RollingTable

    assert series.bearing is not None
    table = s.design.drive.eccentric_bearing
    diameter, pitch = 2.0 * table.roller_radius, 2.0 * s.design.pitch_radius
    row = RollerRow(
        table.rollers, diameter, pitch, table.roller_length, clearance=2.0 * s.design.bearing_play
    )
    forces = series.bearing.force[:-1, disc]
    return Held(RollingTable(), rollers_under(row, forces, series.bearing.resultant[:-1, disc]), None)
