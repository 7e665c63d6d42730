"""What an indexer puts on its casing over a turn of the arm, index and dwell, place by place about the sphere's centre.

    input shaft    what pin and teeth put on the arm, but for its turn about z
    motor          the stator of the motor, which stands on the casing: the input torque, the other way
    fixed wheel    the bevel wheel on which the planet rolls
    output shaft   what the pin puts on the wheel, but for its turn about its axis
    lock           what holds the wheel in the dwell, against the casing; of the elastic drive alone

Friction that brakes the output is another machine's. So all of it together is −dL/dt of what turns with the wheel,
and that friction torque. A load jumps where a soft shock begins: its lines up to the band's end are those of the whole
course, not of samples at positions.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from trochoid.drives.indexer.forces import Forces, State
from trochoid.drives.indexer.shaken import Shaken
from trochoid.dynamics.indexing import Response
from trochoid.dynamics.vibration import BAND
from trochoid.dynamics.wrench import Wrench, balance_residual
from trochoid.kinematics.indexer import Indexer, motion
from trochoid.kinematics.types import Array, frozen

FIXED, ARM, WHEEL, MOTOR, LOCK = "fixed wheel", "input shaft", "output shaft", "motor", "lock"
POINTS = 8193  # of a rigid index
CELLS = 16  # to a line: of the averages that lines are read from, off by 1/(4 CELLS²) where the load jumps
LEAST, MOST = 8, 4096  # lines of a record


@dataclass(frozen=True, eq=False, slots=True)
class Cycle:
    """Loads over one turn of the arm: straight between the instants `time` (n,), s from the start of the index.

    Two equal instants are a jump. `places`: force and moment (n, 6) on the casing; `torque` (n,) of pin or lock on the
    wheel about −o, N·m.
    """

    time: Array
    period: float
    places: Mapping[str, Array]
    torque: Array
    axis: Array

    def residual(self) -> float:
        """Return how far all places together are from what the wheel's torque leaves, relative."""
        left = Wrench(*_split(-self.torque[:, None] * np.concatenate([np.zeros(3), self.axis])), np.zeros(3))
        return balance_residual([*(Wrench(*_split(x), np.zeros(3)) for x in self.places.values()), left])

    def records(self, lines: int) -> dict[str, Wrench]:
        """Return each place's load at 2·lines + 1 even instants of a turn, with no more than these lines in it."""
        return {
            name: Wrench(*_split(record(self.time, values, self.period, lines)), frozen(np.zeros(3)))
            for name, values in self.places.items()
        }

    def whole(self, lines: int) -> Wrench:
        """Return the resultant of `records`."""
        values = np.sum(list(self.places.values()), axis=0)
        return Wrench(*_split(record(self.time, values, self.period, lines)), frozen(np.zeros(3)))


def rigid_cycle(forces: Forces) -> Cycle:
    """Return what the rigid drive puts on its casing; nothing in the dwell."""
    half = forces.indexer.half_turn
    t = np.linspace(-half, half, POINTS)
    state, speed = forces.state(t), forces.load.speed
    time = np.append((t + half) / speed, [2.0 * half / speed, 2.0 * math.pi / speed])
    return _cycle(forces, time, state, state.torque, np.zeros(2))


def elastic_cycle(x: Shaken, found: Response | None = None) -> Cycle:
    """Return what the elastic drive puts on its casing, by its finer march or the one that is given.

    After the end of a march whose output has come to rest the lock holds what friction leaves, else nothing.
    """
    found = x.fine if found is None else found
    forces = x.pair.forces
    half, sense, speed = forces.indexer.half_turn, forces.indexer.sense, x.speed
    t = np.clip(x.angle(found.index.time), -half, half)
    state = forces.under(t, sense * x.pin_force(found))
    start, end = 2.0 * half / speed, 2.0 * math.pi / speed
    held = sense * found.dwell.torque
    last = float(held[-1]) if found.stuck else 0.0
    dwell = np.minimum(start + found.dwell.time, end)
    time = np.concatenate([found.index.time, dwell, [dwell[-1], end]])
    return _cycle(forces, time, state, sense * found.index.torque, np.append(held, [last, last]))


