"""The pin of an indexer as an elastic body: held at one end, pressed along one of its lines.

A cone with its apex in the centre of the sphere is a body of rays as it is; a cylinder is one whose apex is far away.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix

from trochoid.fem.cone_body import ConeBody, factored, product, read
from trochoid.fem.cone_flank import SPREAD, flank, load_at
from trochoid.fem.cone_layers import Layers, integrals, layers
from trochoid.fem.cone_sharp import sharpened
from trochoid.fem.cone_slices import Slices, between, finer
from trochoid.fem.cone_stiffness import cone_stiffness
from trochoid.fem.pin_slot import Pin
from trochoid.fem.point_contact import Bump, curvature_shift, smooth_part
from trochoid.geometry.sphere_mesh import mesh_sphere
from trochoid.geometry.sphere_outline import roller_outline
from trochoid.kinematics.spherical_curve import SmallCircle
from trochoid.kinematics.types import Array

FAR = 400.0  # of its length, the distance of a cylinder's apex: it tapers by as much of its radius
NARROW = 0.01  # of its radius, the half width of a point contact for which S is given; it hardly matters


@dataclass(frozen=True, eq=False, slots=True)
class PinBody:
    """`own` (f, f) is S in m/N between slices (one number for a barrel), `blunt` (f,) in m the half width of the
    elements' loads, `ends` (m from the centre of the sphere) where the pin is free.
    """

    own: Array
    blunt: Array
    ends: tuple[float, float]
    kernel: float
    poissons_ratio: float
    dofs: int


def press_pin(pin: Pin, wall: Slices, facets: int, parts: int, solver: str | None = None) -> PinBody:
    """Return the pin's body; `wall` are the wheel's layers, each of so many `parts`; `facets` go round the pin."""
    length = pin.distance + 0.5 * pin.thickness - pin.root
    apex = (
        0.0 if pin.shape == "cone" else pin.distance - FAR * length
    )  # the body's apex, from the sphere's centre
    angle = (
        math.asin(pin.radius / pin.distance) if pin.shape == "cone" else pin.radius / (pin.distance - apex)
    )
    body, first = _held(pin, wall, apex, angle, facets)
    side = flank(body.mesh, SmallCircle((1.0, 0.0, 0.0), angle), spread=SPREAD)
    center, half = float(side.centers[0]), float(side.half_width[0])
    solve = factored(body, ~body.held, solver)
    # a root that holds the end of the contact is no free end
    ends = pin.root if pin.overhang > 0.0 else pin.root - length, pin.root + length
    plane = body.material.plane("strain")
    made = (ends, plane.kernel, body.material.poissons_ratio, body.size)
    if pin.shape == "barrel":
        rho = pin.distance - apex
        layer = float(np.diff(body.radial.breaks)[first:].max())
        bump = Bump(center, rho, half * rho, min(max(half * rho, SPREAD * layer), 0.5 * pin.thickness))
        shift = curvature_shift(body, 0.5 / pin.radius, NARROW * pin.radius, bump)
        own = smooth_part(body, side, bump, solve) + shift
        return PinBody(np.full((1, 1), own), np.array([bump.across]), *made)
    count = sum(load_at(side, center - k * side.length, half) for k in (-1, 1))
    weights = integrals(body.radial)[:, first:]
    loads = product(csc_matrix(count + load_at(side, center, half)), weights / weights.sum(axis=0))
    inner = np.flatnonzero(~body.held)
    found, _ = read(solve, loads[inner], csc_matrix((len(inner), 0)))
    coarse = between(body.radial.breaks[first:])
    fine = finer(coarse, parts)
    free = ends[0] - apex, ends[1] - apex
    own = sharpened(found[None], np.array([half]), coarse, fine, free, plane.kernel)[0]
    return PinBody(own, half * fine.middle, *made)


def _held(pin: Pin, wall: Slices, apex: float, angle: float, facets: int) -> tuple[ConeBody, int]:
    """Return the body, held at its root, and how many of its layers are before the wall."""
    breaks = np.append(wall.inner, wall.outer[-1]) - apex
    first = 0
    if pin.overhang > 0.0:
        root = pin.root - apex
        count = max(2, round(len(wall.inner) * pin.overhang / pin.thickness))
        before = layers(root, float(breaks[0]), count).breaks
        first = len(before) - 1
        breaks = np.concatenate([before, breaks[1:]])
    radial = Layers(breaks)
    mesh = mesh_sphere(roller_outline(angle, facets))
    held = np.zeros((len(mesh.points), 3, radial.count), dtype=bool)
    held[:, :, 0] = True
    return ConeBody(
        mesh, radial, pin.material, cone_stiffness(mesh, radial, pin.material), held.ravel()
    ), first
