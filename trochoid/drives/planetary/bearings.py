"""The bearings between planets and carrier: a stiffness as given, or that of a rolling bearing under a planet's force.

Equilibrium alone tells that force where planets are alike, so that no stiffness is in it. It stands still in the
carrier's frame: the bearing is stiffer along it than across it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.rolling import Held, held
from trochoid.drives.rolling_seat import seat_levels
from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    from trochoid.drives.planetary.design import Design
    from trochoid.drives.planetary.series import Series

NAME = "drive.planet.bearing"


@dataclass(frozen=True, eq=False, slots=True)
class PlanetSeat:
    """The rolling bearing of a planet and the stiffness (2, 2) that counts, outward and along its orbit, N/m."""

    bearing: Held
    stiffness: Array

    def at(self, center: Array) -> Array:
        """Return the stiffness (2, 2) along x and y for a planet at a place (2,)."""
        axes = local(center)
        turned = axes.T @ self.stiffness @ axes
        return np.asarray(0.5 * (turned + turned.T))


def local(center: Array) -> Array:
    """Return the unit vectors (2, 2) outward and in the orbit's direction at a place (2,), in rows."""
    out = center / np.linalg.norm(center)
    return np.stack([out, [-out[1], out[0]]])


def planet_seat(design: Design) -> PlanetSeat | None:
    """Return the rolling bearing of a planet under its nominal force, None where the scene has none."""
    table = design.drive.planet.bearing
    if table is None:
        return None
    from trochoid.drives.planetary.rigid import rigid
    from trochoid.kinematics.train import planetary_train, speeds

    d, mass = design.drive, 0.0
    if design.scene.has("inertia"):
        from trochoid.drives.planetary.mass import masses
        from trochoid.geometry.planetary_curves import members

        mass = masses(design, members(design.given, design.rounding)).planet.mass
    turning = speeds(planetary_train(d.z_sun, d.z_planet, d.z_ring), d.fixed, d.driving, d.driven)
    force = rigid(design, turning, mass)
    # from the pin, where the inner ring is, to the planet
    found = held(
        NAME,
        table,
        -np.array([[force.radial, force.tangential]]),
        seat_levels(table, design.scene.materials),
        ring_speeds(design),
    )
    return PlanetSeat(found, found.mean[:2, :2])


def ring_speeds(design: Design) -> tuple[float, float]:
    """Return the speeds (rad/s) of the pin and of the planet past the carrier."""
    from trochoid.kinematics.train import planetary_train, speeds

    d = design.drive
    turning = speeds(planetary_train(d.z_sun, d.z_planet, d.z_ring), d.fixed, d.driving, d.driven)
    return 0.0, float(turning.relative("planet", "carrier")) * design.scene.operation.input_speed


def under(design: Design, series: Series) -> tuple[Held, ...]:
    """Return each planet's rolling bearing under the forces over a pitch."""
    seat = design.planet_seat
    if seat is None:
        return ()
    found = []
    for i, place in enumerate(series.places):
        force = -series.bearing[:, i] @ local(place).T
        now = held(NAME, seat.bearing.table, force, None, ring_speeds(design))
        found.append(replace(now, seat=seat.bearing.seat))
    return tuple(found)
