"""The visual style of all figures: colours that the colour-blind can tell apart, thin lines, quiet grid."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
import numpy.typing as npt

FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', 'Liberation Sans', Arial, sans-serif"
INK, MUTED, GRID, AXIS = "#1f2933", "#5b6773", "#e8ebef", "#9aa5b1"
# Okabe and Ito (2008), without black and the yellow that white paper swallows
CATEGORIES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#7A5195", "#4D4D4D")
DASHES = ("solid", "dash", "dot", "dashdot")
# viridis, cut before its light end
_SEQUENCE = (
    "#440154",
    "#482475",
    "#414487",
    "#355f8d",
    "#2a788e",
    "#21918c",
    "#22a884",
    "#44bf70",
    "#7ad151",
    "#b5cc18",
)
HEAT = ((0.0, "#ffffff"), (0.15, "#d6e6f4"), (0.4, "#6baed6"), (0.7, "#2171b5"), (1.0, "#08306b"))


def palette(count: int) -> list[str]:
    """Return `count` colours: distinct ones up to 8, beyond that a sequence by index."""
    if count <= len(CATEGORIES):
        return list(CATEGORIES[:count])
    anchors = np.array(
        [[int(color[i : i + 2], 16) for i in (1, 3, 5)] for color in _SEQUENCE], dtype=np.float64
    )
    at = np.linspace(0.0, len(anchors) - 1.0, count)
    channels = [np.interp(at, np.arange(len(anchors)), anchors[:, i]) for i in range(3)]
    return ["#" + "".join(f"{round(c):02x}" for c in rgb) for rgb in zip(*channels, strict=True)]


def distinct(count: int) -> list[str]:
    """Return `count` colours for things without an order: the categories, then these in lighter tints."""
    tints = [list(CATEGORIES)]
    while sum(map(len, tints)) < count:
        tints.append([_lighter(color) for color in tints[-1]])
    return [color for tint in tints for color in tint][:count]


def _lighter(color: str) -> str:
    channels = [int(color[i : i + 2], 16) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(0.5 * (c + 245)):02x}" for c in channels)


def transparent(color: str, alpha: float) -> str:
    """Return the "#rrggbb" `color` as rgba with the given opacity."""
    return f"rgba({int(color[1:3], 16)},{int(color[3:5], 16)},{int(color[5:7], 16)},{alpha})"


def axis(title: str = "", **more: Any) -> dict[str, Any]:
    """Return the settings of an axis."""
    return {
        "title": {"text": title, "font": {"size": 13, "color": MUTED}, "standoff": 10},
        "gridcolor": GRID,
        "linecolor": AXIS,
        "tickcolor": AXIS,
        "ticks": "outside",
        "ticklen": 4,
        "zeroline": False,
        "showline": True,
        "automargin": True,
        "exponentformat": "power",
        **more,
    }


def layout(height: int, **more: Any) -> dict[str, Any]:
    """Return the settings that all figures share."""
    return {
        "font": {"family": FONT, "size": 12.5, "color": INK},
        "paper_bgcolor": "white",
        "plot_bgcolor": "white",
        "height": height,
        "margin": {"l": 72, "r": 16, "t": 30, "b": 52},
        "hoverlabel": {
            "bgcolor": "white",
            "bordercolor": AXIS,
            "font": {"family": FONT, "size": 12},
            "namelength": -1,
        },
        "legend": {
            "font": {"size": 12},
            "bgcolor": "rgba(255,255,255,0)",
            "itemsizing": "constant",
            "tracegroupgap": 0,
        },
        "separators": ".\u202f",
        **more,
    }


def packed(values: npt.ArrayLike) -> dict[str, Any]:
    """Return numbers in plotly's binary form (float32; a gap is NaN), a third of the size of their digits."""
    array = np.ascontiguousarray(values, dtype="<f4")
    data: dict[str, Any] = {"dtype": "f4", "bdata": base64.b64encode(array.tobytes()).decode("ascii")}
    if array.ndim > 1:
        data["shape"] = ", ".join(map(str, array.shape))
    return data
