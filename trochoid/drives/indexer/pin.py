"""The pin in its slot as an elastic pair: its law, and what it carries over an index that is nearly at rest."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from trochoid.drives.indexer.design import Design
from trochoid.drives.indexer.feasible import between_slots
from trochoid.drives.indexer.forces import Forces
from trochoid.drives.indexer.wall import Bodies
from trochoid.dynamics.pin_law import PinLaw, pin_law, slot_law
from trochoid.fem.material import Material
from trochoid.fem.pin_slot import Pin, Pressed, press
from trochoid.fem.slot_contact import ElasticPair, press_elastic
from trochoid.kinematics.errors import Infeasible, NotConverged
from trochoid.kinematics.indexer_slot import Slot
from trochoid.kinematics.readable import readable
from trochoid.kinematics.types import Array
from trochoid.scene.drive_indexer import IndexerScene

RESERVE = 4.0  # times the largest force of the rigid drive, up to which the law is tabulated
LARGE = 0.1  # rad, by which a wheel that an elastic pin drives does not lag
LOADED = 0.01  # of the largest force, below which a stiffness is not reported
SAMPLES = 181
PLACES = 5  # of an index, and that of the largest force, at which two meshes are compared
SHARE = (
    0.8  # 1/(1.5² − 1): of what two meshes differ by, one of them 1.5 times finer, at second order at least
)
LEAST = 0.15  # of the worst number's relative error: single numbers agree by chance

Presses = Callable[[Array, Array], Pressed]


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


def law_of(
    pin: Pin, presses: Presses, ends: tuple[float, float] | None, largest: float, play: float
) -> PinLaw:
    """Tabulate the law of a pin up to `RESERVE` times the moment `largest` (N·m); `play`: half the slot's, m.

    `ends` (rad) of the pin's way along the slot where the law depends on it, else None.
    """
    return tabulated(presses, ends, top_of(pin, presses, ends, largest), play / pin.distance)


def top_of(pin: Pin, presses: Presses, ends: tuple[float, float] | None, largest: float) -> float:
    """Return the angle (rad) at which a pin carries `RESERVE` times the moment `largest` (N·m).  Raises Infeasible."""
    most = 0.0
    for tries in np.append(np.geomspace(1e-9, LARGE, 41), np.full(4, LARGE)).reshape(-1, 5):
        reached = np.min([presses(tries, np.full(len(tries), x)).moment for x in ends or (0.0,)], axis=0)
        if (i := int(np.searchsorted(reached, RESERVE * largest))) < len(tries):
            return float(tries[i])
        most = float(reached[-1])
    raise Infeasible(
        f"pin_radius = {1e3 * pin.radius:.6g} mm: under {readable(largest / pin.distance, 4)} N, with {RESERVE:g} "
        f"times that in reserve, pin and slot would yield by more than {1e3 * LARGE * pin.distance:.3g} mm; "
        f"{readable(most / RESERVE / pin.distance)} N are the most that serve: pin or wheel must be thicker, or change "
        "operation.output_torque or input_speed"
    )


def fail_if_absurd(pin: Pin, forces: Mapping[str, Forces]) -> None:
    """Raise Infeasible where a pin in a wall that does not bend yields too far; without any finite elements."""
    largest = max(abs(x.largest(lambda y: y.pin)[0]) for x in forces.values()) * pin.distance
    try:
        top_of(pin, presses(pin, None), None, largest)
    except NotConverged:  # its closed form is for thin pins in thick walls
        return


def tabulated(presses: Presses, ends: tuple[float, float] | None, top: float, play: float) -> PinLaw:
    """Return the table of a law up to the angle `top` (rad); `play` in rad."""
    if ends is None:
        return pin_law(lambda u: presses(u, np.zeros(len(u))).moment, top, play)
    return slot_law(lambda u, at: presses(u, at).moment, top, ends, play)


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
    """A pin, its law, and the forces of a mechanism that moves as if rigid.

    `elastic`: the bodies of an elastic wheel and its pin, `coarse` those of a coarser mesh; None: half-spaces.
    """

    pin: Pin
    law: PinLaw
    forces: Forces
    elastic: ElasticPair | None = None
    coarse: ElasticPair | None = None

    def press(self, angle: Array, reach: Array) -> Pressed:
        """Press the pin by angles u (n,) at angles (n,) from the wheel's axis."""
        return presses(self.pin, self.elastic)(angle, reach)

    def longer(self, times: float) -> Pair:
        """Return the pair with a table that reaches so many times as far."""
        ends = self.law.ends if self.elastic else None
        return replace(
            self,
            law=tabulated(presses(self.pin, self.elastic), ends, times * self.law.top, self.law.play),
        )

    def state(self, t: Array) -> Loaded:
        """Return the pair at drive angles t (n,) of the index."""
        reach = self.forces.indexer.reach(t)
        lever = np.sin(reach)
        u = self.law.pressed(np.abs(self.forces.state(t).pin) * self.pin.distance, reach)
        pressed = self.press(u, reach)
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
    def shares(self) -> dict[str, float]:
        """Parts of the deflection at the largest force: of the contact, the pin's bending, and what the wheel adds.

        Contact and pin in closed form, as half-spaces and a beam; a rigid wheel adds nothing.
        """
        here = self.at_largest
        try:
            contact = float(here.slope[0] / self._in_closed_form(here.moment[0], bends=False))
            if self.elastic is None:
                return {"contact": contact}
            pin = float(here.slope[0] / self._in_closed_form(here.moment[0], bends=True))
        except NotConverged:  # out of all proportion: the closed form has no share to tell
            return {}
        return {"contact": contact, "pin": pin - contact, "wheel": 1.0 - pin}

    def _in_closed_form(self, moment: float, *, bends: bool) -> float:
        """Slope (N·m/rad) of the closed form at a moment (N·m)."""
        pin = replace(self.pin, bends=bends)
        found = press(pin, self._pressing * np.linspace(0.02, 1.0, 99))
        return float(np.interp(moment, found.moment, found.slope))

    @cached_property
    def doubt(self) -> float | None:
        """How much of the stiffness is not sure; None where nothing tells.

        By two meshes of an elastic wheel; else by half or twice the wall's depth, where there is such a depth.
        """
        if self.elastic is not None:
            return None if self.coarse is None else self.differences["stiffness"]
        if self.pin.shape == "barrel":
            return None
        others = [replace(self.pin, depth=x * self.pin.depth) for x in (0.5, 2.0)]
        return float(
            max(abs(press(x, self._pressing).slope[0] / self.at_largest.slope[0] - 1.0) for x in others)
        )

    @cached_property
    def differences(self) -> dict[str, float]:
        """`SHARE` of what two meshes differ by over an index, relative, and no less than a share of the worst."""
        assert self.elastic is not None
        assert self.coarse is not None
        return differences(self.elastic, self.coarse, self.forces)

    @property
    def _pressing(self) -> Array:
        return self.law.pressed(np.array([self.largest[0] * self.pin.distance]), self._at_largest)

    @property
    def _at_largest(self) -> Array:
        return self.forces.indexer.reach(np.array([self.largest[1]]))

    @cached_property
    def at_largest(self) -> Pressed:
        """Pin and wall under the largest force of the rigid drive."""
        return self.press(self._pressing, self._at_largest)


