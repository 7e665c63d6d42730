"""The plotly traces of one row: lines, stems of a spectrum, or a map."""

from __future__ import annotations

from typing import Any

import numpy as np

from trochoid.kinematics.types import Array
from trochoid.report import style
from trochoid.report.curves import Curve
from trochoid.report.panels import Panel

_MANY = 10  # curves beyond which lines are thin
_SYMBOLS = ("circle", "circle-open", "diamond", "diamond-open")
_NOISE = 1e-12  # of the largest value is shown as zero
_STEMS = 300  # lines of a spectrum up to which each is a stem; more are drawn as the line over their tops
_DECADES = 5  # of a logarithmic axis below its largest value; under that is rounding


def lines(panel: Panel, named: set[str], legend: str) -> list[dict[str, Any]]:
    """Return one trace per curve; colour by place and dash by variable where both vary.

    `named` collects the names that some legend of the figure already has.
    """
    places = list(dict.fromkeys(curve.label for curve in panel.curves))
    variables = panel.variables
    colored = places if len(places) > 1 else variables
    colors = dict(zip(colored, style.palette(len(colored)), strict=True))
    traces = []
    for curve in panel.curves:
        name = panel.name(curve)
        color = colors[curve.label if colored is places else curve.variable]
        variant = variables.index(curve.variable) if colored is places else 0
        dash = style.DASHES[variant % len(style.DASHES)]
        line = {"color": color, "width": 1.1 if len(panel.curves) > _MANY else 1.8, "dash": dash}
        shown = {"name": name, "legendgroup": name, "showlegend": name not in named, "legend": legend}
        look = _stems(curve, panel, color, variant) if _apart(curve) else {"line": line}
        traces.append(_line(curve, panel) | shown | look)
        named.add(name)
    return traces


def heat_map(panel: Panel, domain: tuple[float, float], limits: tuple[float, float]) -> list[dict[str, Any]]:
    """Return the map of angle and index, coloured between `limits` (SI), with its colour bar beside `domain`."""
    bar = {"title": {"text": panel.unit.symbol, "side": "top"}, "thickness": 12, "outlinewidth": 0}
    degree, unit = panel.x_unit.symbol, panel.unit.symbol
    low, high = (limit * panel.unit.factor for limit in limits)
    colours = {"zmin": low, "zmax": high} if low < high else {}
    return [
        {
            "type": "heatmap",
            "x": style.packed(panel.first.x * panel.x_unit.factor),
            "y": [panel.name(curve) for curve in panel.curves],
            "z": style.packed(np.array([curve.y for curve in panel.curves]) * panel.unit.factor),
            **colours,
            "colorscale": [list(stop) for stop in style.HEAT],
            "colorbar": bar | {"y": sum(domain) / 2, "len": domain[1] - domain[0]},
            "hovertemplate": f"%{{y}}, %{{x:.1f}}{degree}<br>%{{z:.5~g}} {unit}<extra></extra>",
        }
    ]


def _line(curve: Curve, panel: Panel) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "markers" if _apart(curve) else "lines",
        "x": style.packed(curve.x * panel.x_unit.factor),
        "y": style.packed(_cleaned(curve, panel.largest) * panel.unit.factor),
        "hovertemplate": f"%{{y:.5~g}} {panel.unit.symbol}<extra>{panel.name(curve)}</extra>",
    }


def _apart(curve: Curve) -> bool:
    return curve.spectrum and curve.y.size <= _STEMS


def _stems(curve: Curve, panel: Panel, color: str, variant: int) -> dict[str, Any]:
    """Return the look of a spectrum: a marker at every line, with a stem down to the axis, of any scale."""
    down = style.packed(_cleaned(curve, panel.largest) * panel.unit.factor)
    stem = {
        "type": "data",
        "symmetric": False,
        "array": style.packed(np.zeros(curve.y.size)),
        "arrayminus": down,
    }
    return {
        "marker": {"size": 5, "color": color, "symbol": _SYMBOLS[variant % len(_SYMBOLS)]},
        "error_y": stem | {"width": 0, "thickness": 1.1, "color": color},
    }


def _cleaned(curve: Curve, largest: float) -> Array:
    """Return the values without rounding noise: it is left out on a logarithmic axis, elsewhere it is 0."""
    if curve.log:
        return np.where(curve.y > largest * 10.0**-_DECADES, curve.y, np.nan)
    return np.where(np.abs(curve.y) < largest * _NOISE, 0.0, curve.y)
