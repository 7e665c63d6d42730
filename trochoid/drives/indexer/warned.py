"""What a reader must know of a march before trusting its numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from trochoid.drives.indexer.shaken import HELD, STIFF, Shaken
from trochoid.drives.indexer.words import NAMES
from trochoid.kinematics.readable import readable

WIDE = 0.2  # of the pin's radius, half width of a contact up to which it is Hertz's
LEFT = 0.01  # of the amplitude, left when the next index starts


def march_warnings(found: Mapping[str, Shaken]) -> list[str]:
    """Return where an index does not start as it is computed, and where a stiff shaft counts as rigid."""
    names: dict[str, list[str]] = {}
    for name, x in found.items():
        for said in (*_start(x), *_shaft(x), *_wide(x)):
            names.setdefault(said, []).append(NAMES[name])
    return [f"{', '.join(named)}: {said}" for said, named in names.items()]


def _start(x: Shaken) -> Iterator[str]:
    if x.held:
        yield _held(x)
    if x.left > LEFT:
        yield (
            f"{readable(100.0 * x.left, 2)} % of the residual vibration are left when the next index starts; each "
            "index is computed from rest"
        )


def _held(x: Shaken) -> str:
    """Say how far friction holds the output off, what that makes of the next index, and what would serve."""
    swing = x.pair.forces.indexer.swing
    what = "holds the output off its stop" if x.moves else "holds the output, which never moves, off its stop"
    springs = [each for each in (x.output.shaft, x.output.lock) if each > 0.0]
    torque = HELD * swing / sum(1.0 / each for each in springs)
    remedy = f"operation.output_torque {readable(torque)} N*m at most"
    if x.output.shaft > 0.0:
        remedy += f", or drive.output_shaft.stiffness {readable(x.output.friction / (HELD * swing))} N*m/rad at least"
    return (
        f"friction {what} by {readable(math.degrees(abs(x.offset)))}°, {readable(100.0 * x.held)} % of the swing; the "
        "next index starts with springs wound up by that, not from rest without load, as each index is computed: these "
        f"numbers are those of a first index alone; {100.0 * HELD:g} % would be left with {remedy}"
    )


def _shaft(x: Shaken) -> Iterator[str]:
    if 0.0 < x.stiffer < STIFF:
        yield (
            f"the output shaft is {readable(x.stiffer)} times as stiff as pin and slot, its mode too fast to be "
            f"marched: it counts as rigid there, and what it yields, {readable(100.0 / x.stiffer, 2)} % of what they "
            "do, is left out"
        )


def _wide(x: Shaken) -> Iterator[str]:
    """Say where the march alone, by knocks of a pin with play, presses contacts wide; the rigid force is seen to."""
    most = WIDE * x.pair.pin.radius
    if x.peak[0] == 0.0 or float(x.pair.at_largest.half_width.max()) > most:
        return
    wide = float(x.pressed.half_width.max())
    if wide > most:
        yield (
            f"under the largest pin force of the march, {readable(x.peak[0])} N, the contact's half width of "
            f"{readable(1e3 * wide)} mm is no small part of pin_radius = {readable(1e3 * x.pair.pin.radius, 4)} mm: "
            "pressure and stiffness are Hertz's, for narrow contacts"
        )
