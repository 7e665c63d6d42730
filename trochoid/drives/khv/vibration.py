"""Vibration velocity of the casing and the zone that a standard gives it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.design import Design
from trochoid.drives.khv.reactions import Reactions
from trochoid.dynamics.casing import Casing, Mount
from trochoid.dynamics.vibration import Point, Vibration, vibrate
from trochoid.dynamics.zones import Machine, Zone, zone
from trochoid.kinematics.errors import TrochoidError


@dataclass(frozen=True, slots=True)
class CasingVibration:
    """Vibration by the stiffness-aware (or, with rigid bearings, the rigid) load, by the rigid load alone,
    and the zone.
    """

    elastic: Vibration
    rigid: Vibration
    zone: Zone


def casing_vibration(design: Design, found: Reactions) -> CasingVibration:
    """Shake the casing on its mounts with the resultant of all forces on it; raises TrochoidError without a casing."""
    scene = design.scene
    if scene.casing is None:
        raise TrochoidError("vibration needs the scene's [casing] table")
    table = scene.casing
    mounts = tuple(Mount(m.position, m.stiffness, m.damping) for m in table.mounts)
    casing = Casing(table.mass, table.inertia, table.center, mounts)
    points = tuple(Point(p.name, p.position) for p in table.points) or (Point("centre", table.center),)
    base = design.crank_speed / (2 * np.pi)
    elastic = vibrate(casing, found.casing, base, points)
    rigid = vibrate(casing, found.casing_rigid, base, points)
    driven = "output" if design.drive.fixed == "ring" else "ring"
    speed = abs(float(design.speeds.members[driven])) * design.crank_speed
    machine = Machine(
        scene.operation.output_torque * speed,
        design.crank_speed,
        speed,
        gear_unit=table.machine != "industrial_machine",
        rigid_support=table.rigid_support,
    )
    return CasingVibration(elastic, rigid, zone(elastic.rms_max, machine))
