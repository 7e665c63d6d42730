"""What a run hands over to be written and shown: plain values, no solver behind them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias, Union

from trochoid.kinematics.types import Array
from trochoid.results.film import Film
from trochoid.results.plot import Plot

if TYPE_CHECKING:
    import xarray

Parts: TypeAlias = Mapping[str, Union["Quantity", "Parts"]]


@dataclass(frozen=True, slots=True)
class Quantity:
    """One answer: `value ± error` in `unit` ("N*m/arcmin", "" for a number), or nested `parts` in its place.

    `model` names the rung that gave it; `note` is one sentence for the reader.
    Raises ValueError for value and parts together.
    """

    value: float | str | None = None
    unit: str = ""
    error: float | None = None
    model: str | None = None
    parts: Parts | None = None
    note: str | None = None

    def __post_init__(self) -> None:
        """Refuse a quantity with both a value and parts."""
        if self.value is not None and self.parts is not None:
            raise ValueError(
                f"a quantity has a value or parts, not both: {self.value!r} and parts {list(self.parts)}"
            )


@dataclass(frozen=True, slots=True)
class Check:
    """A balance or comparison: |value| against its limit, and the verdict."""

    name: str
    value: float
    limit: float
    ok: bool

    @classmethod
    def within(cls, name: str, value: float, limit: float) -> Check:
        """Return the check of a size against its limit; what is no number does not hold."""
        return cls(name, value, limit, bool(value <= limit))


@dataclass(frozen=True, slots=True)
class Stage:
    """One stage that ran, and for how long (s)."""

    name: str
    seconds: float


@dataclass(frozen=True, slots=True)
class Line:
    """A polyline of the drawing: `xy` (n,2) m.

    `group` is its entry in the legend ("disc 1", "ring pins"). `style`: "body" (filled, coloured by group),
    "hole" (cut out of the bodies of its group), "pin" (filled grey), "outline", "center" (dashed).
    """

    name: str
    xy: Array
    closed: bool = True
    style: str = "outline"
    group: str = ""


@dataclass(frozen=True, slots=True)
class Arrow:
    """A force `vector` (2,) N that acts at `origin` (2,) m, in the colour of `group`."""

    origin: Array
    vector: Array
    group: str = ""
    label: str = ""


@dataclass(frozen=True, slots=True)
class DrawingFrame:
    """The drive at one input angle; `label` is shown at the slider ("12.5°")."""

    label: str
    lines: tuple[Line, ...]
    arrows: tuple[Arrow, ...] = ()


@dataclass(frozen=True, slots=True)
class Drawing:
    """The drive over the input angle; every frame has the same lines in the same order."""

    frames: tuple[DrawingFrame, ...]


@dataclass(frozen=True, slots=True)
class Outcome:
    """All that a run found, ready for `results.write`.

    `scene`: as used, SI. `not_needed`: stages that were not run. `dataset`: coordinates and variables in SI,
    attrs `units`, `long_name` and, when plotted, `figure` (its title), optional `plot` ("line", "heatmap"),
    `scale` ("log"), `caption`. `plots`: pictures of their own. `films`: bodies in space, for VTK.
    `notes`: heading → sentence. `facts`: main data for the head of the report. `not_simulated`: effect → what its
    absence means.
    """

    scene: Mapping[str, Any]
    quantities: Mapping[str, Quantity]
    stages: tuple[Stage, ...] = ()
    not_needed: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    checks: tuple[Check, ...] = ()
    dataset: xarray.Dataset | None = None
    films: tuple[Film, ...] = ()
    drawing: Drawing | None = None
    plots: tuple[Plot, ...] = ()
    notes: Mapping[str, str] = field(default_factory=dict)
    title: str = ""
    facts: Mapping[str, Quantity] = field(default_factory=dict)
    not_simulated: Mapping[str, str] = field(default_factory=dict)
