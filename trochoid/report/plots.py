"""Plane and spatial pictures as plotly figures."""

from __future__ import annotations

from typing import Any

import numpy as np

from trochoid.kinematics.types import Array
from trochoid.report import style
from trochoid.report.units import axis_unit
from trochoid.results.plot import Axis, Plot, PlotCurve, PlotSurface

_PLANE, _SPACE = 620, 760  # px
_NAMES = ("x", "y", "z")
EYE = 1.5  # of the size of what is drawn in space: from nearer by, axes and their titles are cut


def plot_spec(plot: Plot) -> dict[str, Any]:
    """Return a picture as plotly draws it; legend entries of a group switch all of it."""
    things: tuple[PlotSurface | PlotCurve, ...] = (*plot.curves, *plot.surfaces)
    groups = [thing.group or thing.name for thing in things]
    names = list(dict.fromkeys(groups))
    colors = dict(zip(names, style.distinct(len(names)), strict=True))
    scale = np.array([axis_unit(axis.units).factor for axis in plot.axes])
    traces, shown = [], set[str]()
    for thing, group in zip(things, groups, strict=True):
        color = colors[group]
        drawn = (
            _surface(thing, scale, color) if isinstance(thing, PlotSurface) else _curve(thing, scale, color)
        )
        entry = {"legendgroup": group, "name": group, "showlegend": group not in shown}
        traces.append(drawn | entry)
        shown.add(group)
    layout = _space(plot) if len(plot.axes) == 3 else _plane(plot)
    return {"data": traces, "layout": layout | {"showlegend": len(names) > 1, "hovermode": "closest"}}


def _surface(surface: PlotSurface, scale: Array, color: str) -> dict[str, Any]:
    corners = {name: style.packed(surface.vertices[:, i] * scale[i]) for i, name in enumerate(_NAMES)}
    sides = {name: surface.triangles[:, i].tolist() for i, name in enumerate("ijk")}
    light = {"ambient": 0.55, "diffuse": 0.7, "specular": 0.15, "roughness": 0.6}
    return {
        "type": "mesh3d",
        "color": color,
        "opacity": surface.opacity,
        "lighting": light,
        "hoverinfo": "name",
        **corners,
        **sides,
    }


def _curve(curve: PlotCurve, scale: Array, color: str) -> dict[str, Any]:
    points = np.vstack([curve.points, curve.points[:1]]) if curve.closed else curve.points
    space = points.shape[1] == 3
    labels = (*curve.labels, *curve.labels[:1]) if curve.closed else curve.labels
    look: dict[str, Any] = {"mode": "lines", "line": {"color": color, "width": 4 if space else 1.8}}
    if curve.style == "points":
        look = {"mode": "markers", "marker": {"color": color, "size": 4 if space else 8}}
    elif curve.style == "dashed":
        look["line"] |= {"dash": "dash"}
    elif curve.style == "area":
        look |= {"fill": "toself", "fillcolor": style.transparent(color, 0.13)}
    read = (
        {"text": list(labels), "hovertemplate": "%{text}<extra></extra>"} if labels else {"hoverinfo": "name"}
    )
    names = _NAMES[: points.shape[1]]
    places = {name: style.packed(points[:, i] * scale[i]) for i, name in enumerate(names)}
    return {"type": "scatter3d" if space else "scatter", **look, **read, **places}


def _plane(plot: Plot) -> dict[str, Any]:
    square = {"scaleanchor": "x", "constrain": "domain", "constraintoward": "top"} if plot.equal else {}
    x, y = (_titled(axis) for axis in plot.axes)
    return style.layout(_PLANE, xaxis=style.axis(x, constrain="domain"), yaxis=style.axis(y, **square))


def _space(plot: Plot) -> dict[str, Any]:
    quiet = {"backgroundcolor": "white", "gridcolor": style.GRID, "zerolinecolor": style.AXIS}
    axes = {
        f"{name}axis": {"title": {"text": _titled(axis)}, **quiet}
        for name, axis in zip(_NAMES, plot.axes, strict=True)
    }
    scene = {**axes, "aspectmode": "data" if plot.equal else "cube", "dragmode": "orbit"}
    scene["camera"] = {"eye": {"x": EYE, "y": EYE, "z": EYE}}
    return style.layout(_SPACE, scene=scene, margin={"l": 0, "r": 0, "t": 36, "b": 0})


def _titled(axis: Axis) -> str:
    unit = axis_unit(axis.units).symbol
    return f"{axis.name} ({unit})" if unit else axis.name
