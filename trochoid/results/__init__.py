"""What a run found: as values, as files, on the terminal."""

from trochoid.results.document import to_json
from trochoid.results.film import Field, Film
from trochoid.results.folder import prepare
from trochoid.results.outcome import (
    Arrow,
    Check,
    Drawing,
    DrawingFrame,
    Line,
    Outcome,
    Parts,
    Quantity,
    Stage,
)
from trochoid.results.plot import Axis, Plot, PlotCurve, PlotSurface
from trochoid.results.terminal import show
from trochoid.results.write import write

__all__ = [
    "Arrow",
    "Axis",
    "Check",
    "Drawing",
    "DrawingFrame",
    "Field",
    "Film",
    "Line",
    "Outcome",
    "Parts",
    "Plot",
    "PlotCurve",
    "PlotSurface",
    "Quantity",
    "Stage",
    "prepare",
    "show",
    "to_json",
    "write",
]
