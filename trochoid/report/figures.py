"""From the dataset to plotly figures, one per `figure` attribute."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from trochoid.report import style
from trochoid.report.curves import curves_of
from trochoid.report.panels import Panel, panels_of
from trochoid.report.traces import heat_map, lines

if TYPE_CHECKING:
    import xarray

_TOGETHER = 10  # curves up to which one hover box shows them all
_GAP = 34  # px between rows
_AROUND = 90  # px for margins


@dataclass(frozen=True, slots=True)
class Figure:
    """A plotly figure with its heading and the sentence below it."""

    title: str
    caption: str
    spec: Mapping[str, Any]


def figures(dataset: xarray.Dataset) -> tuple[Figure, ...]:
    """Return the figures of `dataset` in the order in which their variables appear."""
    grouped: dict[str, list[xarray.DataArray]] = {}
    for variable in dataset.data_vars.values():
        if variable.attrs.get("figure") and variable.size and variable.ndim:
            grouped.setdefault(str(variable.attrs["figure"]), []).append(variable)
    return tuple(_figure(title, variables) for title, variables in grouped.items())


def _figure(title: str, variables: Sequence[xarray.DataArray]) -> Figure:
    panels = panels_of([curve for variable in variables for curve in curves_of(variable)])
    captions = dict.fromkeys(str(v.attrs["caption"]) for v in variables if v.attrs.get("caption"))
    return Figure(title, " ".join(captions), _spec(panels))


def _spec(panels: Sequence[Panel]) -> dict[str, Any]:
    heights = [_height(panel, alone=len(panels) == 1) for panel in panels]
    layout = style.layout(sum(heights) + _GAP * (len(panels) - 1) + _AROUND)
    traces: list[dict[str, Any]] = []
    named: set[str] = set()
    for row, domain in enumerate(_domains(heights)):
        panel, suffix = panels[row], "" if row == 0 else str(row + 1)
        axes = {"xaxis": f"x{suffix}", "yaxis": f"y{suffix}"}
        drawn = (
            heat_map(panel, domain, _range(panels, panel))
            if panel.heat
            else lines(panel, named, f"legend{suffix}")
        )
        traces += [trace | axes for trace in drawn]
        layout[f"legend{suffix}"] = layout["legend"] | {"y": domain[1], "yanchor": "top"}
        layout[f"xaxis{suffix}"] = _x_axis(panels, row) | {"anchor": axes["yaxis"]}
        layout[f"yaxis{suffix}"] = _y_axis(panel) | {"anchor": axes["xaxis"], "domain": list(domain)}
    most = max((len(panel.curves) for panel in panels if not panel.heat), default=0)
    layout["hovermode"] = "x unified" if 0 < most <= _TOGETHER else "closest"
    layout["showlegend"] = most > 1
    layout["annotations"] = list(_row_titles(panels, _domains(heights)))
    return {"data": traces, "layout": layout}


def _range(panels: Sequence[Panel], panel: Panel) -> tuple[float, float]:
    """Return lowest and highest value of all maps of the same variable: they share one scale of colours."""
    curves = [curve for other in panels if other.variables == panel.variables for curve in other.curves]
    return min(curve.lowest for curve in curves), max(curve.highest for curve in curves)


def _height(panel: Panel, alone: bool) -> int:
    if panel.heat:
        return max(150, 11 * len(panel.curves))
    return 300 if alone else 210


def _domains(heights: Sequence[int]) -> list[tuple[float, float]]:
    """Return the vertical extent of each row as fractions, from the top."""
    total = sum(heights) + _GAP * (len(heights) - 1)
    tops = [sum(heights[:row]) + _GAP * row for row in range(len(heights))]
    return [(max(0.0, 1 - (top + h) / total), 1 - top / total) for top, h in zip(tops, heights, strict=True)]


def _x_axis(panels: Sequence[Panel], row: int) -> dict[str, Any]:
    """Return the axis of a row; rows over one axis move together, and only the last of them is labelled."""
    curve, unit = panels[row].first, panels[row].x_unit.symbol
    last = row + 1 == len(panels) or panels[row + 1].first.x_dim != curve.x_dim
    settings = style.axis(_titled(curve.x_name, unit) if last else "", showticklabels=last)
    spaced = unit if unit == "°" else f" {unit}"
    settings |= {"hoverformat": ".4~g", "unifiedhovertitle": {"text": f"{curve.x_name} %{{x:.4~g}}{spaced}"}}
    if unit == "°":
        turn = curve.x.size > 1 and abs(curve.x[-1] - curve.x[0]) > 3.5
        settings |= {"ticksuffix": "°", "dtick": 45 if turn else None}
    if curve.log and curve.spectrum:
        settings |= {
            "type": "log",
            "dtick": "D2",
            "tickformat": "~r",
            "minor": {"showgrid": True, "gridcolor": "#f3f5f7"},
        }
    if row and panels[0].first.x_dim == curve.x_dim:
        settings["matches"] = "x"
    return settings


def _y_axis(panel: Panel) -> dict[str, Any]:
    if panel.heat:
        varied = [dim for dim in panel.first.place if len({curve.place[dim] for curve in panel.curves}) > 1]
        name = varied[0].replace("_", " ") if varied else ""
        return style.axis(name, type="category", showgrid=False, autorange="reversed")
    settings = style.axis(_titled(panel.subject, panel.unit.symbol))
    if panel.first.log:
        return settings | {"type": "log", "dtick": 1}
    low = min(curve.lowest for curve in panel.curves)
    return settings | ({"rangemode": "tozero"} if 0.0 <= low < 0.5 * panel.largest else {})


def _titled(name: str, unit: str) -> str:
    return f"{name} ({unit})" if name and unit not in ("", "°") else name or unit


def _row_titles(panels: Sequence[Panel], domains: Sequence[tuple[float, float]]) -> Iterator[dict[str, Any]]:
    for panel, (_, top) in zip(panels, domains, strict=True):
        if panel.title:
            yield {
                "text": f"<b>{panel.title}</b>",
                "font": {"size": 12.5, "color": style.MUTED},
                "showarrow": False,
                "xref": "paper",
                "yref": "paper",
                "x": 0,
                "y": top,
                "xanchor": "left",
                "yanchor": "bottom",
                "yshift": 3,
            }
