"""Gear pairs that several test modules set up."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from tests.geometry.gear_cases import external, ring
from trochoid.fem.gear_body import GearBody, press_gear
from trochoid.fem.gear_flank import Flank, Relief
from trochoid.fem.gear_mesh import Wheel, conjugate_angle, flank_pair
from trochoid.fem.gear_pair import GearPair
from trochoid.fem.gear_path import Mating
from trochoid.fem.material import Material, PlaneState
from trochoid.fem.pair import Member
from trochoid.geometry.gear_outline import Blank
from trochoid.geometry.gear_tooth import Tooth
from trochoid.kinematics.involute_pair import Pair, mesh, mesh_at
from trochoid.kinematics.types import Array

WIDTH, LINE_LOAD = 38e-3, 200e3  # m, N/m
CENTERS = 52e-3
FIRST, SECOND = np.eye(3, 6), np.eye(3, 6, 3)  # six motions: x, y, rotation of either member


@lru_cache(maxsize=4)
def teeth_20_30() -> tuple[Tooth, Tooth, Pair]:
    """Return sun and planet of the set of sources §4: m 2 mm, x 0.5/0.634, at 52 mm."""
    one, two = external(20, 0.5), external(30, 0.634)
    pair = mesh_at(one.gear, two.gear, CENTERS)
    short = float(pair.tip_shortening)
    return external(20, 0.5, short), external(30, 0.634, short), pair


@lru_cache(maxsize=32)
def body(
    tooth: Tooth,
    rim: float,
    level: int,
    state: PlaneState = "strain",
    modulus: float = 210e9,
    held: bool = True,
) -> GearBody:
    """Return a pressed steel gear."""
    return press_gear(Blank(tooth, rim), Material(modulus, 0.3).plane(state), level, held)


def sun_planet(level: int = 6, state: PlaneState = "strain", line_load: float = LINE_LOAD) -> Mating:
    """Return 20/30 with bores of half the pitch radii held, under a load per width along the line of action."""
    one, two, _ = teeth_20_30()
    wheels = Wheel.of(body(one, 10e-3, level, state), WIDTH), Wheel.of(body(two, 15e-3, level, state), WIDTH)
    return Mating(wheels, CENTERS, line_load * WIDTH * wheels[1].flank.base_radius)


def unshifted(teeth: tuple[int, int], state: PlaneState, level: int = 8) -> tuple[Mating, Pair]:
    """Return a pair with x = 0, m 2 mm, b 20 mm, 206 GPa, bores of half the pitch radii held, 200 N/mm."""
    made = tuple(external(z) for z in teeth)
    wheels = tuple(Wheel.of(body(t, 0.5 * t.gear.pitch_radius, level, state, 206e9), 20e-3) for t in made)
    pair = mesh(made[0].gear, made[1].gear)
    torque = LINE_LOAD * 20e-3 * wheels[1].flank.base_radius
    return Mating((wheels[0], wheels[1]), float(pair.center_distance), torque), pair


def planet_ring(level: int = 6) -> Mating:
    """Return 30/80 of the set of sources §4, the ring held at its outer edge."""
    _, planet, _ = teeth_20_30()
    wheels = Wheel.of(body(planet, 15e-3, level), WIDTH), Wheel.of(body(ring(), 92e-3, level), WIDTH)
    return Mating(wheels, CENTERS, LINE_LOAD * WIDTH * wheels[1].flank.base_radius)


def rigid_pair(
    teeth: tuple[Tooth, Tooth],
    hand: int,
    angle: Array,
    reliefs: tuple[tuple[Relief, ...], tuple[Relief, ...]] = ((), ()),
    centers: float = CENTERS,
) -> GearPair:
    """Return flanks without bodies at angles (n,) of the first gear, unrelieved flanks touching, both members free."""
    flanks = Flank.of(teeth[0], reliefs[0]), Flank.of(teeth[1], reliefs[1])
    one = Member(np.array([1e-3, -2e-3]), angle, FIRST)
    two = Member(np.array([1e-3, -2e-3]) + centers * np.array([0.6, 0.8]), 0.0, SECOND)
    turned = Member(two.center, conjugate_angle(flanks, (one, two), hand), SECOND)
    return flank_pair(flanks, (one, turned), hand, 1e-4)
