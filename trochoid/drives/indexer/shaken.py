"""What elasticity makes of the soft shocks: wheel and output over an index and its dwell, from rest."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from trochoid.drives.indexer.design import GENEVA, INDEXER
from trochoid.drives.indexer.pin import LARGE, Pair
from trochoid.drives.indexer.wheel import WheelMass
from trochoid.drives.indexer.words import NAMES, SAME_TIME
from trochoid.dynamics.indexing import STEPS, Index, Response, respond, stiffest_of
from trochoid.dynamics.indexing_parts import Output
from trochoid.fem.pin_slot import Pressed
from trochoid.kinematics.errors import Infeasible, NotConverged, TrochoidError
from trochoid.kinematics.indexer import Indexer, motion
from trochoid.kinematics.readable import readable
from trochoid.kinematics.types import Array
from trochoid.scene.drive_indexer import IndexerScene

NOTHING = 1e-9  # of the largest lag in the index, below which an amplitude is rounding
SETTLED = 0.05  # of its amplitude, below which a vibration has settled
LARGER = 4.0  # times, by which the table of the law grows when a response leaves it
LESS = (2.5, 1.6, 1.3)  # where the contacts of so long a table are too wide
TRIES = 9
STIFF, STIFFISH = 1000.0, 10.0  # times the contact's stiffness, from which a shaft is rigid, and may be
HELD = 0.01  # of the swing, from which friction holds the output off its stop by more than a drive may


@dataclass(frozen=True, eq=False)
class Shaken:
    """The elastic response of one mechanism beside its rigid forces; `coarse` has steps twice as long.

    `stiffer`: how many times the shaft's stiffness is that of pin and slot, where it counts as rigid; else 0.
    """

    pair: Pair
    output: Output
    fine: Response
    coarse: Response
    stiffer: float = 0.0

    @property
    def speed(self) -> float:
        """Speed of the arm, rad/s."""
        return self.pair.forces.load.speed

    def angle(self, time: Array) -> Array:
        """Drive angles (n,) from the middle of the index, rad."""
        return time * self.speed - self.pair.forces.indexer.half_turn

    def pin_force(self, found: Response) -> Array:
        """Pin force (n,) in N over the index, positive where it drives."""
        lever = np.sin(self.pair.forces.indexer.reach(self.angle(found.index.time)))
        return np.asarray(found.index.torque / (self.pair.pin.distance * lever))

    @property
    def rigid(self) -> Array:
        """Pin force (n,) in N of the rigid drive at the same instants."""
        state = self.pair.forces.state(self.angle(self.fine.index.time))
        return np.asarray(state.pin * self.pair.forces.indexer.sense)

    @cached_property
    def peak(self) -> tuple[float, float]:
        """Largest pin force (N) and its drive angle (rad)."""
        force = np.abs(self.pin_force(self.fine))
        i = int(force.argmax())
        return float(force[i]), float(self.angle(self.fine.index.time[i]))

    @property
    def factor(self) -> tuple[float, float]:
        """Largest pin force over that of the rigid drive, and its error by the length of the steps."""
        other = float(np.abs(self.pin_force(self.coarse)).max())
        rigid = self.pair.largest[0]
        return self.peak[0] / rigid, abs(self.peak[0] - other) / rigid

    @property
    def at_entry(self) -> float:
        """Largest pin force in the first natural period from the first touch on, over that of the rigid drive's start.

        nan where that start is without force; 0 where the pin never touches.
        """
        force, time = np.abs(self.pin_force(self.fine)), self.fine.index.time
        start = abs(float(self.rigid[0]))
        if start <= 1e-9 * self.pair.largest[0]:
            return math.nan
        touching = np.flatnonzero(force > 0.0)
        if not touching.size:
            return 0.0
        first = time <= time[touching[0]] + 2.0 * math.pi / self.output.frequencies[0]
        return float(force[first].max()) / start

    @property
    def touch(self) -> float:
        """Time (s) from the start of the index at which the pin first touches its slot; nan if it never does."""
        touching = np.flatnonzero(self.fine.index.torque != 0.0)
        return float(self.fine.index.time[touching[0]]) if touching.size else math.nan

    @property
    def pressed(self) -> Pressed:
        """Pin and wall under the largest pin force."""
        force, at = self.peak
        reach = self.pair.forces.indexer.reach(np.array([at]))
        u = self.pair.law.pressed(np.array([force * self.pair.pin.distance]), reach)
        return self.pair.press(u, reach)

    @property
    def amplitude(self) -> tuple[float, float]:
        """Largest way (rad) of the output after the stop from where it ends, and its error by the steps."""
        one, two = (float(np.abs(x.dwell.deviation - _held_off(x)).max()) for x in (self.fine, self.coarse))
        scale = float(np.abs(self.fine.index.deviation).max())
        if one <= NOTHING * scale:
            return 0.0, 0.0 if two <= NOTHING * scale else two
        return one, abs(one - two)

    @property
    def settling(self) -> float | None:
        """Time (s) after the stop from which the output stays within a part of its amplitude of where it ends.

        None where it does not within the dwell, or the part of it that was followed, or where friction `held` it off.
        """
        dwell = self.fine.dwell
        if self.held:
            return None
        away = np.abs(dwell.deviation - self.offset)
        outside = np.flatnonzero(away > SETTLED * self.amplitude[0]) if self.amplitude[0] > 0.0 else away[:0]
        if not outside.size:
            return 0.0
        late = dwell.time[-1] - dwell.time[outside[-1]] < math.pi / self.output.frequencies[0]
        return None if late and not self.fine.stuck else float(dwell.time[outside[-1]])

    @property
    def followed(self) -> float:
        """Part of the dwell that was followed, where the output still swings at the end of it; else 1."""
        dwell, speed = self.fine.dwell, self.speed
        rest = 2.0 * (math.pi - self.pair.forces.indexer.half_turn) / speed
        ended = self.fine.stuck or self.settling is not None
        return 1.0 if ended else min(1.0, float(dwell.time[-1]) / rest)

    @property
    def offset(self) -> float:
        """Where friction holds the output in the end (rad), 0 where it still swings."""
        return _held_off(self.fine)

    @property
    def held(self) -> float:
        """Part of the swing by which friction holds the output off its stop, where that is much; else 0."""
        part = abs(self.offset) / self.pair.forces.indexer.swing
        return part if part >= HELD else 0.0

    @property
    def moves(self) -> bool:
        """Whether the output moves at all in an index."""
        found = self.fine.index
        return bool(np.abs(found.base + found.speed).max() > 1e-9 * found.base.max())

    @property
    def fastest(self) -> float:
        """Largest natural frequency (rad/s) that the march can have in it."""
        index = _index(self.pair.forces.indexer, self.speed)
        return self.output.frequencies_at(stiffest_of(index, self.output, self.pair.law))[-1]

    @property
    def left(self) -> float:
        """Part of the amplitude with which the output still swings when the next index starts, at most."""
        if self.amplitude[0] == 0.0:
            return 0.0
        dwell, period = self.fine.dwell, 2.0 * math.pi / self.output.frequencies[0]
        late = dwell.time >= dwell.time[-1] - period
        return (
            float(np.abs(dwell.deviation[late] - self.offset).max()) / self.amplitude[0]
            if not self.fine.stuck
            else 0.0
        )

    @property
    def balance(self) -> float:
        """Energy that is missing in index or dwell, to the work done."""
        return max(self.fine.index.balance, self.fine.dwell.balance)


def _held_off(found: Response) -> float:
    return float(found.dwell.deviation[-1]) if found.stuck else 0.0


def shaken(scene: IndexerScene, wheel: WheelMass, pairs: Mapping[str, Pair]) -> Mapping[str, Shaken]:
    """March both mechanisms, and the Geneva wheel a third time with its index in the time of the indexer's."""
    asked = dict(pairs)
    if GENEVA in pairs:
        ours, theirs = pairs[INDEXER].forces, pairs[GENEVA].forces
        speed = theirs.load.speed * theirs.indexer.half_turn / ours.indexer.half_turn
        asked[SAME_TIME] = replace(
            pairs[GENEVA], forces=replace(theirs, load=replace(theirs.load, speed=speed))
        )
    found = {}
    for name, pair in asked.items():
        try:
            found[name] = _shaken(scene, wheel, pair)
        except Infeasible as fault:
            raise Infeasible(f"{NAMES[name]}: {fault}") from fault
    return found


