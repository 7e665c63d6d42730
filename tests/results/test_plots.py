"""Pictures of their own: plane and spatial plots as plotly draws them."""

from __future__ import annotations

import base64
from dataclasses import replace

import numpy as np
import pytest

from trochoid.report import render
from trochoid.report.plots import plot_spec
from trochoid.results import Axis, Outcome, Plot, PlotCurve, PlotSurface

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
PLANE = Plot(
    "Blocking contour",
    (Axis("x1"), Axis("x2")),
    (
        PlotCurve("region", SQUARE, style="area", closed=True),
        PlotCurve("line", SQUARE[[0, 2]], style="dashed"),
        PlotCurve("given", SQUARE[:1], style="points", labels=("x1 = 0, x2 = 0",)),
    ),
    caption="What can be made.",
)
CORNERS = np.array([[0.0, 0.0, 0.0], [0.064, 0.0, 0.0], [0.0, 0.064, 0.0], [0.0, 0.0, 0.064]])
SIDES = np.array([[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]])
SPACE = Plot(
    "Cones",
    (Axis("x", "m"), Axis("y", "m"), Axis("z", "m")),
    (PlotCurve("axis", CORNERS[[0, 3]], group="satellite"),),
    (PlotSurface("cone", CORNERS, SIDES, opacity=0.4, group="satellite"),),
)


def numbers(packed: dict[str, str]) -> list[float]:
    return [float(n) for n in np.frombuffer(base64.b64decode(packed["bdata"]), dtype="<f4")]


@pytest.mark.exact
def test_plane_plot_has_its_curves_in_order() -> None:
    """Areas are closed and filled, points are markers that can be read, one unit is as long along both axes."""
    spec = plot_spec(PLANE)
    area, line, given = spec["data"]
    assert [trace["type"] for trace in spec["data"]] == ["scatter"] * 3
    assert numbers(area["x"]) == [0.0, 1.0, 1.0, 0.0, 0.0]
    assert area["fill"] == "toself"
    assert line["line"]["dash"] == "dash"
    assert given["mode"] == "markers"
    assert given["text"] == ["x1 = 0, x2 = 0"]
    assert spec["layout"]["yaxis"]["scaleanchor"] == "x"
    assert "scaleanchor" not in plot_spec(replace(PLANE, equal=False))["layout"]["yaxis"]


@pytest.mark.exact
def test_spatial_plot_is_in_the_units_of_its_axes() -> None:
    """Lengths are shown in mm; what belongs together has one colour and one entry in the legend."""
    spec = plot_spec(SPACE)
    axis, cone = spec["data"]
    assert (axis["type"], cone["type"]) == ("scatter3d", "mesh3d")
    assert max(numbers(cone["x"])) == pytest.approx(64.0)
    assert cone["i"] == [0, 0, 0, 1]
    assert cone["color"] == axis["line"]["color"]
    assert [trace["showlegend"] for trace in spec["data"]] == [True, False]
    assert spec["layout"]["scene"]["xaxis"]["title"]["text"] == "x (mm)"


@pytest.mark.exact
def test_points_must_fit_the_axes() -> None:
    """A curve in the plane has no place among three axes, nor a surface among two."""
    with pytest.raises(ValueError, match=r"do not fit: \['line'\]"):
        Plot("wrong", SPACE.axes, (PlotCurve("line", SQUARE),))
    with pytest.raises(ValueError, match=r"do not fit: \['cone'\]"):
        Plot("wrong", PLANE.axes, (), SPACE.surfaces)
    with pytest.raises(ValueError, match="has 1 axes"):
        Plot("wrong", PLANE.axes[:1])


@pytest.mark.exact
def test_report_shows_the_pictures_before_the_curves(outcome: Outcome) -> None:
    """Each has its heading and caption, and plotly is there for it even when nothing else is drawn."""
    html = render(replace(outcome, plots=(PLANE, SPACE)))
    assert html.index("<h3>Blocking contour</h3>") < html.index("<h3>Cones</h3>")
    assert "What can be made." in html
    alone = render(Outcome(scene={}, quantities={}, plots=(PLANE,)))
    assert "<h3>Blocking contour</h3>" in alone
    assert len(alone) > 1e6
