"""Vibration velocity of the casing on its mounts by both models, and the zone that a standard gives it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from trochoid.drives.precessional.casing import casing_vibration, closed_record
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.elastic import Elastic
from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.turn import MODELS
from trochoid.drives.vibration import casing_of, zone_of
from trochoid.dynamics.vibration import Vibration
from trochoid.dynamics.zones import Zone


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
    casing, points = casing_of(design.scene)
    models = {
        name: casing_vibration(drive, design.speed, casing, points, model) for name, model in MODELS.items()
    }
    if elastic is not None:
        yielding = elastic.reactions(closed_record(drive))
        models["elastic"] = casing_vibration(drive, design.speed, casing, points, found=yielding)
    best = models["rigid" if elastic is None else "elastic"]
    return CasingVibration(models, zone_of(design.scene, best, (design.speed, abs(design.output_speed))))
