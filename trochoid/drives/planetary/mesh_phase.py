"""Where on their paths of contact the pairs of teeth of every mesh stand."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.geometry.planetary import Planetary, PlanetarySet
from trochoid.geometry.planetary_curves import poses
from trochoid.kinematics.types import Array, BoolArray

MESHES = ("sun and planet", "planet and ring")


@dataclass(frozen=True, slots=True)
class Places:
    """Radii of curvature (m) of one flank at the contact points of one mesh, (positions, planets, pairs).

    The flank is the sun's or the ring's; only places from `low` to `high` lie on the path of contact.
    """

    rho: Array
    low: float
    high: float

    @property
    def touching(self) -> BoolArray:
        """Whether each pair is on the path, (positions, planets, pairs)."""
        inside: BoolArray = (self.rho >= self.low) & (self.rho <= self.high)
        return inside


def places(
    given: PlanetarySet, set_: Planetary, carrier: Array, ring: Array, forward: bool = True
) -> tuple[Places, Places]:
    """Contacts of sun and planets and of planets and ring at the angles of carrier and ring (rad, (n,)).

    `forward`: sun and ring push the planets anticlockwise along their orbit; else they touch the other flanks.
    """
    at = poses(given, carrier, ring)
    orbit = np.arctan2(at.center[..., 1], at.center[..., 0])
    sun, planet, wheel = set_.gears
    tip1, tip2, tip3 = (float(tip) for tip in set_.tips)
    side = 1.0 if forward else -1.0
    found = []
    for gear, angle, pair, grows in ((sun, at.sun, set_.outer, 1.0), (wheel, at.ring, set_.inner, -1.0)):
        pitch_radius = float(pair.pitch_radii[0 if gear is sun else 1])
        # the flank that faces its push stands behind the space on the x axis of the wheel's frame
        turn = side * (angle[..., None] - orbit) - float(gear.flank_angle(pitch_radius))
        pitch = 2.0 * math.pi / gear.teeth
        turn = np.mod(turn + 0.5 * pitch, pitch) - 0.5 * pitch
        reach = np.arange(-3, 4) * pitch
        pole = pitch_radius * math.sin(float(pair.operating_angle))
        found.append(pole + grows * gear.base_radius * (turn[..., None] + reach))
    outer = (float(set_.outer.of_first(planet.curvature_radius(tip2))), float(sun.curvature_radius(tip1)))
    inner = (float(wheel.curvature_radius(tip3)), float(set_.inner.of_second(planet.curvature_radius(tip2))))
    return Places(found[0], *outer), Places(found[1], *inner)


def period(given: PlanetarySet, sun_on_carrier: float) -> float:
    """Input angle (rad) of one pitch of the meshes; `sun_on_carrier` is the sun's relative speed over the input's."""
    return 2.0 * math.pi / (given.teeth[0] * abs(sun_on_carrier))
