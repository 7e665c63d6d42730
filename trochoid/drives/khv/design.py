"""What a planetary-cycloid K-H-V drive is made of: profile, discs, places of all members. No solver, no mesh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

from trochoid.drives.disc_pack import Disc, pack
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.cycloid import Cycloid, Modification
from trochoid.kinematics.train import Speeds, khv_train, speeds
from trochoid.kinematics.types import Array
from trochoid.scene.drive_khv import KhvDrive, KhvScene

if TYPE_CHECKING:
    from trochoid.drives.khv.bearings import Bearings
    from trochoid.geometry.mass import Solid
    from trochoid.geometry.outline import Outline


Angle = TypeVar("Angle", float, Array)


@dataclass(frozen=True)
class Design:
    """The drive as the wings see it, in SI.

    `modification` and the plays (in m, of one side) are zero unless the scene lists the effect "clearance";
    `hole_angles` of each distinct body; `supported`: stiffnesses to try in the place of `supports`.
    """

    scene: KhvScene
    flank: Cycloid
    modification: Modification
    pin_play: float
    hole_radius: float
    bearing_play: float
    discs: tuple[Disc, ...]
    hole_angles: tuple[float, ...]
    speeds: Speeds
    supported: Mapping[str, tuple[float, float]] | None = None

    @property
    def drive(self) -> KhvDrive:
        """The scene's [drive] table."""
        return self.scene.drive

    @cached_property
    def arc(self) -> ArcLength:
        """Arc length along the flank."""
        return ArcLength(self.flank)

    @cached_property
    def bearings(self) -> Bearings:
        """Bearings of shaft and flange; rolling ones without a given stiffness are solved for. Raises Infeasible."""
        from trochoid.drives.khv.bearings import bearings

        return bearings(self)

    @property
    def supports(self) -> Mapping[str, tuple[float, float]]:
        """Radial stiffness of the bearings A and B of "shaft" and "output", N/m."""
        from trochoid.drives.khv.bearings import given

        if self.supported is not None:
            return self.supported
        known = {member: pair for member, pair in given(self).items() if pair is not None}
        return known if len(known) == 2 else self.bearings.stiffness

    @cached_property
    def eccentric_mass(self) -> float:
        """Mass of one disc in kg when inertia is in the scene, else 0."""
        return self.disc_solid.mass if self.scene.has("inertia") else 0.0

    @cached_property
    def disc_solid(self) -> Solid:
        """Mass and inertia of one disc, by exact integrals along its outline."""
        from trochoid.geometry.mass import prism, section

        density = self.scene.materials[self.drive.material].density
        return prism(section(self.outline(0)), self.drive.face_width, density)

    def outline(self, body: int, facets_per_lobe: int = 12) -> Outline:
        """Outline of a distinct disc; its flank is the theoretical one, modifications are in the gaps.

        Raises Infeasible.
        """
        from trochoid.geometry.disc import disc_outline

        d = self.drive
        return disc_outline(
            self.flank,
            d.bore_radius,
            d.output_pins.count,
            d.output_pins.circle_radius,
            self.hole_radius,
            self.hole_angles[body],
            facets_per_lobe,
        )

    @property
    def crank_speed(self) -> float:
        """Speed of the eccentric in the fixed frame, rad/s."""
        return self.scene.operation.input_speed

    @property
    def mesh_speed(self) -> float:
        """Crank angle relative to the ring per unit of input angle."""
        return float(self.speeds.relative("input", "ring"))

    @property
    def flange_torque(self) -> float:
        """Torque on the flange in N·m: the output torque, less the input's when the ring is driven."""
        return self.scene.operation.output_torque / self.leverage

    @property
    def leverage(self) -> float:
        """Torque of the driven member over the flange's, z_p/z_c when the ring is driven; angles go the other way."""
        return 1.0 if self.drive.fixed == "ring" else self.flank.pins / self.flank.lobes

    @property
    def pitch_radius(self) -> float:
        """Radius of the circle of the eccentric bearing's roller centres, m."""
        bearing = self.drive.eccentric_bearing
        return self.drive.bore_radius - bearing.roller_radius - self.bearing_play

    @property
    def race_radius(self) -> float:
        """Radius of the eccentric's raceway, m."""
        return self.pitch_radius - self.drive.eccentric_bearing.roller_radius

    def cage_angle(self, crank: Angle) -> Angle:
        """Angle of the eccentric bearing's cage at a crank angle relative to the ring: its rollers roll on
        both raceways.
        """
        outer, inner = self.drive.bore_radius, self.race_radius
        return crank * (inner - outer / self.flank.lobes) / (inner + outer)


def design(scene: KhvScene) -> Design:
    """Read the drive from a scene; nothing is checked here but what no later stage could name."""
    d = scene.drive
    flank = Cycloid(d.pins, d.lobes, d.pin_circle_radius, d.pin_radius, d.eccentricity)
    loose = scene.has("clearance")
    m = d.modification
    train = speeds(khv_train(d.pins, d.lobes), d.fixed, "input", "output" if d.fixed == "ring" else "ring")
    holes, pitch = d.output_pins, d.face_width + d.disc_gap
    discs, angles = pack(d.discs, flank.lobes, holes.count, pitch, holes.phase)
    return Design(
        scene,
        flank,
        Modification(m.equidistant, m.radial, m.rotation) if loose else Modification(),
        d.pin_clearance if loose else 0.0,
        d.output_pins.roller_radius + d.eccentricity + (d.output_pins.hole_clearance if loose else 0.0),
        0.5 * d.eccentric_bearing.clearance if loose else 0.0,  # ISO 5753: the whole play across the bearing
        discs,
        angles,
        train,
    )
