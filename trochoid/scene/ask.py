"""[ask] and [accuracy]: which answers, and how good they must be."""

from __future__ import annotations

from typing import Annotated, Literal

from trochoid.scene.fields import Angle, Fraction, Table, Whole

MOST_FACETS = 200


class Ask(Table):
    """[ask]: the quantities wanted, at how many positions of one turn of the input."""

    quantities: tuple[str, ...]
    positions: Annotated[int, Whole(1, 100_000)] = 60
    stress_position: Angle = 0.0


class Accuracy(Table):
    """[accuracy]: the tolerance that picks the model, or the model itself."""

    tolerance: Fraction = 1e-2
    model: Literal["springs", "level0", "strips", "slices", "rigid_wheel", "elastic_wheel"] | None = None
    facets_per_lobe: Annotated[int, Whole(4, MOST_FACETS)] | None = None
