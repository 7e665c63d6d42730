"""Pictures other than series over an angle: plane and spatial curves, areas and surfaces, as plain values."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.kinematics.types import Array, IntArray


@dataclass(frozen=True, slots=True)
class Axis:
    """An axis: its name and the SI unit of its numbers ("" for pure numbers)."""

    name: str
    units: str = ""


@dataclass(frozen=True, slots=True)
class PlotCurve:
    """A polyline or, with `style` "points", a cloud: `points` (n, d) in the units of the plot's d axes.

    Curves of one `group` share colour and entry in the legend ("" is its own). `style`: "line", "dashed", "area"
    (plane: filled inside), "points". `labels` (n): what the pointer reads at each point.
    """

    name: str
    points: Array
    group: str = ""
    style: str = "line"
    closed: bool = False
    labels: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class PlotSurface:
    """A surface in space: `vertices` (n, 3), `triangles` (m, 3)."""

    name: str
    vertices: Array
    triangles: IntArray
    opacity: float = 1.0
    group: str = ""


@dataclass(frozen=True, slots=True)
class Plot:
    """A picture with two axes (plane) or three (spatial); `equal`: one unit is as long along every axis.

    Raises ValueError for points that do not fit the axes.
    """

    title: str
    axes: tuple[Axis, ...]
    curves: tuple[PlotCurve, ...] = ()
    surfaces: tuple[PlotSurface, ...] = ()
    caption: str = ""
    equal: bool = True

    def __post_init__(self) -> None:
        """Refuse points that do not fit the axes."""
        wrong = [curve.name for curve in self.curves if curve.points.shape[1:] != (len(self.axes),)]
        wrong += [surface.name for surface in self.surfaces if len(self.axes) != 3]
        if wrong or len(self.axes) not in (2, 3):
            raise ValueError(f"plot {self.title!r} has {len(self.axes)} axes; these do not fit: {wrong}")
