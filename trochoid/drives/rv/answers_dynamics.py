"""Answers about the reactions of all bearings over a turn of the crankshafts, and the casing's vibration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.rv.numbers import number
from trochoid.drives.rv.reactions import Forces, Reactions
from trochoid.drives.rv.spectrum import force_lines, order_of
from trochoid.drives.rv.stages import Stages
from trochoid.drives.vibration import CasingVibration
from trochoid.drives.vibration_answers import casing_note, velocity_parts, zone_answer
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Parts, Quantity

if TYPE_CHECKING:
    from trochoid.drives.rv.modes import NaturalModes

# forces (n, m, 2) of one kind of bearing, m alike
BEARINGS: dict[str, Callable[[Forces], Array]] = {
    "crank_A": lambda x: x.crank[:, :, 0],
    "crank_B": lambda x: x.crank[:, :, 1],
    "arm": lambda x: x.arm.reshape(len(x.arm), -1, 2),
    "main_A": lambda x: x.main[:, 0, None],
    "main_B": lambda x: x.main[:, 1, None],
}
STATISTICS: dict[str, Callable[[Array], float]] = {
    "mean": lambda a: float(a.mean()),
    "min": lambda a: float(a.min()),
    "max": lambda a: float(a.max()),
}


def reactions(s: Stages) -> Quantity:
    """Forces in the bearings of crankshafts, discs and carrier over a turn of the crankshafts, by model."""
    parts: dict[str, Parts] = {}
    found = s.reactions
    speed = s.scene.operation.input_speed / (2 * np.pi)
    for model in ("rigid", "elastic"):
        if getattr(found, model) is None:
            continue
        for name, get in BEARINGS.items():
            line = int(force_lines(get(_forces(found, model)))[1:].argmax()) + 1
            order = line * order_of(s.design)
            parts[f"{name}_{model}"] = {
                **{
                    key: _number(s, _of(model, get, statistic), "N", model)
                    for key, statistic in STATISTICS.items()
                },
                "largest_line": _number(s, _line(model, get, line), "N", model),
                **(
                    {}
                    if model == "rigid"
                    else {"change_max": Quantity(_change(found, get), "N", None, model)}
                ),
                "largest_line_order": Quantity(order, "", None, "exact"),
                "largest_line_frequency": Quantity(order * speed, "Hz", None, "exact"),
            }
    note = "over all bearings of a kind, A at the lower z; lines in the carrier's frame, orders of the input speed"
    if found.elastic is not None:
        reach = order_of(s.design) * speed * ((len(found.angle) - 1) // 2)
        note += f"; change_max holds lines up to {reach:.0f} Hz, more positions add more"
    return Quantity(parts=parts, note=f"{note}; {found.reason}")


def _forces(found: Reactions, model: str) -> Forces:
    """Return the forces of a model; rigid ones where a coarser mesh finds the drive free."""
    forces: Forces | None = getattr(found, model)
    return found.rigid if forces is None else forces


def _of(
    model: str, get: Callable[[Forces], Array], statistic: Callable[[Array], float]
) -> Callable[[Reactions], float]:
    return lambda found: statistic(np.linalg.norm(get(_forces(found, model)), axis=-1))


def _change(found: Reactions, get: Callable[[Forces], Array]) -> float:
    """Return the largest vector difference of elastic and rigid forces; its error is that of the lines left out."""
    return float(np.linalg.norm(get(_forces(found, "elastic")) - get(found.rigid), axis=-1).max())


def _line(model: str, get: Callable[[Forces], Array], line: int) -> Callable[[Reactions], float]:
    def amplitude(found: Reactions) -> float:
        lines = force_lines(get(_forces(found, model)))
        return float(lines[line]) if line < len(lines) else 0.0

    return amplitude


def _number(s: Stages, get: Callable[[Reactions], float], unit: str, model: str) -> Quantity:
    return number(s, get(s.reactions), s.reaction_levels.map(get), unit, model)


def natural_frequencies(s: Stages) -> Quantity:
    """Natural frequencies by rising frequency, means over the turn, who moves in each, least and largest."""
    from trochoid.drives.rv.modes import near

    found = s.modes
    parts: dict[str, Quantity] = {}
    for i, mode in enumerate(found.modes):
        value = number(s, mode.frequency, s.mode_levels.map(_frequency(i)), "Hz")
        over = f"{found.lowest[i]:.5g} to {found.highest[i]:.5g} Hz over the turn"
        parts[f"mode_{i + 1}"] = replace(value, note=f"{mode.words}; {over}")
    said = [
        "undamped, input held, seen from the carrier; mean of those at rest at every place of a turn of the crankshafts"
    ]
    if found.free:
        said.append(f"{found.free} motions are free within their play")
    return Quantity(parts=parts, note="; ".join([*said, *near(s.design, found)]))


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
        return number(s, get(found), s.vibration_levels.map(get), unit, model)

    best = "rigid" if s.reactions.response is None else "elastic"
    said = f"lines up to {found.elastic.resolved_to:.0f} Hz are resolved{casing_note(found)}"
    return Quantity(parts=velocity_parts(found, made, best), note=said)


def vibration_zone(s: Stages) -> Quantity:
    """Zone by the standard that applies, or the statement that none does."""
    return zone_answer(s.vibration.zone)