def inertia_residual(forces: Forces, cycle: Cycle) -> float:
    """Return how far a rigid drive's loads are from −dL/dt of the wheel and the friction torque, relative."""
    speed, load = forces.load.speed, forces.load
    inside = slice(0, -2)
    t = cycle.time[inside] * speed - forces.indexer.half_turn
    turned = load.inertia * speed**2 * motion(forces.indexer, t).acceleration
    torque = np.append(turned + forces.indexer.sense * load.friction, [0.0, 0.0])
    return Cycle(cycle.time, cycle.period, cycle.places, torque, cycle.axis).residual()


def lines_for(base: float) -> int:
    """Return how many lines, multiples of `base` in Hz, a record needs for the band, or may have."""
    return min(max(math.ceil(BAND[1] / base * (1.0 - 1e-12)), LEAST), MOST)


def record(time: Array, values: Array, period: float, lines: int) -> Array:
    """Return values (2·lines + 1, k) at even instants of one period, with the lines of the course up to `lines`.

    `values` (n, k) at `time` (n,) from 0 to the period. Averages over small cells are exact, and have the course's
    lines times sin(x)/x.
    """
    cells = CELLS * (2 * lines + 1)
    edge = period / cells * np.arange(cells + 1)
    step = np.diff(time)[:, None]
    area = np.concatenate(
        [np.zeros((1, values.shape[1])), np.cumsum(0.5 * step * (values[1:] + values[:-1]), 0)]
    )
    i = np.clip(np.searchsorted(time, edge, side="right") - 1, 0, len(step) - 1)
    past, width = (edge - time[i])[:, None], step[i]
    slope = np.divide(
        np.diff(values, axis=0)[i], width, out=np.zeros((cells + 1, values.shape[1])), where=width > 0.0
    )
    mean = np.diff(area[i] + past * (values[i] + 0.5 * past * slope), axis=0) * (cells / period)
    order = np.arange(lines + 1)
    found = np.fft.rfft(mean, axis=0)[: lines + 1] / cells
    found = found * (np.exp(-1j * math.pi * order / cells) / np.sinc(order / cells))[:, None]
    count = 2 * lines + 1
    return np.asarray(np.fft.irfft(found * count, n=count, axis=0), dtype=np.float64)


def _cycle(forces: Forces, time: Array, state: State, torque: Array, held: Array) -> Cycle:
    """Join the index, by its `state` and the `torque` on the wheel, and the dwell with what holds it."""
    made = forces.indexer
    rest = np.zeros((len(held), 6))
    places = {name: np.concatenate([each, rest]) for name, each in _pressed(made, state).items()}
    lock = np.zeros((len(time), 6))
    lock[len(torque) :, 3:] = held[:, None] * made.axis
    speed = forces.load.speed
    return Cycle(time, 2.0 * math.pi / speed, places | {LOCK: lock}, np.append(torque, held), made.axis)


def _pressed(indexer: Indexer, state: State) -> dict[str, Array]:
    z = np.array([0.0, 0.0, 1.0])
    motor = np.zeros_like(state.on_arm)
    motor[:, 5] = -state.input_torque
    return {
        FIXED: state.on_fixed,
        ARM: _held(state.on_arm, z),
        WHEEL: _held(state.on_wheel, indexer.axis),
        MOTOR: motor,
    }


def _held(load: Array, axis: Array) -> Array:
    """Return what bearings of a shaft hold of a load (n, 6): all but its moment about the axis."""
    moment = load[:, 3:]
    return np.concatenate([load[:, :3], moment - (moment @ axis)[:, None] * axis], axis=1)


def _split(load: Array) -> tuple[Array, Array]:
    return frozen(load[:, :3]), frozen(load[:, 3:])
