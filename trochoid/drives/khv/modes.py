"""Natural frequencies of discs, shaft and flange on the tangent stiffness of all contacts and bearings.

The loaded pins go round with the eccentric.  In its frame the stiffness hardly varies, and its mean over a turn counts;
in the fixed frame that mean would lose what couples turning with moving across, and come out far too stiff.  The frame
turns: Coriolis and centrifugal terms, and gyroscopic ones of shaft and flange that spin and tilt, belong to it.  Each
frequency is given where the fixed frame hears most of it.  The input turns evenly, and the scene's torque loads the
contacts, at any speed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.design import Design
from trochoid.drives.khv.eccentric import mass_matrix, on_the_eccentric, pairs, turning
from trochoid.drives.khv.mass import Masses
from trochoid.drives.khv.series import Series
from trochoid.drives.modes import CLOSE, Mode, campbell_plot, heard, shares
from trochoid.dynamics.elastic import departure
from trochoid.dynamics.system import System
from trochoid.dynamics.whirl import whirl
from trochoid.kinematics.types import ComplexArray, frozen
from trochoid.results.plot import Plot

SPEEDS = 25
MOTIONS = {
    "x": "across z",
    "y": "across z",
    "rotation": "turning",
    "tilt_x": "tilting",
    "tilt_y": "tilting",
}
MEMBERS = {"shaft": "input shaft", "output": "output flange"}


@dataclass(frozen=True, slots=True)
class NaturalModes:
    """Modes at the speed of operation by rising frequency; those that play leaves `free` have none.

    `stiffness_variation` is the largest departure of the stiffness from its mean over the turn, relative.  `shapes`
    (k, modes) on the motions `names` (k), as the eccentric sees them.
    """

    modes: tuple[Mode, ...]
    free: int
    stiffness_variation: float
    names: tuple[str, ...]
    shapes: ComplexArray


def natural_modes(design: Design, series: Series, masses: Masses) -> NaturalModes:
    """Return the modes at the scene's speed and torque."""
    modes, shapes = _modes(assembled(design, series, masses), design.crank_speed)
    return NaturalModes(
        modes, len(series.names) - len(modes), departure(on_the_eccentric(series)[1]), series.names, shapes
    )


def _modes(at: Callable[[float], System], speed: float) -> tuple[tuple[Mode, ...], ComplexArray]:
    """Return the modes at a speed of the eccentric (rad/s) by rising frequency, and their shapes (k, modes)."""
    system = at(speed)
    found, mass = whirl(system), np.diag(system.mass)
    names = [spoken(name) for name in system.names]
    across = np.array(pairs(system.names), dtype=np.int64).reshape(-1, 2)
    alone = np.array([i for i, name in enumerate(system.names) if name.endswith("rotation")])
    made = []
    for i, own in enumerate(found.frequency):
        shape = found.shapes[:, i]
        frequency, turns = heard(
            shape[across], mass[across[:, 0]], shape[alone], mass[alone], float(own), speed
        )
        made.append(Mode(frequency, shares(mass * np.abs(shape) ** 2, names), turns))
    order = sorted(range(len(made)), key=lambda i: made[i].frequency)
    return tuple(made[i] for i in order), found.shapes[:, order]


def assembled(design: Design, series: Series, masses: Masses) -> Callable[[float], System]:
    """Return crank speed (rad/s) → the undamped system on the motions of the series, in the frame of the eccentric."""
    stiffness = on_the_eccentric(series)[1].mean(axis=0)
    stiffness = 0.5 * (stiffness + stiffness.T)
    mass = mass_matrix(design, series.names, masses)
    frame = turning(design, series.names, masses)

    def at(speed: float) -> System:
        return System(
            frozen(mass),
            frozen(np.zeros_like(mass)),
            frozen(stiffness + speed**2 * frame.centrifugal),
            frozen(speed * frame.gyroscopic),
            tuple(series.names),
        )

    return at


def spoken(name: str) -> str:
    """Return a motion's name as modes are named by: "disc 1 across z" for "disc0.x"."""
    member, motion = name.split(".")
    if member.startswith("disc"):
        member = f"disc {int(member[4:]) + 1}"
    return f"{MEMBERS.get(member, member)} {MOTIONS[motion]}"


def lines(design: Design) -> dict[str, float]:
    """Return the orders of the input speed that excite the drive, with sign left out."""
    drive, speeds = design.drive, design.speeds.members
    ring, output = float(speeds["ring"]), float(speeds["output"])
    return {
        "input speed": 1.0,
        f"output pins pass, {drive.output_pins.count} per turn": drive.output_pins.count * abs(1.0 - output),
        f"ring pins pass, {drive.pins} per turn": drive.pins * abs(1.0 - ring),
    }


def near(design: Design, modes: tuple[Mode, ...]) -> list[str]:
    """Say which line is within CLOSE of which mode."""
    said = []
    for name, order in lines(design).items():
        line = order * design.crank_speed / (2.0 * np.pi)
        for i, mode in enumerate(modes, 1):
            if abs(line / mode.frequency - 1.0) < CLOSE:
                said.append(f"{name} ({line:.4g} Hz) near mode {i} ({mode.frequency:.4g} Hz)")
    return said


def campbell(design: Design, series: Series, masses: Masses) -> Plot:
    """Draw the natural frequencies over the input speed."""
    at, orders = assembled(design, series, masses), lines(design)
    speeds = np.linspace(0.0, 2.0 * design.crank_speed, SPEEDS)
    rows = [[mode.frequency for mode in _modes(at, float(speed))[0]] for speed in speeds]
    caption = (
        "Natural frequencies at the scene's torque, with the mean stiffness that the eccentric sees, up to three "
        "times the highest line. Where a line crosses one, its load is amplified."
    )
    return campbell_plot(speeds, rows, orders, design.crank_speed, caption)
