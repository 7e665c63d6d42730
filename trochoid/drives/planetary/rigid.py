"""Torques and forces of rigid members with all planets alike: what equilibrium alone says."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from trochoid.drives.planetary.design import Design
from trochoid.kinematics.train import Speeds


@dataclass(frozen=True, slots=True)
class Mesh:
    """Force of a mesh of one planet (N) along the line of action and in its parts on the operating pitch circles,
    and the pressure angle there (rad).
    """

    normal: float
    tangential: float
    radial: float
    angle: float


@dataclass(frozen=True, slots=True)
class Rigid:
    """External torques (N·m) on sun, ring and carrier and their speeds (rad/s), positive with the driving member;
    forces of one planet: in its meshes and on its bearing, `tangential` in its orbit's direction, `radial` outward
    (N).
    """

    torques: Mapping[str, float]
    speeds: Mapping[str, float]
    outer: Mesh
    inner: Mesh
    tangential: float
    radial: float
    centrifugal: float

    @property
    def power(self) -> float:
        """Power through the set, W."""
        return max(self.torques[name] * self.speeds[name] for name in self.torques)

    @property
    def bearing(self) -> float:
        """Force on the bearing of one planet, N."""
        return math.hypot(self.tangential, self.radial)

    @property
    def residuals(self) -> tuple[float, float]:
        """Sum of torques over the largest, and sum of powers over the largest."""
        powers = [self.torques[name] * self.speeds[name] for name in self.torques]
        return _sum(list(self.torques.values())), _sum(powers)


def rigid(design: Design, turning: Speeds, planet_mass: float) -> Rigid:
    """Balance the torques T_sun : T_ring : T_carrier = z1 : z3 : −(z1 + z3) under the output's load.

    `planet_mass` (kg) is 0 where inertia is not in the equations.
    """
    d, set_ = design.drive, design.geometry
    speed = design.scene.operation.input_speed
    member = {name: float(value) * speed for name, value in turning.members.items()}
    parts = {"sun": float(d.z_sun), "ring": float(d.z_ring), "carrier": -float(d.z_sun + d.z_ring)}
    load = -math.copysign(design.scene.operation.output_torque, member[d.driven])
    torques = {name: load * part / parts[d.driven] for name, part in parts.items()}
    per_planet = torques["sun"] / d.planets
    sun, _, _ = set_.gears
    normal = abs(per_planet) / sun.base_radius
    outer, inner = (_mesh(normal, float(pair.operating_angle)) for pair in (set_.outer, set_.inner))
    centrifugal = planet_mass * member["carrier"] ** 2 * d.center_distance
    tangential = math.copysign(outer.tangential + inner.tangential, per_planet)
    # the sun pushes the planet outward, the ring inward
    radial = outer.radial - inner.radial + centrifugal
    return Rigid(torques, member, outer, inner, tangential, radial, centrifugal)


def _mesh(normal: float, angle: float) -> Mesh:
    return Mesh(normal, normal * math.cos(angle), normal * math.sin(angle), angle)


def _sum(values: list[float]) -> float:
    largest = max(map(abs, values))
    return abs(math.fsum(values)) / largest if largest > 0.0 else 0.0
