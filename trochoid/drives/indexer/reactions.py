"""Reactions over a turn of the arm: of the rigid drive, and of the elastic one as it was marched.

In the dwell pin and slot are apart: every reaction but the lock's is zero there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.indexer.forces import Forces, State
from trochoid.dynamics.spectrum import harmonics
from trochoid.kinematics.types import Array
from trochoid.scene.drive_indexer import IndexerDrive

if TYPE_CHECKING:
    from trochoid.drives.indexer.shaken import Shaken

RIGID, ELASTIC = "rigid", "elastic"
SAMPLES = 8192  # of a turn, for harmonics, and four for each of more
HARMONICS, MOST = 400, 16384  # lines of a turn, and so many at the most
BEYOND = 1.25  # times the fastest mode, up to which lines are taken

ASKED: dict[str, tuple[Callable[[State], Array], str]] = {
    "tooth_force": (lambda x: x.tooth, "N"),
    "planet_bearing_force": (lambda x: x.arm_force, "N"),
    "arm_tilting_moment": (lambda x: x.arm_moment, "N*m"),
    "wheel_bearing_force": (lambda x: x.pin, "N"),
    "wheel_tilting_moment": (lambda x: x.wheel_moment, "N*m"),
    "wheel_torque": (lambda x: x.torque, "N*m"),
    "input_torque": (lambda x: x.input_torque, "N*m"),
    "input_power": (lambda x: x.power, "W"),
}


@dataclass(frozen=True, slots=True)
class Shafts:
    """Places of the bearings along both shafts, m from the centre of the sphere; None where they are not given."""

    input: tuple[float, float] | None
    output: tuple[float, float] | None

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all bearing reactions, those along the input shaft too."""
        found = ("input_near_bearing", "input_far_bearing", "input_axial_force") if self.input else ()
        return (*found, *(("output_near_bearing", "output_far_bearing") if self.output else ()))


def shafts(drive: IndexerDrive) -> Shafts:
    """Return where a drive's shafts are held."""

    def places(near: float | None, far: float | None) -> tuple[float, float] | None:
        return None if near is None or far is None else (near, far)

    arm, wheel = drive.input_shaft, drive.output_shaft
    return Shafts(places(arm.near_bearing, arm.far_bearing), places(wheel.near_bearing, wheel.far_bearing))


def on_bearings(load: Array, axis: Array, places: tuple[float, float]) -> tuple[Array, Array, Array]:
    """Return what two bearings put on a shaft (n, 3) each, across its axis, and the force along it (n,).

    `load` (n, 6): force and moment about the centre that act on the shaft; `axis` is a unit vector (3,).
    """
    force, moment = load[:, :3], load[:, 3:]
    along = force @ axis
    across = force - along[:, None] * axis
    arms = np.cross(axis, moment)  # s1 R1 + s2 R2
    near, far = places
    one = (arms + far * across) / (near - far)
    return one, -across - one, -along


@dataclass(frozen=True, eq=False)
class Turn:
    """Reactions of one mechanism by one model.

    `state` at the drive angles `angle` (n,) of the index, where extremes are looked for, is by `at` at any angles.
    `count` is the number of its lines.
    """

    forces: Forces
    shafts: Shafts
    angle: Array
    at: Callable[[Array], State]
    count: int = HARMONICS

    @cached_property
    def state(self) -> State:
        """Forces at the model's own instants."""
        return self.at(self.angle)

    def bearings(self, state: State) -> dict[str, Array]:
        """Return sizes (n,) in N of bearing forces, that along the input shaft signed."""
        found: dict[str, Array] = {}
        if self.shafts.input:
            near, far, along = on_bearings(state.on_arm, np.array([0.0, 0.0, 1.0]), self.shafts.input)
            sizes = (np.linalg.norm(near, axis=1), np.linalg.norm(far, axis=1), along)
            found |= dict(zip(self.shafts.names[:3], sizes, strict=True))
        if self.shafts.output:
            near, far, _ = on_bearings(state.on_wheel, self.forces.indexer.axis, self.shafts.output)
            for name, force in zip(self.shafts.names[-2:], (near, far), strict=True):
                found[name] = np.linalg.norm(force, axis=1)
        return found

    def series(self, state: State) -> dict[str, Array]:
        """Return all reactions (n,) by name."""
        return {name: get(state) for name, (get, _) in ASKED.items()} | self.bearings(state)

    def largest(self) -> dict[str, float]:
        """Return the largest size of every reaction over the index."""
        return {name: float(np.abs(x).max()) for name, x in self.series(self.state).items()}

    @cached_property
    def lines(self) -> dict[str, Array]:
        """Amplitudes (count + 1,) of every reaction over a turn, multiples of the arm's speed; 0: the mean."""
        samples = max(SAMPLES, 1 << (4 * self.count - 1).bit_length())
        turn = 2.0 * math.pi * np.arange(samples) / samples - math.pi
        inside = np.abs(turn) <= self.forces.indexer.half_turn
        found = {}
        for name, values in self.series(self.at(turn[inside])).items():
            whole = np.zeros(samples)
            whole[inside] = values
            found[name] = np.abs(harmonics(whole))[: self.count + 1]
        return found

    def residual(self) -> float:
        """Largest difference of input power and power at the pin, to the largest power."""
        from trochoid.kinematics.indexer import motion

        speed = motion(self.forces.indexer, self.angle).velocity * self.forces.load.speed
        power, at_pin = self.state.power, self.state.torque * speed
        size = float(np.abs(power).max())
        return float(np.abs(power - at_pin).max()) / size if size > 0.0 else 0.0


def rigid_turn(forces: Forces, held: Shafts) -> Turn:
    """Return the reactions of the rigid drive."""
    half = forces.indexer.half_turn
    return Turn(forces, held, np.linspace(-half, half, 2881), forces.state)


def elastic_turn(x: Shaken, held: Shafts) -> Turn:
    """Return the reactions of the elastic drive: those of the rigid train under the pin force of the march."""
    forces = x.pair.forces
    half, sense = forces.indexer.half_turn, forces.indexer.sense
    angle, pin = x.angle(x.fine.index.time), sense * x.pin_force(x.fine)
    angle = np.clip(angle, -half, half)
    return Turn(forces, held, angle, lambda t: forces.under(t, np.interp(t, angle, pin)))


def turns(
    forces: Mapping[str, Forces], held: Shafts, shaken: Mapping[str, Shaken] | None
) -> dict[str, dict[str, Turn]]:
    """Return the reactions of each mechanism by model, with as many lines; `shaken` None: rigid alone."""
    found = {name: {RIGID: rigid_turn(x, held)} for name, x in forces.items()}
    for name in found if shaken else ():
        assert shaken is not None
        made = {**found[name], ELASTIC: elastic_turn(shaken[name], held)}
        count = lines_of(shaken[name])
        found[name] = {model: replace(turn, count=count) for model, turn in made.items()}
    return found


def lines_of(x: Shaken) -> int:
    """Return how many multiples of the arm's speed hold all natural frequencies of a march."""
    return min(max(HARMONICS, math.ceil(BEYOND * x.fastest / x.speed)), MOST)
