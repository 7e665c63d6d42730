"""Masses of all members: from the scene where it gives them, else from their shapes."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.drives.khv.design import Design
from trochoid.geometry.mass import Solid, cylinder


@dataclass(frozen=True, slots=True)
class Masses:
    """One disc, one ring pin, one output pin with its roller, one bearing roller, shaft with eccentrics,
    flange without pins, ring.
    """

    disc: Solid
    ring_pin: Solid
    output_pin: Solid
    bearing_roller: Solid
    shaft: Solid
    flange: Solid
    ring: Solid


def density(design: Design) -> float:
    """Return the density of all members, kg/m³."""
    return design.scene.materials[design.drive.material].density


def masses(design: Design) -> Masses:
    """Return all members' masses; pins and rollers reach through the whole pack of discs."""
    d, rho = design.drive, density(design)
    pack = len(design.discs) * d.face_width + (len(design.discs) - 1) * d.disc_gap
    eccentrics = cylinder(design.race_radius, pack, rho, d.input_shaft.radius)
    ring_bore = d.pin_circle_radius + d.pin_radius
    return Masses(
        design.disc_solid,
        cylinder(d.pin_radius, d.ring.width, rho),
        cylinder(d.output_pins.roller_radius, pack, rho),
        cylinder(d.eccentric_bearing.roller_radius, d.eccentric_bearing.roller_length, rho),
        _given(
            _sum(cylinder(d.input_shaft.radius, d.input_shaft.length, rho), eccentrics), d.input_shaft.mass
        ),
        _given(
            cylinder(d.output_flange.outer_radius, d.output_flange.thickness, rho, d.input_shaft.radius),
            d.output_flange.mass,
            d.output_flange.inertia,
        ),
        cylinder(d.ring.outer_radius, d.ring.width, rho, ring_bore),
    )


def total_mass(design: Design, parts: Masses) -> dict[str, float]:
    """Return the mass in kg of all members of each kind."""
    d = design.drive
    return {
        "discs": len(design.discs) * parts.disc.mass,
        "ring_pins": d.pins * parts.ring_pin.mass,
        "output_pins": d.output_pins.count * parts.output_pin.mass,
        "eccentric_bearings": len(design.discs) * d.eccentric_bearing.rollers * parts.bearing_roller.mass,
        "input_shaft": parts.shaft.mass,
        "output_flange": parts.flange.mass,
        "ring": parts.ring.mass,
    }


def _sum(a: Solid, b: Solid) -> Solid:
    return Solid(
        a.mass + b.mass, a.axial_inertia + b.axial_inertia, a.transverse_inertia + b.transverse_inertia
    )


def _given(shape: Solid, mass: float | None, inertia: float | None = None) -> Solid:
    """Take a given mass or inertia in place of the shape's; inertias scale with the mass."""
    scale = 1.0 if mass is None else mass / shape.mass
    axial = shape.axial_inertia * scale if inertia is None else inertia
    return Solid(shape.mass * scale, axial, shape.transverse_inertia * scale)
