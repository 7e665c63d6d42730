"""The tables of the spherical planetary-pin indexer, in SI; the starter scene says what each field means."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Field, ValidationInfo, field_validator

from trochoid.scene import units
from trochoid.scene.fields import (
    DriveTable,
    Fraction,
    Inertia,
    Length,
    Measure,
    Play,
    PositiveLength,
    Table,
    Whole,
    fault,
)
from trochoid.scene.model import Scene

Swing = Annotated[float, Measure(units.ANGLE, least=1.0, most=359.0)]
AxisAngle = Annotated[float, Measure(units.ANGLE, least=1.0, most=179.0)]
PinRatio = Annotated[float, Measure(units.NUMBER, least=1e-3, most=1e3)]
Tolerance = Annotated[float, Measure(units.ANGLE, above=0.0, most=10.0)]
Torsion = Annotated[float, Measure(units.TILT, above=0.0)]


class Pin(Table):
    """[drive.pin]: how the pin is shaped and held, for elastic contact; its radius is the drive's."""

    shape: Literal["cylinder", "cone", "barrel"] = "cylinder"
    crown_radius: PositiveLength = 0.2
    overhang: Play = 0.001
    play: Play = 0.00002


class Wheel(Table):
    """[drive.wheel]: the slotted output link, a piece of a spherical shell."""

    hub_radius: Play = 0.0
    thickness: PositiveLength = 0.01
    slot_length: PositiveLength | None = None
    slot_clearance: Play = 0.0
    inertia: Inertia | None = None
    wall_depth: PositiveLength | None = None
    lock_stiffness: Torsion | None = None


def _apart(far: float | None, info: ValidationInfo) -> float | None:
    if "near_bearing" not in info.data:
        return far
    near = info.data["near_bearing"]
    if (near is None) != (far is None):
        raise fault("given, or missing, without the other of near_bearing and far_bearing; give both or none")
    if near is not None and near == far:
        raise fault("the same as near_bearing; two bearings in one place cannot hold a shaft")
    return far


class InputShaft(Table):
    """[drive.input_shaft]: where the arm's shaft is held."""

    near_bearing: Length | None = None
    far_bearing: Length | None = Field(default=None, validate_default=True)

    _both = field_validator("far_bearing")(_apart)


class OutputShaft(Table):
    """[drive.output_shaft]: what the wheel drives, and the shaft between the two, rigid if it has no stiffness."""

    inertia: Inertia | None = None
    stiffness: Torsion | None = Field(default=None, validate_default=True)
    near_bearing: Length | None = None
    far_bearing: Length | None = Field(default=None, validate_default=True)

    _both = field_validator("far_bearing")(_apart)

    @field_validator("stiffness")
    @classmethod
    def _needs_a_mass(cls, stiffness: float | None, info: ValidationInfo) -> float | None:
        if stiffness is not None and info.data.get("inertia", 1.0) is None:
            raise fault(
                "given without drive.output_shaft.inertia; a shaft without a mass at its end twists by nothing"
            )
        return stiffness


def _pin_on_sphere(data: dict[str, Any]) -> float:
    radius: float = data["sphere_radius"]
    return 0.04 * radius


class IndexerDrive(DriveTable):
    """[drive] with type = "indexer"."""

    type: Literal["indexer"]
    ratio: Annotated[int, Whole(2, 20)]
    train: Literal["hypo", "epi"]
    swing_angle: Swing
    axis_angle: AxisAngle
    relative_turning_time: Fraction | None = None
    pin_ratio: PinRatio | None = Field(default=None, validate_default=True)
    place: Literal["near", "far"] | None = None
    sphere_radius: PositiveLength = 0.1
    pin_radius: PositiveLength = Field(default_factory=_pin_on_sphere)
    dwell_tolerance: Tolerance = math.radians(0.1)
    pin: Pin = Pin()
    wheel: Wheel = Wheel()
    input_shaft: InputShaft = InputShaft()
    output_shaft: OutputShaft = OutputShaft()

    @field_validator("pin_ratio")
    @classmethod
    def _one_of_two(cls, pin_ratio: float | None, info: ValidationInfo) -> float | None:
        if "relative_turning_time" not in info.data:
            return pin_ratio
        time = info.data["relative_turning_time"]
        if pin_ratio is not None and time is not None:
            raise fault(
                f"given beside relative_turning_time = {time:g}; give one of the two, the other follows from it"
            )
        if pin_ratio is None and time is None:
            raise fault(
                "missing, and relative_turning_time too; give one of the two, the other follows from it, "
                "e.g. relative_turning_time = 0.29"
            )
        return pin_ratio


IndexerScene: TypeAlias = Scene[IndexerDrive]
SCENE = IndexerScene
