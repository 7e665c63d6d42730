"""[casing]: the rigid casing, what it stands on, and where its vibration is measured."""

from __future__ import annotations

from typing import Literal

from trochoid.scene.fields import AnyStiffness, Boolean, Damping, Inertia, Mass, Position, Table


class Mount(Table):
    """[[casing.mounts]]: a spring and a damper along each axis."""

    position: Position
    stiffness: tuple[AnyStiffness, AnyStiffness, AnyStiffness]
    damping: tuple[Damping, Damping, Damping] = (0.0, 0.0, 0.0)


class MeasuringPoint(Table):
    """[[casing.points]]: where the vibration velocity is reported."""

    name: str
    position: Position


class Casing(Table):
    """[casing]: mass and principal moments of inertia about its centre."""

    mass: Mass
    inertia: tuple[Inertia, Inertia, Inertia]
    center: Position = (0.0, 0.0, 0.0)
    machine: Literal["gear_unit", "industrial_machine"] = "gear_unit"
    rigid_support: Boolean = False
    mounts: tuple[Mount, ...] = ()
    points: tuple[MeasuringPoint, ...] = ()
