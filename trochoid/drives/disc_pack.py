"""A pack of equal cycloid discs whose cranks are spread evenly: places, and which of them are the same body turned."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Disc:
    """One disc in the pack: which body it is made from, and how that body sits.

    `lead` of the body's frame on the profile frame (whole lobes, rad), `first_hole` that roller 0 finds,
    axial place `z` in m, `crank` angle ahead of disc 0.
    """

    body: int
    lead: float
    first_hole: int
    z: float
    crank: float


def pack(
    count: int, lobes: int, holes: int, pitch: float, phase: float = 0.0
) -> tuple[tuple[Disc, ...], tuple[float, ...]]:
    """Place discs `pitch` (m) apart; those that are the same body turned by whole lobes and holes share it.

    Returns the discs and, for each distinct body, the angle (rad) of its first hole, `phase` on disc 0.
    Disc i runs i/n of a turn ahead, so its holes lead its profile by i/(n z_c) of a turn. It is disc 0 turned
    if that is a whole number of lobes plus a whole number of holes: for n | z_p and n | z_w always (sources
    §3), and in more cases.
    """
    bodies: list[Fraction] = []
    discs = []
    for i in range(count):
        lead = Fraction(i, count * lobes)
        z = (i - 0.5 * (count - 1)) * pitch
        crank = 2 * math.pi * i / count
        match = _same_body(bodies, lead, lobes, holes)
        if match is None:
            bodies.append(lead)
            match = len(bodies) - 1, 0, 0
        body, turned, first = match
        discs.append(Disc(body, 2 * math.pi * turned / lobes, first, z, crank))
    return tuple(discs), tuple(phase + 2 * math.pi * float(b) for b in bodies)


def _same_body(bodies: list[Fraction], lead: Fraction, lobes: int, holes: int) -> tuple[int, int, int] | None:
    for number, own in enumerate(bodies):
        for turned in range(lobes):
            first = (lead - own - Fraction(turned, lobes)) * holes
            if first.denominator == 1:
                return number, turned, int(first) % holes
    return None


def circle(radius: float, count: int, start: float = 0.0) -> Array:
    """Return `count` equally spaced points (count, 2) of a circle about the origin."""
    angle = start + 2 * np.pi * np.arange(count) / count
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
