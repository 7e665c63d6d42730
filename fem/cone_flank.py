"""Where a body of rays is pressed: stations along its flank, and the load that stands for a narrow contact there.

A contact of half width b is far narrower than an element.  The elements are loaded by a half ellipse as wide as they
are, B = `spread` facets; what a contact of width b < B adds is the half-space's, in closed form (see `cone_table`).
All is in angles on the unit sphere, so that the load's width grows with ρ as that of a conical roller does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix

from trochoid.geometry.sphere_mesh import SphereMesh
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.spherical_curve import SphericalCurve
from trochoid.kinematics.types import Array, IntArray

# Half width of the load in facets.  What the elements miss of it, in units of the logarithm: 1: 0.027, 1.5: 0.007,
# 2.5: 0.000; but the wider it is, the more it bends with the flank.
SPREAD = 1.5
_GAUSS = np.polynomial.legendre.leggauss(6)


@dataclass(frozen=True, eq=False, slots=True)
class Flank:
    """A pressed side of a mesh.

    `edge` (3, f) nodes of its facets, `ends` (f+1,) their arc lengths, rad, from the first on; `centers` (k,) of the
    stations, the facets' middles, and `half_width` (k,) of their loads, rad.  Where crests are cut, `edges` (2,) are
    the arc lengths of the edges: there are no stations between them, and no load reaches over them.
    """

    curve: SphericalCurve
    edge: IntArray
    parameters: Array
    ends: Array
    centers: Array
    half_width: Array
    nodes: int
    arc: ArcLength
    edges: tuple[float, float] | None = None

    @property
    def length(self) -> float:
        """Arc length of all facets, rad."""
        return float(self.ends[-1])

    def normal_at(self, place: float) -> Array:
        """Return the true outward normal (3,) at an arc length, rad, on the side or beyond its ends."""
        first = float(self.arc.length(self.parameters[0, 0]))
        return np.asarray(self.curve.normal(self.arc.parameter(first + place)))

    def facet(self, place: Array) -> IntArray:
        """Return the facet at arc lengths (...), rad, of the side continued periodically: any integer."""
        turn = np.floor(place / self.length)
        inside = np.searchsorted(self.ends, place - turn * self.length, side="right") - 1
        count = len(self.ends) - 1
        return np.asarray(np.clip(inside, 0, count - 1) + count * turn, dtype=np.intp)


def flank(
    mesh: SphereMesh,
    curve: SphericalCurve,
    side: str = "flank",
    spread: float = SPREAD,
    cut: tuple[float, float] | None = None,
) -> Flank:
    """Return the stations of a side that lies on `curve`, but between the parameters `cut` of a crest cut away."""
    parameters = mesh.parameters[side]
    arc = ArcLength(curve)
    s = arc.length(np.append(parameters[0], parameters[1, -1]))
    ends = s - s[0]
    centers, half = 0.5 * (ends[1:] + ends[:-1]), spread * np.diff(ends)
    edges = None
    if cut is not None:
        low, high = (float(x) for x in arc.length(np.array(cut)) - s[0])
        edges = low, high
        on = (centers < low) | (centers > high)
        centers, half = centers[on], half[on]
        half = np.minimum(half, np.where(centers < low, low - centers, centers - high))
    return Flank(curve, mesh.edges[side], parameters, ends, centers, half, len(mesh.points), arc, edges)


def load_at(side: Flank, center: float, half_width: float) -> csc_matrix:
    """Return the plane load (3n, 1) of a half ellipse of unit integral about the arc length `center` (rad).

    What lies beyond the side's ends is left out.  It acts inwards along the true normal at the center alone: so does
    a narrow contact, and normals that fan out over ±B would have its own bending counted as softness.
    """
    stops = side.ends[(side.ends > center - half_width) & (side.ends < center + half_width)]
    first, last = max(center - half_width, 0.0), min(center + half_width, side.length)
    if first >= last:
        return csc_matrix((3 * side.nodes, 1))
    angle = np.arcsin(np.clip((np.unique([first, *stops, last]) - center) / half_width, -1.0, 1.0))
    middle, half = 0.5 * (angle[1:] + angle[:-1]), 0.5 * np.diff(angle)
    psi = (middle[:, None] + half[:, None] * _GAUSS[0]).ravel()
    weight = (half[:, None] * _GAUSS[1]).ravel() * (2.0 / np.pi) * np.cos(psi) ** 2
    place = center + half_width * np.sin(psi)
    number = side.facet(place)
    x = (place - side.ends[number]) / (side.ends[number + 1] - side.ends[number])
    shape = np.stack([(1 - x) * (1 - 2 * x), x * (2 * x - 1), 4 * x * (1 - x)])
    force = -weight[:, None] * side.normal_at(center)
    values = shape[..., None] * force  # (3, q, 3)
    rows = 3 * side.edge[:, number][..., None] + np.arange(3)
    zeros = np.zeros(rows.size, dtype=np.intp)
    return csc_matrix((values.ravel(), (rows.ravel(), zeros)), shape=(3 * side.nodes, 1))
