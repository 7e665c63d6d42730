"""What an RV drive is made of: both stages, discs, places of all members. No solver, no mesh.

All is seen from the carrier, where the crankshafts stand, the discs only shift and the ring turns.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.disc_pack import Disc, circle, pack
from trochoid.drives.rv.first_stage import Stage, first_stage
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.cycloid import Cycloid, Modification
from trochoid.kinematics.train import Speeds, rv_train, speeds
from trochoid.kinematics.types import Array
from trochoid.scene.drive_rv import RvDrive, RvScene

if TYPE_CHECKING:
    from trochoid.geometry.check import Holes
    from trochoid.geometry.mass import Solid
    from trochoid.geometry.outline import Outline

ROLES = {  # fixed: driving, driven
    "ring": ("sun", "carrier"),
    "carrier": ("sun", "ring"),
    "sun": ("ring", "carrier"),
}


@dataclass(frozen=True)
class Design:
    """The drive as the wings see it, in SI.

    `modification` and the plays (m, of one side) are zero unless the scene lists the effect "clearance";
    `hole_angles` of each distinct body.
    """

    scene: RvScene
    flank: Cycloid
    modification: Modification
    pin_play: float
    arm_play: float
    discs: tuple[Disc, ...]
    hole_angles: tuple[float, ...]
    speeds: Speeds

    @property
    def drive(self) -> RvDrive:
        """The scene's [drive] table."""
        return self.scene.drive

    @property
    def driving(self) -> str:
        """The member that is driven from outside: the sun, or the ring when the sun stands."""
        return ROLES[self.drive.fixed][0]

    @property
    def driven(self) -> str:
        """The output member."""
        return ROLES[self.drive.fixed][1]

    @cached_property
    def first(self) -> Stage:
        """Sun and planets; raises Infeasible where they cannot mesh."""
        return first_stage(self.drive.first_stage)

    @cached_property
    def crank_places(self) -> Array:
        """Axes of the crankshafts (j, 2), m, in the carrier's frame; the first on its x axis."""
        return circle(self.first.arm, self.drive.first_stage.cranks)

    @cached_property
    def arc(self) -> ArcLength:
        """Arc length along the flank."""
        return ArcLength(self.flank)

    @property
    def pitch_radius(self) -> float:
        """Radius of the circle of the turning-arm bearing's roller centres, m."""
        bearing = self.drive.arm_bearing
        return bearing.hole_radius - bearing.roller_radius - self.arm_play

    @property
    def race_radius(self) -> float:
        """Radius of an eccentric's raceway, m."""
        return self.pitch_radius - self.drive.arm_bearing.roller_radius

    def holes(self, body: int) -> Holes:
        """Crank holes of a distinct disc."""
        from trochoid.geometry.check import Holes

        count = self.drive.first_stage.cranks
        return Holes(count, self.first.arm, self.drive.arm_bearing.hole_radius, self.hole_angles[body])

    def windows(self, body: int) -> Holes | None:
        """Windows of a distinct disc for the carrier's pillars, midway between its crank holes."""
        from trochoid.geometry.check import Holes

        pillars, count = self.drive.carrier.pillars, self.drive.first_stage.cranks
        if pillars is None:
            return None
        radius = pillars.radius + self.flank.eccentricity + pillars.gap
        return Holes(count, pillars.circle_radius, radius, self.hole_angles[body] + math.pi / count)

    def outline(self, body: int, facets_per_lobe: int = 12) -> Outline:
        """Outline of a distinct disc; its flank is the theoretical one. Raises Infeasible."""
        from trochoid.geometry.disc import disc_outline

        holes = self.holes(body)
        return disc_outline(
            self.flank,
            self.drive.cycloid.bore_radius,
            holes.count,
            holes.circle_radius,
            holes.radius,
            holes.angle0,
            facets_per_lobe,
            self.windows(body),
        )

    @cached_property
    def disc_solid(self) -> Solid:
        """Mass and inertia of one disc, by exact integrals along its outline."""
        from trochoid.geometry.mass import prism, section

        density = self.scene.materials[self.drive.material].density
        return prism(section(self.outline(0)), self.drive.cycloid.face_width, density)

    @property
    def eccentric_mass(self) -> float:
        """Mass of one eccentric, a round disc of its raceway's radius, kg."""
        density = self.scene.materials[self.drive.material].density
        return density * math.pi * self.race_radius**2 * self.drive.cycloid.face_width

    @property
    def pack_width(self) -> float:
        """Axial width of all discs with their gaps, m."""
        c = self.drive.cycloid
        return c.discs * c.face_width + (c.discs - 1) * c.disc_gap

    @property
    def crank_speed(self) -> float:
        """Speed of the crankshafts in the fixed frame, rad/s: the discs' centres orbit with it."""
        return float(self.speeds.members["planet"]) * self.scene.operation.input_speed

    @property
    def turning(self) -> float:
        """Angle of a crankshaft as seen from the carrier per input angle."""
        return float(self.speeds.relative("planet", "carrier"))

    @property
    def leverage(self) -> float:
        """Torque of the driven member over the ring's; angles go the other way.

        Torques of sun, ring and carrier are as 1 : i − 1 : −i with the ratio i of the drive whose ring stands,
        whichever stands here.
        """
        f, c = self.drive.first_stage, self.drive.cycloid
        geared = f.z_planet * c.pins / (f.z_sun * (c.pins - c.lobes))  # i − 1
        return 1.0 if self.driven == "ring" else (1.0 + geared) / geared

    @property
    def ring_torque(self) -> float:
        """Torque on the ring, N·m, amount."""
        return self.scene.operation.output_torque / self.leverage

    def crank_angle(self, angle: Array) -> Array:
        """Angle of the crankshafts as seen from the carrier at input angles, rad."""
        return self.turning * angle

    def eccentric(self, disc: int, crank: Array) -> Array:
        """Centre (n, 2), m, of a disc from the axis, and of an eccentric from its crankshaft's, at crank angles."""
        at = np.asarray(crank, dtype=np.float64) + self.discs[disc].crank
        return self.flank.eccentricity * np.stack([np.cos(at), np.sin(at)], axis=-1)


def design(scene: RvScene) -> Design:
    """Read the drive from a scene; nothing is checked here but what no later stage could name."""
    d, c = scene.drive, scene.drive.cycloid
    flank = Cycloid(c.pins, c.lobes, c.pin_circle_radius, c.pin_radius, c.eccentricity)
    loose, m, f = scene.has("clearance"), c.modification, d.first_stage
    discs, angles = pack(c.discs, c.lobes, f.cranks, c.face_width + c.disc_gap)
    train = rv_train(f.z_sun, f.z_planet, c.lobes, c.pins)
    return Design(
        scene,
        flank,
        Modification(m.equidistant, m.radial, m.rotation) if loose else Modification(),
        c.pin_clearance if loose else 0.0,
        0.5 * d.arm_bearing.clearance if loose else 0.0,  # ISO 5753: the whole play across the bearing
        discs,
        angles,
        speeds(train, d.fixed, *ROLES[d.fixed]),
    )
