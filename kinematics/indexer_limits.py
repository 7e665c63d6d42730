"""What a swing without solution fails by, and the nearest swing that has one."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.indexer import in_wheel
from trochoid.kinematics.indexer_pin_roots import roots_by_pin
from trochoid.kinematics.indexer_roots import Roots, facing, joined, roots_by_duration
from trochoid.kinematics.indexer_synthesis import FAULTS, Place, Task, assess
from trochoid.kinematics.spherical_trochoid import Kind, pin_derivatives
from trochoid.kinematics.types import Array, BoolArray

REASONS = {
    "swing": "the slot then turns by another angle",
    "reverses": "the wheel would turn back on its way",
    "returns": "the pin would come back into the wheel while it should rest",
    "axis": "the pin would pass through the wheel's axis",
    "": "the two arm angles that solve it have become one, and there is none beyond",
}

_SWEPT = 40  # swings of a given ρ that are looked at


@dataclass(frozen=True, slots=True)
class Wish:
    """What is free in a task: k or ρ, one of them given; and the kind of path or its place, where it matters."""

    duration: float | None = None
    pin_ratio: float | None = None
    kind: Kind | None = None
    place: Place | None = None

    def __post_init__(self) -> None:
        """Refuse to have both k and ρ, or neither."""
        if (self.duration is None) == (self.pin_ratio is None):
            raise Infeasible(
                "k and ρ belong to each other once swing, planet ratio and shaft angle are given; give one of them"
            )

    @property
    def free(self) -> str:
        """Name what is given of k and ρ."""
        return f"k = {self.duration:.10g}" if self.duration is not None else f"ρ = {self.pin_ratio:.10g}"

    def __str__(self) -> str:
        """Name the wish in a message."""
        return ", ".join(x for x in (self.free, self.kind, self.place) if x)


def nearest_swing(task: Task, wish: Wish) -> tuple[float, str] | None:
    """Swing (rad) nearest to the task's that has a solution, and what binds there; None if there is none.

    Swings (or arms, for a given ρ) are tried degree by degree and the limit is then bisected: what serves over
    less than a degree may be missed.
    """
    first = next(serving_swings(task, wish), None)
    if first is None:
        return None
    inside, outside = first, task.swing
    while abs(outside - inside) > 1e-9:
        middle = 0.5 * (inside + outside)
        if _serving(task, wish, np.array([middle])).any():
            inside = middle
        else:
            outside = middle
    return inside, _binding(task, wish, inside, outside)


def serving_swings(task: Task, wish: Wish) -> Iterator[float]:
    """Swings (rad) that serve, in whole degrees for a given k, nearest to the task's first."""
    tried = _swept_swings(task, wish) if wish.duration is None else np.radians(np.arange(1.0, 360.0))
    tried = tried[np.abs(tried - task.swing).argsort()]
    if wish.duration is not None:
        yield from (float(x) for x in tried[_serving(task, wish, tried)])
        return
    for x in tried[:_SWEPT]:
        if _serving(task, wish, np.array([x])).any():
            yield float(x)


def serving_free(task: Task, wish: Wish) -> Iterator[Wish]:
    """The wish with each k or ρ that serves with the task's own swing, nearest first, in few digits.

    Every k in steps of 0.005 is tried, with all its ρ: a nearer one may lie between.
    """
    steps = np.linspace(0.005, 0.995, 199)
    roots = roots_by_duration(0.5 * task.swing, math.pi * steps, task.planet, task.shaft_angle)
    roots = roots.take((assess(roots, task).fault == 0) & _wanted(roots, wish) & (roots.pin > 1e-9))
    if wish.duration is not None:
        k = roots.half_turn / math.pi
        for x in dict.fromkeys(float(f"{x:.4g}") for x in k[np.abs(k - wish.duration).argsort()]):
            yield replace(wish, duration=x)
        return
    assert wish.pin_ratio is not None
    nearest = np.abs(np.log(roots.pin_ratio / wish.pin_ratio)).argsort()
    for x in dict.fromkeys(float(f"{x:.6g}") for x in roots.pin_ratio[nearest]):
        yield replace(wish, pin_ratio=x)


