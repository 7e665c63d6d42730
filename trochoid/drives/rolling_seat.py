"""A bearing's outer ring in its housing, by finite elements, and how much a rigid ring would be wrong.

The outer ring is a round wall from the outer raceway to the outside diameter, the housing another about it, which is
held at some places of its outer edge. Loads go round past these places: what is said is the mean over them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from trochoid.kinematics.errors import Infeasible, NotConverged, TrochoidError
from trochoid.kinematics.types import Array, frozen
from trochoid.scene.rolling import RollingTable, Seat

if TYPE_CHECKING:
    from trochoid.fem.bearing import RollerBearing
    from trochoid.fem.bearing_duty import Duty
    from trochoid.fem.bearing_rating import Row
    from trochoid.fem.seat import FlexibleSeat
    from trochoid.scene.materials import Material

WAYS = 4  # directions of the load from one support to the next
LOOSE = 1e-9  # of the largest stiffness: less is rounding
THIN = 0.2e-3  # m: no outer ring is thinner
MOST = 640  # facets of a raceway; half as many on the coarser mesh, where none may be longer than its wall is thick


@dataclass(frozen=True, eq=False, slots=True)
class Seated:
    """What a flexible seat leaves of the stiffness along the load, across it, and of both tilts, against a rigid ring.

    `error`: of `along`, by finite elements; `largest`: load of the most loaded element against that on a rigid ring.
    `laws`: by how much the compliances of a roller differ, relative, after the standard and after Hertz and the seat's
    elements: both are in `along`.
    """

    along: float
    across: float
    tilts: tuple[float, float]
    error: float
    largest: float
    laws: float = 0.0

    @property
    def too_stiff(self) -> float:
        """How much the rigid ring's stiffness along the load is more than the seated one, in %."""
        return 100.0 * (1.0 / self.along - 1.0)

    @property
    def too_stiff_error(self) -> float:
        """Estimated error of `too_stiff`, in %: of the mesh and of the laws; no housing stiffens, so 0 is within it."""
        return max(100.0 * (self.error / self.along**2 + self.laws / self.along), -self.too_stiff)

    def applied(self, found: Duty) -> Array:
        """Return stiffnesses (m, 5, 5) of a bearing on rigid rings as they are in the seat."""
        push = found.loads[:, :2]
        size = np.linalg.norm(push, axis=1, keepdims=True)
        way = np.where(size > 0.0, push / np.where(size > 0.0, size, 1.0), [1.0, 0.0])
        side = np.stack([-way[:, 1], way[:, 0]], axis=1)
        scale = np.zeros((len(push), 5, 5))

        def share(one: float, other: float) -> Array:
            along, across = (np.einsum("mi,mj->mij", v, v) for v in (way, side))
            return np.asarray(np.sqrt(one) * along + np.sqrt(other) * across)

        scale[:, :2, :2] = share(self.along, self.across)
        scale[:, 2, 2] = 1.0
        scale[:, 3:, 3:] = share(*self.tilts)
        return frozen(scale @ found.stiffness @ scale)


def ring_faults(table: RollingTable, row: Row) -> tuple[str, ...]:
    """Return why an outer ring cannot be in the seat of a bearing."""
    assert table.outside is not None
    assert table.width is not None
    found = []
    race = _race(table, row)
    if 0.5 * table.outside - race < THIN:
        found.append(
            f"outside = {1e3 * table.outside:g} mm: rollers reach to {2e3 * race:.6g} mm, which leaves no outer ring; "
            f"need at least {2e3 * (race + THIN):.6g} mm"
        )
    length = getattr(row, "length", 0.0)
    if length > table.width:
        found.append(
            f"element_length = {1e3 * length:g} mm is more than width = {1e3 * table.width:g} mm of the ring"
        )
    return tuple(found)


@dataclass(frozen=True, eq=False, slots=True)
class SeatLevels:
    """The seat of a bearing by finite elements: `facets` on the raceway, and what meshes it with so many, once each.

    `wall`: thickness of the thinnest body beside the raceway, m.
    """

    table: RollingTable
    row: Row
    wall: float
    facets: int
    at: Callable[[int], FlexibleSeat]


def seat_levels(table: RollingTable, materials: Mapping[str, Material]) -> SeatLevels | None:
    """Return the seat of a bearing, None where it has none; nothing is meshed yet."""
    if table.seat is None or table.kind is None:
        return None
    from trochoid.drives.rolling import rolling
    from trochoid.fem.seat_ring import usual_facets

    assert table.outside is not None
    row = rolling(table)
    race = _race(table, row)
    wall = 0.5 * table.outside - race
    if _alike(table, materials):
        wall += table.seat.thickness
    at = lru_cache(maxsize=4)(lambda count: seat_of_table(table, row, materials, count))
    return SeatLevels(table, row, wall, min(usual_facets(race, wall), MOST), at)


