"""Linear elastic materials and what they mean in the plane."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

PlaneState = Literal["strain", "stress"]


@dataclass(frozen=True, slots=True)
class Material:
    """An isotropic material: Young's modulus in Pa, Poisson's ratio, density in kg/m³."""

    youngs_modulus: float
    poissons_ratio: float
    density: float = 0.0

    def plane(self, state: PlaneState) -> Plane:
        """Return the moduli of a slice of this material in plane strain or plane stress."""
        shear = self.youngs_modulus / (2 * (1 + self.poissons_ratio))
        if state == "strain":
            return Plane(self.youngs_modulus / (1 - self.poissons_ratio**2), shear, self.poissons_ratio, 1.0)
        return Plane(self.youngs_modulus, shear, self.poissons_ratio, 0.0)


@dataclass(frozen=True, slots=True)
class Plane:
    """Moduli of a plane body.

    `modulus` is E' (E/(1−ν²) in plane strain, E in plane stress) and `shear` G, both in Pa. The stress out of
    the plane is `out_of_plane · ν (σxx + σyy)`.
    """

    modulus: float
    shear: float
    poissons_ratio: float
    out_of_plane: float

    @property
    def lame(self) -> float:
        """First Lamé parameter of the plane problem, Pa: E' = 4G(λ+G)/(λ+2G)."""
        return 2 * self.shear * (self.modulus - 2 * self.shear) / (4 * self.shear - self.modulus)

    @property
    def kolosov(self) -> float:
        """Kolosov's constant κ, from (κ+1)/(4G) = 2/E'."""
        return 8 * self.shear / self.modulus - 1

    @property
    def kernel(self) -> float:
        """Factor 2/(πE') of the logarithm in the half-plane's surface compliance, 1/Pa."""
        return 2 / (math.pi * self.modulus)
