"""A pin that is held at one end and presses on the wall of a slot: contact, bending, and how stiff both are together.

The pin's axis is a ray through a centre O, the wall turns about an axis through O.  Where a wall comes nearer by the
angle u (rad), a place at the distance ρ from O comes nearer by u ρ:

    u ρ_i = δ_i(f_i) + Σ_j G_ij f_j,   N(u) = Σ f_i ρ_i,

G: a short Timoshenko beam clamped at its root; δ: a line contact in slices (Johnson, Contact Mechanics, 5.58)

    δ = Σ_bodies q (1−ν²)/(πE) (2 ln(2d/b) − ν/(1−ν)),   b² = 4 q r/(π E*),   p = 2 q/(π b),

q = f/width, with a depth d for each body at which it is taken to stand still: the pin's axis, and for the wall what
is given.  A barrel is one Hertz point contact in the middle, whose half-spaces need no depth.  What N is for u does
not depend on where in the slot the pin is.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from trochoid.fem.beam import Step, shaft
from trochoid.fem.hertz_point import PointContact, contact_modulus, point_contact
from trochoid.fem.material import Material
from trochoid.fem.point_contact import PointLaw
from trochoid.kinematics.errors import Infeasible, NotConverged
from trochoid.kinematics.types import Array, BoolArray

Shape = Literal["cylinder", "cone", "barrel"]
SLICES = 16
PASSES = 200
RIGID = 1e-6  # of its deflection, that of a pin that does not bend


@dataclass(frozen=True, slots=True)
class Pin:
    """A pin of `radius` at the `distance` from O in a wall of `thickness` about it, held `overhang` before the wall.

    Lengths in m.  It is held at its end nearer to O.  A cone has its apex in O, in a slot of rays; a cylinder is in a
    slot of parallel planes; a barrel has the `crown` radius along its axis.  `depth`: below the wall's face, m.
    With `bends` false the contact is all there is.
    """

    shape: Shape
    radius: float
    distance: float
    thickness: float
    overhang: float
    depth: float
    material: Material
    crown: float = math.inf
    bends: bool = True

    @property
    def root(self) -> float:
        """Distance (m) from O at which the pin is held."""
        return self.distance - 0.5 * self.thickness - self.overhang


@dataclass(frozen=True, eq=False, slots=True)
class Pressed:
    """A pin pressed by the angles u (n,): `moment` N (N·m), its slope dN/du, `force` (n, slices) in N.

    `pressure` (Pa) and `half_width` (m) of each slice (n, slices); `along` (n,) is the half axis of a point contact
    along the pin in m, 0 in a line contact.
    """

    moment: Array
    slope: Array
    force: Array
    pressure: Array
    half_width: Array
    along: Array


def press(pin: Pin, angle: Array) -> Pressed:
    """Press a pin by the angles (n,), none negative.  Raises Infeasible for a pin held beyond O, NotConverged."""
    if not pin.root > 0.0:
        raise Infeasible(
            f"a pin held {1e3 * pin.overhang:g} mm before a wall of {1e3 * pin.thickness:g} mm would be held beyond "
            f"the centre of the sphere; the overhang must be less than "
            f"{1e3 * (pin.distance - 0.5 * pin.thickness):.6g} mm"
        )
    return _point(pin, angle) if pin.shape == "barrel" else _line(pin, angle)


def flexibility(pin: Pin, places: Array) -> Array:
    """Deflection (n, n) in m/N of a pin at distances (n,) from O under forces there, clamped at its root.

    A shaft of twice the length, loaded alike at both sides of its middle, is not turned there.
    """
    ends = np.linspace(pin.root, pin.distance + 0.5 * pin.thickness, 9)
    if pin.shape != "cone":
        ends = ends[[0, -1]]
    thick = pin.radius * (0.5 * (ends[1:] + ends[:-1]) / pin.distance if pin.shape == "cone" else np.ones(1))
    z = ends - pin.root
    half = [Step(float(a), float(b), float(r)) for a, b, r in zip(z[:-1], z[1:], thick, strict=True)]
    steps = [Step(-x.high, -x.low, x.radius) for x in reversed(half)] + half
    at = places - pin.root
    K = shaft(steps, [*(-at), 0.0, *at], pin.material).bending
    n = len(at)
    found = np.linalg.inv(K[n + 1 :, n + 1 :] + K[n + 1 :, :n])
    return 0.5 * (found + found.T) * (1.0 if pin.bends else RIGID)


def crowned(pin: Pin) -> PointContact:
    """Return the Hertz contact of a barrel on a plane wall."""
    return point_contact((1.0 / pin.radius, 1.0 / pin.crown), contact_modulus(pin.material, pin.material))


def _point(pin: Pin, angle: Array) -> Pressed:
    contact = crowned(pin)
    law = PointLaw(contact, float(flexibility(pin, np.array([pin.distance]))[0, 0]))
    force = law.force(angle * pin.distance)
    _, yields = law.approach(np.maximum(force, 1e-300))
    along, across = contact.semi_axes(force)
    return Pressed(
        force * pin.distance,
        np.where(force > 0.0, pin.distance**2 / yields, 0.0),
        force[:, None],
        np.asarray(contact.pressure(force))[:, None],
        across[:, None],
        along,
    )


def _line(pin: Pin, angle: Array) -> Pressed:
    width = pin.thickness / SLICES
    rho = pin.distance + pin.thickness * ((np.arange(SLICES) + 0.5) / SLICES - 0.5)
    G = flexibility(pin, rho)
    radius, depth = _radii(pin, rho)
    modulus, nu = contact_modulus(pin.material, pin.material), pin.material.poissons_ratio
    factor = (1.0 - nu**2) / (math.pi * pin.material.youngs_modulus * width)
    asked = angle[:, None] * rho

    def local(force: Array) -> Array:
        """Compliance (n, slices) of the contacts as they are, m/N; at most where they are wider than they are deep."""
        b = _half_width(np.maximum(force, 1e-300) / width, radius, modulus)
        return np.asarray(
            factor * sum(np.maximum(2.0 * np.log(2.0 * d / b) - nu / (1.0 - nu), 0.0) for d in depth)
        )

    force, touching = _balanced(asked, G, local)
    # dδ/df = compliance less what the contact widens: δ = f c(b), b ~ √f, dc/d ln f = −2·factor
    tangent = np.where(touching, local(force) - 2.0 * factor, 0.0)
    rate = _solved(np.maximum(tangent, 0.0), G, np.broadcast_to(rho, asked.shape), touching)
    b = np.where(touching, _half_width(force / width, radius, modulus), 0.0)
    pressure = np.divide(2.0 * force / width, math.pi * b, out=np.zeros_like(force), where=b > 0.0)
    return Pressed(force @ rho, rate @ rho, force, pressure, b, np.zeros(len(angle)))


def _radii(pin: Pin, rho: Array) -> tuple[Array, tuple[Array, Array]]:
    """Return relative radii (slices,) of pin and wall and the depths of both, m."""
    wall = np.full(rho.shape, pin.depth)
    if pin.shape == "cylinder":
        return np.full(rho.shape, pin.radius), (np.full(rho.shape, pin.radius), wall)
    opening = pin.radius / pin.distance  # the wall is a cone too, about the normal of the slot's great circle
    return rho * math.sin(opening) * math.cos(opening), (rho * math.tan(opening), wall)


def _half_width(load: Array, radius: Array, modulus: float) -> Array:
    found: Array = np.sqrt(4.0 * load * radius / (math.pi * modulus))
    return found


def _balanced(asked: Array, G: Array, local: Callable[[Array], Array]) -> tuple[Array, BoolArray]:
    """Forces (n, slices), none negative: the logarithm hardly changes, so that its compliance is put in again."""
    touching = asked > 0.0
    force = np.where(touching, 1.0, 0.0)  # N: from narrow contacts, as wide ones have no logarithm
    for number in range(PASSES):
        found = _solved(local(force), G, asked, touching)
        now = np.where(touching, found > 0.0, asked - found @ G > 0.0)
        change = np.abs(found - force).max(axis=-1)
        enough = (
            1e-12 if number < PASSES // 2 else 1e-9
        )  # rounding, where slices are far stiffer than the pin
        settled = bool((change <= enough * np.abs(found).max(axis=-1)).all()) and bool(
            (now == touching).all()
        )
        force, touching = np.maximum(found, 0.0), now
        if settled:
            return force, touching
    raise NotConverged(
        f"contact of pin and slot: forces still change by {float(change.max()):.3g} N after {PASSES} passes; "
        "take a thicker pin or a smaller load"
    )


def _solved(local: Array, G: Array, asked: Array, touching: BoolArray) -> Array:
    both = touching[:, :, None] & touching[:, None, :]
    matrix = np.where(both, G, 0.0)
    i = np.arange(len(G))
    scale = float(np.trace(G)) / len(G)
    matrix[:, i, i] += np.where(touching, local, scale)
    found: Array = np.linalg.solve(matrix, np.where(touching, asked, 0.0)[:, :, None])[:, :, 0]
    return found
