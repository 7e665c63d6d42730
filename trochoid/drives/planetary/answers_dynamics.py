"""Answers about the set that moves: reactions, natural frequencies, the casing's vibration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.planetary.answers_contact import number
from trochoid.drives.planetary.moving import MAIN
from trochoid.drives.planetary.reactions import Reactions, explain
from trochoid.drives.planetary.stages import Stages
from trochoid.drives.vibration_answers import casing_note, velocity_parts, zone_answer
from trochoid.dynamics.spectrum import harmonics
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Parts, Quantity

if TYPE_CHECKING:
    from trochoid.drives.planetary.modes import SetModes
    from trochoid.drives.vibration import CasingVibration

LINES = ("at_mesh_frequency", "at_harmonic_2", "at_harmonic_3")
READ = {
    "mean": lambda a: float(a.mean()),
    "largest": lambda a: float(a.max()),
    "peak_to_peak": lambda a: float(np.ptp(a)),
}


def elastic_reactions(s: Stages, rigid: Quantity) -> Quantity:
    """Reactions of rigid members, and of elastic ones whose inertia acts back, over a pitch of the meshes."""
    parts: dict[str, Quantity | Parts] = {name: _member(s, name) for name in MAIN}
    parts["planet_bearing"] = _force(s, lambda x: x.bearing)
    for i, name in enumerate(("sun_and_planet", "planet_and_ring")):
        parts[name] = _mesh(s, i)
    note = f"rigid: members rigid, planets alike; elastic: with their inertia; {explain(s.reactions.fine)}"
    return Quantity(parts={"rigid": dict(rigid.parts or {}), "elastic": parts}, note=note)


def _over(s: Stages, get: Callable[[Reactions], float], unit: str) -> Quantity:
    return replace(number(s, s.reactions.map(get), unit), model="elastic")


def _member(s: Stages, name: str) -> Parts:
    torque: dict[str, Quantity] = {
        said: _over(s, lambda x, read=read: read(x.torque[name]), "N*m")  # type: ignore[misc]
        for said, read in READ.items()
        if said != "largest"
    }
    torque["peak_to_peak_without_inertia"] = _over(s, lambda x: float(np.ptp(x.static_torque[name])), "N*m")
    torque |= _lines(s, lambda x: x.torque[name][:, None], "N*m")
    return {"torque": torque, "bearing_force": _force(s, lambda x: x.force[name][:, None])}


def _force(s: Stages, get: Callable[[Reactions], Array]) -> Parts:
    """Return mean and largest size of forces (n, m, 2), and the largest amplitude of their vectors at harmonics."""
    made = {
        said: _over(s, lambda x, read=READ[said]: read(np.linalg.norm(get(x), axis=-1)), "N")  # type: ignore[misc]
        for said in ("mean", "largest")
    }
    return made | _lines(s, get, "N")


def _lines(s: Stages, get: Callable[[Reactions], Array], unit: str) -> dict[str, Quantity]:
    resolved = (s.scene.ask.positions - 1) // 2

    def amplitude(h: int) -> Callable[[Reactions], float]:
        def of(x: Reactions) -> float:
            line = np.abs(harmonics(get(x))[h])
            return float((np.linalg.norm(line, axis=-1) if line.ndim > 1 else line).max())

        return of

    return {name: _over(s, amplitude(h), unit) for h, name in enumerate(LINES, 1) if h <= resolved}


def _mesh(s: Stages, i: int) -> Parts:
    return {
        "mean": _over(s, lambda x: float(x.mesh[:, i].mean()), "N"),
        "largest": _over(s, lambda x: float(x.mesh[:, i].max()), "N"),
        "least": _over(s, lambda x: float(x.mesh[:, i].min()), "N"),
        "over_largest_without_inertia": _over(
            s, lambda x: float(x.mesh[:, i].max() / x.static_mesh[:, i].max()), ""
        ),
    }


def natural_frequencies(s: Stages) -> Quantity:
    """Natural frequencies by rising frequency, what kind each mode is and who moves in it."""
    from trochoid.drives.planetary.modes import near

    found = s.modes.fine
    parts: dict[str, Quantity] = {}
    for i, mode in enumerate(found.modes):
        value = number(s, s.modes.map(_frequency(i)), "Hz")
        parts[f"mode_{i + 1}"] = replace(value, note=mode.words)
    mesh = s.moving.fine.speed / (2.0 * np.pi)
    said = [
        f"undamped, input held, seen from the carrier; mean stiffness over a pitch, which departs from it by up to "
        f"{100.0 * found.variation:.2g} %; mesh frequency {mesh:.4g} Hz"
    ]
    if found.free:
        said.append(f"{found.free} motions have no frequency")
    return Quantity(parts=parts, note="; ".join([*said, *near(s.moving.fine, found.modes)]))


def _frequency(i: int) -> Callable[[SetModes], float]:
    def get(found: SetModes) -> float:
        return found.modes[
            min(i, len(found.modes) - 1)
        ].frequency  # a coarser mesh may leave more of them free

    return get


def vibration_velocity(s: Stages) -> Quantity:
    """Velocity of the casing, rms 10–1000 Hz, at each point by direction; without each effect the worst beside it."""
    found = s.vibration

    def made(get: Callable[[CasingVibration], float], unit: str, model: str) -> Quantity:
        return replace(number(s, found.map(get), unit), model=model)

    resolved = found.fine.elastic.resolved_to
    return Quantity(
        parts=velocity_parts(found.fine, made, "elastic"),
        note=(
            f"lines up to {resolved:.0f} Hz are resolved; rigid members press evenly and shake nothing"
            f"{casing_note(found.fine)}"
        ),
    )


def vibration_zone(s: Stages) -> Quantity:
    """Zone by the standard that applies, or the statement that none does."""
    return zone_answer(s.vibration.fine.zone)
