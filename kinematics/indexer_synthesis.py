"""Synthesis of spherical indexers without hard shock: every solution of a task, and what is wrong with some.

A root of the equations only starts and ends its index at rest.  It serves if between the two the wheel turns
one way by the angle asked for, and if the pin then stays outside the wheel's rim until the next index.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.indexer import Indexer, in_wheel
from trochoid.kinematics.indexer_measure import highest, rest_samples
from trochoid.kinematics.indexer_pin_roots import roots_by_pin
from trochoid.kinematics.indexer_roots import Roots, facing, planet_and_sense, roots_by_duration, slot_normal
from trochoid.kinematics.spherical_trochoid import Kind, SphericalTrochoid, bending, pin_derivatives
from trochoid.kinematics.types import Array, BoolArray, IntArray

Place = Literal["near", "far"]
Fault = Literal["", "swing", "reverses", "returns"]
FAULTS: tuple[Fault, ...] = ("", "swing", "reverses", "returns")
SAMPLES = 97
STILL = 1e-9  # ε at the ends that counts as none


@dataclass(frozen=True, slots=True)
class Task:
    """What is asked: swing ψ_Σ and shaft angle D (rad), and the whole number i of planet turns per arm turn."""

    swing: float
    planet: int
    shaft_angle: float = 0.5 * math.pi

    def __post_init__(self) -> None:
        """Refuse what no mechanism can be asked for."""
        if not 0.0 < self.swing < 2.0 * math.pi:
            raise Infeasible(
                f"a swing of {math.degrees(self.swing):g}°; take more than 0° and less than 360°"
            )
        if self.planet < 2 or self.planet != int(self.planet):
            nearest = max(2, round(self.planet))
            raise Infeasible(
                f"planet ratio {self.planet:g}: the pin is back for the next index only after a whole number of "
                f"turns of the planet, 2 or more; the nearest is {nearest}"
            )
        if not 0.0 < self.shaft_angle < math.pi:
            raise Infeasible(
                f"shaft angle {math.degrees(self.shaft_angle):g}°: the shafts must cross; take 0° to 180°, "
                "both excluded"
            )


@dataclass(frozen=True, slots=True)
class Solution:
    """An indexer without hard shock; `fault` says why it does not serve, "" if it does.

    "swing": the slot turns by another angle; "reverses": the wheel turns back on its way; "returns": the pin
    comes back into the wheel while it should rest.  `inflections` counts those of the path over half an index,
    and `nearest` says whether the pin is nearest to the wheel's axis in the middle (Nadezhdin's conditions).
    """

    indexer: Indexer
    fault: Fault
    inflections: int
    nearest: bool

    @property
    def kind(self) -> Kind:
        """Epi- or hypotrochoid."""
        return self.indexer.path.kind

    @property
    def place(self) -> Place:
        """Whether the pin is far from the drive's axis in mid-index, or near."""
        return "far" if math.cos(self.indexer.path.phase) * self.indexer.path.arm > 0.0 else "near"

    @property
    def cusp(self) -> bool:
        """Whether the index runs from cusp to cusp."""
        return float(self.indexer.path.speed(self.indexer.half_turn)) < STILL


def by_duration(task: Task, duration: float) -> tuple[Solution, ...]:
    """All solutions with k = `duration`, those that serve first, by rising C.  Raises Infeasible.

    At k = 1/i every solution is a cusp, unless cos D = cot(π/i) cot ψ0: then any arm does, and ρ must be given.
    """
    if not 0.0 < duration < 1.0:
        raise Infeasible(
            f"an index that takes {duration:g} of a turn of the drive; take more than 0, less than 1"
        )
    return sorted_solutions(
        task, roots_by_duration(0.5 * task.swing, math.pi * duration, task.planet, task.shaft_angle)
    )


def by_pin(task: Task, pin_ratio: float) -> tuple[Solution, ...]:
    """All solutions with ρ = `pin_ratio`, those that serve first, by rising C.  Raises Infeasible."""
    if not pin_ratio > 0.0:
        raise Infeasible(f"pin ratio {pin_ratio:g}: the pin must be off the planet's axis; take more than 0")
    return sorted_solutions(task, roots_by_pin(0.5 * task.swing, pin_ratio, task.planet, task.shaft_angle))


