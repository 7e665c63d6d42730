"""What elastic sphere teeth need beside [drive.teeth]: the rollers, and the rim that carries the flanks."""

from __future__ import annotations

from typing import Annotated

from pydantic import ValidationInfo, field_validator

from trochoid.scene import units
from trochoid.scene.fields import Measure, Play, PositiveLength, Stiffness, Table, fault

BoreAngle = Annotated[float, Measure(units.ANGLE, above=0.0, below=90.0)]
Lean = Annotated[float, Measure(units.ANGLE, least=-1.0, most=1.0)]
RimAngle = Annotated[float, Measure(units.ANGLE, above=0.0, below=180.0)]


class Rollers(Table):
    """[drive.rollers]: the tapered rollers that are the pins; as long as the teeth, solid and straight by default."""

    inner_radius: PositiveLength | None = None
    outer_radius: PositiveLength | None = None
    bore_angle: BoreAngle | None = None
    crown: Play = 0.0
    clearance: Play = 0.0
    tilt: Lean = 0.0
    skew: Lean = 0.0
    seat_stiffness: Stiffness | None = None


class Rim(Table):
    """[drive.rim]: the lobed member between its flanks and the cone that holds it."""

    hub_angle: RimAngle | None = None
    tip_angle: RimAngle | None = None
    web_inner_radius: PositiveLength | None = None
    web_outer_radius: PositiveLength | None = None

    @field_validator("web_outer_radius")
    @classmethod
    def _beyond_inner(cls, outer: float | None, info: ValidationInfo) -> float | None:
        inner = info.data.get("web_inner_radius")
        if inner is not None and outer is not None and not outer > inner:
            raise fault(f"given {1e3 * outer:g} mm; need more than web_inner_radius = {1e3 * inner:g} mm")
        return outer
