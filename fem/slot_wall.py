"""The wall of a slot as part of an elastic wheel: what it yields anywhere along the slot under a narrow contact.

The wheel is a body of rays between two spheres, held at its hub. At some stations along the wall it is pressed slice
by slice, as the teeth of a rim are (see `cone_flank`, `cone_sharp`, `cone_table`): what is left without the contact's
own narrowness is smooth along the slot, and interpolated between the stations by splines in the logarithm of the
distance from the mouth.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csc_matrix, hstack

from trochoid.fem.cone_body import ConeBody, cone_body, product, read
from trochoid.fem.cone_flank import SPREAD, Flank, flank, load_at
from trochoid.fem.cone_layers import Layers, integrals, layers
from trochoid.fem.cone_sharp import sharpened
from trochoid.fem.cone_slices import Slices, between, finer
from trochoid.fem.cone_smooth import smoothed
from trochoid.fem.linear_solver import Solve
from trochoid.fem.material import Material
from trochoid.fem.point_contact import Bump, smooth_part
from trochoid.geometry.quality import Quality
from trochoid.geometry.slotted import HUB, WALL, SlottedWheel, slotted_outline
from trochoid.geometry.sphere_mesh import SphereMesh, mesh_sphere, sphere_quality
from trochoid.geometry.sphere_outline import SphereOutline
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, BoolArray, IntArray

EDGE = 0.06  # of the thickness: nearer to an end of the wall than about that there is no station
COUNTS = 1.5  # of that length: nearer to the mouth a contact counts as there; real edges are rounded
NARROW = 0.05  # of the pin's radius, the same for thin wheels: contacts are narrower
AT_EDGE = 2.5  # facets on that length, so that a station's load lies on the wall
MOST = 26  # facets along a wall, on the level with 8 of them over the thickness
STATIONS = 8
NEAR = 0.5  # of the thickness: farther from the wall than that displacements are cubics along the rays
RETRIES, SLOWER = 2, 0.7  # of a mesh that folds, and by how much slower elements then grow
SLICES, LAYERS = 12, (2, 3, 4, 6)


@dataclass(frozen=True, slots=True)
class WallMesh:
    """How fine: `facets` over the wheel's thickness, along the slot; a contact has `SLICES` slices on any mesh."""

    facets: int = 6

    @property
    def layers(self) -> int:
        """Layers between the spheres, about two thirds of the facets."""
        return min(LAYERS, key=lambda n: abs(n - 2.0 * self.facets / 3.0))

    @property
    def parts(self) -> int:
        """Slices of a layer."""
        return SLICES // self.layers

    def radial(self, ends: tuple[float, float]) -> Layers:
        """Return layers of one thickness between two distances (m) from the centre: the same slices on any mesh."""
        return layers(*ends, self.layers, grading=1.0)

    @property
    def times(self) -> float:
        """How many times the facets of the coarsest mesh are away from the wall."""
        return self.facets / 4.0

    @property
    def growth(self) -> float:
        """Growth of elements away from the wall, from one to the next."""
        return 1.0 + 4.2 / self.facets


@dataclass(frozen=True, eq=False)
class Wall:
    """What a wall yields at the stations `reach` (k,), rad from the wheel's axis along the slot, growing.

    `own` (k, f, f) is S in m/N between `slices`, without (2/(πE'))(ln(2/b) + ¼)/Δ of each on itself; `half_width` (k,)
    in rad that of the elements' loads. `kernel` is 2/(πE') in 1/Pa, `ends` (m) where the body ends, `mouth` (rad)
    where the wall does, and `last` (rad) where contacts beyond count as, on any mesh.
    """

    reach: Array
    own: Array
    half_width: Array
    slices: Slices
    kernel: float
    poissons_ratio: float
    ends: tuple[float, float]
    mouth: float
    last: float
    dofs: int
    quality: Quality

    def at(self, reach: Array) -> tuple[Array, Array]:
        """Return S (n, f, f) in m/N and half widths (n, f) in m at angles (n,), none taken beyond `last`."""
        found = self._spline(self._place(np.clip(reach, self.reach[0], self.last)))
        own, half = found[..., :-1], found[..., -1]
        count = len(self.slices.middle)
        return own.reshape(len(reach), count, count), half[:, None] * self.slices.middle

    def _place(self, reach: Array) -> Array:
        """Return a coordinate (n,) along the wall in which S is smooth up to the mouth."""
        scale = 0.25 * (self.ends[1] - self.ends[0]) / self.ends[1]
        return np.asarray(-np.log1p((self.mouth - reach) / scale))

    @cached_property
    def _spline(self) -> Callable[[Array], Array]:
        from scipy.interpolate import CubicSpline

        rows = np.concatenate([self.own.reshape(len(self.reach), -1), self.half_width[:, None]], axis=1)
        spline: Callable[[Array], Array] = CubicSpline(self._place(self.reach), rows)
        return spline


