"""Masses of the wheels, by exact integrals along their teeth."""

from __future__ import annotations

import math
from dataclasses import dataclass

from trochoid.drives.planetary.design import Design
from trochoid.geometry.mass import Section, Solid, enclosed, prism
from trochoid.geometry.planetary_curves import Members


@dataclass(frozen=True, slots=True)
class Masses:
    """Sun, one planet, ring: teeth and rim, without shafts and carrier."""

    sun: Solid
    planet: Solid
    ring: Solid


def masses(design: Design, curves: Members) -> Masses:
    """Masses and inertias about the wheels' own axes."""
    d = design.drive
    density = design.scene.materials[d.material].density
    sun, planet, ring = (_round(radius) for radius in design.bores)
    figures = (
        _less(enclosed(curves.sun), sun),
        _less(enclosed(curves.planet), planet),
        _less(ring, enclosed(curves.ring)),
    )
    return Masses(*(prism(figure, d.face_width, density) for figure in figures))


def carrier(design: Design) -> tuple[float, float]:
    """Return mass (kg) and moment of inertia (kg·m²) of the carrier, as given, or of a plain one.

    A plain one has two round cheeks, each a quarter of the face width thick, that end where the bores of the planets
    do, and pins that fill these bores between them.
    """
    given, d = design.drive.carrier, design.drive
    density = design.scene.materials[d.material].density
    bore, reach = design.bores[1], d.center_distance + design.bores[1]
    cheeks, pin = (
        prism(_round(reach), 0.5 * d.face_width, density),
        prism(_round(bore), d.face_width, density),
    )
    mass = cheeks.mass + d.planets * pin.mass
    inertia = cheeks.axial_inertia + d.planets * (pin.axial_inertia + pin.mass * d.center_distance**2)
    if given.mass is not None:
        inertia *= given.mass / mass  # of the same shape
        mass = given.mass
    return mass, given.inertia or inertia


def _round(radius: float) -> Section:
    area = math.pi * radius**2
    return Section(area, (0.0, 0.0), 0.5 * area * radius**2)


def _less(whole: Section, hole: Section) -> Section:
    """Section without its hole; all wheels are centred."""
    return Section(whole.area - hole.area, (0.0, 0.0), whole.polar - hole.polar)
