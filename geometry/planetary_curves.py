"""The flanks of a planetary set as exact curves, and where its members stand at a carrier angle."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.geometry.planetary import PlanetarySet, planetary
from trochoid.kinematics.involute_curve import GearCurve
from trochoid.kinematics.rack import Rack, rack_cut
from trochoid.kinematics.shaper import shaper_cut
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Members:
    """Sun, planet and ring, each in its own frame with a space on the x axis; the ring's curve is that of a hole."""

    sun: GearCurve
    planet: GearCurve
    ring: GearCurve


@dataclass(frozen=True, eq=False, slots=True)
class Poses:
    """Angles (rad) of the members' frames and planet centres (m); leading axes are those of the carrier angle."""

    sun: Array
    planet: Array  # (..., planets)
    center: Array  # (..., planets, 2)
    ring: Array


def members(given: PlanetarySet, rounding: float = 0.38) -> Members:
    """Sun and planet cut by a rack with tip rounding ρ_f* (modules), the ring by the set's cutter.

    Raises Infeasible where a tool cannot cut or a tip circle does not fit.
    """
    sun, planet, ring = given.gears()
    rack = Rack(given.module, given.pressure_angle, given.addendum + given.clearance, rounding)
    tips = [float(tip) for tip in planetary(given).tips]
    return Members(
        GearCurve(rack_cut(sun, rack), tips[0]),
        GearCurve(rack_cut(planet, rack), tips[1]),
        GearCurve(shaper_cut(ring, given.cutter), tips[2]),
    )


def poses(given: PlanetarySet, carrier: npt.ArrayLike, ring: npt.ArrayLike = 0.0) -> Poses:
    """Where the members stand at the angles of carrier and ring (rad, any one shape).

    At zero, the first planet lies on the x axis with a tooth in the space of the ring there.
    """
    z1, z2, z3 = given.teeth
    carrier, ring = np.broadcast_arrays(np.asarray(carrier, float), np.asarray(ring, float))
    place = carrier[..., None] + 2.0 * math.pi * np.arange(given.planets) / given.planets
    relative = place - ring[..., None]
    # the planet's frame has a space on its x axis, half a pitch from a tooth
    planet = place - relative * z3 / z2 + math.pi / z2
    # a planet with an even number of teeth shows the sun a tooth, one with an odd number a space
    sun = carrier + (carrier - ring) * z3 / z1 + (0.0 if z2 % 2 == 0 else math.pi / z1)
    center = given.center_distance * np.stack((np.cos(place), np.sin(place)), axis=-1)
    return Poses(sun, planet, center, ring)
