"""Natural frequencies of discs, shaft and flange on the tangent stiffness of all contacts and bearings.

The stiffness is the mean over a turn, at the scene's torque; contacts that come and go are in the mean by their share.
Shaft and flange spin: their tilting has gyroscopic terms.  The input is held, as in the torsional stiffness.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.design import Design
from trochoid.drives.khv.mass import Masses
from trochoid.drives.khv.reactions import frames, mass_matrix
from trochoid.drives.khv.series import Series
from trochoid.drives.modes import CLOSE, Mode, campbell_plot, shares
from trochoid.dynamics.system import System
from trochoid.dynamics.whirl import whirl
from trochoid.kinematics.types import Array, frozen
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

    `stiffness_variation` is the largest departure of the stiffness from its mean over the turn, relative.
    """

    modes: tuple[Mode, ...]
    free: int
    stiffness_variation: float


def natural_modes(design: Design, series: Series, masses: Masses) -> NaturalModes:
    """Return the modes at the scene's speed and torque."""
    system = assembled(design, series, masses)(design.crank_speed)
    found = whirl(system)
    names = [spoken(name) for name in series.names]
    energy = np.diag(system.mass)[:, None] * np.abs(found.shapes) ** 2
    modes = tuple(
        Mode(float(frequency), shares(energy[:, i], names)) for i, frequency in enumerate(found.frequency)
    )
    return NaturalModes(modes, system.size - len(modes), _variation(series))


def assembled(design: Design, series: Series, masses: Masses) -> Callable[[float], System]:
    """Return crank speed (rad/s) → the undamped system on the motions of the series, in the fixed frame."""
    turn = float(design.speeds.members["ring"]) * series.angle
    turned = frames(series.names, turn)
    stiffness = np.einsum("nij,njk,nlk->nil", turned, series.stiffness, turned)[:-1].mean(axis=0)
    stiffness = 0.5 * (stiffness + stiffness.T)
    mass = mass_matrix(design, series.names, masses)
    spinning = _gyroscopic(design, series.names, masses, mass)

    def at(speed: float) -> System:
        gyroscopic = frozen(speed * spinning) if spinning.any() else None
        return System(
            frozen(mass), frozen(np.zeros_like(mass)), frozen(stiffness), gyroscopic, tuple(series.names)
        )

    return at


def _gyroscopic(design: Design, names: tuple[str, ...], masses: Masses, mass: Array) -> Array:
    """Return the gyroscopic matrix (k, k) at 1 rad/s of the crank: the momentum turns with the tilting member."""
    matrix = np.zeros((len(names), len(names)))
    speeds = design.speeds.members
    momenta = {"shaft": masses.shaft.axial_inertia}
    if "output.rotation" in names:
        place = names.index("output.rotation")
        momenta["output"] = float(mass[place, place]) * float(speeds["output"])
    for member, momentum in momenta.items():
        if f"{member}.tilt_x" in names:
            x, y = names.index(f"{member}.tilt_x"), names.index(f"{member}.tilt_y")
            matrix[x, y], matrix[y, x] = momentum, -momentum
    return matrix


def _variation(series: Series) -> float:
    size = np.sqrt(np.abs(np.diag(series.stiffness[:-1].mean(axis=0))))
    scale = np.divide(1.0, size, out=np.zeros_like(size), where=size > 0.0)
    off = (series.stiffness[:-1] - series.stiffness[:-1].mean(axis=0)) * np.outer(scale, scale)
    return float(np.linalg.norm(off, ord=2, axis=(1, 2)).max())


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
        heard = order * design.crank_speed / (2.0 * np.pi)
        for i, mode in enumerate(modes, 1):
            if abs(heard / mode.frequency - 1.0) < CLOSE:
                said.append(f"{name} ({heard:.4g} Hz) near mode {i} ({mode.frequency:.4g} Hz)")
    return said


def campbell(design: Design, series: Series, masses: Masses) -> Plot:
    """Draw the natural frequencies over the input speed."""
    at, orders = assembled(design, series, masses), lines(design)
    speeds = np.linspace(0.0, 2.0 * design.crank_speed, SPEEDS)
    rows = [whirl(at(float(speed))).frequency for speed in speeds]
    count = min(len(row) for row in rows)
    frequencies = np.array([row[:count] for row in rows]).reshape(len(rows), count)
    most = 3.0 * max(orders.values()) * speeds[-1] / (2.0 * np.pi)
    shown = frequencies[:, frequencies[0] <= most]
    caption = (
        "Natural frequencies at the scene's torque, with the mean stiffness over a turn, up to three times the highest "
        "line. Where a line crosses one, its load is amplified."
    )
    return campbell_plot(speeds, shown, orders, design.crank_speed, caption)
