"""Answers about bearings, their reactions, and the casing's vibration."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.entries import STIFFNESS_ENTRIES
from trochoid.drives.khv.numbers import number, over_turn
from trochoid.drives.khv.reactions import Reactions
from trochoid.drives.khv.series import Series
from trochoid.drives.khv.stages import Stages
from trochoid.drives.khv.vibration import CasingVibration
from trochoid.drives.mesh_error import Pair
from trochoid.drives.vibration_answers import casing_note, velocity_parts, zone_answer
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Parts, Quantity

if TYPE_CHECKING:
    from trochoid.drives.khv.modes import NaturalModes

STATISTICS: dict[str, Callable[[Array], float]] = {
    "mean": lambda a: float(a.mean()),
    "min": lambda a: float(a.min()),
    "max": lambda a: float(a.max()),
}


def bearing_loads(s: Stages) -> Quantity:
    """Load of each eccentric bearing over a turn, and of the most loaded roller."""
    parts: dict[str, Quantity] = {}
    for i in range(len(s.design.discs)):
        load = Pair(s.contact.fine, s.contact.coarse).map(_eccentric_load(s, i))
        for name in ("mean", "max"):
            parts[f"eccentric_{i + 1}_{name}"] = number(s, load.map(STATISTICS[name]), "N")
    if s.contact.fine.bearing is not None:
        parts["roller_max"] = over_turn(
            s, lambda x: 0.0 if x.bearing is None else float(x.bearing.force.max()), "N"
        )
    return Quantity(parts=parts)


def _eccentric_load(s: Stages, i: int) -> Callable[[Series], Array]:
    """Return the force (n,) of disc i on its eccentric: what ring, output pins and inertia leave."""
    from trochoid.drives.khv.contact import centrifugal

    def load(series: Series) -> Array:
        inertia = centrifugal(s.design, series.crank)[:, i]
        rest = inertia - series.ring.resultant[:, i] - series.output.resultant[:, i]
        return np.asarray(np.linalg.norm(rest[:-1], axis=-1))

    return load


def bearing_stiffness(s: Stages) -> Quantity:
    """Stiffness of the first eccentric bearing under its load, on a rigid ring and on the disc's elastic bore."""
    parts: dict[str, Quantity | Parts] = {"rigid_ring": _entries(s, s.bearing.map(lambda x: x.rigid))}
    if s.bearing.fine.elastic is not None:
        parts["elastic_seat"] = _entries(
            s, s.bearing.map(lambda x: x.rigid if x.elastic is None else x.elastic)
        )
    from trochoid.drives.khv.answers_bearings import rigid_ring, supports

    note = "first disc at the first position; rollers by ISO/TS 16281"
    if s.rolling:
        note += "; of shaft and flange over a turn, ± what the loads of elastic discs would change"
    return Quantity(parts={**parts, **rigid_ring(s), **supports(s)}, note=note)


def _entries(s: Stages, matrix: Pair[Array]) -> Mapping[str, Quantity]:
    def entry(ij: tuple[int, int], scale: float) -> Callable[[Array], float]:
        return lambda k: scale * float(k[ij])

    return {
        name: number(s, matrix.map(entry(ij, scale)), unit) for name, ij, scale, unit in STIFFNESS_ENTRIES
    }


def reactions(s: Stages) -> Quantity:
    """Reactions of the bearings of shaft and flange over a turn, by model."""
    parts: dict[str, Mapping[str, Quantity]] = {}
    for model in ("rigid", "elastic"):
        if getattr(s.reactions.fine, model) is None:
            continue
        for member in ("shaft", "output"):
            for b, place in enumerate("AB"):
                size = s.reactions.map(_size(model, member, b))
                parts[f"{member}_{place}_{model}"] = {
                    name: number(s, size.map(statistic), "N", model) for name, statistic in STATISTICS.items()
                }
    return Quantity(parts=parts, note=s.reactions.fine.reason)


def _size(model: str, member: str, bearing: int) -> Callable[[Reactions], Array]:
    def size(found: Reactions) -> Array:
        forces = getattr(found, model) or found.rigid  # a coarser mesh may find the drive free
        return np.asarray(np.linalg.norm(forces[member][:, bearing], axis=-1))

    return size


def natural_frequencies(s: Stages) -> Quantity:
    """Natural frequencies by rising frequency, who moves in each; free motions are counted."""
    from trochoid.drives.khv.modes import near

    found = s.modes.fine
    parts: dict[str, Quantity] = {}
    for i, mode in enumerate(found.modes):
        value = number(s, s.modes.map(_frequency(i)), "Hz")
        parts[f"mode_{i + 1}"] = replace(value, note=mode.words)
    said = [
        "undamped, as the fixed frame hears them, with the mean stiffness that the turning eccentric sees, which "
        f"departs from it by up to {100.0 * found.stiffness_variation:.2g} %"
    ]
    if found.free:
        said.append(f"{found.free} motions are free within their play")
    return Quantity(parts=parts, note="; ".join([*said, *near(s.design, found.modes)]))


def _frequency(i: int) -> Callable[[NaturalModes], float]:
    def get(found: NaturalModes) -> float:
        return found.modes[
            min(i, len(found.modes) - 1)
        ].frequency  # a coarser mesh may leave more of them free

    return get


def vibration_velocity(s: Stages) -> Quantity:
    """Velocity of the casing, rms 10–1000 Hz, at each point by direction; without each effect the worst beside it."""
    found = s.vibration

    def made(get: Callable[[CasingVibration], float], unit: str, model: str) -> Quantity:
        return number(s, found.map(get), unit, model)

    best = "rigid" if s.reactions.fine.response is None else "elastic"
    said = f"lines up to {found.fine.elastic.resolved_to:.0f} Hz are resolved{casing_note(found.fine)}"
    return Quantity(parts=velocity_parts(found.fine, made, best), note=said)


def vibration_zone(s: Stages) -> Quantity:
    """Zone by the standard that applies, or the statement that none does."""
    return zone_answer(s.vibration.fine.zone)
