"""What an involute planetary set is made of, read from a scene. No solver, no mesh."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from trochoid.geometry.planetary import Planetary, PlanetarySet, planetary
from trochoid.geometry.planetary_check import planetary_faults
from trochoid.geometry.planetary_quality import Limits
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute_pair import mesh_at, needed_shift
from trochoid.kinematics.shaper import Shaper
from trochoid.kinematics.types import Array
from trochoid.scene.drive_planetary import PlanetaryDrive, PlanetaryScene

if TYPE_CHECKING:
    from trochoid.drives.planetary.bearings import PlanetSeat

ROLLER = 1.732  # diameter of the rollers to measure over, in modules


@dataclass(frozen=True)
class Design:
    """The set as the wings see it, in SI; `rounding` of the rack's tip in modules, `roller` diameter in m.

    `sums` are x1 + x2 and x3 − x2 that mesh without play at the centre distance.
    """

    scene: PlanetaryScene
    given: PlanetarySet
    sums: tuple[float, float]
    rounding: float
    roller: float
    limits: Limits

    @property
    def drive(self) -> PlanetaryDrive:
        """The scene's [drive] table."""
        return self.scene.drive

    @cached_property
    def geometry(self) -> Planetary:
        """Circles, meshes and boundaries; raises Infeasible where teeth cannot reach each other."""
        return planetary(self.given)

    @cached_property
    def planet_seat(self) -> PlanetSeat | None:
        """The rolling bearing of a planet, None where the scene has none. Raises Infeasible if it resists nothing."""
        from trochoid.drives.planetary.bearings import planet_seat

        return planet_seat(self)

    def seat_stiffness(self, center: Array) -> Array | float:
        """Stiffness of the bearing of a planet at a place (2,), N/m: one number, or (2, 2) along x and y."""
        given = self.drive.planet.bearing_stiffness
        if given is not None:
            return given
        assert self.planet_seat is not None
        return self.planet_seat.at(center)

    @property
    def relief_length(self) -> float:
        """Length of the tip reliefs along the line of action, m: half of where two pairs touch in the outer mesh."""
        if self.drive.tip_relief_length is not None:
            return self.drive.tip_relief_length
        outer, (sun, planet, _) = self.geometry.outer, self.geometry.tips
        pitch = math.pi * self.drive.module * math.cos(self.drive.pressure_angle)
        return 0.5 * max(0.1, float(outer.contact_ratio(sun, planet)) - 1.0) * pitch

    @property
    def bores(self) -> tuple[float, float, float]:
        """Bore radii of sun and planet and the outer radius of the ring, m."""
        d, (sun, planet, ring) = self.drive, (float(root) for root in self.geometry.roots)
        return (
            d.sun.bore_radius or 0.5 * sun,
            d.planet.bore_radius or 0.6 * planet,
            d.ring.outer_radius or ring + 4.0 * d.module,
        )


def design(scene: PlanetaryScene) -> Design:
    """Read the set from a scene; raises Infeasible where the centre distance is out of reach of the teeth."""
    d = scene.drive
    cutter, teeth = d.ring_cutter, (d.z_sun, d.z_planet, d.z_ring)
    tip = d.module * (cutter.z + 2.0 * (cutter.x + d.addendum + d.root_clearance))
    given = PlanetarySet(
        teeth,
        d.module,
        d.center_distance,
        (d.x_sun, 0.0, 0.0),
        Shaper(cutter.z, cutter.x, cutter.tip_diameter or tip, cutter.tip_rounding),
        d.planets,
        d.pressure_angle,
        d.addendum,
        d.root_clearance,
    )
    sun, planet, ring = given.gears()
    try:
        pairs = [mesh_at(*gears, d.center_distance) for gears in ((sun, planet), (planet, ring))]
    except Infeasible as error:
        faults = planetary_faults(given, Limits(d.limits.tip_thickness, d.limits.contact_ratio))
        raise Infeasible("\n".join(faults) or str(error)) from None
    sums = [float(needed_shift(pair)) for pair in pairs]
    x2 = sums[0] - d.x_sun if d.x_planet is None else d.x_planet
    x3 = sums[1] + x2 if d.x_ring is None else d.x_ring
    return Design(
        scene,
        replace(given, shifts=(d.x_sun, x2, x3)),
        (sums[0], sums[1]),
        _rounding(d),
        d.roller_diameter or ROLLER * d.module,
        Limits(d.limits.tip_thickness, d.limits.contact_ratio),
    )


def _rounding(d: PlanetaryDrive) -> float:
    """Tip rounding of the rack in modules: c*/(1 − sin α), which ends at its straight flank, or what has room."""
    if d.root_rounding is not None:
        return d.root_rounding
    sine, height = math.sin(d.pressure_angle), d.addendum + d.root_clearance
    half = 0.25 * math.pi - height * math.tan(d.pressure_angle)  # of the tip land
    return max(0.0, min(d.root_clearance, half * math.cos(d.pressure_angle)) / (1.0 - sine))
