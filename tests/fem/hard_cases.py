"""Contact problems that break contact solvers, each written in metres or in millimetres (`unit` per metre).

Loads are given in N/mm of face width, lengths in m; what is returned counts in the unit: gaps, N per unit of width.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from tests.fem.cases import STEEL, free_disc_smooth, hole_in_plate_green, on_circle
from trochoid.fem.complementarity import Group, Problem
from trochoid.fem.laws import HertzLine
from trochoid.fem.material import Plane
from trochoid.fem.rubbing import Rubbing, System
from trochoid.fem.strips import curve_compliance, strip_centres, strip_compliance
from trochoid.kinematics.types import Array

METRE, MILLIMETRE = 1.0, 1e3


def steel(unit: float, ratio: float = 1.0) -> Plane:
    """Return steel, `ratio` times as stiff."""
    return replace(STEEL, modulus=ratio * STEEL.modulus / unit**2, shear=ratio * STEEL.shear / unit**2)


def line_load(newtons_per_mm: float, unit: float) -> float:
    """Return a line load in N per unit of width."""
    return newtons_per_mm * 1e3 / unit


def pin_in_hole(clearance: float, load: float, ratio: float, unit: float, count: int = 72) -> Problem:
    """Press a steel pin of 20 mm in a hole of a plate `ratio` times as stiff, in a direction between two strips.

    Both bodies in closed form (see `test_conforming`), strips all round, the pin free to move in the plane.
    """
    radius, pin, plate = 0.020 * unit, steel(unit), steel(unit, ratio)
    angle = 2 * np.pi * np.arange(count) / count
    width, points, apart = np.full(count, 2 * np.pi * radius / count), on_circle(radius, angle), None
    apart = angle[:, None] - angle
    chord = 2 * radius * np.abs(np.sin(apart / 2)) + np.eye(count)
    hole = hole_in_plate_green(plate, apart + np.eye(count)) + plate.kernel * np.log(chord)
    own = plate.kernel * (np.log(radius) - 0.75) + (0.75 * (plate.kolosov - 1) + 1) / (
        4 * np.pi * plate.shear
    )
    np.fill_diagonal(hole, own - (plate.kolosov - 1) / (8 * plate.shear * radius) * width / 4)
    disc = free_disc_smooth(pin, radius, apart)
    disc[np.diag_indices(count)] += (pin.kolosov - 1) / (8 * pin.shear * radius) * width / 4
    local = curve_compliance(pin.kernel + plate.kernel, points, width) + disc + hole
    group = Group(local[None], np.full((1, count), clearance * unit), points[None] / radius)
    push = line_load(load, unit) * on_circle(1.0, np.array([0.3]))[0]
    return Problem((group,), np.zeros((1, 1)), np.zeros((2, 2)), push)


def cylinders(
    clearance: float, load: float, ratio: float, unit: float, count: int = 8, strips: int = 15
) -> Problem:
    """Press a stiff bar with cylinders under it on a half-plane, off its middle; every third one stands back.

    The cylinders are of steel and, in turn, of a material `ratio` times as stiff; the half-plane is as stiff as
    the stiffest. The bar moves down and tilts.
    """
    pitch, radius = 0.020, 0.010
    place = pitch * (np.arange(count) - 0.5 * (count - 1))
    table = steel(unit, max(1.0, ratio)).kernel
    kernel = table + np.where(np.arange(count) % 2, steel(unit, ratio).kernel, steel(unit).kernel)
    pressed = np.full(count, line_load(max(load, 1e-6), unit) / 2)
    half = HertzLine(kernel, np.full(count, radius * unit)).half_width(pressed)
    offset = strip_centres(strips) * np.minimum(half, 0.4 * pitch * unit)[:, None]
    # the datum of both logarithms is a depth of 1 m
    local = (
        strip_compliance(kernel, offset[:, 1] - offset[:, 0], strips) + (kernel * np.log(unit))[:, None, None]
    )
    apart = np.abs(place[:, None] - place) + np.eye(count)
    gap = (
        offset**2 / (2 * radius * unit) + np.where(np.arange(count) % 3 == 1, clearance * unit, 0.0)[:, None]
    )
    arms = np.stack([np.ones_like(offset), offset + place[:, None] * unit], axis=-1)
    push = line_load(load, unit) * np.array([1.0, 0.013 * unit])
    return Problem((Group(local, gap, arms),), -table * np.log(apart), np.zeros((2, 2)), push)


SHAPES: dict[str, Callable[[Array], Array]] = {
    "punch": lambda x: 0 * x,
    "open everywhere": lambda x: 1.0 + 0.1 * x**2,
    "flat, 1e-12 rough": lambda x: 1e-12 * np.sin(1e5 * x),
    "flat with a rounded edge": lambda x: np.maximum(0.0, np.abs(x) - 0.5) ** 2,
    "wedge": lambda x: np.abs(x),
    "lopsided wedge": lambda x: np.where(x < 0, -0.01 * x, x),
    "cusp": lambda x: np.sqrt(np.abs(x)),
    "sharper cusp": lambda x: np.abs(x) ** 0.1,
    "both edges": lambda x: 1.0 - x**2,
    "valley": lambda x: 1.0 - np.sqrt(np.abs(x)),
    "off an edge": lambda x: 0.5 * (x - 0.95) ** 2,
    "beyond an edge": lambda x: 0.5 * (x - 1.5) ** 2,
    "waves": lambda x: 0.01 * (1 - np.cos(9 * x)),
    "one step": lambda x: np.where(x < 0.2, 0.0, 1.0),
    "spikes": lambda x: np.where(np.arange(len(x)) % 5 == 2, 0.0, 1.0),
}


def shape(name: str, depth: float, load: float, unit: float, tilt: bool, count: int = 60) -> Problem:
    """Press a rigid body of this shape, 20 mm wide, on a steel half-plane; with `tilt` off its middle.

    `depth` in m scales the shape. The last strip lies beyond the edge: it can never touch.
    """
    half = 0.010 * unit
    x = strip_centres(count)
    local = strip_compliance(np.array([steel(unit).kernel]), np.array([2 * half / count]), count)
    local += steel(unit).kernel * np.log(unit)
    gap = depth * unit * np.asarray(SHAPES[name](x), dtype=np.float64)
    gap[-1] = np.inf
    arms = np.stack([np.ones(count), x * half], axis=-1)[:, : 2 if tilt else 1]
    push = line_load(load, unit) * np.array([1.0, -0.4 * half])[: arms.shape[1]]
    group = Group(local, gap[None], arms[None])
    return Problem((group,), np.zeros((1, 1)), np.zeros((len(push), len(push))), push)


def many(contacts: int, strips: int, unit: float) -> Problem:
    """Press a disc of 50 mm on contacts all round it, every fourth with play, by a torque and a force.

    Its centre rests on springs, it turns freely; normals lean by 0.6 rad so that they hold the torque.
    """
    radius, width = 0.050 * unit, 2e-5 * unit
    angle = 2 * np.pi * np.arange(contacts) / contacts + 0.1
    points = on_circle(radius, angle)
    normal = on_circle(1.0, angle + 0.6)
    lever = points[:, 0] * normal[:, 1] - points[:, 1] * normal[:, 0]
    chord = np.linalg.norm(points[:, None] - points, axis=-1) + 2 * radius * np.eye(contacts)
    kernel = steel(unit).kernel
    local = strip_compliance(np.full(contacts, kernel), np.full(contacts, width / radius), strips)
    offset = strip_centres(strips) * width * strips / 2
    gap = 1e-7 * unit * (1 + np.sin(7 * angle)) + np.where(np.arange(contacts) % 4 == 3, 1e-5 * unit, 0.0)
    arms = np.concatenate([normal, lever[:, None]], axis=1)[:, None].repeat(strips, axis=1)
    group = Group(local, gap[:, None] + offset**2 / (0.02 * unit), arms)
    springs = np.diag([3e10, 3e10, 0.0]) / unit**2
    push = line_load(100.0, unit) * np.array([1.0, 0.3, radius])
    return Problem((group,), -kernel * np.log(chord / (2 * radius)), springs, push)


def rubbed(friction: float, clearance: float, load: float, ratio: float, unit: float) -> System:
    """Return the `cylinders` with friction: the bar also moves sideways, and friction below it tilts it."""
    normal = cylinders(clearance, load, ratio, unit, 6, 9)
    (group,) = normal.groups
    contacts, strips = group.gap.shape
    zero, one = np.zeros((contacts, strips, 1)), np.ones((contacts, strips, 1))
    upright = Group(group.local, group.gap, np.concatenate([group.arms, zero], axis=2))
    arms = np.concatenate([zero, -0.004 * unit * one, -one], axis=2)
    along = Group(group.local, np.zeros((contacts, strips)), arms)
    nothing = np.zeros_like(normal.coupling)
    coupling = np.block([[normal.coupling, nothing], [nothing, normal.coupling]])
    return System(
        (Rubbing(upright, along, friction),), coupling, np.zeros((3, 3)), np.append(normal.load, 0.0)
    )


def held(system: System, slip: Array, pressure: Array) -> Problem:
    """Return the contact problem whose friction is bounded by μ times a `pressure` (c, m), after a `slip` (c, m)."""
    (rubbing,) = system.contacts
    most = rubbing.friction * np.maximum(pressure, 0.0)
    along = replace(rubbing.tangential, gap=-slip, lower=-most, upper=most)
    return Problem((rubbing.normal, along), system.coupling, system.springs, system.load)