def cusped(task: Task) -> tuple[Solution, ...]:
    """Solutions from one cusp to the next, ρ = 1 and k = 1/i, in closed form.

    tan δ_c = sin D sin ψ0/(cos D sin ψ0 cos φ0 + cos ψ0 sin φ0): the cusp is on the central wheel's pitch cone.
    """
    m, sense = (np.tile(x, 2) for x in planet_and_sense(task.planet))
    phi, psi = np.full(8, math.pi / task.planet), np.full(8, 0.5 * task.swing)
    A = slot_normal(sense * psi, task.shaft_angle, phi)
    cusp = np.arctan2(-A[1], A[0])  # polar angle on the arm's meridian, or opposite
    cusp[4:] -= np.copysign(math.pi, cusp[4:])
    # there the pin is where the pitch cones touch: γ = δ_c + s δ_s, sin δ_s = sin δ_c/i
    planet = np.copysign(np.sign(m), cusp * m) * np.arcsin(np.abs(np.sin(cusp)) / task.planet)
    return sorted_solutions(task, facing(cusp + planet, planet, m, sense, phi, psi, task.shaft_angle))


def sorted_solutions(task: Task, roots: Roots) -> tuple[Solution, ...]:
    """Candidates as solutions, those that serve first, by rising C."""
    found = assess(roots, task)
    order = np.lexsort((found.cost, found.fault))
    return tuple(
        Solution(
            _indexer(task, roots, i),
            FAULTS[found.fault[i]],
            int(found.inflections[i]),
            bool(found.nearest[i]),
        )
        for i in order
    )


def _indexer(task: Task, roots: Roots, i: int) -> Indexer:
    path = SphericalTrochoid(*(float(x[i]) for x in (roots.arm, roots.pin, roots.ratio, roots.phase)))
    return Indexer(path, task.shaft_angle, float(roots.half_turn[i]))


@dataclass(frozen=True, eq=False, slots=True)
class Assessment:
    """Of candidates (n,): index of the `fault` in FAULTS, `cost` C from samples, and as in Solution."""

    fault: IntArray
    cost: Array
    inflections: IntArray
    nearest: BoolArray


def assess(roots: Roots, task: Task) -> Assessment:
    """What is wrong with each candidate, from samples of its index and its dwell."""
    arm, pin, m, phase = (x[:, None] for x in (roots.arm, roots.pin, roots.ratio, roots.phase))
    part = np.linspace(0.0, 1.0, SAMPLES)
    work = roots.half_turn[:, None] * part
    moving = pin_derivatives(arm, pin, m, phase, work, 2)
    zeta = in_wheel(moving, task.shaft_angle)
    with np.errstate(divide="ignore", invalid="ignore"):
        velocity = (zeta[1] / zeta[0]).imag * roots.sense[:, None]
        acceleration = (zeta[2] / zeta[0] - (zeta[1] / zeta[0]) ** 2).imag * roots.sense[:, None]
        turned = np.angle(zeta[0, :, 1:] / zeta[0, :, :-1]).sum(axis=-1) * roots.sense
    steady = (
        (velocity[:, 1:-1] > 0.0).all(axis=-1) & (velocity[:, 0] > -STILL) & (acceleration[:, -1] < STILL)
    )
    right = np.abs(turned - roots.half_swing) < 1e-6
    clear = _stays_outside(roots, task, right & steady)
    axis = np.array([math.sin(task.shaft_angle), 0.0, math.cos(task.shaft_angle)])
    bent = np.signbit(bending(moving)[:, :-1])
    inflections = np.count_nonzero(bent[:, 1:] != bent[:, :-1], axis=-1)
    deep = moving[0] @ axis
    nearest = (deep <= deep[:, :1] + 1e-12).all(axis=-1)
    fault = np.select([~right, ~steady, ~clear], [1, 2, 3], 0)
    with np.errstate(divide="ignore", invalid="ignore"):  # no swing at all is a fault of the first kind
        cost = np.abs(acceleration).max(axis=-1) * roots.half_turn**2 / roots.half_swing
    return Assessment(fault, 2.0 * cost, inflections, nearest)


def _stays_outside(roots: Roots, task: Task, asked: BoolArray) -> BoolArray:
    """Whether the pin stays outside the wheel's rim in the dwell; true where it is not `asked`."""
    few = roots.take(asked)
    arm, pin, m, phase, start = (x[:, None] for x in (few.arm, few.pin, few.ratio, few.phase, few.half_turn))
    rest = np.linspace(0.0, 1.0, rest_samples(task.planet)) * (math.pi - start) + start
    axis = np.array([math.sin(task.shaft_angle), 0.0, math.cos(task.shaft_angle)])
    height = pin_derivatives(arm, pin, m, phase, rest, 0)[0] @ axis
    clear = np.ones(asked.shape, dtype=bool)
    clear[asked] = highest(height) <= height[:, 0] + 1e-12
    return clear
