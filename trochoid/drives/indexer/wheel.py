"""Mass and moment of inertia of the wheel: a zone of a spherical shell, its slots left out of account."""

from __future__ import annotations

import math
from dataclasses import dataclass

from trochoid.drives.indexer.design import Design
from trochoid.kinematics.indexer_slot import Slot
from trochoid.scene.drive_indexer import IndexerScene


@dataclass(frozen=True, slots=True)
class WheelMass:
    """`mass` (kg) and `own` moment of inertia (kg·m²) by the shape, and the moment of inertia `used`."""

    mass: float
    own: float
    used: float


def wheel_mass(scene: IndexerScene, slot: Slot, design: Design) -> WheelMass:
    """Return what the wheel weighs: the shell from the hub to the rim, half its thickness to either side of R."""
    wheel, density = design.drive.wheel, scene.materials[design.drive.material].density
    inner, outer = (design.drive.sphere_radius + s * wheel.thickness / 2 for s in (-1.0, 1.0))
    hub, rim = hub_angle(design), slot.farthest
    top, low = math.cos(hub), math.cos(rim)
    mass = density * 2.0 * math.pi * (outer**3 - inner**3) / 3.0 * (top - low)
    # ∫ sin³α dα from hub to rim, times ∫ r⁴ dr
    own = density * 2.0 * math.pi * (outer**5 - inner**5) / 5.0 * ((top - top**3 / 3) - (low - low**3 / 3))
    return WheelMass(mass, own, own if wheel.inertia is None else wheel.inertia)


def hub_angle(design: Design) -> float:
    """Angle (rad) from the wheel's axis to the outside of the hub on the sphere."""
    return math.asin(min(1.0, design.drive.wheel.hub_radius / design.drive.sphere_radius))
