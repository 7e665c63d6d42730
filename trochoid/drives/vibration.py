"""Vibration velocity of a scene's rigid casing under two loads, and the zone that a standard gives it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from trochoid.dynamics.casing import Casing, Mount
from trochoid.dynamics.vibration import Point, Vibration, vibrate
from trochoid.dynamics.wrench import Wrench
from trochoid.dynamics.zones import Machine, Zone, zone
from trochoid.kinematics.errors import TrochoidError
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
    if scene.casing is None:
        raise TrochoidError("vibration needs the scene's [casing] table")
    table = scene.casing
    mounts = tuple(Mount(m.position, m.stiffness, m.damping) for m in table.mounts)
    casing = Casing(table.mass, table.inertia, table.center, mounts)
    points = tuple(Point(p.name, p.position) for p in table.points) or (Point("centre", table.center),)
    elastic = vibrate(casing, load, base, points)
    by_rigid = vibrate(casing, rigid, base, points)
    machine = Machine(
        scene.operation.output_torque * speeds[1],
        *speeds,
        gear_unit=table.machine != "industrial_machine",
        rigid_support=table.rigid_support,
    )
    return CasingVibration(elastic, by_rigid, zone(elastic.rms_max, machine))
