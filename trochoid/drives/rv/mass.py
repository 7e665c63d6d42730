"""Masses of all members of an RV drive: from their shapes, the carrier's from the scene where it gives it."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.drives.rv.design import Design
from trochoid.geometry.mass import Solid, cylinder, enclosed, prism
from trochoid.kinematics.involute_curve import GearCurve


@dataclass(frozen=True, slots=True)
class Masses:
    """One disc, one ring pin, one roller of a turning-arm bearing, one eccentric, one crankshaft without eccentrics,
    sun, one planet, carrier with its pillars, ring.
    """

    disc: Solid
    ring_pin: Solid
    roller: Solid
    eccentric: Solid
    shaft: Solid
    sun: Solid
    planet: Solid
    carrier: Solid
    ring: Solid

    @property
    def orbiting(self) -> float:
        """What runs round a crankshaft's axis on one eccentric apart from the disc, kg: the eccentric itself."""
        return self.eccentric.mass


def masses(design: Design) -> Masses:
    """Return all members' masses; the gears have their exact outlines, shafts and carrier are round."""
    d, rho = design.drive, design.scene.materials[design.drive.material].density
    shaft, table = d.crankshaft, d.first_stage
    low, high = shaft.bearing_positions
    ends = (low, high, shaft.planet_position)
    tips = design.first.tips
    sun, planet = (
        prism(enclosed(GearCurve(cut, tip)), table.face_width, rho)
        for cut, tip in zip(design.first.cuts, tips, strict=True)
    )
    return Masses(
        design.disc_solid,
        cylinder(d.cycloid.pin_radius, d.ring.width, rho),
        cylinder(d.arm_bearing.roller_radius, d.arm_bearing.roller_length, rho),
        cylinder(design.race_radius, d.cycloid.face_width, rho),
        cylinder(shaft.radius, max(ends) - min(ends) - design.pack_width, rho),
        sun,
        planet,
        _carrier(design, rho),
        cylinder(d.ring.outer_radius, d.ring.width, rho, d.cycloid.pin_circle_radius + d.cycloid.pin_radius),
    )


def _carrier(design: Design, rho: float) -> Solid:
    table = design.drive.carrier
    plates = cylinder(table.outer_radius, 2.0 * table.thickness, rho)
    total, inertia = plates.mass, plates.axial_inertia
    if table.pillars is not None:
        one = cylinder(table.pillars.radius, design.pack_width, rho)
        count = design.drive.first_stage.cranks
        total += count * one.mass
        inertia += count * (one.axial_inertia + one.mass * table.pillars.circle_radius**2)
    scale = 1.0 if table.mass is None else table.mass / total
    return Solid(scale * total, scale * inertia, scale * plates.transverse_inertia)


def total_mass(design: Design, parts: Masses) -> dict[str, float]:
    """Return the mass in kg of all members of each kind."""
    d = design.drive
    cranks, discs = d.first_stage.cranks, len(design.discs)
    return {
        "discs": discs * parts.disc.mass,
        "ring_pins": d.cycloid.pins * parts.ring_pin.mass,
        "arm_bearings": cranks * discs * d.arm_bearing.rollers * parts.roller.mass,
        "crankshafts": cranks * (parts.shaft.mass + discs * parts.eccentric.mass),
        "sun": parts.sun.mass,
        "planets": cranks * parts.planet.mass,
        "carrier": parts.carrier.mass,
        "ring": parts.ring.mass,
    }
