"""The kinds of quantities that a scene holds, their units there, and SI."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Family:
    """A kind of quantity: `name` with its article, the `unit` of a bare number, and SI = number · up / down.

    Two exact factors instead of one rounded one: 52 mm are 52/1000 m, the float nearest to 0.052.
    """

    name: str
    unit: str
    si: str
    up: float = 1.0
    down: float = 1.0
    example: str = ""

    @property
    def noun(self) -> str:
        """The name without its article."""
        return self.name.split(" ", 1)[1]

    def to_si(self, number: float) -> float:
        """Return a number of the default unit in SI."""
        return number * self.up / self.down

    def from_si(self, value: float) -> float:
        """Return an SI value as a number of the default unit."""
        return value * self.down / self.up


NUMBER = Family("a number", "", "", example="0.3")
LENGTH = Family("a length", "mm", "m", down=1e3, example='64 or "64 mm"')
ANGLE = Family("an angle", "deg", "rad", up=math.pi, down=180.0, example='20 or "20 deg"')
TORQUE = Family("a torque", "N*m", "N*m", example='400 or "400 N*m"')
SPEED = Family("a rotational speed", "rpm", "rad/s", up=math.pi, down=30.0, example='1500 or "157 rad/s"')
STRESS = Family("a stress", "MPa", "Pa", up=1e6, example='210000 or "210 GPa"')
MASS = Family("a mass", "kg", "kg", example='25 or "25 kg"')
INERTIA = Family("a moment of inertia", "kg*m^2", "kg*m^2", example='0.25 or "0.25 kg*m^2"')
DENSITY = Family("a density", "kg/m^3", "kg/m^3", example='7850 or "7.85 g/cm^3"')
STIFFNESS = Family("a stiffness", "N/mm", "N/m", up=1e3, example='300000 or "3e8 N/m"')
DAMPING = Family("a damping constant", "N*s/m", "N*s/m", example='200 or "200 N*s/m"')
FORCE = Family("a force", "N", "N", example='120 or "120 N"')
TILT = Family(
    "a torsional stiffness", "N*m/rad", "N*m/rad", example='20000 or "20 kN*m/rad"'
)  # a torque by its dimension

FAMILIES = (LENGTH, ANGLE, TORQUE, SPEED, STRESS, MASS, INERTIA, DENSITY, STIFFNESS, DAMPING, FORCE)


def needed(family: Family) -> str:
    """Return what may be written for a quantity of the family."""
    unit = f" in {family.unit}" if family.unit else ""
    return f"{family.name}{unit}, e.g. {family.example}"
