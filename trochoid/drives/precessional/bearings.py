"""The joints A, B, O, C of a precessional drive: what they yield by, and where they are rigid.

A joint holds some of the six relative motions (x, y, z, rotations about them) of two members by springs, some
rigidly; the others are free, as in the rigid model, so that both have the same reactions where nothing moves.
Rolling bearings are taken at the mean reaction of the rigid drive, which stands still in the frame of the shaft.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.reactions import Reactions
from trochoid.fem.rolling import Rolling, about
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, frozen
from trochoid.scene.drive_precessional import Bearing, Support

ACROSS, ALONG, TILTS = (0, 1), 2, (3, 4)
TURNS = 4  # places of the elements over one pitch, whose stiffness is averaged
ANGULAR, TAPERED = float(np.radians(25.0)), float(np.radians(14.0))  # contact angles where none is given


@dataclass(frozen=True, eq=False, slots=True)
class Joint:
    """`stiffness` (6, 6) of a joint, N/m, N, N·m/rad, and the motions that it holds `rigid`ly."""

    name: str
    stiffness: Array
    rigid: tuple[int, ...]

    @property
    def yields(self) -> bool:
        """Whether any spring is in it."""
        return bool(self.stiffness.any())

    def times(self, factor: float) -> Joint:
        """Return the joint with springs that many times as stiff."""
        return Joint(self.name, frozen(factor * self.stiffness), self.rigid)


@dataclass(frozen=True, slots=True)
class Joints:
    """All joints: A between crank and satellite, B between shaft and casing, O before and C behind the output shaft.

    `c` is None where the output shaft is held rigidly: then it does not move.
    """

    a: Joint
    b: Joint
    o: Joint
    c: Joint | None

    @property
    def yields(self) -> bool:
        """Whether any joint does."""
        return any(joint.yields for joint in (self.a, self.b, self.o, self.c) if joint is not None)

    def times(self, factor: float) -> Joints:
        """Return the joints with all springs that many times as stiff."""
        return Joints(
            self.a.times(factor),
            self.b.times(factor),
            self.o.times(factor),
            None if self.c is None else self.c.times(factor),
        )


def joints(design: Design, rigid: Reactions) -> Joints:
    """Read the joints from the scene, rolling bearings under the mean of the `rigid` reactions over a turn.

    Raises Infeasible for a bearing that cannot be built or loaded, or that resists nothing.
    """
    d = design.scene.drive
    none = np.zeros(2)
    force_a, force_b = rigid.joint_a.mean(axis=0)[:2], -rigid.support.mean(axis=0)[:2]
    moment_b = -rigid.support_moment.mean(axis=0)[:2]
    springs = np.zeros((6, 6))
    o, c = Joint("O", springs, ACROSS), None
    if d.joint_o is not None:
        o = Joint("O", _diagonal({0: d.joint_o.radial_stiffness, 1: d.joint_o.radial_stiffness}), ())
        back = d.joint_o.bearing_stiffness
        # the output shaft turns evenly and cannot tilt: with its mass goes its motion across z alone
        c = None if back is None else Joint("C", _diagonal({0: back, 1: back}), (2, 3, 4, 5))
    return Joints(
        _joint("A", d.bearing_a, force_a, none, tilts=False),
        _joint("B", d.bearing_b, force_b, moment_b, tilts=True),
        o,
        c,
    )


def _diagonal(entries: dict[int, float]) -> Array:
    matrix = np.zeros((6, 6))
    for place, value in entries.items():
        matrix[place, place] = value
    return frozen(matrix)


def _joint(name: str, table: Bearing | None, force: Array, moment: Array, tilts: bool) -> Joint:
    if table is None:
        return Joint(name, np.zeros((6, 6)), (*ACROSS, ALONG, *(TILTS if tilts else ())))
    axial = table.axial_stiffness is not None or (table.kind is not None and table.axial_load > 0.0)
    tilt = table.tilt_stiffness if isinstance(table, Support) else None
    tilting = tilts and (table.kind is not None or tilt is not None)
    sprung = [*ACROSS, *((ALONG,) if axial else ()), *(TILTS if tilting else ())]
    matrix = np.zeros((6, 6))
    if table.kind is not None:
        found, lever = rolling_stiffness(name, table, force, moment, tilts)
        matrix[np.ix_(sprung, sprung)] = found[np.ix_(sprung, sprung)]
        _fail_if_loose(name, matrix[np.ix_(sprung, sprung)], lever, sprung)
    _replaced(matrix, ACROSS, table.radial_stiffness)
    _replaced(matrix, (ALONG,), table.axial_stiffness)
    _replaced(matrix, TILTS, tilt)
    held = (*ACROSS, ALONG, *(TILTS if tilts else ()))
    return Joint(name, frozen(matrix), tuple(i for i in held if i not in sprung))


def _replaced(matrix: Array, places: tuple[int, ...], value: float | None) -> None:
    """Put a given stiffness in the place of a computed one, without what coupled it to others."""
    if value is None:
        return
    for i in places:
        matrix[i, :] = matrix[:, i] = 0.0
        matrix[i, i] = value


def rolling_stiffness(
    name: str, table: Bearing, force: Array, moment: Array, tilts: bool
) -> tuple[Array, float]:
    """Return the stiffness (5, 5) on x, y, z and both tilts of a joint's rolling bearings, and their lever in m.

    `force` (2,) N and `moment` (2,) N·m go from shaft to seat; `radial_load` takes the place of their size.
    """
    size = float(np.hypot(*force))
    if table.radial_load is not None:
        direction = force / size if size > 0.0 else np.array([0.0, 1.0])
        moment = moment * (table.radial_load / size if size > 0.0 else 0.0)
        force = direction * table.radial_load
    bearing = rolling(table)
    spread = table.spread if isinstance(table, Support) else 0.0
    if spread == 0.0:
        load = np.array([*force, table.axial_load, *moment])
        return _mean_stiffness(bearing, table, load, tilts), bearing.lever
    whole = np.zeros((5, 5))
    for sign in (1.0, -1.0):  # a pair of like bearings carries a moment as a couple of forces
        couple = sign * np.array([moment[1], -moment[0]]) / spread
        load = np.array([*(0.5 * force + couple), table.axial_load, 0.0, 0.0])
        whole += about(_mean_stiffness(bearing, table, load, tilts), -0.5 * sign * spread)
    return whole, max(bearing.lever, 0.5 * spread)


def rolling(table: Bearing) -> Rolling:
    """Return the rolling bearing of a table: assumed from its boundary dimensions, with what is given besides."""
    from trochoid.fem.rolling_assumed import (
        assumed_ball_bearing,
        assumed_needle_bearing,
        assumed_roller_bearing,
        assumed_tapered_bearing,
    )
    from trochoid.fem.rolling_ball import BallBearing
    from trochoid.fem.rolling_roller import RollerRow, logarithmic

    sizes = (table.bore or 0.0, table.outside or 0.0, table.width or 0.0)
    made: BallBearing | RollerRow
    if table.kind in ("deep_groove", "angular_contact"):
        angle = 0.0 if table.kind == "deep_groove" else (table.contact_angle or ANGULAR)
        made = assumed_ball_bearing(*sizes, contact_angle=angle, clearance=table.clearance)
        ball = table.element_diameter or made.ball_diameter
        ratio = ball / made.ball_diameter
        return replace(
            made,
            balls=table.elements or made.balls,
            ball_diameter=ball,
            inner_groove_radius=ratio * made.inner_groove_radius,
            outer_groove_radius=ratio * made.outer_groove_radius,
        )
    if table.kind == "tapered":
        made = assumed_tapered_bearing(*sizes, contact_angle=table.contact_angle or TAPERED)
    elif table.kind == "needle":
        made = assumed_needle_bearing(*sizes, clearance=table.clearance)
    else:
        made = assumed_roller_bearing(*sizes, clearance=table.clearance)
    diameter, length = (
        table.element_diameter or made.roller_diameter,
        table.element_length or made.length,
    )
    given = (diameter, length) != (made.roller_diameter, made.length)
    return replace(
        made,
        rollers=table.elements or made.rollers,
        roller_diameter=diameter,
        length=length,
        drop=logarithmic(diameter, length) if given else made.drop,
    )


def _mean_stiffness(bearing: Rolling, table: Bearing, load: Array, tilts: bool) -> Array:
    """Return the mean stiffness (5, 5) over the places that the elements take as they go round."""
    from trochoid.fem.rolling_equilibrium import solve

    held = {} if tilts else {"tilt_x": 0.0, "tilt_y": 0.0}
    if table.kind in ("cylindrical", "needle"):
        held["z"] = 0.0
    count = getattr(bearing, "balls", 0) or getattr(bearing, "rollers", 0)
    turns = 2.0 * np.pi / count * np.arange(TURNS) / TURNS
    return np.asarray(np.mean([solve(bearing, load, held, turn).stiffness for turn in turns], axis=0))


def _fail_if_loose(name: str, matrix: Array, lever: float, sprung: list[int]) -> None:
    unit = np.array([lever if i in TILTS else 1.0 for i in sprung])
    values = np.linalg.eigvalsh(matrix / np.outer(unit, unit))
    if values[0] <= 1e-9 * max(values[-1], 1e-300):
        raise Infeasible(
            f"bearing {name} resists nothing in one of its directions: under the mean inertia load too few elements "
            f"carry; give bearing_{name.lower()}.radial_load (what it carries besides), an axial_load or a smaller "
            f"clearance, or its stiffnesses"
        )
