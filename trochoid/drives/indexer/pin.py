"""The pin in its slot as an elastic pair: its law, and what it carries over an index that is nearly at rest."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from trochoid.drives.indexer.design import Design
from trochoid.drives.indexer.feasible import between_slots
from trochoid.drives.indexer.forces import Forces
from trochoid.dynamics.pin_law import PinLaw, pin_law
from trochoid.fem.material import Material
from trochoid.fem.pin_slot import Pin, Pressed, press
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.indexer_slot import Slot
from trochoid.kinematics.types import Array
from trochoid.scene.drive_indexer import IndexerScene

RESERVE = 4.0  # times the largest force of the rigid drive, up to which the law is tabulated
LARGE = 0.1  # rad, by which a wheel that an elastic pin drives does not lag
LOADED = 0.01  # of the largest force, below which a stiffness is not reported
SAMPLES = 181


def pin_of(scene: IndexerScene, design: Design, slot: Slot) -> Pin:
    """Return the pin of a scene in a wall that stands still half-way to the next slot, at most R below its face."""
    drive, given = design.drive, scene.materials[design.drive.material]
    depth = drive.wheel.wall_depth or min(
        0.5 * between_slots(design, slot) - drive.pin_radius, drive.sphere_radius
    )
    return Pin(
        drive.pin.shape,
        drive.pin_radius,
        drive.sphere_radius,
        drive.wheel.thickness,
        drive.pin.overhang,
        depth,
        Material(given.youngs_modulus, given.poissons_ratio, given.density),
        drive.pin.crown_radius,
    )


def law_of(pin: Pin, largest: float, play: float) -> PinLaw:
    """Tabulate the law of a pin up to `RESERVE` times the moment `largest` (N·m); `play`: half the slot's, m."""
    tries = np.geomspace(1e-9, LARGE, 41)
    reached = press(pin, tries).moment
    i = int(np.searchsorted(reached, RESERVE * largest))
    if i == len(tries):
        raise Infeasible(
            f"pin_radius = {1e3 * pin.radius:.6g} mm: under {largest / pin.distance:.4g} N, with {RESERVE:g} times "
            f"that in reserve, pin and slot would yield by more than {1e3 * LARGE * pin.distance:.3g} mm; "
            "the pin must be thicker, or change operation.output_torque or input_speed"
        )
    top = float(tries[i])
    return pin_law(lambda u: press(pin, u).moment, top, play / pin.distance)


@dataclass(frozen=True, eq=False, slots=True)
class Loaded:
    """The pair at drive angles (n,): `stiffness` about the wheel's axis (N·m/rad), `lag` (rad) of the wheel, and how
    pin and wall are `pressed`.
    """

    stiffness: Array
    lag: Array
    pressed: Pressed


@dataclass(frozen=True, eq=False)
class Pair:
    """A pin, its law, and the forces of a mechanism that moves as if rigid."""

    pin: Pin
    law: PinLaw
    forces: Forces

    def state(self, t: Array) -> Loaded:
        """Return the pair at drive angles t (n,) of the index."""
        lever = np.sin(self.forces.indexer.reach(t))
        u = self.law.pressed(np.abs(self.forces.state(t).pin) * self.pin.distance)
        pressed = press(self.pin, u)
        return Loaded(lever**2 * pressed.slope, u / lever, pressed)

    @cached_property
    def largest(self) -> tuple[float, float]:
        """Largest pin force (N) and its drive angle (rad)."""
        force, at = self.forces.largest(lambda x: x.pin)
        return abs(force), at

    @cached_property
    def loaded(self) -> tuple[Array, Loaded]:
        """Drive angles (n,) over an index at which the pin is loaded, and the pair there."""
        half = self.forces.indexer.half_turn
        t = np.linspace(-half, half, SAMPLES)
        t = t[np.abs(self.forces.state(t).pin) > LOADED * self.largest[0]]
        return t, self.state(t)

    @cached_property
    def share(self) -> float:
        """Part of the deflection at the largest force that is the contact's, the rest is bending of the pin."""
        here = self.at_largest
        found = press(replace(self.pin, bends=False), self._pressing * np.linspace(0.02, 1.0, 99))
        return float(here.slope[0] / np.interp(here.moment[0], found.moment, found.slope))

    @cached_property
    def doubt(self) -> float | None:
        """How much of the stiffness half or twice the wall's depth changes; None where there is no such depth."""
        if self.pin.shape == "barrel":
            return None
        others = [replace(self.pin, depth=x * self.pin.depth) for x in (0.5, 2.0)]
        return float(
            max(abs(press(x, self._pressing).slope[0] / self.at_largest.slope[0] - 1.0) for x in others)
        )

    @property
    def _pressing(self) -> Array:
        return self.law.pressed(np.array([self.largest[0] * self.pin.distance]))

    @cached_property
    def at_largest(self) -> Pressed:
        """Pin and wall under the largest force of the rigid drive."""
        return press(self.pin, self._pressing)


def pairs(
    scene: IndexerScene, design: Design, slots: Mapping[str, Slot], forces: Mapping[str, Forces]
) -> Mapping[str, Pair]:
    """Return the pairs of all mechanisms: one pin, one law."""
    pin = pin_of(scene, design, slots["indexer"])
    largest = max(abs(x.largest(lambda y: y.pin)[0]) for x in forces.values()) * pin.distance
    play = 0.5 * design.drive.pin.play if scene.has("clearance") else 0.0
    law = law_of(pin, largest, play)
    return {name: Pair(pin, law, x) for name, x in forces.items()}


def lash(pair: Pair, t: float) -> float:
    """Angle (rad) by which the play lets the wheel move at a drive angle."""
    return 2.0 * pair.law.play / math.sin(float(pair.forces.indexer.reach(t)))
