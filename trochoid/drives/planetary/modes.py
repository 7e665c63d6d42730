"""Natural frequencies of a set, each mode named by its kind: rotational, translational, or one of the planets.

With planets alike and evenly spaced, a mode is one of three (Lin and Parker): main members turn and planets all move
alike; main members shift, in pairs of one frequency when the carrier stands still; or planets move against each other
and the main members stay. The kinds are told by the harmonic of the motion over the planets, which holds for any set:
where planets are unlike, modes are mixed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.modes import CLOSE, Mode, campbell_plot, shares
from trochoid.drives.planetary.moving import MAIN, Moving
from trochoid.dynamics.elastic import departure
from trochoid.dynamics.system import System
from trochoid.dynamics.whirl import whirl
from trochoid.kinematics.types import Array, ComplexArray, frozen
from trochoid.results.plot import Plot

KINDS = ("rotational", "translational", "planets")
PURE = 0.9  # share of the energy from which a mode is of one kind
SPEEDS = 25
ORDERS = 3  # harmonics of the mesh frequency that are looked at


@dataclass(frozen=True, slots=True)
class SetModes:
    """Modes at the speed of operation by rising frequency, and the energy's `kinds` (modes, 3) of each; `free` have no
    stiffness. `variation`: the largest departure of the stiffness from its mean over a pitch, relative. `shapes`
    (k, modes) on the free motions.
    """

    modes: tuple[Mode, ...]
    kinds: Array
    free: int
    variation: float
    shapes: ComplexArray


def assembled(set_: Moving, share: float = 1.0) -> System:
    """Return the undamped system on the free motions, the carrier at a share of its speed."""
    mass, coriolis, centrifugal = set_.inertia()
    stiffness = set_.stiffness().mean(axis=0) + share**2 * centrifugal
    spins = frozen(share * coriolis) if share * coriolis.any() else None
    return System(frozen(mass), frozen(np.zeros_like(mass)), frozen(stiffness), spins, set_.names)


def natural_modes(set_: Moving) -> SetModes:
    """Return the modes on the mean stiffness over a pitch, as seen in the carrier's frame."""
    system = assembled(set_)
    found = whirl(system)
    members = set_.free @ found.shapes
    energy = set_.mass[:, None] * np.abs(members) ** 2
    kinds = kind_shares(set_, members)
    names = [_spoken(name) for name in set_.layout.names]
    modes = tuple(
        Mode(float(f), shares(energy[:, i], names), _kind(kinds[i])) for i, f in enumerate(found.frequency)
    )
    return SetModes(modes, frozen(kinds), system.size - len(modes), departure(set_.stiffness()), found.shapes)


def kind_shares(set_: Moving, members: ComplexArray) -> Array:
    """Return the share (modes, 3) of each kind in the energy of motions of all members (F, modes)."""
    names, count = set_.layout.names, (len(set_.layout.names) - 9) // 3
    energy = set_.mass[:, None] * np.abs(members) ** 2
    turns = sum(energy[names.index(f"{m}.rotation")] for m in MAIN)
    shifts = sum(energy[names.index(f"{m}.{axis}")] for m in MAIN for axis in "xy")
    first = names.index("planet0.x")
    angle = 2.0 * np.pi * np.arange(count)[:, None] / count
    x, y, turn = (members[first + axis :: 3][:count] for axis in range(3))
    c, s = np.cos(angle), np.sin(angle)
    lines = np.stack([c * x + s * y, c * y - s * x, turn])  # radial, along the orbit, rotation
    weight = set_.mass[first : first + 3][:, None, None]
    over = (weight * np.abs(np.fft.fft(lines, axis=1)) ** 2 / count).sum(axis=0)  # (harmonic, modes)
    once = {1 % count, -1 % count} - {0}
    parts = np.stack(
        [
            turns + over[0],
            shifts + sum((over[h] for h in once), np.zeros(over.shape[1])),
            sum((over[h] for h in range(1, count) if h not in once), np.zeros(over.shape[1])),
        ],
        axis=1,
    )
    return np.asarray(parts / parts.sum(axis=1, keepdims=True))


def _kind(share: Array) -> str:
    best = int(np.argmax(share))
    if share[best] >= PURE:
        return "planet mode" if best == 2 else KINDS[best]
    return "mixed: planets are unlike"


def _spoken(name: str) -> str:
    member, motion = name.split(".")
    if member.startswith("planet"):
        member = "planets"
    return f"{member} {'turning' if motion == 'rotation' else 'across the axis'}"


def near(set_: Moving, modes: tuple[Mode, ...]) -> list[str]:
    """Say which harmonic of the mesh frequency is close to which mode."""
    said = []
    for order in range(1, ORDERS + 1):
        heard = order * set_.speed / (2.0 * np.pi)
        for i, mode in enumerate(modes, 1):
            if abs(heard / mode.frequency - 1.0) < CLOSE:
                name = "mesh frequency" if order == 1 else f"harmonic {order} of the mesh frequency"
                said.append(f"{name} ({heard:.4g} Hz) near mode {i} ({mode.frequency:.4g} Hz)")
    return said


def campbell(set_: Moving, input_speed: float) -> Plot:
    """Draw the natural frequencies over the input speed."""
    speeds = np.linspace(0.0, 2.0 * input_speed, SPEEDS)
    rows = [whirl(assembled(set_, float(speed / input_speed))).frequency for speed in speeds]
    order = set_.speed / input_speed
    orders = {f"{h} × mesh frequency" if h > 1 else "mesh frequency": h * order for h in range(1, ORDERS + 1)}
    caption = (
        "Natural frequencies as seen from the carrier, at the scene's torque, with the mean stiffness over a pitch. "
        "Where a harmonic of the mesh frequency crosses one, forces are amplified."
    )
    return campbell_plot(speeds, rows, orders, input_speed, caption, reach=2.0)