def output_of(scene: IndexerScene, wheel: WheelMass, pair: Pair) -> Output:
    """Return the masses and springs that a pin drives."""
    shaft, load = scene.drive.output_shaft, pair.forces.load
    far = shaft.inertia or 0.0
    made = Output(wheel.used, load.friction, lock_of(scene, pair))
    if far > 0.0:
        made = (
            replace(made, shaft=shaft.stiffness, load=far)
            if shaft.stiffness
            else replace(made, inertia=wheel.used + far)
        )
    return replace(made, damping=2.0 * scene.operation.damping_ratio / made.frequencies[0])


def lock_of(scene: IndexerScene, pair: Pair) -> float:
    """Stiffness (N·m/rad) of what holds the wheel: as given, or that of the pin at the end of an index."""
    given = scene.drive.wheel.lock_stiffness
    if given is not None:
        return given
    reach = pair.forces.indexer.reach(np.array([pair.forces.indexer.half_turn]))
    u = pair.law.pressed(np.array([pair.largest[0] * pair.pin.distance]), reach)
    return float(np.sin(reach[0]) ** 2 * pair.law.slope(u, reach)[0])


def _shaken(scene: IndexerScene, wheel: WheelMass, pair: Pair) -> Shaken:
    output, stiffer = output_of(scene, wheel, pair), 0.0
    index = _index(pair.forces.indexer, pair.forces.load.speed)
    for _ in range(TRIES):
        times = output.shaft / stiffest_of(index, output, pair.law)
        try:
            if times >= STIFF:
                raise NotConverged("its mode is far above all others")
            fine = respond(index, output, pair.law)
        except NotConverged:
            if times < STIFFISH:
                raise
            output, stiffer = _without_shaft(scene, output), times
            fine = respond(index, output, pair.law)
        lever = np.sin(index.sample(fine.index.time)[0])
        peak = float(np.abs(fine.index.torque / lever).max())
        if peak <= pair.law.largest:
            return Shaken(pair, output, fine, respond(index, output, pair.law, STEPS // 2), stiffer)
        pair = longer(pair, peak)
    raise Infeasible(_strikes(pair, peak))


def _without_shaft(scene: IndexerScene, output: Output) -> Output:
    """Return wheel and load in one."""
    made = replace(output, inertia=output.inertia + output.load, shaft=0.0, load=0.0)
    return replace(made, damping=2.0 * scene.operation.damping_ratio / made.frequencies[0])


def longer(pair: Pair, peak: float) -> Pair:
    """Return the pair with a table that reaches farther, for a moment `peak` (N·m).

    Raises Infeasible where contacts of pin and slot are no more than that: too wide for it, or yielding too far.
    """
    needed = max(1.2 * peak / pair.law.largest, 1.2)
    for times in (LARGER, *(x for x in (needed, *LESS) if x < LARGER)):
        try:
            if times * pair.law.top <= LARGE:
                return pair.longer(times)
        except TrochoidError:
            continue
    raise Infeasible(_strikes(pair, peak))


def _strikes(pair: Pair, peak: float) -> str:
    """Say what would serve: a free pin strikes with a force as its speed, and that is as √play."""
    part = pair.law.largest / peak
    play = 2e3 * pair.law.play * pair.pin.distance
    less = f"pin.play about {readable(play * part**2, 2)} mm, or " if play > 0.0 else ""
    return (
        f"the pin strikes its slot with about {readable(peak / pair.pin.distance)} N, and pin and slot of these sizes "
        f"are narrow contacts up to {readable(pair.law.largest / pair.pin.distance)} N only: give {less}"
        f"about {readable(part, 2)} times the operation.input_speed"
    )


def _index(indexer: Indexer, speed: float) -> Index:
    half, sense = indexer.half_turn, indexer.sense

    def sample(time: Array) -> tuple[Array, Array, Array]:
        t = np.clip(time * speed - half, -half, half)
        at = motion(indexer, t)
        velocity = np.maximum(sense * speed * at.velocity, 0.0)  # not less but for rounding
        return indexer.reach(t), velocity, sense * speed**2 * at.acceleration

    return Index(2.0 * half / speed, 2.0 * (math.pi - half) / speed, sample)
