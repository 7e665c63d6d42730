"""The drive drawn at each input angle: what stands still once, what moves as arrays over the frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from trochoid.kinematics.types import Array
from trochoid.report import arrows, style
from trochoid.results.outcome import Arrow, Drawing, DrawingFrame, Line
from trochoid.results.text import number

_MM = 1e3
_MOST_POINTS = 800  # of one polyline
_LONGEST = 0.28  # length of the largest force as a share of the drawing's width
_STEEL, _EDGE = "#dfe4ea", "#7b8794"
_HEIGHT = 780


@dataclass(frozen=True, slots=True)
class _Trace:
    """A plotly trace and its points, (frames, n) mm; `text` per frame is what the pointer reads."""

    settings: dict[str, Any]
    x: Array
    y: Array
    text: tuple[list[str], ...] = ()

    @property
    def moves(self) -> bool:
        return bool(self.text) or not (_same(self.x) and _same(self.y))

    def drawn(self) -> dict[str, Any]:
        """Return the trace of the first frame."""
        points = {"x": style.packed(self.x[0]), "y": style.packed(self.y[0])}
        return self.settings | points | ({"text": self.text[0]} if self.text else {})


def drawing_spec(drawing: Drawing) -> dict[str, Any]:
    """Return what report.js draws: the first frame as a plotly figure, and what changes in the others."""
    frames = drawing.frames
    low, high = _bounds(frames[0])
    width = float(max(high - low))
    forces = any(frame.arrows for frame in frames)
    largest = max((arrows.magnitude(a) for frame in frames for a in frame.arrows), default=0.0)
    colors = _colors(frames[0])
    traces = _line_traces(frames, colors)
    if largest > 0.0:
        traces += _arrow_traces(frames, colors, width, _LONGEST * width / largest)
    return {
        "data": [trace.drawn() for trace in traces],
        "layout": _layout(low * _MM, high * _MM, 0.04 * width * _MM),
        "moving": [_motion(index, trace) for index, trace in enumerate(traces) if trace.moves],
        "labels": [frame.label for frame in frames],
        "captions": [arrows.summary(frame) if forces else "" for frame in frames],
        "scale": _scale(_LONGEST * width * _MM, largest),
    }


def _scale(length: float, force: float) -> str:
    return f"Arrows: {number(length, 3)} mm for {number(force, 4)} N." if force else ""


def _motion(index: int, trace: _Trace) -> dict[str, Any]:
    points = {"x": style.packed(trace.x), "y": style.packed(trace.y), "size": trace.x.shape[1]}
    return {"trace": index, "text": list(trace.text)} | points


def _layout(low: Array, high: Array, margin: float) -> dict[str, Any]:
    x, y = ([float(low[i]) - margin, float(high[i]) + margin] for i in (0, 1))
    square = {"scaleanchor": "x", "constrain": "domain", "constraintoward": "top"}
    return style.layout(
        _HEIGHT,
        xaxis=style.axis("x (mm)", range=x, constrain="domain", showgrid=False),
        yaxis=style.axis("y (mm)", range=y, showgrid=False, **square),
        hovermode="closest",
        showlegend=True,
    )


def _line_traces(frames: Sequence[DrawingFrame], colors: dict[str, str]) -> list[_Trace]:
    """Return one trace per legend group and way of drawing, bodies with their holes cut out."""
    groups: dict[tuple[str, str], list[int]] = {}
    for index, line in enumerate(frames[0].lines):
        kind = "body" if line.style == "hole" else line.style
        groups.setdefault((line.group or line.name, kind), []).append(index)
    traces = []
    for (group, kind), members in groups.items():
        paths = np.array([_joined([frame.lines[i] for i in members]) for frame in frames]) * _MM
        settings = {"type": "scatter", "mode": "lines", "name": group, "hoverinfo": "skip"}
        look = _look(kind, colors.get(group, _EDGE)) | {"legendgroup": group}
        traces.append(_Trace(settings | look, paths[..., 0], paths[..., 1]))
    return traces


def _look(kind: str, color: str) -> dict[str, Any]:
    looks: dict[str, dict[str, Any]] = {
        "body": {"fillcolor": style.transparent(color, 0.13), "line": {"color": color, "width": 1.4}},
        "pin": {"fillcolor": _STEEL, "line": {"color": _EDGE, "width": 1}},
        "center": {"line": {"color": style.AXIS, "width": 0.8, "dash": "longdashdot"}},
    }
    look = looks.get(kind, {"line": {"color": _EDGE, "width": 1.2}})
    return look | ({"fill": "toself"} if "fillcolor" in look else {})


def _joined(lines: Sequence[Line]) -> Array:
    """Return the polylines as one, with gaps; holes run against the bodies, so that filling spares them."""
    pieces: list[Array] = []
    for line in lines:
        xy = line.xy[:: -(-len(line.xy) // _MOST_POINTS)]
        if line.closed:
            xy = np.vstack([xy, xy[:1]])
            clockwise = float(np.sum(xy[:-1, 0] * xy[1:, 1] - xy[1:, 0] * xy[:-1, 1])) < 0
            xy = xy[::-1] if clockwise != (line.style == "hole") else xy
        pieces += [xy, np.full((1, 2), np.nan)]
    return np.vstack(pieces[:-1])


def _arrow_traces(
    frames: Sequence[DrawingFrame], colors: dict[str, str], width: float, scale: float
) -> list[_Trace]:
    """Return per group the arrows as filled shapes, and the points that tell their force when pointed at."""
    traces = []
    for group in dict.fromkeys(arrow.group for frame in frames for arrow in frame.arrows):
        acting = [[a for a in f.arrows if a.group == group and arrows.magnitude(a) > 0] for f in frames]
        color = colors.get(group, style.INK)
        name = {"type": "scatter", "name": f"forces, {group}" if group else "forces"}
        shapes = _stacked([arrows.outlines(row, scale, width) for row in acting])
        name["legendgroup"] = name["name"]
        traces.append(_Trace(name | _fill(color), *shapes))
        texts = tuple([arrows.reading(arrow) for arrow in row] for row in acting)
        traces.append(_Trace(name | _marks(color), *_stacked([_origins(row) for row in acting]), text=texts))
    return traces


def _marks(color: str) -> dict[str, Any]:
    marker = {"size": 6, "color": color, "line": {"color": "white", "width": 1}}
    hover = {"hovertemplate": "%{text}<extra></extra>"}
    return {"mode": "markers", "marker": marker, "showlegend": False} | hover


def _fill(color: str) -> dict[str, Any]:
    return {"mode": "lines", "fill": "toself", "fillcolor": color, "line": {"width": 0}, "hoverinfo": "skip"}


def _origins(row: Sequence[Arrow]) -> Array:
    return np.array([arrow.origin for arrow in row], dtype=np.float64).reshape(-1, 2)


def _stacked(rows: Sequence[Array]) -> tuple[Array, Array]:
    """Return x and y, (frames, n) mm, of rows of points that differ in number, filled up with gaps."""
    most = max(map(len, rows))
    filled = np.array([np.vstack([row, np.full((most - len(row), 2), np.nan)]) for row in rows]) * _MM
    return filled[..., 0], filled[..., 1]


def _colors(frame: DrawingFrame) -> dict[str, str]:
    groups = list(dict.fromkeys(line.group or line.name for line in frame.lines if line.style == "body"))
    return dict(zip(groups, style.palette(len(groups)), strict=True))


def _bounds(frame: DrawingFrame) -> tuple[Array, Array]:
    points = np.vstack([line.xy for line in frame.lines])
    return points.min(axis=0), points.max(axis=0)


def _same(values: Array) -> bool:
    return bool(np.all((values == values[0]) | (np.isnan(values) & np.isnan(values[0]))))
