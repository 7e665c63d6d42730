"""The tables of the RV (2K-V) drive, in SI; the starter scene says what each field means."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import AfterValidator, Field, ValidationInfo, field_validator, model_validator

from trochoid.scene import units
from trochoid.scene.cycloid_fields import ascending, one_less_than_pins
from trochoid.scene.fields import (
    DriveTable,
    Mass,
    Measure,
    Stiffness,
    Table,
    Whole,
    fault,
)
from trochoid.scene.model import Scene
from trochoid.scene.rolling import RollingBearing, has_a_stiffness

PressureAngle = Annotated[float, Measure(units.ANGLE, least=14.0, most=30.0)]
Shift = Annotated[float, Measure(units.NUMBER, least=-3.0, most=3.0)]
Size = Annotated[float, Measure(units.LENGTH, above=0.0, most=1e5)]
SmallSize = Annotated[float, Measure(units.LENGTH, least=0.0, most=1e5)]
Place = Annotated[float, Measure(units.LENGTH, least=-1e5, most=1e5)]


BearingPositions = Annotated[tuple[Place, Place], AfterValidator(ascending)]


class Modification(Table):
    """[drive.cycloid.modification]: deviation of the ground flank from the theoretical one."""

    equidistant: Place = 0.0
    radial: Place = 0.0
    rotation: Annotated[float, Measure(units.ANGLE)] = 0.0


class CycloidStage(Table):
    """[drive.cycloid]: second stage, cycloid discs between ring pins."""

    pins: Annotated[int, Whole(4, 1000)]
    lobes: Annotated[int, Whole(3, 999)] = Field(default_factory=one_less_than_pins)
    pin_circle_radius: Size
    pin_radius: Size
    eccentricity: Size
    discs: Annotated[int, Whole(1, 4)] = 2
    face_width: Size
    disc_gap: SmallSize = 0.002
    bore_radius: Size
    pin_clearance: SmallSize = 0.0
    modification: Modification = Modification()

    @field_validator("lobes")
    @classmethod
    def _match_pins(cls, lobes: int, info: ValidationInfo) -> int:
        pins = info.data.get("pins")
        if pins is not None and lobes != pins - 1:
            raise fault(
                f"given {lobes}; need pins - 1 = {pins - 1} (other tooth differences are not offered yet)"
            )
        return lobes


class FirstStage(Table):
    """[drive.first_stage]: sun and planets, one on each crankshaft."""

    z_sun: Annotated[int, Whole(6, 500)]
    z_planet: Annotated[int, Whole(6, 1000)]
    module: Size
    cranks: Annotated[int, Whole(2, 6)] = 3
    pressure_angle: PressureAngle = units.ANGLE.to_si(20.0)
    x_sun: Shift | None = None
    x_planet: Shift | None = None
    center_distance: Size | None = None
    face_width: Size
    backlash: SmallSize = 0.0
    mesh_stiffness: Stiffness | None = None
    sun_stiffness: Stiffness = 2e7


class ArmBearing(Table):
    """[drive.arm_bearing]: turning-arm bearing, rollers between an eccentric and the crank hole of a disc."""

    hole_radius: Size
    rollers: Annotated[int, Whole(3, 200)]
    roller_radius: Size
    roller_length: Size
    clearance: SmallSize = 0.0


class Crankshaft(Table):
    """[drive.crankshaft]: one of the equal crankshafts, on two bearings in the carrier."""

    radius: Size
    planet_position: Place
    bearing_positions: BearingPositions
    bearing_stiffness: Stiffness | None = None
    bearing: RollingBearing | None = None

    _held = model_validator(mode="after")(has_a_stiffness)


class Pillars(Table):
    """[drive.carrier.pillars]: round pillars between the carrier's two sides, through windows of the discs."""

    circle_radius: Size
    radius: Size
    gap: SmallSize = 0.0005


class Carrier(Table):
    """[drive.carrier]: the output, two sides of the pack joined by pillars."""

    outer_radius: Size
    thickness: Size
    bearing_positions: BearingPositions | None = None
    pillars: Pillars | None = None
    mass: Mass | None = None


class Ring(Table):
    """[drive.ring]: the body that holds the ring pins."""

    outer_radius: Size
    width: Size


class RvDrive(DriveTable):
    """[drive] with type = "rv"."""

    type: Literal["rv"]
    fixed: Literal["ring", "carrier", "sun"] = "ring"
    plane: Literal["strain", "stress"] = "strain"
    cycloid: CycloidStage
    first_stage: FirstStage
    arm_bearing: ArmBearing
    crankshaft: Crankshaft
    carrier: Carrier
    ring: Ring


RvScene: TypeAlias = Scene[RvDrive]
SCENE = RvScene