def _candidates(task: Task, wish: Wish, swings: Array) -> Roots:
    if wish.duration is not None:
        return roots_by_duration(0.5 * swings, math.pi * wish.duration, task.planet, task.shaft_angle)
    assert wish.pin_ratio is not None
    return joined(
        [roots_by_pin(float(0.5 * x), wish.pin_ratio, task.planet, task.shaft_angle) for x in swings]
    )


def _wanted(roots: Roots, wish: Wish) -> BoolArray:
    wanted = np.ones(roots.arm.shape, dtype=bool)
    if wish.kind is not None:
        wanted &= (roots.ratio > 0.0) == (wish.kind == "epi")
    if wish.place is not None:
        wanted &= (np.cos(roots.phase) * roots.arm > 0.0) == (wish.place == "far")
    return wanted


def _serving(task: Task, wish: Wish, swings: Array) -> BoolArray:
    """Which of the swings (n,) have a solution that serves."""
    roots = _candidates(task, wish, swings)
    good = (assess(roots, task).fault == 0) & _wanted(roots, wish)
    serving: BoolArray = np.isin(0.5 * swings, roots.half_swing[good])
    return serving


def _swept_swings(task: Task, wish: Wish) -> Array:
    """Swings (rad) of mechanisms with the wanted ρ and arms degree by degree, from the middle to the first rest."""
    assert wish.pin_ratio is not None
    degrees = np.concatenate((np.arange(-179.0, 0.0), np.arange(1.0, 180.0)))
    arm, m, sign = (
        x.ravel()[:, None] for x in np.meshgrid(np.radians(degrees), [task.planet, -task.planet], [1.0, -1.0])
    )
    pin = np.arctan(wish.pin_ratio * np.sin(np.abs(arm)) / (task.planet + np.sign(m) * np.cos(arm)))
    phi = np.linspace(0.0, math.pi, 36 * task.planet + 1)
    phase = np.where(sign < 0.0, math.pi, 0.0)
    zeta = in_wheel(pin_derivatives(arm, pin, m, phase, phi, 1), task.shaft_angle)
    velocity = (zeta[1] / zeta[0]).imag
    turning = velocity * velocity[:, :1] > 0.0
    rests = ~turning.all(axis=-1)
    last = np.maximum(turning.argmin(axis=-1), 1)
    row = np.arange(arm.size)
    before, after = velocity[row, last - 1], velocity[row, last]
    rests &= before != after
    half_turn = phi[last] - (phi[1] * after / np.where(rests, after - before, 1.0))
    end = in_wheel(
        pin_derivatives(arm[:, 0], pin[:, 0], m[:, 0], phase[:, 0], half_turn, 0), task.shaft_angle
    )
    roots = facing(
        arm[:, 0],
        (sign * pin)[:, 0],
        m[:, 0],
        np.sign(velocity[:, 0]),
        half_turn,
        np.abs(np.angle(end[0])),
        task.shaft_angle,
    )
    roots = roots.take((roots.half_turn > 0.0) & (roots.half_turn < math.pi))
    swings: Array = 2.0 * roots.half_swing[(assess(roots, task).fault == 0) & _wanted(roots, wish)]
    return swings


def _binding(task: Task, wish: Wish, inside: float, outside: float) -> str:
    """Say what becomes of the solution that serves at the swing `inside` at the one just `outside`."""
    roots = _candidates(task, wish, np.array([inside, outside]))
    fault = assess(roots, task).fault
    here = roots.half_swing == 0.5 * inside
    good = np.flatnonzero(here & (fault == 0) & _wanted(roots, wish))
    if good.size == 0:
        return REASONS[""]
    one = good[0]
    far = np.abs(roots.arm - roots.arm[one]) + np.abs(roots.half_turn - roots.half_turn[one])
    far[here | (roots.ratio != roots.ratio[one]) | (roots.sense != roots.sense[one])] = math.inf
    next_to = int(far.argmin())
    if not far[next_to] < 1e-3:
        at_middle = task.shaft_angle - roots.arm[one] - roots.pin[one] * math.cos(roots.phase[one])
        return REASONS["axis" if math.sin(at_middle) < 1e-6 else ""]
    if fault[next_to] == 0:
        return "near and far have become one, with the pin on the planet's axis"
    return REASONS[FAULTS[fault[next_to]]]
