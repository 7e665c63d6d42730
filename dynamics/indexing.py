"""A wheel that is driven by a pin through an elastic contact, stopped, and held: one mass, or two with a shaft.

The pin prescribes an angle ψ(t), the wheel lags behind by d, its load behind the wheel by e (a shaft's twist):

    J1 θ1'' = s N(s d) + β s² N' d' − (k e + β k e'),   J2 θ2'' = k e + β k e' − M_f sign θ2',
    θ1 = ψ − d,   θ2 = θ1 − e,

s(t) the sine of the angle α from the wheel's axis to the pin, N(u) the contact.  In the dwell ψ rests and a lock with a
constant stiffness takes the place of the contact.  The fourth-order method of Runge and Kutta with steps that are a
part of the shortest period; Coulomb friction sticks and slips at instants found within a step.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from trochoid.dynamics.indexing_march import March
from trochoid.dynamics.indexing_parts import Output, State
from trochoid.dynamics.pin_law import PinLaw
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.readable import readable
from trochoid.kinematics.types import Array

STEPS = 64  # per shortest period
MOST = 64_000  # steps of an index
RIGID = 100.0  # periods of the lowest mode in an index, beyond which it is as good as rigid


@dataclass(frozen=True, eq=False, slots=True)
class Index:
    """One index and its dwell: `duration` and `rest` in s, and `sample`, which gives for instants (n,) from the start
    of the index the angle α (rad), and ψ', ψ'' in the sense of the index, (n,) each.
    """

    duration: float
    rest: float
    sample: Callable[[Array], tuple[Array, Array, Array]]


@dataclass(frozen=True, eq=False, slots=True)
class Course:
    """Over the instants `time` (n,): `lag` d and `twist` e (rad), their rates, and the `torque` on the wheel, N·m.

    `base` (n,) is ψ'; `balance` is the energy that is missing at the end, to the work done.
    """

    time: Array
    lag: Array
    rate: Array
    twist: Array
    twist_rate: Array
    torque: Array
    base: Array
    balance: float

    @property
    def deviation(self) -> Array:
        """How far the output is from where a rigid drive would have it (n,), rad."""
        return np.asarray(-self.lag - self.twist)

    @property
    def speed(self) -> Array:
        """Speed of the output less that of a rigid drive (n,), rad/s."""
        return np.asarray(-self.rate - self.twist_rate)


@dataclass(frozen=True, eq=False, slots=True)
class Response:
    """Courses of the index and of the dwell that follows, time from the start of each; `stuck`: friction holds it."""

    index: Course
    dwell: Course
    stuck: bool


def respond(index: Index, output: Output, law: PinLaw, steps: int = STEPS) -> Response:
    """March through an index and its dwell, from rest without load; `steps` per shortest period.

    Contact, lock and shaft are damped by β of their stiffness, but no more than the masses on each alone critically:
    beyond that a wall would strike a pin that hardly moves.
    Raises NotConverged where an index holds more periods than can be followed.
    """
    stiffest = stiffest_of(index, output, law)
    damping = min(output.damping, 2.0 / math.sqrt(stiffest / output.inertia))
    if output.shaft > 0.0:
        output = replace(output, damping=min(output.damping, 2.0 / output.shaft_frequency))
    h = 2.0 * math.pi / (steps * output.frequencies_at(stiffest)[-1])
    decay = damping * stiffest / output.inertia + output.damping * output.shaft_frequency**2
    if decay > 0.0:
        h = min(h, 2.0 / decay)  # else the method is not stable: of few steps, strongly damped
    count = math.ceil(index.duration / h)
    if count > MOST:
        raise NotConverged(_too_many(index, output, stiffest, count, steps))
    at = index.sample(np.linspace(0.0, index.duration, 2 * count + 1))
    start = (0.0, float(at[1][0]), 0.0, 0.0, 0.0, 0.0)
    march = March(output, law.torque(damping))
    h_index = index.duration / count
    states, grip = march.run(at, h_index, start, march.begin(start, start[1], True))
    d, p, e, g = (float(x) for x in states[-1, :4])
    dwell, held = _dwell(index.rest, h, output, damping, (d, p, e, g, 0.0, 0.0), grip.held)
    return Response(_course(march, at, h_index, states), dwell, held)


def stiffest_of(index: Index, output: Output, law: PinLaw) -> float:
    """Return the largest stiffness (N·m/rad) that contact and lock have about the wheel's axis, over an index."""
    reach = index.sample(np.linspace(0.0, index.duration, 65))[0]
    return max(output.lock, float((np.sin(reach) ** 2 * law.stiffest(reach)).max()))