def seated(name: str, levels: SeatLevels, load: float) -> Seated:
    """Return what the seat of a bearing does under a radial `load` in N; raises Infeasible that names the bearing."""
    from trochoid.fem.seat import plain_rollers
    from trochoid.fem.seat_error import rigid_ring_error

    table, rollers, facets = levels.table, plain_rollers(levels.row), levels.facets
    assert table.seat is not None
    if not load > 0.0:
        raise Infeasible(
            f"{name}: without a radial load nothing presses its seat; give radial_load, or take the seat away"
        )
    _fail_if_fine(name, levels)
    span, pitch = 2.0 * np.pi / max(table.seat.supports, 1), 2.0 * np.pi / rollers.rollers
    stiff, errors, largest = [], [], []
    for k in range(WAYS):  # with the load the rollers go on, a quarter of their pitch each time
        way = span * k / WAYS if table.seat.supports else 0.0
        push = np.array([np.cos(way), np.sin(way)])
        side = np.array([-push[1], push[0]])
        try:
            report = rigid_ring_error(rollers, levels.at, facets, load * push, way + pitch * k / WAYS)
        except NotConverged as error:
            raise NotConverged(f"{name}: {error}") from error
        except TrochoidError as error:
            raise Infeasible(f"{name}: {error}") from error
        both = (report.seated.stiffness, report.rigid.stiffness)
        stiff.append(
            [[float(v @ m[i : i + 2, i : i + 2] @ v) for i in (0, 2) for v in (push, side)] for m in both]
        )
        errors.append(report.stiffness.error / report.stiffness.value**2)
        largest.append(report.largest.value)
    soft, hard = np.mean(stiff, axis=0)
    held = hard > LOOSE * hard[[0, 0, 2, 2]].max()
    along, across, *tilts = np.where(held, np.maximum(soft, 0.0) / np.where(held, hard, 1.0), 1.0)
    return Seated(
        float(along),
        float(across),
        (float(tilts[0]), float(tilts[1])),
        float(np.mean(errors)),
        float(max(largest)),
        _between_laws(rollers, load),
    )


def _between_laws(rollers: RollerBearing, load: float) -> float:
    """Return how much a roller's tangent compliance differs after two laws under a bearing load, relative.

    ISO/TS 16281's power has 0.9 of its secant as tangent; of four logarithms with half widths that grow as √F (Hertz:
    both halves of the roller, both raceways) the tangent is the secant less 2·2/(πE'L). The seat of the one is
    exchanged for that of the other; as the load vanishes they part.
    """
    from trochoid.fem.bearing import EXPONENT, iso16281_constant
    from trochoid.fem.seat import STEEL

    share = 4.0 * load / rollers.rollers
    secant = (share / iso16281_constant(rollers.length)) ** (1.0 / EXPONENT) / share
    one = STEEL.plane("stress").kernel / rollers.length
    return float(abs(2.0 * one - (1.0 - 1.0 / EXPONENT) * secant) / (secant / EXPONENT))


def _fail_if_fine(name: str, levels: SeatLevels) -> None:
    """Refuse a wall that is too thin for elements of its thickness."""
    race = _race(levels.table, levels.row)
    least = 1.1 * 2.0 * np.pi * race / (0.5 * MOST)
    if levels.wall < least:
        raise Infeasible(
            f"{name}: the wall beside the raceway is {1e3 * levels.wall:.4g} mm thin: finite elements need "
            f"{1e3 * least:.4g} mm; give a larger outside or a smaller pitch_diameter (or a seat of steel as wide as "
            f"the bearing, which is one wall with the ring), or take the rigid ring"
        )


def seat_of_table(
    table: RollingTable, row: Row, materials: Mapping[str, Material], facets: int
) -> FlexibleSeat:
    """Return the outer ring in its housing with so many facets on the raceway."""
    from trochoid.fem.body import build_body
    from trochoid.fem.material import Material as Solid
    from trochoid.fem.seat import STEEL, seat_of
    from trochoid.fem.seat_ring import ring_outline
    from trochoid.geometry.mesh import mesh_outline

    seat = table.seat
    assert seat is not None
    assert table.outside is not None
    assert table.width is not None
    race, fit = _race(table, row), 0.5 * table.outside
    given = materials[seat.material]
    housing = Solid(given.youngs_modulus, given.poissons_ratio, given.density)
    width = seat.width or table.width
    arcs = held_arcs(seat)
    held = tuple(f"held{i}" for i in range(len(arcs))) or ("outer",)
    ring_plane, housing_plane = STEEL.plane("stress"), housing.plane("stress")
    if _alike(table, materials):
        outline = ring_outline(race, fit - race + seat.thickness, facets, arcs)
        return seat_of(build_body(mesh_outline(outline), ring_plane, held), outline.holes[0], table.width)
    from trochoid.fem.seat_joined import Layer, pressed_body
    from trochoid.geometry.outline import Loop, Outline
    from trochoid.kinematics.curve import Circle

    bore = Loop("bore", Circle((0.0, 0.0), race, hole=True), facets)
    ring = Outline(Loop("fit", Circle((0.0, 0.0), fit), facets), (bore,))
    around = ring_outline(fit, seat.thickness, facets, arcs)
    (hole,) = around.holes
    outside = Outline(around.outer, (Loop("fit", hole.curve, facets),))
    layers = (
        Layer(mesh_outline(ring), ring_plane, table.width),
        Layer(mesh_outline(outside), housing_plane, width),
    )
    return seat_of(pressed_body(*layers, "fit", held), bore, table.width)


def held_arcs(seat: Seat) -> tuple[tuple[float, float], ...]:
    """Return the arcs (from, to) in rad at which the housing is held, evenly spaced; none where all of its edge is."""
    pitch, half = 2.0 * np.pi / max(seat.supports, 1), 0.5 * seat.support_angle
    return tuple((float(pitch * i - half), float(pitch * i + half)) for i in range(seat.supports))


def _alike(table: RollingTable, materials: Mapping[str, Material]) -> bool:
    """Whether ring and housing are one wall: both of steel and equally wide."""
    from trochoid.fem.seat import STEEL

    seat = table.seat
    assert seat is not None
    given = materials[seat.material]
    same = (given.youngs_modulus, given.poissons_ratio) == (STEEL.youngs_modulus, STEEL.poissons_ratio)
    return same and seat.width in (None, table.width)


def _race(table: RollingTable, row: Row) -> float:
    """Return the radius of the outer raceway, m."""
    return 0.5 * (row.pitch_diameter + getattr(row, "roller_diameter", 0.0) + table.clearance)
