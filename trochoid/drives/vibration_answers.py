"""What is said of a casing's vibration: numbers at each point, pictures, checks, the zone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from trochoid.drives.casing import FREE, RIGID_CASING, RIGID_MOUNTS
from trochoid.drives.casing_body import COMPARED, REDUCED
from trochoid.drives.entries import Entries, entry, named
from trochoid.drives.vibration import GENEVA, PRINTED, RIGID, SLOW, UNBALANCED, CasingVibration
from trochoid.drives.vibration_read import Read, frequency, told_frequencies, velocity_at
from trochoid.dynamics.zones import Zone
from trochoid.kinematics.types import IntArray
from trochoid.results.outcome import Check, Parts, Quantity
from trochoid.scene.casing_faults import FREQUENCIES

WORDS = {
    RIGID: "rigid reactions",
    SLOW: "reactions without inertia",
    PRINTED: "printed reactions",
    UNBALANCED: "without counterweight",
    GENEVA: "Geneva wheel in its place, at the same speed of the arm",
    RIGID_CASING: "rigid casing",
    RIGID_MOUNTS: "on rigid mounts",
    FREE: "free casing, without mounts",
}
COMPARISON = (
    "Length of the velocity's amplitudes along x, y and z: with all effects of the scene, and with one of them "
    "changed."
)
EXPLAINED = WORDS | {
    RIGID_CASING: "the casing taken as rigid, with the same mass, on the same mounts",
    RIGID_MOUNTS: "the elastic casing with its sprung feet held still",
    FREE: "the casing without its mounts",
}
BALANCE = 1e-9
Number = Callable[[Read, str, str], Quantity]


def velocity_parts(found: CasingVibration, number: Number, model: str) -> Parts:
    """Return the rms velocity at each point by direction, the worst one, and beside it that without each effect.

    `number(get, unit, model)` makes the answer of a number that `get` reads from a vibration.
    """
    if found.casing.alone:
        number = _without_error(number)
    parts: dict[str, Quantity | Parts] = {}
    for i, point in enumerate(found.elastic.points):
        entries = {axis: number(velocity_at(i, j), "mm/s", model) for j, axis in enumerate("xyz")}
        entries["worst"] = number(velocity_at(i), "mm/s", model)
        for name in found.others:
            said = name if name in (RIGID, PRINTED) else model
            value = number(velocity_at(i, None, name), "mm/s", said)
            entries[f"worst_{name}"] = replace(value, note=EXPLAINED[name])
        parts[point.name] = entries
    if found.casing.elastic:
        count = len(told_frequencies(found))
        number = number if found.casing.compared else _without_error(number)
        parts[FREQUENCIES] = {f"mode_{i + 1}": number(frequency(i), "Hz", "elastic") for i in range(count)}
    return parts


def _without_error(number: Number) -> Number:
    """Return the same maker of answers, that knows no error: one mesh tells none."""

    def made(get: Read, unit: str, model: str) -> Quantity:
        return replace(number(get, unit, model), error=None)

    return made


def casing_note(found: CasingVibration) -> str:
    """Say of an elastic casing where its first elastic mode lies; nothing of a rigid one."""
    if not found.casing.elastic:
        return ""
    hertz = found.casing.frequencies
    said = f"from {hertz[0]:.4g} Hz on" if hertz else f"none up to {COMPARED:g} Hz"
    return f"; elastic casing: modes without mounts {said}"


def casing_checks(found: CasingVibration) -> tuple[Check, ...]:
    """Return what an elastic casing must fulfil: its loads sum to the resultant, its reduction is near the whole."""
    if not found.casing.elastic:
        return ()
    made = [Check.within("loads on the casing's bores sum to their resultant", found.residual, BALANCE)]
    if found.casing.error is not None:
        made.append(
            Check.within(
                "natural frequencies of the reduced casing are the whole's", found.casing.error, REDUCED
            )
        )
    return tuple(made)


def comparison(found: CasingVibration, lines: IntArray | slice = slice(None)) -> Entries:
    """Return the vector amplitudes of the velocity with all effects and without each, a figure for each point.

    The entries have the dimensions "frequency", of which `lines` are shown, and "variant", which is among them.
    """
    compared = [found.elastic, *found.others.values()]
    words = ("with all effects", *(WORDS[name] for name in found.others))
    made: Entries = {"variant": named("variant", words, "what the vibration is without")}
    for i, point in enumerate(found.elastic.points):
        size = np.stack(
            [np.linalg.norm(np.abs(each.velocity[i]), axis=0)[lines] for each in compared], axis=1
        )
        made[f"vibration_compared_{i + 1}"] = entry(
            ("frequency", "variant"),
            size,
            "m/s",
            f"velocity, {point.name}",
            f"{point.name[:1].upper()}{point.name[1:]}: velocity by effect",
            scale="log",
            caption=COMPARISON,
        )
    return made


def zone_answer(found: Zone) -> Quantity:
    """Zone by the standard that applies, or the statement that none does."""
    return Quantity(found.letter or "none applies", "", None, found.standard, note=found.reason)
