"""Vibration velocity of a scene's rigid casing under two loads, and the zone that a standard gives it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from trochoid.dynamics.casing import Casing, Mount
from trochoid.dynamics.vibration import Point, Vibration, vibrate
from trochoid.dynamics.wrench import Wrench
from trochoid.dynamics.zones import Machine, Zone, zone
from trochoid.kinematics.errors import TrochoidError
from trochoid.results.outcome import Quantity
from trochoid.scene import Casing as CasingTable
from trochoid.scene import Scene


@dataclass(frozen=True, slots=True)
class CasingVibration:
    """Vibration by the stiffness-aware (or, with rigid bearings, the rigid) load, by the rigid load alone,
    and the zone.
    """

    elastic: Vibration
    rigid: Vibration
    zone: Zone


def shaken(
    scene: Scene[Any], load: Wrench, rigid: Wrench, base: float, speeds: tuple[float, float]
) -> CasingVibration:
    """Shake the casing on its mounts with the resultant of all forces on it, and with that of rigid members.

    The records of the loads last 1/`base` seconds; `speeds` of the driving and the driven shaft in rad/s. Raises
    TrochoidError without a casing.
    """
    casing, points = casing_of(scene)
    elastic = vibrate(casing, load, base, points)
    by_rigid = vibrate(casing, rigid, base, points)
    return CasingVibration(elastic, by_rigid, zone_of(scene, elastic, speeds))


def casing_of(scene: Scene[Any]) -> tuple[Casing, tuple[Point, ...]]:
    """Return the casing on its mounts and where it is measured; raises TrochoidError without a casing."""
    table = _table(scene)
    mounts = tuple(Mount(m.position, m.stiffness, m.damping) for m in table.mounts)
    points = tuple(Point(p.name, p.position) for p in table.points) or (Point("centre", table.center),)
    return Casing(table.mass, table.inertia, table.center, mounts), points


def zone_of(scene: Scene[Any], found: Vibration, speeds: tuple[float, float]) -> Zone:
    """Return the zone of a vibration; `speeds` of the driving and the driven shaft in rad/s, both positive."""
    table = _table(scene)
    machine = Machine(
        scene.operation.output_torque * speeds[1],
        *speeds,
        gear_unit=table.machine != "industrial_machine",
        rigid_support=table.rigid_support,
    )
    return zone(found.rms_max, machine)


def _table(scene: Scene[Any]) -> CasingTable:
    if scene.casing is None:
        raise TrochoidError("vibration needs the scene's [casing] table")
    return scene.casing


def velocity(found: Vibration, point: int, axis: int | None) -> float:
    """Return the rms velocity at a point along an axis, mm/s; without one the largest of the three."""
    rms = found.rms[point]
    return 1e3 * float(rms.max() if axis is None else rms[axis])


def zone_answer(found: Zone) -> Quantity:
    """Zone by the standard that applies, or the statement that none does."""
    return Quantity(found.letter or "none applies", "", None, found.standard, note=found.reason)
