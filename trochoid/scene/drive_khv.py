"""The tables of the planetary-cycloid K-H-V drive, in SI; the starter scene says what each field means."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import AfterValidator, Field, ValidationInfo, field_validator, model_validator

from trochoid.scene.cycloid_fields import ascending, one_less_than_pins
from trochoid.scene.fields import (
    Angle,
    DriveTable,
    Inertia,
    Length,
    Mass,
    Play,
    PositiveLength,
    Stiffness,
    Table,
    Whole,
    fault,
)
from trochoid.scene.model import Scene
from trochoid.scene.rolling import RollingBearing, has_a_stiffness

BearingPositions = Annotated[tuple[Length, Length], AfterValidator(ascending)]


class OutputPins(Table):
    """[drive.output_pins]: rollers of the parallel crank in the holes of the discs."""

    count: Annotated[int, Whole(3, 100)]
    circle_radius: PositiveLength
    roller_radius: PositiveLength
    hole_clearance: Play = 0.0
    phase: Angle = 0.0


class EccentricBearing(Table):
    """[drive.eccentric_bearing]: the rollers that run on the bore of each disc."""

    kind: Literal["cylindrical"] = "cylindrical"
    rollers: Annotated[int, Whole(3, 200)]
    roller_radius: PositiveLength
    roller_length: PositiveLength
    clearance: Play = 0.0


class Modification(Table):
    """[drive.modification]: deviation of the ground flank from the theoretical one."""

    equidistant: Length = 0.0
    radial: Length = 0.0
    rotation: Angle = 0.0


class Ring(Table):
    """[drive.ring]: the body that holds the ring pins."""

    outer_radius: PositiveLength
    width: PositiveLength


class InputShaft(Table):
    """[drive.input_shaft]: the shaft with the eccentrics, on two bearings."""

    radius: PositiveLength
    length: PositiveLength
    bearing_positions: BearingPositions
    bearing_stiffness: Stiffness | None = None
    bearing: RollingBearing | None = None
    mass: Mass | None = None

    _held = model_validator(mode="after")(has_a_stiffness)


class OutputFlange(Table):
    """[drive.output_flange]: the flange with the output pins, on two bearings."""

    outer_radius: PositiveLength
    thickness: PositiveLength
    bearing_positions: BearingPositions
    bearing_stiffness: Stiffness | None = None
    bearing: RollingBearing | None = None
    mass: Mass | None = None
    inertia: Inertia | None = None

    _held = model_validator(mode="after")(has_a_stiffness)


class KhvDrive(DriveTable):
    """[drive] with type = "khv"."""

    type: Literal["khv"]
    pins: Annotated[int, Whole(4, 1000)]
    lobes: Annotated[int, Whole(3, 999)] = Field(default_factory=one_less_than_pins)
    pin_circle_radius: PositiveLength
    pin_radius: PositiveLength
    eccentricity: PositiveLength
    discs: Annotated[int, Whole(1, 12)] = 2
    face_width: PositiveLength
    disc_gap: Play = 0.002
    bore_radius: PositiveLength
    fixed: Literal["ring", "output"] = "ring"
    plane: Literal["strain", "stress"] = "strain"
    pin_clearance: Play = 0.0
    contact_stiffness: Stiffness | None = None
    output_pins: OutputPins
    eccentric_bearing: EccentricBearing
    modification: Modification = Modification()
    ring: Ring
    input_shaft: InputShaft
    output_flange: OutputFlange

    @field_validator("lobes")
    @classmethod
    def _match_pins(cls, lobes: int, info: ValidationInfo) -> int:
        pins = info.data.get("pins")
        if pins is not None and lobes != pins - 1:
            raise fault(
                f"given {lobes}; need pins - 1 = {pins - 1} (other tooth differences are not offered yet)"
            )
        return lobes


KhvScene: TypeAlias = Scene[KhvDrive]
SCENE = KhvScene
