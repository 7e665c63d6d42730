"""Vibration velocity of the casing on its mounts by both models, and the zone that a standard gives it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from trochoid.drives.precessional.casing import casing_vibration, closed_record
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.elastic import Elastic
from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.turn import MODELS
from trochoid.dynamics.casing import Casing, Mount
from trochoid.dynamics.vibration import Point, Vibration
from trochoid.dynamics.zones import Machine, Zone, zone
from trochoid.kinematics.errors import TrochoidError


@dataclass(frozen=True, slots=True)
class CasingVibration:
    """Vibration by the models "rigid" and "printed", "elastic" where joints yield, and the zone of the best one."""

    models: Mapping[str, Vibration]
    zone: Zone

    @property
    def best(self) -> str:
        """The model that has most in it: "elastic", else "rigid"."""
        return "elastic" if "elastic" in self.models else "rigid"

    @property
    def rigid(self) -> Vibration:
        """Vibration by exact reactions."""
        return self.models["rigid"]


def vibration(design: Design, drive: PrecessionalDrive, elastic: Elastic | None = None) -> CasingVibration:
    """Shake the casing with the vector sum of all reactions on it; raises TrochoidError without a casing."""
    table = design.scene.casing
    if table is None:
        raise TrochoidError("vibration needs the scene's [casing] table")
    mounts = tuple(Mount(m.position, m.stiffness, m.damping) for m in table.mounts)
    casing = Casing(table.mass, table.inertia, table.center, mounts)
    points = tuple(Point(p.name, p.position) for p in table.points) or (Point("centre", table.center),)
    models = {
        name: casing_vibration(drive, design.speed, casing, points, model) for name, model in MODELS.items()
    }
    if elastic is not None:
        yielding = elastic.reactions(closed_record(drive))
        models["elastic"] = casing_vibration(drive, design.speed, casing, points, found=yielding)
    speed = abs(design.output_speed)
    machine = Machine(
        design.scene.operation.output_torque * speed,
        design.speed,
        speed,
        gear_unit=table.machine != "industrial_machine",
        rigid_support=table.rigid_support,
    )
    return CasingVibration(models, zone(models["rigid" if elastic is None else "elastic"].rms_max, machine))
