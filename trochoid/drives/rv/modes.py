"""Natural frequencies of an RV drive at every place of a turn, on the tangent stiffness of all contacts and bearings.

The loaded pins and rollers go round with the eccentrics, many times slower than any mode swings or dies away: the
stiffness is as good as at rest, and a mode's frequency goes up and down a little over the turn.  A mean stiffness in
the carrier's frame would lose what couples turning cranks with shifting discs, and come out far too stiff.  The frame
turns: Coriolis and centrifugal terms belong to it (dynamics.carried).  The sun is held, as by a motor of any inertia.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.drives.modes import CLOSE, Mode, campbell_plot, shares
from trochoid.drives.rv.carried import carried_masses
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.mass import Masses
from trochoid.drives.rv.reactions import frame_speed
from trochoid.drives.rv.series import Series
from trochoid.dynamics.carried import Mass, carried_frame, mass_matrix
from trochoid.dynamics.system import System
from trochoid.dynamics.whirl import Whirl, whirl
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, ComplexArray, frozen
from trochoid.results.plot import Plot

PLACES = 24  # of the turn, at which modes are looked at, at most
FEW, SPEEDS = 6, 9  # places and speeds of the Campbell diagram


@dataclass(frozen=True, slots=True)
class NaturalModes:
    """Modes by rising frequency, each the mean over the turn; `lowest` and `highest` (modes,) over it, Hz.

    `free`: motions without a frequency at some place.  `shapes` (k, modes) at the first place, on all motions.
    """

    modes: tuple[Mode, ...]
    lowest: Array
    highest: Array
    free: int
    shapes: ComplexArray


def natural_modes(design: Design, series: Series, masses: Masses) -> NaturalModes:
    """Return the modes at the scene's speed and torque; raises TrochoidError where a motion has no mass."""
    parts = carried_masses(design, series.motions, masses)
    found = _over_turn(design, series, parts, 1.0, PLACES)
    count = min(len(each.frequency) for each in found)
    frequencies = np.array([each.frequency[:count] for each in found])
    energy, names = _energy(design, parts)
    shared = np.mean([energy(each.shapes[:, :count]) for each in found], axis=0)
    modes = tuple(Mode(float(f), shares(shared[:, i], names)) for i, f in enumerate(frequencies.mean(axis=0)))
    return NaturalModes(
        modes,
        frozen(frequencies.min(axis=0)),
        frozen(frequencies.max(axis=0)),
        len(series.motions.names) - count,
        found[0].shapes[:, :count],
    )


def _over_turn(
    design: Design, series: Series, parts: tuple[Mass, ...], share: float, places: int
) -> list[Whirl]:
    """Return the modes at `places` of the turn, or all there are, at a share of the speed."""
    mass = mass_matrix(parts)
    if np.linalg.eigvalsh(mass)[0] <= 0.0:
        raise TrochoidError("natural frequencies: every motion needs a mass or a moment of inertia")
    frame = carried_frame(parts, share * frame_speed(design))
    stiffness = series.stiffness[:-1]
    rows = np.unique(np.linspace(0, len(stiffness), min(places, len(stiffness)), endpoint=False).astype(int))
    return [
        whirl(System(mass, 0.0 * mass, 0.5 * (k + k.T) + frame.centrifugal, frame.gyroscopic))
        for k in stiffness[rows]
    ]


def _energy(design: Design, parts: tuple[Mass, ...]) -> tuple[Callable[[ComplexArray], Array], list[str]]:
    """Return the function of shapes (k, m) that gives energies (2 p, m) of the p masses, and their names."""
    discs, cranks = len(design.discs), len(design.crank_places)
    places = (len(parts) - discs - 2) // cranks
    members = [f"disc {i + 1}" for i in range(discs)]
    members += [*["crankshafts"] * (places - 1), "planets"] * cranks
    members += ["sun", "ring" if design.driven == "ring" else "carrier"]
    names = [f"{member} {how}" for member in members for how in ("across the axis", "turning")]

    def energy(shapes: ComplexArray) -> Array:
        rows = []
        for part in parts:
            rows.append(part.mass * (np.abs(part.moves @ shapes) ** 2).sum(axis=0))
            rows.append(part.inertia * np.abs(part.turns @ shapes) ** 2)
        return np.asarray(np.array(rows) / np.sum(rows, axis=0))

    return energy, names


def lines(design: Design) -> dict[str, float]:
    """Return the orders of the input speed that excite the drive, as seen from the carrier."""
    table, pins = design.drive.first_stage, design.drive.cycloid.pins
    turning = abs(design.turning)
    sun = abs(float(design.speeds.relative("sun", "carrier")))
    return {
        "crankshafts turn": turning,
        f"ring pins pass, {pins} per turn of the crankshafts": pins * turning,
        "sun and planets mesh": table.z_sun * sun,
    }


def near(design: Design, found: NaturalModes) -> list[str]:
    """Say which line is within CLOSE of what a mode's frequency takes over the turn."""
    said = []
    for name, order in lines(design).items():
        line = order * design.scene.operation.input_speed / (2.0 * np.pi)
        for i, (low, high) in enumerate(zip(found.lowest, found.highest, strict=True)):
            if (1.0 - CLOSE) * low < line < (1.0 + CLOSE) * high:
                said.append(f"{name} ({line:.4g} Hz) near mode {i + 1} ({found.modes[i].frequency:.4g} Hz)")
    return said


def campbell(design: Design, series: Series, masses: Masses) -> Plot:
    """Draw the natural frequencies over the input speed."""
    orders, operating = lines(design), design.scene.operation.input_speed
    parts = carried_masses(design, series.motions, masses)
    speeds = np.linspace(0.0, 2.0 * operating, SPEEDS)
    rows = []
    for speed in speeds:
        found = _over_turn(design, series, parts, float(speed / operating), FEW)
        count = min(len(each.frequency) for each in found)
        rows.append(np.mean([each.frequency[:count] for each in found], axis=0))
    caption = (
        "Natural frequencies as seen from the carrier, at the scene's torque, means over a turn of the crankshafts, up "
        "to three times the highest line. Where a line crosses one, its load is amplified."
    )
    return campbell_plot(speeds, rows, orders, operating, caption)
