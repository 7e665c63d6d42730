"""[materials.*]: what bodies are made of."""

from __future__ import annotations

from typing import Annotated

from trochoid.scene import units
from trochoid.scene.fields import Measure, Table


class Material(Table):
    """[materials.NAME]: an isotropic linear elastic material, SI."""

    youngs_modulus: Annotated[float, Measure(units.STRESS, above=0.0)]
    poissons_ratio: Annotated[float, Measure(units.NUMBER, least=0.0, below=0.5)]
    density: Annotated[float, Measure(units.DENSITY, above=0.0)]


# As it would be written in a scene; [materials.steel] replaces single values of it.
PREDEFINED: dict[str, dict[str, float]] = {
    "steel": {"youngs_modulus": 210000.0, "poissons_ratio": 0.3, "density": 7850.0},
}


def with_predefined(given: object) -> object:
    """Return the raw [materials.*] tables of a scene completed by the predefined ones."""
    if not isinstance(given, dict):
        return given
    complete: dict[str, object] = {**PREDEFINED, **given}
    for name, values in PREDEFINED.items():
        if isinstance(own := complete[name], dict):
            complete[name] = {**values, **own}
    return complete
