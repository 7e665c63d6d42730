"""Area, centroid and moments of plane bodies by exact boundary integrals, and the masses they make."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.geometry.outline import Outline
from trochoid.kinematics.curve import ArcLength, Curve
from trochoid.kinematics.errors import Infeasible

_X, _W = np.polynomial.legendre.leggauss(16)


@dataclass(frozen=True, slots=True)
class Section:
    """Area (m²), centroid (m) and polar second moment about the frame's origin (m⁴) of a plane figure."""

    area: float
    centroid: tuple[float, float]
    polar: float

    @property
    def polar_centroid(self) -> float:
        """Polar second moment about the centroid, m⁴ (Steiner)."""
        return self.polar - self.area * (self.centroid[0] ** 2 + self.centroid[1] ** 2)


@dataclass(frozen=True, slots=True)
class Solid:
    """Mass (kg), moment of inertia about the axis, and the mean one about diameters at mid length (kg·m²)."""

    mass: float
    axial_inertia: float
    transverse_inertia: float


def enclosed(curve: Curve) -> Section:
    """Section inside a closed counter-clockwise curve, whether it bounds a body or a hole.

    With q = r × dr (Green): A = ½∮q, ∫r dA = ⅓∮r q, ∫r² dA = ¼∮r² q.
    """
    knots = ArcLength(curve).knots
    half = 0.5 * np.diff(knots)
    t = knots[:-1, None] + half[:, None] * (1.0 + _X)
    r, tangent = curve.point(t), curve.tangent(t)
    q = half[:, None] * _W * curve.speed(t) * (r[..., 0] * tangent[..., 1] - r[..., 1] * tangent[..., 0])
    area = 0.5 * float(q.sum())
    first = np.einsum("ij,ijk->k", q, r) / 3.0
    polar = 0.25 * float(np.sum(q * np.sum(r * r, axis=-1)))
    if area == 0.0:  # so small that its area is none in floating point
        return Section(0.0, (0.0, 0.0), 0.0)
    return Section(area, (float(first[0] / area), float(first[1] / area)), polar)


def section(outline: Outline) -> Section:
    """Section of a body: its outer loop less its holes; raises Infeasible when nothing is left."""
    outer = enclosed(outline.outer.curve)
    holes = [enclosed(loop.curve) for loop in outline.holes]
    area = outer.area - sum(hole.area for hole in holes)
    if area <= 0.0:
        raise Infeasible(f"the holes of '{outline.outer.name}' are larger than the body by {-area:.6g} m²")
    x, y = (
        (outer.area * outer.centroid[i] - sum(hole.area * hole.centroid[i] for hole in holes)) / area
        for i in (0, 1)
    )
    return Section(area, (x, y), outer.polar - sum(hole.polar for hole in holes))


def prism(figure: Section, width: float, density: float) -> Solid:
    """Solid of a section over an axial width (m), of a density (kg/m³), about the frame's origin."""
    mass = density * width * figure.area
    axial = density * width * figure.polar
    return Solid(mass, axial, 0.5 * axial + mass * width**2 / 12.0)


def cylinder(outer_radius: float, length: float, density: float, inner_radius: float = 0.0) -> Solid:
    """Cylinder, hollow with an inner radius; lengths in m."""
    if not 0.0 <= inner_radius < outer_radius:
        raise Infeasible(
            f"inner radius {inner_radius} m must be at least 0 and less than the outer, {outer_radius} m"
        )
    area = math.pi * (outer_radius**2 - inner_radius**2)
    return prism(Section(area, (0.0, 0.0), 0.5 * area * (outer_radius**2 + inner_radius**2)), length, density)