@dataclass(frozen=True, eq=False, slots=True)
class WallBody:
    """The factored wheel and its pressed side; stations are numbers (k,) of facets."""

    wheel: SlottedWheel
    body: ConeBody
    side: Flank
    stations: IntArray
    solve: Solve
    unknowns: int

    def half_width(self) -> Array:
        """Return half widths (k,) of the loads, rad: as far as the ends of the wall at most."""
        side = self.side
        to_end = np.minimum(side.centers, side.length - side.centers)
        return np.asarray(np.minimum(side.half_width, to_end)[self.stations])


def wall_body(
    wheel: SlottedWheel,
    ends: tuple[float, float],
    nearest: float,
    material: Material,
    mesh: WallMesh,
    solver: str | None = None,
) -> WallBody:
    """Mesh and factor a wheel between two spheres (m), stations from the angle `nearest` (rad) to the mouth."""
    size = max(
        min((ends[1] - ends[0]) / mesh.facets / ends[1], (wheel.mouth - nearest) / mesh.facets),
        (wheel.mouth - wheel.bottom) * 8.0 / (MOST * mesh.facets),
    )
    edge = edge_of(wheel, ends)
    plane = _meshed(
        slotted_outline(wheel, size, min(size, edge / AT_EDGE), nearest, times=mesh.times), mesh.growth
    )
    body = cone_body(plane, mesh.radial(ends), material, held=(HUB,))
    side = flank(plane, wheel.wall, WALL, SPREAD)
    near = _beside(plane, NEAR * (ends[1] - ends[0]) / ends[1])
    return WallBody(wheel, body, side, _stations(side, wheel, nearest, edge), *smoothed(body, near, solver))


def press_stations(made: WallBody, parts: int = 1, point: float | None = None) -> Wall:
    """Return what the wall yields at its stations under contacts over all of its thickness, in `parts` of layers.

    With `point` (m from the centre) under point contacts there: S is one number, and there is one slice.
    """
    body, half = made.body, made.half_width()
    centers = made.side.centers[made.stations]
    coarse = between(body.radial.breaks)
    reach = made.wheel.bottom + centers / np.sin(made.wheel.wall.radius)
    ends = float(body.radial.breaks[0]), float(body.radial.breaks[-1])
    kernel = body.material.plane("strain").kernel
    known = (
        kernel,
        body.material.poissons_ratio,
        ends,
        made.wheel.mouth,
        made.wheel.mouth - COUNTS * edge_of(made.wheel, ends),
        made.unknowns,
        sphere_quality(body.mesh),
    )
    if point is not None:
        layer = float(coarse.length[np.abs(coarse.middle - point).argmin()])
        longest = 0.98 * min(point - ends[0], ends[1] - point)
        bumps = [
            Bump(float(c), point, float(b) * point, min(max(float(b) * point, SPREAD * layer), longest))
            for c, b in zip(centers, half, strict=True)
        ]
        found = np.array([smooth_part(body, made.side, bump, made.solve) for bump in bumps])
        return Wall(reach, found[:, None, None], half, between(np.array(ends)), *known)
    plane = hstack(
        [load_at(made.side, float(c), float(b)) for c, b in zip(centers, half, strict=True)], format="csc"
    )
    weights = integrals(body.radial)
    inner = np.flatnonzero(~body.held)
    loads = product(plane, weights / weights.sum(axis=0))[inner]
    found, _ = read(made.solve, loads, csc_matrix((len(inner), 0)))
    count = len(centers)
    number = np.arange(count)
    own = found.reshape(count, len(coarse.middle), count, -1)[number, :, number]
    fine = finer(coarse, parts)
    return Wall(reach, sharpened(own, half, coarse, fine, ends, kernel), half, fine, *known)


def _meshed(outline: SphereOutline, growth: float) -> SphereMesh:
    """Mesh an outline; where elements fold beside a slim slot, with slower growth."""
    for _ in range(RETRIES):
        try:
            return mesh_sphere(outline, growth)
        except TrochoidError:
            growth = 1.0 + SLOWER * (growth - 1.0)
    return mesh_sphere(outline, growth)


def edge_of(wheel: SlottedWheel, ends: tuple[float, float]) -> float:
    """Return the angle (rad) from an end of the wall within which there are no stations."""
    return max(EDGE * (ends[1] - ends[0]) / ends[1], NARROW * wheel.opening)


def _beside(plane: SphereMesh, distance: float) -> BoolArray:
    """Return which nodes (n,) are within a distance (rad) of the pressed wall."""
    wall = plane.points[np.unique(plane.edges[WALL])]
    return np.asarray((plane.points @ wall.T).max(axis=1) >= np.cos(distance))


def _stations(side: Flank, wheel: SlottedWheel, nearest: float, edge: float) -> IntArray:
    """Return facets evenly apart in the logarithm of the distance from the mouth, none nearer to an end than `edge`."""
    along = side.centers / np.sin(wheel.wall.radius)
    away = wheel.mouth - wheel.bottom - along
    inside = np.flatnonzero((away >= 0.95 * edge) & (along >= 0.95 * edge))
    last = int(inside[-1])
    below = int(np.searchsorted(along, nearest - wheel.bottom)) - 1
    first = min(max(int(inside[0]), below), last - 3)
    wanted = np.geomspace(away[first], away[last], STATIONS)
    return np.unique([int(np.abs(np.log(away / x)).argmin()) for x in wanted])
