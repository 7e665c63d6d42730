"""[casing]: the casing, rigid or elastic, what it stands on, and where its vibration is measured.

What the fields demand of each other, a rigid casing of its mass and an elastic one of its body, is in `casing_faults`.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator

from trochoid.scene import units
from trochoid.scene.fields import (
    AnyStiffness,
    Boolean,
    Damping,
    Inertia,
    Length,
    Mass,
    Measure,
    Play,
    Position,
    PositiveLength,
    Table,
    fault,
)


def _with_a_length(direction: tuple[float, float, float]) -> tuple[float, float, float]:
    if not any(direction):
        raise fault("given 0, 0, 0; need a direction, which has a length")
    return direction


def _rising(span: tuple[float, float]) -> tuple[float, float]:
    if not span[0] < span[1]:
        raise fault(f"given {1e3 * span[0]:g} and {1e3 * span[1]:g} mm; need two places, the lower first")
    return span


Number = Annotated[float, Measure(units.NUMBER)]
Direction = Annotated[tuple[Number, Number, Number], AfterValidator(_with_a_length)]
Span = Annotated[tuple[Length, Length], AfterValidator(_rising)]
DampingRatio = Annotated[float, Measure(units.NUMBER, least=0.0, below=1.0)]
Unit = Literal["um", "mm", "cm", "m", "in"]
METRES: dict[str, float] = {"um": 1e-6, "mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254}


class Mount(Table):
    """[[casing.mounts]]: a spring and a damper along each axis; on an elastic casing the place that they hold."""

    position: Position
    stiffness: tuple[AnyStiffness, AnyStiffness, AnyStiffness]
    damping: tuple[Damping, Damping, Damping] = (0.0, 0.0, 0.0)
    name: str | None = None
    radius: PositiveLength | None = None
    normal: Direction | None = None
    set: str | None = None


class Bore(Table):
    """[[casing.bores]]: a seat in an elastic casing and the places of the drive that it `holds`."""

    name: str
    holds: tuple[str, ...] = ()
    wall: Literal["low", "high"] | None = None
    radius: PositiveLength | None = None
    boss: PositiveLength | None = None
    length: PositiveLength | None = None
    x: Length = 0.0
    y: Length = 0.0
    set: str | None = None
    point: Position | None = None
    direction: Direction | None = None
    span: Span | None = None

    @property
    def seats(self) -> tuple[str, ...]:
        """The places of the drive that it holds: that of its own name where none is given."""
        return self.holds or (self.name,)


class Box(Table):
    """[casing.box]: an elastic casing by its measures, a box on a base plate."""

    size: tuple[PositiveLength, PositiveLength, PositiveLength]
    wall: PositiveLength
    center: Position = (0.0, 0.0, 0.0)
    base: PositiveLength | None = None
    flange: tuple[Play, Play] = (0.0, 0.0)


class MeasuringPoint(Table):
    """[[casing.points]]: where the vibration velocity is reported."""

    name: str
    position: Position


class Casing(Table):
    """[casing]: rigid, with mass and principal moments of inertia about its centre; or elastic, with a body."""

    mass: Mass | None = None
    inertia: tuple[Inertia, Inertia, Inertia] | None = None
    center: Position = (0.0, 0.0, 0.0)
    machine: Literal["gear_unit", "industrial_machine"] = "gear_unit"
    rigid_support: Boolean = False
    elastic: Boolean = False
    material: str = "steel"
    damping_ratio: DampingRatio | None = None
    mesh_edge: PositiveLength | None = None
    mesh_file: str | None = None
    mesh_unit: Unit = "mm"
    box: Box | None = None
    bores: tuple[Bore, ...] = ()
    mounts: tuple[Mount, ...] = ()
    points: tuple[MeasuringPoint, ...] = ()
