"""The tables of the precessional K-H-V drive, in SI; the starter scene says what each field means."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import ValidationInfo, field_validator, model_validator

from trochoid.scene import units
from trochoid.scene.fields import (
    DriveTable,
    Inertia,
    Length,
    Mass,
    Measure,
    Play,
    PositiveLength,
    Stiffness,
    Table,
    Whole,
    fault,
)
from trochoid.scene.model import Scene
from trochoid.scene.precessional_teeth import Rim, Rollers
from trochoid.scene.rolling import RollingBearing, RollingTable

NutationAngle = Annotated[float, Measure(units.ANGLE, least=1e-6, below=90.0)]
PolarAngle = Annotated[float, Measure(units.ANGLE, above=0.0, most=90.0)]
PinAngle = Annotated[float, Measure(units.ANGLE, above=0.0, below=90.0)]
ProductOfInertia = Annotated[float, Measure(units.INERTIA)]
TeethNumber = Annotated[int, Whole(2, 1000)]
MomentLoad = Annotated[float, Measure(units.TORQUE, above=0.0)]
TiltStiffness = Annotated[float, Measure(units.TILT, above=0.0)]
ROUNDING = 1e-9  # of a moment of inertia


class Satellite(Table):
    """[drive.satellite]: the nutating body; its axis goes from O, the centre of precession, to the bearing A."""

    mass: Mass
    center: Length
    inertia: tuple[Inertia, Inertia, Inertia]
    bearing_distance: PositiveLength

    @field_validator("inertia")
    @classmethod
    def _of_a_body(
        cls, inertia: tuple[float, float, float], info: ValidationInfo
    ) -> tuple[float, float, float]:
        x, y, z = inertia
        for name, one, others in (("x", x, y + z), ("y", y, x + z), ("z", z, x + y)):
            if one > others * (1.0 + ROUNDING):
                raise fault(
                    f"given {x:g}, {y:g}, {z:g} kg*m^2: no body has these; the moment about {name} must be at most "
                    f"the sum of the other two, {others:.6g}"
                )
        if "mass" not in info.data or "center" not in info.data:
            return inertia
        shift = info.data["mass"] * info.data["center"] ** 2
        if x + y - z < 2.0 * shift * (1.0 - ROUNDING):
            raise fault(
                f"given {x:g}, {y:g}, {z:g} kg*m^2: they are about O, where each of the first two has "
                f"mass * center^2 = {shift:.6g} in it; their sum less the third must be at least {2.0 * shift:.6g}, "
                f"and is {x + y - z:.6g}; add mass * center^2 to moments about the centre of mass"
            )
        return inertia


class InputShaft(Table):
    """[drive.input_shaft]: the shaft with the inclined crank, in its bearing B."""

    mass: Mass
    offset: Length = 0.0
    product_of_inertia: ProductOfInertia = 0.0
    bearing_distance: Length
    center: Length | None = None
    inertia: tuple[Inertia, Inertia] | None = None


class Counterweight(Table):
    """[drive.counterweight]: on the input shaft, opposite to A."""

    mass: Mass
    radius: Length | None = None
    z: Length
    product_of_inertia: ProductOfInertia = 0.0


class Bearing(RollingTable):
    """[drive.bearing_a]: between crank and satellite; a rolling bearing, or stiffnesses as given."""

    radial_stiffness: Stiffness | None = None
    axial_stiffness: Stiffness | None = None

    @model_validator(mode="after")
    def _has_a_stiffness(self) -> Bearing:
        if self.kind is None and self.radial_stiffness is None:
            raise fault(
                "no stiffness; need radial_stiffness, or the kind of a rolling bearing with its bore, outside and "
                "width; without the table the bearing is rigid"
            )
        return self


class Support(Bearing):
    """[drive.bearing_b]: between input shaft and casing; one bearing that resists tilting, or two alike."""

    spread: Play = 0.0
    moment_load: MomentLoad | None = None
    tilt_stiffness: TiltStiffness | None = None


class Joint(Table):
    """[drive.joint_o]: the constant-velocity joint, and the bearings C of the output shaft behind it."""

    radial_stiffness: Stiffness
    bearing_stiffness: Stiffness | None = None


class OutputBearing(RollingBearing):
    """[drive.bearing_c]: behind O, what the output shaft turns in; one, or two alike that share the load."""

    number: Annotated[int, Whole(1, 4)] = 1


class OutputShaft(Table):
    """[drive.output_shaft]: turns evenly about z, so its mass alone counts."""

    mass: Mass


class Teeth(Table):
    """[drive.teeth]: tapered rollers (pins) on the one member, sphere-tooth flanks on the other."""

    pins_on: Literal["ring", "satellite"] = "ring"
    polar_angle: PolarAngle
    pin_angle: PinAngle
    inner_radius: PositiveLength
    outer_radius: PositiveLength
    lobed_member: Literal["inside", "outside"] | None = None

    @field_validator("outer_radius")
    @classmethod
    def _beyond_inner(cls, outer: float, info: ValidationInfo) -> float:
        inner = info.data.get("inner_radius")
        if inner is not None and not outer > inner:
            raise fault(f"given {1e3 * outer:g} mm; need more than inner_radius = {1e3 * inner:g} mm")
        return outer


class PrecessionalDrive(DriveTable):
    """[drive] with type = "precessional"."""

    type: Literal["precessional"]
    z_wheel: TeethNumber
    z_satellite: TeethNumber
    nutation_angle: NutationAngle
    satellite: Satellite
    input_shaft: InputShaft
    counterweight: Counterweight | None = None
    output_shaft: OutputShaft | None = None
    bearing_a: Bearing | None = None
    bearing_b: Support | None = None
    joint_o: Joint | None = None
    bearing_c: OutputBearing | None = None
    teeth: Teeth | None = None
    rollers: Rollers = Rollers()
    rim: Rim = Rim()

    @field_validator("z_satellite")
    @classmethod
    def _turns_the_output(cls, satellite: int, info: ValidationInfo) -> int:
        if satellite == info.data.get("z_wheel"):
            near = " or ".join(str(z) for z in (satellite - 1, satellite + 1) if 2 <= z <= 1000)
            raise fault(f"given {satellite}, as many as z_wheel: the output would stand still; take {near}")
        return satellite

    @field_validator("joint_o")
    @classmethod
    def _has_a_mass(cls, joint: Joint | None, info: ValidationInfo) -> Joint | None:
        if (
            joint is not None
            and joint.bearing_stiffness is not None
            and info.data.get("output_shaft") is None
        ):
            raise fault(
                "bearing_stiffness needs the mass of the output shaft: the table [drive.output_shaft]"
            )
        return joint

    @field_validator("bearing_c")
    @classmethod
    def _behind_a_joint(cls, bearing: OutputBearing | None, info: ValidationInfo) -> OutputBearing | None:
        if bearing is not None and (
            info.data.get("joint_o") is None or info.data.get("output_shaft") is None
        ):
            raise fault(
                "the bearings C are behind the joint O and carry the output shaft: need the tables [drive.joint_o] and "
                "[drive.output_shaft]"
            )
        return bearing

    @field_validator("teeth")
    @classmethod
    def _differ_by_one(cls, teeth: Teeth | None, info: ValidationInfo) -> Teeth | None:
        wheel, satellite = info.data.get("z_wheel"), info.data.get("z_satellite")
        if teeth is None or wheel is None or satellite is None:
            return teeth
        if abs(wheel - satellite) != 1 and wheel > 2:
            near = " or ".join(str(z) for z in (wheel - 1, wheel + 1) if 3 <= z <= 1000)
            raise fault(
                f"z_wheel = {wheel} and z_satellite = {satellite}: flanks are known for numbers that differ by 1; take "
                f"z_satellite = {near}, or leave the table [drive.teeth] out"
            )
        if min(wheel, satellite) < 3:
            raise fault(
                f"z_wheel = {wheel} and z_satellite = {satellite}: flanks need at least 3 teeth on either; take 4 and "
                f"3, or leave the table [drive.teeth] out"
            )
        return teeth


PrecessionalScene: TypeAlias = Scene[PrecessionalDrive]
SCENE = PrecessionalScene
