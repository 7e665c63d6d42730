"""Motions as the turning eccentric sees them: their masses, what the frame's turning adds, their stiffness.

The loaded pins go round with the eccentric.  In its frame the stiffness hardly varies; in the fixed frame its mean over
a turn would lose what couples turning with moving across.
"""

from __future__ import annotations

import numpy as np

from trochoid.drives.khv.design import Design
from trochoid.drives.khv.mass import Masses
from trochoid.drives.khv.series import Series
from trochoid.dynamics.elastic import Frame
from trochoid.kinematics.types import Array, frozen


def frames(names: tuple[str, ...], turn: Array) -> Array:
    """Return matrices (n, k, k) that turn motions by the angles (n,): from the ring's frame into the fixed one."""
    made = np.tile(np.eye(len(names)), (len(turn), 1, 1))
    for i, j in pairs(names):
        made[:, i, i] = made[:, j, j] = np.cos(turn)
        made[:, j, i], made[:, i, j] = np.sin(turn), -np.sin(turn)
    return made


def pairs(names: tuple[str, ...]) -> list[tuple[int, int]]:
    """Return the places of the motions x and y, tilt_x and tilt_y, of each member."""
    found = []
    for first, second in (("x", "y"), ("tilt_x", "tilt_y")):
        for name in names:
            member, motion = name.split(".")
            if motion == first:
                found.append((names.index(name), names.index(f"{member}.{second}")))
    return found


def on_the_eccentric(series: Series) -> tuple[Array, Array]:
    """Return motion (n + 1, k) and stiffness (n, k, k) over a turn, both ends and one of them, along its axes."""
    turned = frames(series.names, -series.crank)
    motion = np.einsum("nij,nj->ni", turned, series.motion)
    return motion, np.einsum("nij,njk,nlk->nil", turned, series.stiffness, turned)[:-1]


def mass_matrix(design: Design, names: tuple[str, ...], masses: Masses) -> Array:
    """Return the diagonal mass matrix of the motions: kg for x and y, kg·m² for rotation and tilt."""
    pins = design.drive.output_pins
    flange = masses.flange.mass + pins.count * masses.output_pin.mass
    spin = masses.flange.axial_inertia + pins.count * masses.output_pin.mass * pins.circle_radius**2
    tilt = masses.flange.transverse_inertia + 0.5 * (spin - masses.flange.axial_inertia)
    disc = {"x": masses.disc.mass, "y": masses.disc.mass, "rotation": masses.disc.axial_inertia}
    shaft_tilt = masses.shaft.transverse_inertia
    values = {
        "shaft": {"x": masses.shaft.mass, "y": masses.shaft.mass, "tilt_x": shaft_tilt, "tilt_y": shaft_tilt},
        "output": {"x": flange, "y": flange, "rotation": spin, "tilt_x": tilt, "tilt_y": tilt},
    }
    split = [name.split(".") for name in names]
    return np.diag([values.get(member, disc)[motion] for member, motion in split])


def momenta(design: Design, names: tuple[str, ...], masses: Masses) -> Array:
    """Return the skew matrix (k, k) of the momentum about z of members that tilt, for 1 rad/s of the eccentric."""
    mass, found = mass_matrix(design, names, masses), np.zeros((len(names),) * 2)
    about_z = {"shaft": masses.shaft.axial_inertia}
    if "output.rotation" in names:
        place = names.index("output.rotation")
        about_z["output"] = float(mass[place, place]) * float(design.speeds.members["output"])
    for x, y in pairs(names):
        member, motion = names[x].split(".")
        if motion == "tilt_x":
            found[x, y], found[y, x] = about_z.get(member, 0.0), -about_z.get(member, 0.0)
    return found


def turning(design: Design, names: tuple[str, ...], masses: Masses) -> Frame:
    """Return what the frame adds for 1 rad/s of the eccentric; centrifugal terms go with the square of the speed.

    Across: 2 m Ω × and −m Ω²; tilting: (2 J Ω − H) × and −(J Ω − H) Ω with the momentum H about z (dynamics.turning).
    Damping feels velocities in the fixed frame, where the bearings of shaft and flange stand.
    """
    mass, spins = mass_matrix(design, names, masses), momenta(design, names, masses)
    rate = np.zeros_like(mass)
    for x, y in pairs(names):
        rate[x, y], rate[y, x] = -1.0, 1.0
    return Frame(frozen(2.0 * mass @ rate + spins), frozen(mass @ rate @ rate + spins @ rate), frozen(rate))
