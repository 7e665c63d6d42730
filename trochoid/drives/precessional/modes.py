"""Natural frequencies of a precessional drive: satellite and shafts on their joints, and the casing on its mounts.

Small motions about the steady nutation, in the frame of the input shaft, where joints, teeth and mean inertia stand
still (`elastic`).  A frequency there is heard in the fixed frame shifted by that of the shaft, up or down; each mode
is given at the frequency at which most of it is heard.  Loads that stand still in the shaft's frame meet a mode where
its frequency there is 0; the line of 2 z1/z2, which an uneven satellite excites, where its frequency is that.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.casing import rigid_casing_of
from trochoid.drives.modes import Mode, campbell_plot, heard, shares
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.members import Bodies, bodies
from trochoid.drives.precessional.yielding import Yielding, output_mass
from trochoid.dynamics.casing import follow, matrices
from trochoid.dynamics.constraint import free_motions
from trochoid.dynamics.system import System
from trochoid.dynamics.whirl import Whirl, whirl
from trochoid.kinematics.errors import NotConverged, TrochoidError
from trochoid.kinematics.types import Array, ComplexArray, frozen
from trochoid.results.plot import Plot

if TYPE_CHECKING:
    from trochoid.fem.solid import SolidBody

MOTIONS = ("across z", "across z", "along z", "tilting", "tilting", "turning about z")
SPEEDS, CRITICAL = 49, 3
ALIKE = 0.01  # critical speeds that are nearer to each other, relative, are one: a round drive has pairs
REAL = 1e-6


@dataclass(frozen=True, eq=False, slots=True)
class Reduced:
    """Matrices (k, k) of the motions that rigid joints leave, `basis` (n, k): G and K_c are those of 1 rad/s."""

    made: Bodies
    basis: Array
    mass: Array
    springs: Array
    gyroscopic: Array
    centrifugal: Array

    def system(self, speed: float) -> System:
        """Return the undamped system at a speed of the shaft, rad/s."""
        return System(
            self.mass,
            np.zeros_like(self.mass),
            frozen(self.springs + speed**2 * self.centrifugal),
            frozen(speed * self.gyroscopic),
        )


@dataclass(frozen=True, slots=True)
class NaturalModes:
    """Modes at the speed of operation; lowest critical speeds (rad/s), of loads that turn with the shaft and of the
    line 2 z1/z2; the Campbell diagram.  `with_casing`: whether the casing on its mounts is in it.  `motions` (modes, m,
    6) of the m `members` about their `centers` (m, 3), as the shaft sees them.
    """

    modes: tuple[Mode, ...]
    critical: tuple[float, ...]
    critical_uneven: tuple[float, ...]
    campbell: Plot
    with_casing: bool
    members: tuple[str, ...]
    centers: Array
    motions: ComplexArray


def natural_modes(
    design: Design, drive: PrecessionalDrive, held: Yielding | None, body: SolidBody | None = None
) -> NaturalModes:
    """Return modes and critical speeds, with the mass of an elastic casing's `body`.

    Raises TrochoidError where nothing yields.
    """
    if held is None or not (held.joints.yields or design.scene.has("casing_on_mounts")):
        raise TrochoidError(
            "natural frequencies need something that yields: give bearing_a, bearing_b or joint_o a table"
        )
    casing = casing_matrices(design, body) if design.scene.has("casing_on_mounts") else None
    speed = design.speed
    made = bodies(drive, speed, design.shaft_shape, held.joints, output_mass(design), casing)
    reduced = reduce(made, speed)
    found = whirl(reduced.system(speed))
    modes = [_mode(reduced, found, i, speed) for i in range(found.frequency.size)]
    by_frequency = sorted(range(len(modes)), key=lambda i: modes[i].frequency)
    motions = (reduced.basis @ found.shapes[:, by_frequency]).T.reshape(len(modes), len(made.members), 6)
    order = 2.0 * drive.tooth_ratio
    return NaturalModes(
        tuple(modes[i] for i in by_frequency),
        _apart(critical_speeds(reduced, 0.0))[:CRITICAL],
        _apart(critical_speeds(reduced, order))[:CRITICAL],
        _campbell(reduced, speed, drive.tooth_ratio),
        casing is not None,
        tuple(member.name for member in made.members),
        frozen(np.array([member.center for member in made.members])),
        motions,
    )


def fail_if_unstable(held: Yielding, speed: float) -> None:
    """Raise NotConverged where the members run away from their steady motion at a speed of the shaft (rad/s)."""
    if not held.joints.yields:
        return
    growth = whirl(reduce(held.bodies, speed).system(speed)).growth
    if growth > 0.0:
        raise NotConverged(
            f"at {30.0 * speed / np.pi:.6g} rpm the members do not stay on any steady motion: what disturbs it grows "
            f"by e every {1.0 / growth:.2g} s without damping, for joints are too soft for the inertia that turns; "
            "take a lower operation.input_speed or stiffer bearings"
        )


def casing_matrices(design: Design, body: SolidBody | None = None) -> tuple[Array, Array]:
    """Return mass and mount stiffness (6, 6) of the casing about O, fixed frame; of an elastic one as if rigid."""
    casing, _ = rigid_casing_of(design.scene, body)
    mass, _, stiffness = matrices(casing)
    to_center = np.vstack([follow(casing.center, (0.0, 0.0, 0.0)), np.eye(6)[3:]])
    return frozen(to_center.T @ mass @ to_center), frozen(to_center.T @ stiffness @ to_center)


def reduce(made: Bodies, speed: float) -> Reduced:
    """Return the matrices of the motions that the rigid joints of `made` (at `speed`, rad/s) leave."""
    basis, turning = free_motions(made.rows, made.matrices.mass), made.matrices
    parts = (turning.mass, made.springs, turning.gyroscopic / speed, turning.centrifugal / speed**2)
    return Reduced(made, basis, *(frozen(basis.T @ part @ basis) for part in parts))


def critical_speeds(reduced: Reduced, order: float) -> tuple[float, ...]:
    """Return the speeds Ω (rad/s), rising, at which a load of `order` Ω in the frame of the shaft meets a mode.

    K v = Ω² (order² M − i order G − K_c) v, for matrices of 1 rad/s: no search over speeds.
    """
    from scipy.linalg import eig

    if not reduced.basis.size:
        return ()
    right = order**2 * reduced.mass - 1j * order * reduced.gyroscopic - reduced.centrifugal
    size = 1.0 / np.sqrt(np.diag(reduced.mass))
    scale = np.outer(size, size)
    top, below = eig(reduced.springs * scale, right * scale, right=False, homogeneous_eigvals=True)
    finite = np.abs(below) > 1e-12 * np.abs(below).max(initial=0.0)
    squares = top[finite] / below[finite]
    real = np.abs(squares.imag) <= REAL * np.abs(squares)
    return tuple(float(s) for s in np.sort(np.sqrt(squares.real[real & (squares.real > REAL)])))


def _apart(speeds: tuple[float, ...]) -> tuple[float, ...]:
    """Return rising speeds without those that are as good as the one before."""
    return tuple(s for i, s in enumerate(speeds) if i == 0 or s > (1.0 + ALIKE) * speeds[i - 1])


def _mode(reduced: Reduced, found: Whirl, i: int, speed: float) -> Mode:
    """Return a mode of the shaft's frame as the fixed frame hears it."""
    motion = reduced.basis @ found.shapes[:, i]
    members = reduced.made.members
    names = [f"{member.name} {how}" for member in members for how in MOTIONS]
    energy = np.maximum(np.real(np.conj(motion) * (reduced.made.matrices.mass @ motion)), 0.0)
    triples, weight = motion.reshape(-1, 3), np.diag(reduced.made.matrices.mass).reshape(-1, 3)
    frequency, turns = heard(
        triples[:, :2], weight[:, 0], triples[:, 2], weight[:, 2], float(found.frequency[i]), speed
    )
    return Mode(frequency, shares(energy, names), turns)


def _campbell(reduced: Reduced, operating: float, tooth_ratio: float) -> Plot:
    fastest = 2.0 * operating
    for first in critical_speeds(reduced, 0.0)[:1]:
        fastest = min(max(fastest, 1.2 * first), 8.0 * operating)
    speeds = np.linspace(0.0, fastest, SPEEDS)
    lines = {
        "input speed": 1.0,
        f"2 z1/z2 - 1 = {2.0 * tooth_ratio - 1.0:.4g}": 2.0 * tooth_ratio - 1.0,
        f"2 z1/z2 + 1 = {2.0 * tooth_ratio + 1.0:.4g}": 2.0 * tooth_ratio + 1.0,
    }
    rows = []
    for speed in speeds:
        found = whirl(reduced.system(float(speed)))
        rows.append(
            sorted(_mode(reduced, found, i, float(speed)).frequency for i in range(found.frequency.size))
        )
    return campbell_plot(
        speeds,
        rows,
        lines,
        operating,
        "Natural frequencies as the fixed frame hears them, up to three times the highest line; stiffnesses of "
        "bearings as at the speed of operation. A crossing with the input speed matters for a mode that turns forward.",
    )
