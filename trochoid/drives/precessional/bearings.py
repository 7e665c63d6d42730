"""The joints A, B, O, C of a precessional drive: what they yield by, and where they are rigid.

A joint holds some of the six relative motions (x, y, z, rotations about them) of two members by springs, some
rigidly; the others are free, as in the rigid model, so that both have the same reactions where nothing moves.
Rolling bearings are taken at the mean reaction, which stands still in the frame of the shaft.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.reactions import Reactions
from trochoid.drives.precessional.tooth_loads import ToothLoads
from trochoid.drives.rolling import Held, held, sized
from trochoid.drives.rolling_seat import SeatLevels, seat_levels
from trochoid.fem.bearing_duty import fail_if_loose
from trochoid.fem.rolling import about
from trochoid.kinematics.types import Array, frozen
from trochoid.scene.drive_precessional import Bearing, OutputBearing, Support
from trochoid.scene.rolling import RollingTable

ACROSS, ALONG, TILTS = (0, 1), 2, (3, 4)
ADVICE = (
    "under the mean inertia load alone; give bearing_{}.radial_load (what it carries besides), an axial_load or a "
    "smaller clearance, or its stiffnesses"
)


@dataclass(frozen=True, eq=False, slots=True)
class Joint:
    """`stiffness` (6, 6) of a joint, N/m, N, N·m/rad, the motions that it holds `rigid`ly, its rolling `bearings`."""

    name: str
    stiffness: Array
    rigid: tuple[int, ...]
    bearings: tuple[Held, ...] = ()

    @property
    def yields(self) -> bool:
        """Whether any spring is in it."""
        return bool(self.stiffness.any())

    def times(self, factor: float) -> Joint:
        """Return the joint with springs that many times as stiff."""
        return Joint(self.name, frozen(factor * self.stiffness), self.rigid, self.bearings)


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
    def all(self) -> tuple[Joint, ...]:
        """A, B, O, and C where it yields."""
        return (self.a, self.b, self.o) if self.c is None else (self.a, self.b, self.o, self.c)

    @property
    def yields(self) -> bool:
        """Whether any joint does."""
        return any(joint.yields for joint in self.all)

    def times(self, factor: float) -> Joints:
        """Return the joints with all springs that many times as stiff."""
        return Joints(
            self.a.times(factor),
            self.b.times(factor),
            self.o.times(factor),
            None if self.c is None else self.c.times(factor),
        )


@dataclass(frozen=True, eq=False, slots=True)
class Carried:
    """Forces (m, 2) N and moments (m, 2) N·m from shaft to seat of A, B, C, in the frame of the input shaft."""

    a: Array
    b: Array
    b_moment: Array
    c: Array

    @classmethod
    def by(cls, found: Reactions) -> Carried:
        """Read them from reactions at m angles."""
        return cls(
            found.joint_a[:, :2],
            -found.support[:, :2],
            -found.support_moment[:, :2],
            -(found.joint_o if found.output is None else found.output)[:, :2],
        )

    def beside(self, teeth: ToothLoads) -> Carried:
        """Return the loads (m, 2) with the mean over a pitch of what teeth add: all but steady in the shaft's frame.

        There the satellite's axis leans to y, in the crank's frame of the teeth to x.
        """

        def turned(vectors: Array) -> Array:
            x, y = vectors[:, :2].mean(axis=0)
            return np.array([-y, x])

        return Carried(
            self.a + turned(teeth.joint_a),
            self.b - turned(teeth.support),
            self.b_moment - turned(teeth.support_moment),
            self.c - turned(teeth.joint_o),
        )

    @property
    def mean(self) -> Carried:
        """Their mean alone (1, 2)."""
        return Carried(*(x.mean(axis=0, keepdims=True) for x in (self.a, self.b, self.b_moment, self.c)))


def seats(design: Design) -> dict[str, SeatLevels | None]:
    """Return the flexible seats of A, B and C."""
    d, materials = design.scene.drive, design.scene.materials
    tables = {"A": d.bearing_a, "B": d.bearing_b, "C": d.bearing_c}
    return {name: None if x is None else seat_levels(x, materials) for name, x in tables.items()}


def joints(design: Design, loads: Carried, seated: Mapping[str, SeatLevels | None]) -> Joints:
    """Read the joints from the scene, rolling bearings in their `seats` under the mean of `loads` over a turn.

    Raises Infeasible for a bearing that cannot be built or loaded, or that resists nothing.
    """
    d, at = design.scene.drive, loads.mean
    none = np.zeros(2)
    springs = np.zeros((6, 6))
    o, c = Joint("O", springs, ACROSS), None
    if d.joint_o is not None:
        o = Joint("O", _diagonal({0: d.joint_o.radial_stiffness, 1: d.joint_o.radial_stiffness}), ())
        back = d.joint_o.bearing_stiffness
        # the output shaft turns evenly and cannot tilt: with its mass goes its motion across z alone
        c = None if back is None else Joint("C", _diagonal({0: back, 1: back}), (2, 3, 4, 5))
        if d.bearing_c is not None:
            c = _behind(design, d.bearing_c, at.c, back, seated.get("C"))
    turning = speeds(design)
    return Joints(
        _joint("A", d.bearing_a, at.a[0], none, False, seated.get("A"), turning["A"]),
        _joint("B", d.bearing_b, at.b[0], at.b_moment[0], True, seated.get("B"), turning["B"]),
        o,
        c,
    )


def speeds(design: Design) -> dict[str, tuple[float, float]]:
    """Return the speeds (rad/s) of the inner and the outer ring of A, B and C about their axis."""
    d, shaft = design.scene.drive, design.speed
    ratio = d.z_wheel / d.z_satellite
    return {"A": (shaft, shaft * (1.0 - ratio)), "B": (shaft, 0.0), "C": (shaft * (1.0 - ratio), 0.0)}


def _behind(
    design: Design, table: OutputBearing, force: Array, given: float | None, seat: SeatLevels | None
) -> Joint:
    """Return the joint C, whose bearings share the load."""
    found = held("bearing C", table, force / table.number, seat, speeds(design)["C"])
    matrix = np.zeros((6, 6))
    matrix[:2, :2] = table.number * found.mean[:2, :2]
    _replaced(matrix, ACROSS, given)
    return Joint("C", frozen(matrix), (2, 3, 4, 5), (found,))


def _diagonal(entries: dict[int, float]) -> Array:
    matrix = np.zeros((6, 6))
    for place, value in entries.items():
        matrix[place, place] = value
    return frozen(matrix)


def _joint(
    name: str,
    table: Bearing | None,
    force: Array,
    moment: Array,
    tilts: bool,
    seat: SeatLevels | None = None,
    speed: tuple[float, float] = (0.0, 0.0),
) -> Joint:
    if table is None:
        return Joint(name, np.zeros((6, 6)), (*ACROSS, ALONG, *(TILTS if tilts else ())))
    axial = table.axial_stiffness is not None or (table.kind is not None and table.axial_load > 0.0)
    tilt = table.tilt_stiffness if isinstance(table, Support) else None
    tilting = tilts and (table.kind is not None or tilt is not None)
    sprung = [*ACROSS, *((ALONG,) if axial else ()), *(TILTS if tilting else ())]
    matrix, found = np.zeros((6, 6)), tuple[Held, ...]()
    if table.kind is not None:
        loads = np.array([[*force, 0.0, *moment]])
        found = bearings_of(name, table, loads, tilts, seat, speed)
        whole, lever = combined(table, found)
        matrix[np.ix_(sprung, sprung)] = whole[np.ix_(sprung, sprung)]
        unit = np.array([lever if i in TILTS else 1.0 for i in sprung])
        fail_if_loose(f"bearing {name}", matrix[np.ix_(sprung, sprung)], unit, ADVICE.format(name.lower()))
    _replaced(matrix, ACROSS, table.radial_stiffness)
    _replaced(matrix, (ALONG,), table.axial_stiffness)
    _replaced(matrix, TILTS, tilt)
    everything = (*ACROSS, ALONG, *(TILTS if tilts else ()))
    return Joint(name, frozen(matrix), tuple(i for i in everything if i not in sprung), found)


def _replaced(matrix: Array, places: tuple[int, ...], value: float | None) -> None:
    """Put a given stiffness in the place of a computed one, without what coupled it to others."""
    if value is None:
        return
    for i in places:
        matrix[i, :] = matrix[:, i] = 0.0
        matrix[i, i] = value


def bearings_of(
    name: str,
    table: RollingTable,
    loads: Array,
    tilts: bool,
    seat: SeatLevels | None,
    speed: tuple[float, float],
) -> tuple[Held, ...]:
    """Return the one or two rolling bearings of a joint under loads (m, 5) from shaft to seat, N and N·m.

    `radial_load` takes the place of the force's size, `moment_load` of the moment's.
    """
    said, spread = f"bearing {name}", spread_of(table)
    if spread == 0.0:
        return (held(said, table, loads, seat, speed, upright=not tilts),)
    whole = sized(table, loads)
    push, moment = whole[:, :2], whole[:, 3:]
    alone = unsized(table)
    found = []
    for sign in (1.0, -1.0):  # a pair of like bearings carries a moment as a couple of forces
        couple = sign * np.stack([moment[:, 1], -moment[:, 0]], axis=1) / spread
        one = held(said, alone, 0.5 * push + couple, seat, speed, upright=not tilts)
        found.append(replace(one, table=table))
    return tuple(found)


def unsized(table: RollingTable) -> RollingTable:
    """Return the table without the loads that stand for what the drive puts on it."""
    given = {"radial_load": None} | ({"moment_load": None} if isinstance(table, Support) else {})
    return table.model_copy(update=given)


def spread_of(table: RollingTable) -> float:
    """Return the distance of the two bearings of a table, 0 for a single one, m."""
    return table.spread if isinstance(table, Support) else 0.0


def combined(table: RollingTable, found: tuple[Held, ...]) -> tuple[Array, float]:
    """Return the stiffness (5, 5) of a joint's rolling bearings on x, y, z and both tilts, and their lever in m."""
    from trochoid.drives.rolling import rolling

    lever, spread = rolling(table).lever, spread_of(table)
    if len(found) == 1:
        return found[0].mean, lever
    whole = np.zeros((5, 5))
    for sign, one in zip((1.0, -1.0), found, strict=True):
        whole += about(one.mean, -0.5 * sign * spread)
    return whole, max(lever, 0.5 * spread)
