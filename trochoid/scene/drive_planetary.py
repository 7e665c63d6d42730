"""The tables of the involute planetary set 2K-H, in SI; the starter scene says what each field means."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Field, ValidationInfo, field_validator, model_validator

from trochoid.scene import units
from trochoid.scene.fields import (
    AnyStiffness,
    DriveTable,
    Inertia,
    Mass,
    Measure,
    Stiffness,
    Table,
    Whole,
    fault,
)
from trochoid.scene.model import Scene
from trochoid.scene.rolling import RollingBearing, has_a_stiffness

Member = Literal["sun", "ring", "carrier"]
Shift = Annotated[float, Measure(units.NUMBER, least=-50.0, most=50.0)]
Size = Annotated[float, Measure(units.LENGTH, above=0.0, most=1e5)]
SmallSize = Annotated[float, Measure(units.LENGTH, least=0.0, most=1e5)]
Module = Annotated[float, Measure(units.LENGTH, least=0.01, most=1000.0)]
PressureAngle = Annotated[float, Measure(units.ANGLE, least=5.0, most=40.0)]
Addendum = Annotated[float, Measure(units.NUMBER, least=0.1, most=3.0)]
RootClearance = Annotated[float, Measure(units.NUMBER, least=0.0, most=1.0)]
Torsion = Annotated[float, Measure(units.TILT, above=0.0)]
Relief = Annotated[float, Measure(units.LENGTH, least=0.0, most=10.0)]
PlaceError = Annotated[float, Measure(units.LENGTH, least=-10.0, most=10.0)]
LeastRatio = Annotated[float, Measure(units.NUMBER, least=0.0, most=10.0)]


USUAL_SEAT = 200000.0  # N/mm, of a planet on the carrier


class RingCutter(Table):
    """[drive.ring_cutter]: the pinion-type cutter of the ring."""

    z: Annotated[int, Whole(3, 999)]
    x: Shift = 0.0
    tip_diameter: Size | None = None
    tip_rounding: SmallSize = 0.0


class Limits(Table):
    """[drive.limits]: least tip thickness and contact ratio of a set that can be made."""

    tip_thickness: SmallSize = 0.4e-3
    contact_ratio: LeastRatio = 1.2


class SunBody(Table):
    """[drive.sun]: the body within its teeth, its relief, what it floats on."""

    bore_radius: Size | None = None
    tip_relief: Relief = 0.0
    bearing_stiffness: AnyStiffness = 0.0
    torsional_stiffness: Torsion | None = None


class PlanetBody(Table):
    """[drive.planet]: the body within its teeth, its relief, its seat on the carrier, errors of the planets' places."""

    bore_radius: Size | None = None
    tip_relief: Relief = 0.0
    bearing_stiffness: Stiffness | None = None
    bearing: RollingBearing | None = None
    position_errors: tuple[PlaceError, ...] = ()

    @model_validator(mode="before")
    @classmethod
    def _usual(cls, given: Any) -> Any:
        """Take a usual stiffness where no rolling bearing stands in its place."""
        if isinstance(given, dict) and given.get("bearing") is None:
            return {"bearing_stiffness": USUAL_SEAT, **given}
        return given

    @model_validator(mode="after")
    def _has_a_stiffness(self) -> PlanetBody:
        return has_a_stiffness(self)


class RingBody(Table):
    """[drive.ring]: the body around its teeth, its relief, how it is held."""

    outer_radius: Size | None = None
    tip_relief: Relief = 0.0
    held: Literal["edge", "evenly"] = "edge"
    bearing_stiffness: AnyStiffness = 1e7
    torsional_stiffness: Torsion | None = None


class CarrierBody(Table):
    """[drive.carrier]: what it floats on, what it weighs."""

    bearing_stiffness: AnyStiffness = 3e8
    torsional_stiffness: Torsion | None = None
    mass: Mass | None = None
    inertia: Inertia | None = None


class MeshLead(Table):
    """[drive.lead.sun_and_planet], [drive.lead.planet_and_ring]: how the gap changes over the face width of a mesh."""

    misalignment: PlaceError = 0.0
    crown: Relief = 0.0


class Lead(Table):
    """[drive.lead]: load over the face width, in slices."""

    slices: Annotated[int, Whole(3, 101)] = 15
    sun_and_planet: MeshLead = MeshLead()
    planet_and_ring: MeshLead = MeshLead()


def _usual_driving(data: dict[str, Any]) -> Member:
    return "ring" if data.get("fixed") == "sun" else "sun"


class PlanetaryDrive(DriveTable):
    """[drive] with type = "planetary"."""

    type: Literal["planetary"]
    z_sun: Annotated[int, Whole(3, 1000)]
    z_planet: Annotated[int, Whole(3, 1000)]
    z_ring: Annotated[int, Whole(4, 3000)]
    planets: Annotated[int, Whole(1, 24)] = 3
    module: Module
    pressure_angle: PressureAngle = units.ANGLE.to_si(20.0)
    addendum: Addendum = 1.0
    root_clearance: RootClearance = 0.25
    root_rounding: RootClearance | None = None
    center_distance: Size
    x_sun: Shift
    x_planet: Shift | None = None
    x_ring: Shift | None = None
    face_width: Size
    roller_diameter: Size | None = None
    tip_rounding: Size | None = None
    tip_relief_length: Size | None = None
    plane: Literal["strain", "stress"] = "strain"
    fixed: Member = "ring"
    driving: Member = Field(default_factory=_usual_driving)
    ring_cutter: RingCutter
    limits: Limits = Limits()
    sun: SunBody = SunBody()
    planet: PlanetBody = PlanetBody()
    ring: RingBody = RingBody()
    carrier: CarrierBody = CarrierBody()
    lead: Lead | None = None

    @field_validator("z_ring")
    @classmethod
    def _around_planet(cls, ring: int, info: ValidationInfo) -> int:
        sun, planet = info.data.get("z_sun"), info.data.get("z_planet")
        if planet is not None and ring <= planet:
            usual = "" if sun is None else f", usually near z_sun + 2 z_planet = {sun + 2 * planet}"
            raise fault(f"given {ring}; need more than z_planet = {planet}{usual}")
        return ring

    @field_validator("driving")
    @classmethod
    def _moves(cls, driving: str, info: ValidationInfo) -> str:
        if driving == info.data.get("fixed"):
            others = " or ".join(f'"{name}"' for name in ("sun", "ring", "carrier") if name != driving)
            raise fault(f'given "{driving}", which is fixed; need {others}')
        return driving

    @field_validator("planet")
    @classmethod
    def _an_error_each(cls, planet: PlanetBody, info: ValidationInfo) -> PlanetBody:
        given, count = len(planet.position_errors), info.data.get("planets")
        if count is not None and given > count:
            raise fault(f"given {given} position_errors; need at most one for each of the {count} planets")
        return planet

    @property
    def driven(self) -> Member:
        """The third of the members about the main axis."""
        members: tuple[Member, ...] = ("carrier", "ring", "sun")
        return next(name for name in members if name not in (self.fixed, self.driving))


PlanetaryScene: TypeAlias = Scene[PlanetaryDrive]
SCENE = PlanetaryScene