def _too_many(index: Index, output: Output, stiffest: float, count: int, steps: int) -> str:
    """Say what an index has too many of, and what to change."""
    modes, over, turn = output.frequencies_at(stiffest), count / MOST, 2.0 * math.pi
    periods, lowest = (index.duration * x / turn for x in (modes[-1], modes[0]))
    speed = f"take {readable(over)} times the speed"
    if lowest > RIGID or len(modes) == 1:
        end = f"so slow a drive is as good as rigid: leave the vibration out, or {speed}"
    elif output.shaft > stiffest:
        end = (
            f"they are those of wheel and load on the output shaft, which is {readable(output.shaft / stiffest)} times "
            f"as stiff as pin and slot: leave out its stiffness, and it is rigid, or {speed}"
        )
    else:
        end = (
            f"its lowest mode, the load on the shaft, has {readable(lowest)} of its own, the wheel on its pin is that "
            f"much faster: give the wheel {readable(over**2)} times the inertia, or {speed}"
        )
    return (
        f"response of the wheel: the index lasts {readable(periods)} of its shortest natural periods "
        f"({turn / modes[-1]:.3g} s), and no more than {readable(periods / over)} are followed; {end}"
    )


def _dwell(
    rest: float, h: float, output: Output, damping: float, start: State, held: bool
) -> tuple[Course, bool]:
    """March in steps of about h through the dwell, or until nothing moves; deviations from a base at rest."""
    k, damp = output.lock, damping * output.lock
    march = March(output, lambda d, p, _: k * d + damp * p, rest=True)
    count = min(max(math.ceil(rest / h), 1), MOST)
    h = min(h, rest / count)
    still = np.zeros(2 * count + 1)
    at = (still + 1.0, still, still)
    states, grip = march.run(at, h, start, march.begin(start, 0.0, held))
    return _course(march, at, h, states), grip.held


def _course(march: March, at: tuple[Array, Array, Array], h: float, states: Array) -> Course:
    n = len(states)
    reach, base = (x[: 2 * n : 2] for x in at[:2])
    d, p, e, g = states[:, :4].T
    rows = zip(d.tolist(), p.tolist(), reach.tolist(), strict=True)
    torque = np.array([march.torque(*row) for row in rows])
    time = np.asarray(np.arange(n) * h, dtype=np.float64)
    return Course(time, d, p, e, g, torque, base, _missing(march.output, states, base))


def _missing(output: Output, states: Array, base: Array) -> float:
    """Energy that is neither in the masses and the shaft nor lost, to the most that there was."""
    first, last = (_state(states[i]) for i in (0, -1))
    before, after = output.energy(first, float(base[0])), output.energy(last, float(base[-1]))
    speed, twist, back = base - states[:, 1], states[:, 2], states[:, 3]
    kinetic = output.inertia * speed**2 + output.load * (speed - back) ** 2
    most = 0.5 * (kinetic + output.shaft * twist**2)
    size = last[5] + float(most.max())
    return abs(last[4] - last[5] + before - after) / size if size > 0.0 else 0.0


def _state(row: Array) -> State:
    d, p, e, g, work, loss = row.tolist()
    return d, p, e, g, work, loss
