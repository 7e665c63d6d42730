"""From a bearing's table of the scene to the bearing, its stiffness under loads, its seat, and what is said of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.kinematics.errors import Infeasible, NotConverged
from trochoid.kinematics.types import Array, frozen
from trochoid.scene.rolling import PLAIN, RollingTable

if TYPE_CHECKING:
    from trochoid.drives.rolling_seat import Seated, SeatLevels
    from trochoid.fem.bearing_duty import Duty, Endurance
    from trochoid.fem.bearing_rating import Row
    from trochoid.fem.rolling import Rolling
    from trochoid.fem.rolling_roller import RollerRow

ANGULAR, TAPERED = float(np.radians(25.0)), float(np.radians(14.0))  # contact angles where none is given
SETTLED = 1e-6  # relative change of the stiffness when loads and stiffness agree
STEPS = 20
MOST_PLAY = 0.1  # of the element's diameter: more is no clearance or press fit of a bearing
MOST_PRESSURE = 10e9  # Pa: raceways sink in from 4 GPa on
UPRIGHT = {"tilt_x": 0.0, "tilt_y": 0.0}


@dataclass(frozen=True, eq=False, slots=True)
class Held:
    """A rolling bearing in a drive: its table, and what it does under its loads; `seat` where it has a flexible one."""

    table: RollingTable
    duty: Duty
    seat: Seated | None

    @property
    def stiffness(self) -> Array:
        """Stiffness (m, 5, 5) under each load on x, y, z in N/m and both tilts, in its seat."""
        return self.duty.stiffness if self.seat is None else self.seat.applied(self.duty)

    @property
    def mean(self) -> Array:
        """Mean (5, 5) over the loads."""
        return np.asarray(self.stiffness.mean(axis=0))

    @property
    def radial(self) -> float:
        """Mean radial stiffness over the loads and all directions, N/m."""
        return float(0.5 * np.trace(self.mean[:2, :2]))

    @property
    def extremes(self) -> tuple[float, float]:
        """Least and largest stiffness along the load, over the loads, N/m."""
        along = self.duty.along * (1.0 if self.seat is None else self.seat.along)
        return float(along.min()), float(along.max())


def rolling(table: RollingTable) -> Row:
    """Return the rolling bearing of a table: what is given, the rest assumed from its boundary dimensions.

    Raises Infeasible for elements that overlap and for sizes that no bearing has.
    """
    made = _row(table)
    size = getattr(made, "ball_diameter", None) or made.roller_diameter  # type: ignore[union-attr]
    if abs(table.clearance) > MOST_PLAY * size:
        raise Infeasible(
            f"clearance = {1e3 * table.clearance:g} mm with elements of {1e3 * size:.4g} mm: no bearing is so loose or "
            f"so tight; need {1e3 * MOST_PLAY * size:.3g} mm at most, of either sign"
        )
    return made


def _row(table: RollingTable) -> Row:
    from trochoid.fem.rolling_assumed import (
        assumed_ball_bearing,
        assumed_needle_bearing,
        assumed_roller_bearing,
        assumed_tapered_bearing,
    )
    from trochoid.fem.rolling_ball import BallBearing
    from trochoid.fem.rolling_roller import logarithmic

    balls, angle = table.kind in ("deep_groove", "angular_contact"), _angle(table)
    if table.bore is None or table.outside is None or table.width is None:
        made = _of_inner_geometry(table)
    elif balls:
        sizes = (table.bore, table.outside, table.width)
        made = assumed_ball_bearing(*sizes, contact_angle=angle, clearance=table.clearance)
    elif table.kind == "tapered":
        made = assumed_tapered_bearing(table.bore, table.outside, table.width, contact_angle=angle)
        made = replace(made, clearance=table.clearance)
    else:
        assume = assumed_needle_bearing if table.kind == "needle" else assumed_roller_bearing
        made = assume(table.bore, table.outside, table.width, clearance=table.clearance)
    pitch = table.pitch_diameter or made.pitch_diameter
    if isinstance(made, BallBearing):
        ball = table.element_diameter or made.ball_diameter
        return replace(
            made,
            balls=table.elements or made.balls,
            ball_diameter=ball,
            pitch_diameter=pitch,
            inner_groove_radius=table.inner_groove * ball,
            outer_groove_radius=table.outer_groove * ball,
        )
    diameter, length = table.element_diameter or made.roller_diameter, table.element_length or made.length
    drop = made.drop
    if (diameter, length) != (made.roller_diameter, made.length):
        drop = logarithmic(diameter, length)
    return replace(
        made,
        rollers=table.elements or made.rollers,
        roller_diameter=diameter,
        pitch_diameter=pitch,
        length=length,
        drop=() if table.straight_rollers or table.seat is not None else drop,
    )


def _angle(table: RollingTable) -> float:
    if table.contact_angle:
        return table.contact_angle
    return {"angular_contact": ANGULAR, "tapered": TAPERED}.get(table.kind or "", 0.0)


def _of_inner_geometry(table: RollingTable) -> Row:
    """Return a bearing whose inner geometry is given in full; the scene has seen to that."""
    from trochoid.fem.rolling_ball import BallBearing
    from trochoid.fem.rolling_roller import RollerRow, logarithmic

    count, diameter, pitch = table.elements or 0, table.element_diameter or 0.0, table.pitch_diameter or 0.0
    if table.kind in ("deep_groove", "angular_contact"):
        grooves = (table.inner_groove * diameter, table.outer_groove * diameter)
        return BallBearing(count, diameter, pitch, *grooves, _angle(table), table.clearance)
    length = table.element_length or 0.0
    drop = logarithmic(diameter, length, factor=0.00045 if table.kind == "tapered" else None)
    return RollerRow(count, diameter, pitch, length, _angle(table), table.clearance, drop=drop)


def faults(named: Mapping[str, RollingTable | None]) -> tuple[str, ...]:
    """Return why the bearings of these names cannot be built, one sentence each."""
    from trochoid.drives.rolling_seat import ring_faults

    found: list[str] = []
    for name, table in named.items():
        if table is None or table.kind is None:
            continue
        try:
            row = rolling(table)
        except Infeasible as error:
            found.append(f"{name}: {error}")
            continue
        if table.seat is not None:
            found += [f"{name}.{reason}" for reason in ring_faults(table, row)]
    return tuple(found)


def held(
    name: str,
    table: RollingTable,
    loads: Array,
    levels: SeatLevels | None = None,
    speed: tuple[float, float] = (0.0, 0.0),
    upright: bool = True,
) -> Held:
    """Return a bearing under radial loads (m, 2) in N, or under loads (m, 5) with moments if it is not kept `upright`.

    `radial_load` of the table takes the place of their size, `axial_load` is added; `levels`: the seat of the table;
    `speed` (rad/s) of inner and outer ring counts where centrifugal force does. Raises Infeasible that names the
    bearing where it cannot be built or loaded, or resists nothing.
    """
    from trochoid.fem.bearing_duty import duty, fail_if_loose

    row, whole = rolling(table), sized(table, loads)
    bearing: Rolling = row
    if table.centrifugal:
        from trochoid.fem.rolling_ball import BallBearing
        from trochoid.fem.rolling_centrifugal import spinning

        assert isinstance(row, BallBearing)
        bearing = spinning(row, *speed)
    fixed = dict(UPRIGHT) if upright else {}
    if table.kind in PLAIN:
        fixed["z"] = 0.0
    try:
        found = duty(bearing, whole, fixed)
    except Infeasible as error:
        raise Infeasible(f"{name}: {error}") from error
    except NotConverged as error:
        raise NotConverged(f"{name}: {error}") from error
    if found.pressure > MOST_PRESSURE:
        sizes = [float(np.linalg.norm(whole[:, :2], axis=1).max()), float(np.abs(whole[:, 2]).max())]
        raise Infeasible(
            f"{name}: {1e-9 * found.pressure:.3g} GPa on a raceway under a radial load of {sizes[0]:.4g} N and an "
            f"axial one of {sizes[1]:.4g} N at clearance = {1e3 * table.clearance:g} mm: no bearing carries that "
            f"(raceways sink in from 4 GPa on); give a smaller load, less press fit or a larger bearing"
        )
    mean = found.mean
    fail_if_loose(
        name,
        mean[:2, :2],
        np.ones(2),
        "give it a radial_load (what it carries), a negative clearance (preload), or a stiffness in its place",
    )
    seat = None
    if levels is not None:
        from trochoid.drives.rolling_seat import seated

        seat = seated(name, levels, float(np.linalg.norm(whole[:, :2], axis=1).mean()))
    return Held(table, found, seat)


def sized(table: RollingTable, loads: Array) -> Array:
    """Return loads (m, 5) with the sizes that the table gives; the force's leaves the moment as it is."""
    loads = np.atleast_2d(np.asarray(loads, dtype=np.float64))
    whole = np.zeros((len(loads), 5))
    whole[:, : loads.shape[1]] = loads
    if table.radial_load is not None:
        whole[:, :2] = table.radial_load * _ways(whole[:, :2], (0.0, 1.0))
    moment = getattr(table, "moment_load", None)
    if moment is not None:
        whole[:, 3:] = moment * _ways(whole[:, 3:], (1.0, 0.0))
    whole[:, 2] = table.axial_load
    return frozen(whole)


