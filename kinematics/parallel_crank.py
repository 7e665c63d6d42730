"""Output pins in the holes of cycloid discs: which of them carry, and whether the discs are one part.

Sources §3.  A parallel crank turns disc and flange alike; with D_o = d_b + 2e every roller touches its hole on
the side of the eccentricity, but only half of them are on the side that pushes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class LoadedPins:
    """Output pins that carry load on a rigid disc.

    Least and most, each half the time where they differ, leave out the instants when pins stand in line with
    the eccentricity: then `in_line` carry, `instants` times per turn of the eccentricity past the pins.
    """

    mean: float
    least: int
    most: int
    in_line: int
    instants: int


def loaded_output_pins(count: int) -> LoadedPins:
    """Pins that carry: n/2 of an even number, (n − 1)/2 and (n + 1)/2 of an odd one; raises Infeasible.

    Sources §3 prints n/2 and n/2 − 1 by turns; the latter is met only with two pins in line.
    """
    if count < 3:
        raise Infeasible(
            f"{count} output pins: at least 3 are needed to carry in every position; 3 … 12 are usual"
        )
    even = count % 2 == 0
    in_line = count // 2 - 1 if even else count // 2
    return LoadedPins(0.5 * count, count // 2, (count + 1) // 2, in_line, count if even else 2 * count)


def loaded_at(count: int, turn: Fraction) -> int:
    """Pins that carry when the first stands `turn` (turns) from the eccentricity: those with 0 < γ < 1/2."""
    places = ((turn + Fraction(j, count)) % 1 for j in range(count))
    return sum(0 < place < Fraction(1, 2) for place in places)


def output_pin_forces(torque: float, circle_radius: float, count: int, angle: npt.ArrayLike) -> Array:
    """Forces Q_j = T sin γ_j/(ρ_w Σ sin² γ) (…, count), N, of equal springs on a rigid disc; 0 where γ_j pulls away.

    Torque in N·m, radius ρ_w in m; `angle` (…), rad, is that of the first pin from the eccentricity.
    """
    gamma = np.asarray(angle, dtype=np.float64)[..., None] + 2.0 * math.pi * np.arange(count) / count
    push = np.maximum(0.0, np.sin(gamma))
    return np.asarray(torque * push / (circle_radius * np.sum(push**2, axis=-1, keepdims=True)))


def distinct_discs(discs: int, pins: int, lobes: int, holes: int) -> int:
    """How many different parts n equally phased discs are; 1 if n divides (z_p − z_c) z_w/gcd(z_w, z_c).

    The holes of disc i lead its profile by i (z_p − z_c)/(n z_c) of a turn, which must be whole lobes and whole
    holes together for disc i to be disc 0 turned.  With z_p − z_c = 1, n | z_p and n | z_w are enough, not needed.
    """
    return discs // math.gcd(discs, (pins - lobes) * holes // math.gcd(holes, lobes))


def identical_disc_faults(discs: int, pins: int, lobes: int, holes: int) -> tuple[str, ...]:
    """The reason why the discs are not one part, with the nearest numbers that make them so; empty if they are."""
    parts = distinct_discs(discs, pins, lobes, holes)
    if parts == 1:
        return ()
    fewer, more = (
        next((k for k in numbers if distinct_discs(discs, pins, lobes, k) == 1), None)
        for numbers in (range(holes - 1, 2, -1), range(holes + 1, holes + discs * lobes + 1))
    )
    near = " or ".join(str(k) for k in (fewer, more) if k is not None)
    numbers = [k for k in range(discs - 1, 0, -1) if distinct_discs(k, pins, lobes, holes) == 1]
    return (
        f"{discs} discs with {lobes} lobes and {holes} holes are {parts} different parts: "
        f"{discs} must divide (pins − lobes)·holes/gcd(holes, lobes) = "
        f"{(pins - lobes) * holes // math.gcd(holes, lobes)}; take {near} holes, or {numbers[0]} "
        f"{'disc' if numbers[0] == 1 else 'discs'}",
    )
