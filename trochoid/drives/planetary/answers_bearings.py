"""Answers about the rolling bearings of the planets: stiffness under a planet's force, safety and life."""

from __future__ import annotations

import numpy as np

from trochoid.drives.planetary.bearings import ring_speeds
from trochoid.drives.planetary.stages import Stages
from trochoid.drives.rolling_answers import life_parts, noted, stiffness_parts
from trochoid.results.outcome import Parts, Quantity


def bearing_stiffness(s: Stages) -> Quantity:
    """Stiffness of the bearings that members float on; that of a rolling one along and across the planet's force."""
    d, seat = s.feasible.drive, s.feasible.planet_seat
    parts: dict[str, Quantity | Parts] = {
        name: Quantity(1e-6 * getattr(d, name).bearing_stiffness, "N/um", None, "given")
        for name in ("sun", "ring", "carrier")
    }
    note = "as given; sun, ring and carrier carry only what unequal planets leave"
    if d.planet.bearing_stiffness is not None:
        parts["planet"] = Quantity(1e-6 * d.planet.bearing_stiffness, "N/um", None, "given")
    if seat is None:
        return Quantity(parts=parts, note=note)
    off = max(abs(each.radial / seat.bearing.radial - 1.0) for each in s.rolling)
    (outward, coupling), (_, along_orbit) = seat.stiffness
    model = "ISO/TS 16281"
    parts["planet_rolling"] = {
        **noted(stiffness_parts(seat.bearing, off), seat.bearing),
        "outward": Quantity(1e-6 * float(outward), "N/um", None, model),
        "along_the_orbit": Quantity(1e-6 * float(along_orbit), "N/um", None, model),
        "coupling": Quantity(1e-6 * float(coupling), "N/um", None, model),
    }
    note = "the planet's under its nominal force; x outward, y along the orbit; ± what forces over a pitch would change"
    return Quantity(parts=parts, note=note)


def bearing_life(s: Stages) -> Quantity:
    """Safety and life of the planets' rolling bearings under their forces over a pitch."""
    inner, outer = ring_speeds(s.feasible)
    parts: dict[str, Quantity | Parts] = {}
    if all(np.allclose(s.rolling[0].duty.loads, each.duty.loads, rtol=1e-9) for each in s.rolling):
        parts["each_planet"] = life_parts(s.rolling[0], inner - outer, inner_turns=False)
    else:
        for i, each in enumerate(s.rolling, 1):
            parts[f"planet_{i}"] = life_parts(each, inner - outer, inner_turns=False)
    return Quantity(
        parts=parts, note="forces over a pitch, which stand still in the carrier's frame; on rigid rings"
    )
