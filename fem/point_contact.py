"""Point contact of a ball or a crowned roller on an elastic body: Hertz for both half-spaces, one number for the rest.

The body is pressed by half an ellipsoid over A × B, as wide as its elements.  A half-space yields 4/5 of its middle
under such a load, as a mean over that load (Hertz: Q ~ δ^(3/2), so the work ½Q·mean is ⅖Qδ).  What the body yields
beyond that, S, does not depend on the width of the contact, and adds S Q to Hertz's approach.

On a surface of mean curvature κ it does a little, by −k ln a: k = (1−2ν)² κ/(4πG) for a force on a curved surface.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix

from trochoid.fem.cone_body import ConeBody, factored, read
from trochoid.fem.cone_flank import Flank
from trochoid.fem.hertz_point import EXACT, PointContact
from trochoid.fem.linear_solver import Solve
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array

MEAN = 0.8  # mean of Hertz's displacement over Hertz's pressure, of its middle
_RINGS, _SPOKES = 8, 16


@dataclass(frozen=True, slots=True)
class PointLaw:
    """Approach s Q^(2/3) of two half-spaces and S Q of both bodies: a local law for one contact or several.

    `contact` is Hertz's, `smooth` the sum of both bodies' S in m/N.
    """

    contact: PointContact
    smooth: float = 0.0

    def approach(self, force: Array) -> tuple[Array, Array]:
        """Return approach (c,) in m and its derivative in m/N at positive forces (c,) in N."""
        local = self.contact.softness(EXACT) * np.cbrt(force) ** 2
        return local + self.smooth * force, 2.0 / 3.0 * local / force + self.smooth

    def force(self, approach: Array) -> Array:
        """Return the force (c,) in N at approaches (c,) in m, 0 where they are not positive: Newton from Hertz's."""
        given = np.maximum(np.asarray(approach, dtype=np.float64), 0.0)
        found = (given / self.contact.softness(EXACT)) ** 1.5
        if self.smooth == 0.0:
            return np.asarray(found)
        for _ in range(100):
            at = np.maximum(found, 1e-300)
            value, slope = self.approach(at)
            step = np.where(given > 0.0, (value - given) / slope, 0.0)
            found = np.maximum(found - step, 0.05 * found)
            if np.all(np.abs(step) <= 1e-14 * np.maximum(found, 1e-300)):
                break
        return np.asarray(np.where(given > 0.0, found, 0.0))


@dataclass(frozen=True, slots=True)
class Bump:
    """A half ellipsoid on a flank at the arc length `place` (rad) and the distance `rho` (m) from O.

    Its half axes (m) lie across and along the ray.
    """

    place: float
    rho: float
    across: float
    along: float


def smooth_part(body: ConeBody, side: Flank, bump: Bump, solve: Solve | None = None) -> float:
    """Return S in m/N of a body under a bump of 1 to 1.5 elements; `solve` is the body's factor, when there is one.

    Raises Infeasible when the bump reaches beyond the body.
    """
    load = bump_load(body, side, bump)
    inner = np.flatnonzero(~body.held)
    solve = factored(body, ~body.held) if solve is None else solve
    own, _ = read(solve, load[inner], csc_matrix((len(inner), 0)))
    return float(own[0, 0]) - MEAN * middle_of_bump(body, bump)


def middle_of_bump(body: ConeBody, bump: Bump) -> float:
    """Return what a half-space yields in the middle of a unit load over the bump, m/N: 3K/(2πE'A) (Johnson, 4.26)."""
    modulus = body.material.plane("strain").modulus
    short, long = sorted((bump.across, bump.along))
    if long < short * (1.0 + 1e-9):
        return 0.75 / (modulus * long)
    return 1.5 * _first(long / short) / (math.pi * modulus * long)


def _first(ratio: float) -> float:
    """Return K of k² = 1 − 1/χ², by the arithmetic-geometric mean."""
    a, b = 1.0, 1.0 / ratio
    while a - b > 1e-15 * a:
        a, b = 0.5 * (a + b), math.sqrt(a * b)
    return 0.5 * math.pi / a


def bump_load(body: ConeBody, side: Flank, bump: Bump) -> csc_matrix:
    """Return the nodal load (all, 1) of a unit force over the bump, inwards along the normal at its middle."""
    breaks = body.radial.breaks
    if not (breaks[0] <= bump.rho - bump.along and bump.rho + bump.along <= breaks[-1]):
        raise Infeasible(
            f"a load over {bump.rho - bump.along:.6g} to {bump.rho + bump.along:.6g} m reaches beyond a body from "
            f"{breaks[0]:.6g} to {breaks[-1]:.6g} m; take finer elements, or a contact farther from the end"
        )
    x, weight = np.polynomial.legendre.leggauss(_RINGS)
    height = 0.5 * (x + 1.0)  # √(1 − r²): the load is 3/(2π) h over r dr dθ = h dh dθ
    radius = np.sqrt(1.0 - height**2)
    angle = 2.0 * math.pi * (np.arange(_SPOKES) + 0.5) / _SPOKES
    share = np.repeat(1.5 / math.pi * height**2 * 0.5 * weight * 2.0 * math.pi / _SPOKES, _SPOKES)
    u = np.outer(radius, np.cos(angle)).ravel()
    v = np.outer(radius, np.sin(angle)).ravel()
    place = np.mod(bump.place + u * bump.across / bump.rho, side.length)
    rho = bump.rho + v * bump.along
    facet = side.facet(place)
    s = (place - side.ends[facet]) / (side.ends[facet + 1] - side.ends[facet])
    layer = np.clip(np.searchsorted(breaks, rho, side="right") - 1, 0, len(breaks) - 2)
    t = (rho - breaks[layer]) / (breaks[layer + 1] - breaks[layer])
    across = np.stack([(1 - s) * (1 - 2 * s), s * (2 * s - 1), 4 * s * (1 - s)])
    along = np.stack([(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)])
    values = np.einsum("aq,lq,q,c->alqc", across, along, share, -side.normal_at(bump.place))
    nodes, levels = side.edge[:, facet], 2 * layer + np.arange(3)[:, None]
    rows = (3 * nodes[:, None, :, None] + np.arange(3)) * body.radial.count + levels[None, :, :, None]
    zeros = np.zeros(rows.size, dtype=np.intp)
    return csc_matrix((values.ravel(), (rows.ravel(), zeros)), shape=(body.size, 1))


def curvature_shift(body: ConeBody, curvature: float, width: float, bump: Bump) -> float:
    """Return −k ln(a/A) in m/N, what S changes from the bump's width A to a contact of half width `width` (m).

    `curvature` κ is the body's mean curvature, 1/m, positive where it is convex.
    """
    nu = body.material.poissons_ratio
    shear = body.material.youngs_modulus / (2.0 * (1.0 + nu))
    blunt = math.sqrt(bump.across * bump.along)
    return -((1.0 - 2.0 * nu) ** 2) * curvature / (4.0 * math.pi * shear) * math.log(width / blunt)
