"""What a single field of a scene may hold: quantities, whole numbers, flags; and the base of all tables."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, GetCoreSchemaHandler
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from trochoid.faults import shown
from trochoid.scene import reading, units
from trochoid.scene.units import Family

FAULT = "scene"  # the type of our own pydantic errors, whose text is ready to be read


def fault(message: str) -> PydanticCustomError:
    """Return the error by which a validator hands over a message that is ready to be read."""
    return PydanticCustomError(FAULT, "{text}", {"text": message})


class Table(BaseModel):
    """A table of the scene: frozen, without unknown keys."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, protected_namespaces=())


class DriveTable(Table):
    """[drive]: what every kind of drive says of itself."""

    type: str
    material: str = "steel"


@dataclass(frozen=True, slots=True)
class Measure:
    """A quantity of a family; limits in the default unit, `above`, `below` exclusive, `least`, `most` inclusive."""

    family: Family
    above: float | None = None
    least: float | None = None
    below: float | None = None
    most: float | None = None

    @property
    def allowed(self) -> str:
        """What may be written, in words."""
        limits = " and ".join(self._limits())
        return f"{units.needed(self.family)}; {limits}" if limits else units.needed(self.family)

    def _limits(self) -> list[str]:
        said = []
        if self.above is not None:
            said.append(f"greater than {self.above:g}")
        if self.least is not None:
            said.append(f"of {self.least:g} or more")
        if self.below is not None:
            said.append(f"less than {self.below:g}")
        if self.most is not None:
            said.append(f"of at most {self.most:g}")
        return said

    def read(self, value: object) -> float:
        """Return `value` in SI; raises a ready fault."""
        try:
            si = reading.read(value, self.family)
        except ValueError as error:
            raise fault(str(error)) from None
        number = self.family.from_si(si)
        if (
            (self.above is not None and not number > self.above)
            or (self.least is not None and not number >= self.least)
            or (self.below is not None and not number < self.below)
            or (self.most is not None and not number <= self.most)
        ):
            unit = f" {self.family.unit}" if self.family.unit and not isinstance(value, str) else ""
            raise fault(f"given {shown(value)}{unit}; need {self.family.name} {' and '.join(self._limits())}")
        return si

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Let pydantic call `read` and nothing else."""
        return core_schema.no_info_plain_validator_function(self.read)


@dataclass(frozen=True, slots=True)
class Whole:
    """A whole number from `least` to `most`."""

    least: int
    most: int

    @property
    def allowed(self) -> str:
        """What may be written, in words."""
        return f"a whole number from {self.least} to {self.most}"

    def read(self, value: object) -> int:
        """Return `value` if it is a whole number within the limits; raises a ready fault."""
        if isinstance(value, bool) or not isinstance(value, int) or not self.least <= value <= self.most:
            raise fault(f"given {shown(value)}; need {self.allowed}")
        return value

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Let pydantic call `read` and nothing else."""
        return core_schema.no_info_plain_validator_function(self.read)


@dataclass(frozen=True, slots=True)
class Flag:
    """True or false, nothing that resembles it."""

    allowed: str = "true or false"

    def read(self, value: object) -> bool:
        """Return `value` if it is a boolean; raises a ready fault."""
        if not isinstance(value, bool):
            raise fault(f"given {shown(value)}; need {self.allowed}")
        return value

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Let pydantic call `read` and nothing else."""
        return core_schema.no_info_plain_validator_function(self.read)


Length = Annotated[float, Measure(units.LENGTH)]
PositiveLength = Annotated[float, Measure(units.LENGTH, above=0.0)]
Play = Annotated[float, Measure(units.LENGTH, least=0.0)]
Angle = Annotated[float, Measure(units.ANGLE)]
Mass = Annotated[float, Measure(units.MASS, above=0.0)]
Inertia = Annotated[float, Measure(units.INERTIA, above=0.0)]
Stiffness = Annotated[float, Measure(units.STIFFNESS, above=0.0)]
AnyStiffness = Annotated[float, Measure(units.STIFFNESS, least=0.0)]
Damping = Annotated[float, Measure(units.DAMPING, least=0.0)]
Fraction = Annotated[float, Measure(units.NUMBER, above=0.0, below=1.0)]
Coefficient = Annotated[float, Measure(units.NUMBER, least=0.0, most=1.0)]
Boolean = Annotated[bool, Flag()]
Position = tuple[Length, Length, Length]
