"""What a precessional drive is made of: nutating pair, sphere tooth, masses and places. Nothing is checked here."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from trochoid.kinematics.nutation import Nutation
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.types import Array
from trochoid.scene.drive_precessional import PrecessionalScene, Teeth

if TYPE_CHECKING:
    from trochoid.drives.precessional.mechanism import PrecessionalDrive


@dataclass(frozen=True)
class Design:
    """The drive as the wings see it, in SI; `tooth` is None where the scene has no [drive.teeth]."""

    scene: PrecessionalScene
    nutation: Nutation
    tooth: SphereTooth | None

    @property
    def teeth(self) -> Teeth | None:
        """The scene's [drive.teeth]."""
        return self.scene.drive.teeth

    @property
    def speed(self) -> float:
        """Speed ω_3 of the input shaft, rad/s."""
        return self.scene.operation.input_speed

    @property
    def output_speed(self) -> float:
        """Speed ω_4 of the output shaft, rad/s, negative against the input's."""
        return float(1 / self.nutation.ratio) * self.speed

    @property
    def tooth_radius(self) -> float:
        """Distance from O at which the tooth force acts, m: the middle of the teeth, infinite without any."""
        teeth = self.teeth
        return math.inf if teeth is None else 0.5 * (teeth.inner_radius + teeth.outer_radius)

    @property
    def instantaneous_axis(self) -> Array:
        """Unit vector (3,) along the line on which the pair rolls, in the frame of the crank, on the teeth's side."""
        relative = self.nutation.relative_velocity
        axis: Array = relative / np.linalg.norm(relative)
        return axis if self.nutation.fixed_teeth < self.nutation.satellite_teeth else -axis

    @property
    def pitch_cones(self) -> tuple[float, float]:
        """Half angles (rad) of the pitch cones of wheel and satellite: space cone and body cone."""
        along = self.instantaneous_axis
        return self.nutation.pitch_angle, float(np.arccos(np.clip(along @ self.nutation.axis, -1.0, 1.0)))

    @property
    def shaft_shape(self) -> tuple[float, float, float]:
        """Place of the input shaft's centre of mass on z (m), moments of inertia across and about it (kg·m²).

        Where the scene does not give them: those of a solid cylinder from A to B, a third as thick as it is long.
        """
        d = self.scene.drive
        shaft, near = d.input_shaft, d.satellite.bearing_distance * math.cos(self.nutation.angle)
        long = abs(shaft.bearing_distance - near) or near
        thick = long / 3.0
        center = 0.5 * (near + shaft.bearing_distance) if shaft.center is None else shaft.center
        solid = (shaft.mass * (long**2 / 12.0 + thick**2 / 16.0), shaft.mass * thick**2 / 8.0)
        return center, *(solid if shaft.inertia is None else shaft.inertia)

    @cached_property
    def mechanism(self) -> PrecessionalDrive:
        """Masses and places; a counterweight without a radius gets that of static balance."""
        from trochoid.drives.precessional.balance import statically_balanced
        from trochoid.drives.precessional.mechanism import (
            Counterweight,
            InputShaft,
            PrecessionalDrive,
            Satellite,
        )

        d = self.scene.drive
        weight = d.counterweight
        drive = PrecessionalDrive(
            self.nutation,
            Satellite(d.satellite.mass, d.satellite.center, d.satellite.inertia),
            InputShaft(d.input_shaft.mass, d.input_shaft.offset, d.input_shaft.product_of_inertia),
            Counterweight(0.0, 0.0, 0.0)
            if weight is None
            else Counterweight(weight.mass, weight.radius or 0.0, weight.z, weight.product_of_inertia),
            joint=d.satellite.bearing_distance,
            support=d.input_shaft.bearing_distance,
            mesh_radius=self.tooth_radius,
        )
        if weight is None or weight.radius is not None:
            return drive
        return statically_balanced(drive)


def design(scene: PrecessionalScene) -> Design:
    """Read the drive from a scene."""
    d = scene.drive
    pair = Nutation(d.z_wheel, d.z_satellite, d.nutation_angle)
    return Design(scene, pair, None if d.teeth is None else tooth_of(pair, d.teeth))


def tooth_of(pair: Nutation, teeth: Teeth) -> SphereTooth:
    """Return the sphere tooth of a nutating pair as [drive.teeth] has it."""
    pins, lobes = pair.fixed_teeth, pair.satellite_teeth
    if teeth.pins_on == "satellite":
        pins, lobes = lobes, pins
    tooth = SphereTooth(
        pins, lobes, teeth.polar_angle, teeth.pin_angle, pair.angle, side=1, pins_on=teeth.pins_on
    )
    # by default lobes lie inside the pins where they are fewer, outside where they are more: there they are round
    outside = tooth.hole if teeth.lobed_member is None else teeth.lobed_member == "outside"
    return tooth if tooth.hole == outside else replace(tooth, side=-1)