def _ways(vectors: Array, otherwise: tuple[float, float]) -> Array:
    """Return unit vectors (m, 2) along vectors, where these are none the other one."""
    size = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(np.where(size > 0.0, vectors / np.where(size > 0.0, size, 1.0), otherwise))


def rollers_under(row: RollerRow, forces: Array, resultant: Array) -> Duty:
    """Return cylindrical rollers that were solved elsewhere: normal forces (m, rollers) and their resultant (m, 2), N.

    Their stiffness is not in it.
    """
    from trochoid.fem.bearing_duty import Duty
    from trochoid.fem.rolling import RollingState

    count = len(forces)
    loads = np.zeros((count, 5))
    loads[:, :2] = resultant
    slices = np.repeat(forces[..., None] / row.slices, row.slices, axis=-1)
    flat = np.zeros_like(forces)
    none, matrix = np.zeros((count, 5)), np.zeros((count, 5, 5))
    state = RollingState(
        none, np.zeros(row.rollers), forces, forces, flat, flat, slices, loads, matrix, np.zeros(count)
    )
    return Duty(row, frozen(loads), frozen(matrix), (state,))


def endured(found: Held, inner_turns: bool = True) -> Endurance:
    """Return safety and life of a bearing under its loads."""
    from trochoid.fem.bearing_duty import Lubrication, endurance

    table, oil = found.table, None
    if table.viscosity_ratio is not None and table.fatigue_load is not None:
        oil = Lubrication(table.viscosity_ratio, table.fatigue_load, table.contamination)
    return endurance(found.duty, table.dynamic_rating, inner_turns, oil)
