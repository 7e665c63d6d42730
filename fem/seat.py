"""A bearing seat that yields: the bore of an elastic plane body under the rollers that run in it.

Rollers press the bore along its radii. What the bore moves under each of them per unit force on each is read from
the body's compliance; the seat that ISO/TS 16281 contains is taken out in exchange (see `seat_law`). All of it is
one matrix (rollers, rollers), which `seat_equilibrium` puts in series with the rollers. The body is plane: it yields
alike over its width, so a seat serves rollers only. Balls press at points, which no plane body has.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.bearing import EXPONENT, RollerBearing, iso16281_constant
from trochoid.fem.body import Body
from trochoid.fem.compliance import press, surface_weights
from trochoid.fem.coupling import ElasticBody
from trochoid.fem.laws import PowerLaw
from trochoid.fem.material import Material, Plane, PlaneState
from trochoid.fem.rolling import Rolling
from trochoid.fem.rolling_roller import RollerRow
from trochoid.fem.seat_law import RollerSeat
from trochoid.fem.surface import Surface, Weights
from trochoid.geometry.mesh import Mesh
from trochoid.geometry.outline import Loop
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, frozen

STEEL = Material(210e9, 0.3)  # of rollers and inner raceway: ISO/TS 16281's
FIT = 0.01  # of the bore: how much the rollers' outer circle may differ from it
AROUND = 360  # points of the bore that its mean motion is taken from


@dataclass(frozen=True, slots=True)
class FlexibleSeat:
    """The bore of a body: its compliance per unit thickness and the width, the bore's surface and circle, m.

    `plane` are the moduli of the material at the bore.
    """

    body: ElasticBody
    surface: Surface
    circle: Circle
    plane: Plane

    def places(self, angle: Array) -> tuple[Weights, Array]:
        """Return where (n,) polar angles lie on the bore: spline weights and points (n, 2) in m."""
        return surface_weights(self.surface, self.circle.radius * angle), self.circle.point(angle)


def seat_of(body: Body, bore: Loop, width: float) -> FlexibleSeat:
    """Return the seat in a body of `width` m; every facet of the loop `bore` is pressed once.

    A free body (without supports) yields relative to its mean motion. Raises Infeasible where the bore is not a
    round hole, or where a wall beside it is thinner than its facets.
    """
    circle = bore.curve
    if not (isinstance(circle, Circle) and circle.hole):
        raise Infeasible(f'seat: the loop "{bore.name}" must be a round hole, given {type(circle).__name__}')
    if not (np.isfinite(width) and width > 0.0):
        raise Infeasible(f"seat: the width must be positive and finite, given {width} m")
    _fail_if_thin(body.mesh, bore.name)
    compliance = press(body, [bore])
    return FlexibleSeat(ElasticBody(compliance, width), compliance.surfaces[bore.name], circle, body.plane)


def plain_rollers(bearing: RollerBearing | Rolling) -> RollerBearing:
    """Return a cylindrical roller bearing as the plane sees it; raises Infeasible for any other bearing."""
    if isinstance(bearing, RollerBearing):
        return bearing
    advice = "take its rigid-ring stiffness, or a roller bearing in its place"
    if not isinstance(bearing, RollerRow):
        raise Infeasible(
            f"seat: {type(bearing).__name__} presses its seat at points: how far that yields is a problem in three "
            f"dimensions, and a plane body has no answer; {advice}"
        )
    if bearing.contact_angle != 0.0 or any(bearing.drop) or bearing.factor != 1.0:
        raise Infeasible(
            f"seat: a plane body carries straight steel rollers at contact angle 0, given "
            f"{np.degrees(bearing.contact_angle):.6g}°, {'a' if any(bearing.drop) else 'no'} profile, "
            f"factor {bearing.factor:.6g}; {advice}"
        )
    return RollerBearing(
        bearing.rollers,
        0.5 * bearing.roller_diameter,
        0.5 * bearing.pitch_diameter,
        bearing.length,
        bearing.clearance,
        bearing.slices,
    )


def roller_angles(bearing: RollerBearing, roller_angle0: float = 0.0) -> Array:
    """Return the polar angles (rollers,) of the rollers."""
    return roller_angle0 + 2.0 * np.pi * np.arange(bearing.rollers) / bearing.rollers


def seat_compliance(
    bearing: RollerBearing, seat: FlexibleSeat, force: float, roller_angle0: float = 0.0
) -> Array:
    """Return what the seat yields beyond the one that ISO/TS 16281 contains, (rollers, rollers) in m/N.

    On the diagonal is also the logarithm of each contact on the bore, at a typical roller load under the bearing
    `force` in N and the preload. Raises Infeasible when the rollers do not fit the bore.
    """
    law = roller_seat(bearing, seat)
    weights, points = seat.places(roller_angles(bearing, roller_angle0))
    compliance = seat.body.compliance.between(weights, points) / seat.body.width
    whole = PowerLaw(iso16281_constant(bearing.length), EXPONENT)
    preload = whole.constant * max(-0.5 * bearing.clearance, 0.0) ** EXPONENT
    load = max(law.typical_load(force), preload)
    compliance[np.diag_indices_from(compliance)] += law.widening + law.seat_for_seat(whole, load)
    return frozen(0.5 * (compliance + compliance.T))


def bore_motion(bearing: RollerBearing, seat: FlexibleSeat, roller_angle0: float = 0.0) -> Array:
    """Return the mean motion x, y of the bore per unit roller forces (2, rollers), in m/N.

    It is the translation that fits the bore's radial displacements best. The logarithm's part is in closed form:
    −ln|x−y| on a circle is −ln R + Σ cos nφ/n.
    """
    rollers, around = roller_angles(bearing, roller_angle0), 2.0 * np.pi * np.arange(AROUND) / AROUND
    (one, at), (two, points) = seat.places(rollers), seat.places(around)
    compliance, count = seat.body.compliance, bearing.rollers
    smooth = compliance.smooth(Weights.joined([one, two]), np.concatenate([at, points]))[count:, :count]
    mean = 2.0 / AROUND * _radii(around).T @ smooth + compliance.kernel * _radii(rollers).T
    return frozen(mean / seat.body.width)


def roller_seat(bearing: RollerBearing, seat: FlexibleSeat) -> RollerSeat:
    """Return the rollers in the bore as the exchange of the seat sees them; raises Infeasible when they do not fit."""
    outer = bearing.pitch_radius + bearing.roller_radius + 0.5 * bearing.clearance
    bore, width = seat.circle.radius, seat.body.width
    if abs(outer - bore) > FIT * bore:
        raise Infeasible(
            f"seat: rollers reach to the radius {1e3 * outer:.6g} mm, the bore has {1e3 * bore:.6g} mm; "
            f"nearest is a pitch radius of {1e3 * (bore - bearing.roller_radius - 0.5 * bearing.clearance):.6g} mm"
        )
    if bearing.length > width * (1.0 + 1e-9):
        raise Infeasible(
            f"seat: rollers of {1e3 * bearing.length:.6g} mm in a body {1e3 * width:.6g} mm wide; "
            f"make it at least as wide as the rollers are long"
        )
    state: PlaneState = "strain" if seat.plane.out_of_plane else "stress"
    steel, inner = STEEL.plane(state), bore - 2.0 * bearing.roller_radius
    sizes = (bearing.roller_radius, bearing.length, inner, bore, width)
    return RollerSeat(steel, state, bearing.rollers, *sizes, hole=seat.plane)


def _radii(angle: Array) -> Array:
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def _fail_if_thin(mesh: Mesh, bore: str) -> None:
    """Refuse walls with less than one facet of the bore across: no element there could bend."""
    edge = mesh.edges[bore]
    others = [e.ravel() for e in mesh.edges.values() if not np.isin(e, edge).any()]
    if not others:
        return
    from scipy.spatial import cKDTree

    facet = np.linalg.norm(mesh.points[edge[1]] - mesh.points[edge[0]], axis=1)
    wall, _ = cKDTree(mesh.points[np.unique(np.concatenate(others))]).query(mesh.points[edge[2]])
    worst = int(np.argmax(facet / wall))
    if facet[worst] > wall[worst]:
        need = int(np.ceil(facet.size * facet[worst] / wall[worst]))
        raise Infeasible(
            f'seat: the wall beside "{bore}" is {1e3 * wall[worst]:.6g} mm thin where its facets are '
            f"{1e3 * facet[worst]:.6g} mm long; give at least {need} facets instead of {facet.size}"
        )