def presses(pin: Pin, elastic: ElasticPair | None) -> Presses:
    """Return what presses a pin by angles (n,) at angles (n,) from the wheel's axis."""
    if elastic is None:
        return lambda angle, _: press(pin, angle)
    return lambda angle, reach: press_elastic(elastic, angle, reach)


def differences(fine: ElasticPair, coarse: ElasticPair, forces: Forces) -> dict[str, float]:
    """Return the relative errors of stiffness and largest pressure over an index that two meshes suggest."""
    half = forces.indexer.half_turn
    force, at = forces.largest(lambda x: x.pin)
    t = np.append(half * np.linspace(-1.0, 1.0, PLACES), at)
    reach = forces.indexer.reach(t)
    stiff = press_elastic(fine, np.full(len(t), 1e-6), reach)
    u = abs(force) * fine.pin.distance / stiff.slope if force != 0.0 else np.full(len(t), 1e-6)
    one, other = (press_elastic(x, u, reach) for x in (fine, coarse))
    other = press_elastic(coarse, u * one.moment / other.moment, reach)  # under about the same force
    found = {
        "stiffness": SHARE * float(np.abs(one.slope / other.slope - 1.0).max()),
        "pressure": SHARE * float(np.abs(one.pressure.max(axis=1) / other.pressure.max(axis=1) - 1.0).max()),
    }
    return {name: max(x, LEAST * max(found.values())) for name, x in found.items()}


def pairs(
    scene: IndexerScene, design: Design, pin: Pin, forces: Mapping[str, Forces], made: Bodies
) -> Mapping[str, Pair]:
    """Return the pairs of all mechanisms: one pin, and one law where the wheel is rigid."""
    largest = {name: abs(x.largest(lambda y: y.pin)[0]) * pin.distance for name, x in forces.items()}
    play = 0.5 * design.drive.pin.play if scene.has("clearance") else 0.0
    if made.fine is None:
        try:
            law = law_of(pin, presses(pin, None), None, max(largest.values()), play)
        except NotConverged as fault:
            raise Infeasible(
                f"pin_radius = {1e3 * pin.radius:.6g} mm in a wheel {1e3 * pin.thickness:.6g} mm thick: {fault}; the "
                "two must be nearer to each other, or the load smaller"
            ) from fault
        return {name: Pair(pin, law, x) for name, x in forces.items()}
    found = {}
    for name, x in forces.items():
        elastic = made.fine[name]
        half = x.indexer.half_turn
        reach = x.indexer.reach(np.linspace(-half, half, SAMPLES))
        ends = float(reach.min()), float(reach.max())
        law = law_of(pin, presses(pin, elastic), ends, largest[name], play)
        found[name] = Pair(pin, law, x, elastic, None if made.coarse is None else made.coarse[name])
    return found


def lash(pair: Pair, t: float) -> float:
    """Angle (rad) by which the play lets the wheel move at a drive angle."""
    return 2.0 * pair.law.play / math.sin(float(pair.forces.indexer.reach(t)))
