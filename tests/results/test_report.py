"""The report: self-contained, complete, in the engineer's units."""

from __future__ import annotations

import base64
import json
import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import xarray

from trochoid.kinematics.types import Array
from trochoid.report import render
from trochoid.report.drawing import drawing_spec
from trochoid.report.figures import Figure, figures
from trochoid.report.tables import tiles_of
from trochoid.report.units import axis_unit, display_unit
from trochoid.results import Arrow, Check, Drawing, DrawingFrame, Line, Outcome, Quantity


@pytest.fixture(scope="module")
def html(outcome: Outcome) -> str:
    return render(outcome)


@pytest.fixture(scope="module")
def drawn(outcome: Outcome) -> dict[str, Figure]:
    assert outcome.dataset is not None
    return {figure.title: figure for figure in figures(outcome.dataset)}


def _numbers(packed: dict[str, Any]) -> Array:
    array = np.frombuffer(base64.b64decode(packed["bdata"]), dtype="<f4").astype(np.float64)
    return array.reshape([int(n) for n in packed["shape"].split(",")]) if "shape" in packed else array


def _embedded(html: str) -> Any:
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', html, re.DOTALL)
    assert found
    return json.loads(found.group(1))


@pytest.mark.exact
def test_nothing_is_loaded_from_elsewhere(html: str) -> None:
    """Outside of plotly's own code there is no address, and no element names a source."""
    start, end = html.index("<script>"), html.index("</script>")
    ours = html[:start] + html[end:]
    assert not re.search(r"https?://|//cdn", ours)
    assert not re.search(r"<(script|img|link|iframe)[^>]+(src|href)=", html, re.IGNORECASE)
    assert "@import" not in ours


@pytest.mark.exact
def test_plotly_is_inlined_once(html: str) -> None:
    """One copy, and small enough to mail."""
    assert html.count("* plotly.js v") == 1
    assert len(html.encode()) < 8e6


@pytest.mark.exact
def test_sections_and_numbers_are_there(html: str, outcome: Outcome) -> None:
    """Issue 2, chain 6: everything that the report must say."""
    for words in (
        "<h1>Cycloid drive K-H-V, 20 pins, 19 lobes, 2 discs</h1>",
        '101.31 <span class="error">± 0.41</span> <span class="unit">N·m/arcmin</span>',
        "80 mm",
        "none applies: 63 W is below",
        '<dt>Eccentric disc 1</dt><dd>6408.7 <span class="error">± 3.1</span>',
        "larger pins cut the flank",
        "<b>exact</b>",
        '<th scope="col">Speed (rpm)</th>',
        "<td>−78.947</td>",
        "The drive and its contact forces",
        *(
            f"<h3>{name}</h3>"
            for name in ("Load sharing", "Contact pressure", "Torsional stiffness", "Transmission error")
        ),
        *(f"<h3>{name}</h3>" for name in ("Reactions", "Velocity spectrum")),
        "Balances and checks",
        "What was not simulated",
        "Contact forces are normal to the surfaces",
        outcome.warnings[0],
        "The elastic ones carry the mesh frequency",
        "Scene as used",
        "output_pins.circle_radius",
    ):
        assert words in html


@pytest.mark.exact
def test_text_of_a_scene_cannot_break_the_page() -> None:
    """Markup in names and warnings stays text, also inside the embedded data."""
    evil = "</script><img src=x onerror=alert(1)>"
    frame = DrawingFrame(evil, (Line("a", np.eye(2), group=evil),))
    page = render(
        Outcome({"a": evil}, {"q": Quantity(evil)}, warnings=(evil,), title=evil, drawing=Drawing((frame,)))
    )
    assert "<img" not in page
    assert _embedded(page)["drawing"]["labels"] == [evil]


@pytest.mark.exact
def test_numbers_alone_need_no_plotly() -> None:
    """The report of `--ask ratio` is a few kilobytes."""
    page = render(Outcome({}, {"ratio": Quantity(-19.0)}))
    assert "plotly" not in page.replace("Plotly", "").lower() or "* plotly.js v" not in page
    assert len(page) < 50_000
    assert "−19" in page


@pytest.mark.exact
def test_the_worst_of_each_thing_has_a_tile_and_long_remarks_none() -> None:
    """Numbers called "worst" stand at the head; a remark of many words stands below the tiles, once."""
    worst = Quantity(1.5, "mm/s", 0.1, "elastic", note="not here")
    point = {name: Quantity(1.0, "mm/s", note=f"remark on {name}") for name in "xyzabc"} | {"worst": worst}
    reason = "no standard applies, " + "which is said in many words " * 6
    asked = {
        "velocity": Quantity(parts={"cover": point, "side": point}),
        "zone": Quantity("none applies", note=reason),
    }
    velocity, zone = tiles_of(asked)
    assert (velocity.name, [n.name for n in velocity.numbers]) == ("Velocity · worst", ["Cover", "Side"])
    assert (zone.notes, zone.more) == ((), reason)
    html = render(Outcome({}, asked))
    assert html.count(reason.strip()) == 1
    assert html.count("remark on a") == 1
    crowd = {f"p{i}": {"worst": Quantity(float(i), "mm/s")} for i in range(6)}
    [tile] = tiles_of({"velocity": Quantity(parts=crowd)})
    assert [n.value for n in tile.numbers] == ["5"]


@pytest.mark.exact
def test_failed_checks_are_announced_at_the_head() -> None:
    """Nobody should read the numbers first."""
    page = render(Outcome({}, {"mass": Quantity(1.0)}, checks=(Check("force balance", 0.1, 1e-9, False),)))
    assert "1 of 1 checks failed" in page
    assert page.index("checks failed") < page.index("Results</h2>")
    assert "✗ fails" in page


@pytest.mark.exact
def test_curves_are_converted_once(drawn: dict[str, Figure], outcome: Outcome) -> None:
    """rad → °, N stays, N·m/rad → N·m/arcmin (1 rad = 10800/π arcmin), Pa → MPa, m/s → mm/s."""
    data = outcome.dataset
    assert data is not None
    trace = drawn["Torsional stiffness"].spec["data"][0]
    np.testing.assert_allclose(_numbers(trace["x"]), np.degrees(data["input_angle"].values), rtol=1e-6)
    np.testing.assert_allclose(_numbers(trace["y"]), data["stiffness"].values * math.pi / 10800, rtol=1e-6)
    assert (
        drawn["Torsional stiffness"].spec["layout"]["yaxis"]["title"]["text"]
        == "torsional stiffness (N·m/arcmin)"
    )
    pressure = drawn["Contact pressure"].spec["data"][1]
    np.testing.assert_allclose(_numbers(pressure["y"]), data["pressure"].values[:, 1] * 1e-6, rtol=1e-6)
    velocity = _numbers(drawn["Velocity spectrum"].spec["data"][0]["y"])
    true = np.abs(data["velocity"].values[:, 0, 0]) * 1e3
    shown = ~np.isnan(velocity)
    np.testing.assert_allclose(velocity[shown], true[shown], rtol=1e-6)
    assert np.all(true[~shown] < 1e-10)


@pytest.mark.exact
def test_crowds_are_spread_over_rows(drawn: dict[str, Figure]) -> None:
    """40 pin forces: one row per disc with one legend; the pressures are maps of pin and angle."""
    forces = drawn["Load sharing"].spec
    assert len(forces["data"]) == 40
    assert {trace["yaxis"] for trace in forces["data"]} == {"y", "y2"}
    assert sum(trace["showlegend"] for trace in forces["data"]) == 20
    assert len({trace["line"]["color"] for trace in forces["data"]}) == 20
    assert [note["text"] for note in forces["layout"]["annotations"]] == ["<b>disc 1</b>", "<b>disc 2</b>"]
    heat = drawn["Pressure at every pin"].spec["data"]
    assert [trace["type"] for trace in heat] == ["heatmap", "heatmap"]
    assert _numbers(heat[0]["z"]).shape == (20, 24)
    assert heat[0]["y"][3] == "pin 3"


@pytest.mark.exact
def test_units_and_variants_are_told_apart(drawn: dict[str, Figure]) -> None:
    """Forces and moments have rows of their own; rigid is solid and elastic dashed in the same colours."""
    spec = drawn["Reactions"].spec
    force = [trace for trace in spec["data"] if trace["yaxis"] == "y"]
    assert len(force) == 8
    assert spec["layout"]["yaxis"]["title"]["text"] == "reaction (N)"
    assert spec["layout"]["yaxis2"]["title"]["text"] == "moment on the casing (N·m)"
    looks = {trace["name"]: (trace["line"]["color"], trace["line"]["dash"]) for trace in force}
    assert looks["rigid · bearing A · x"][0] == looks["elastic · bearing A · x"][0]
    assert looks["rigid · bearing A · x"][1] == "solid"
    assert looks["elastic · bearing A · x"][1] == "dash"


@pytest.mark.property
def test_spectra_have_stems(drawn: dict[str, Figure]) -> None:
    """A line of a spectrum is a marker whose stem goes down by its value, to the axis of any scale."""
    for trace in drawn["Velocity spectrum"].spec["data"]:
        assert trace["mode"] == "markers"
        down, up = (_numbers(trace["error_y"][key]) for key in ("arrayminus", "array"))
        np.testing.assert_array_equal(down, _numbers(trace["y"]))
        assert not up.any()
    assert all("error_y" not in trace for trace in drawn["Reactions"].spec["data"])


@pytest.mark.exact
def test_only_variables_with_a_figure_are_drawn(drawn: dict[str, Figure]) -> None:
    """natural_frequencies and the contact flags are for results.nc."""
    assert next(iter(drawn)) == "Load sharing"
    assert len(drawn) == 9


@pytest.mark.property
@pytest.mark.parametrize("fill", [np.nan, 0.0])
@pytest.mark.parametrize("more", [{}, {"plot": "heatmap"}, {"scale": "log"}])
def test_empty_curves_can_be_drawn(fill: float, more: dict[str, str]) -> None:
    """Nothing touches: all forces are zero, all pressures are missing."""
    attrs = {"units": "N", "long_name": "force", "figure": "f"} | more
    data = xarray.Dataset(
        {
            "a": (("input_angle", "pin"), np.full((3, 2), fill), attrs),
            "b": (("input_angle",), np.full(3, fill), attrs),
        }
    )
    (figure,) = figures(data)
    json.dumps(figure.spec, allow_nan=False)
    assert len(figure.spec["data"]) == (2 if "plot" in more else 3)


@pytest.mark.property
def test_one_position_can_be_drawn(build_outcome: Callable[..., Outcome]) -> None:
    """positions = 1 is valid."""
    page = render(build_outcome(positions=1, frames=1, around=4, across=1))
    assert len(_embedded(page)["figures"]) == 9


@pytest.mark.exact
@pytest.mark.parametrize(
    ("units", "largest", "symbol", "factor"),
    [
        ("m", 2e-5, "µm", 1e6),
        ("m", 2e-3, "mm", 1e3),
        ("rad", 1e-3, "arcmin", 10800 / math.pi),
        ("rad", 1e-5, "arcsec", 648000 / math.pi),
        ("rad", 6.0, "°", 180 / math.pi),
        ("Pa", 1e9, "MPa", 1e-6),
        ("N*m/rad", 1e5, "N·m/arcmin", math.pi / 10800),
        ("N/m", 1e9, "N/µm", 1e-6),
        ("rad/s", 157.0, "rpm", 30 / math.pi),
        ("", 1.0, "", 1.0),
        ("kg*m^2", 1.0, "kg·m²", 1.0),
    ],
)
def test_display_units(units: str, largest: float, symbol: str, factor: float) -> None:
    """1 arcmin = π/10800 rad, 1 rpm = π/30 rad/s."""
    shown = display_unit(units, largest)
    assert shown.symbol == symbol
    assert shown.factor == pytest.approx(factor, rel=1e-15)


@pytest.mark.independent
def test_display_factors_agree_with_pint() -> None:
    """pint converts one unit of each to the same number."""
    import pint

    registry: Any = pint.UnitRegistry()
    for units in ("Pa", "m/s", "N/m", "N*m/rad", "m", "rad", "rad/s", "m^2", "1/m", "N"):
        shown = axis_unit(units)
        target = shown.symbol.replace("·", "*").replace("°", "deg").replace("²", "**2")
        assert registry(units).to(target).magnitude == pytest.approx(shown.factor, rel=1e-12)


def _frames() -> Drawing:
    square = np.array([[0.0, 0], [2, 0], [2, 2], [0, 2]])
    hole = 0.5 * square + 0.5
    pin = Line("pin", 0.1 * square, style="pin", group="pins")
    frames = []
    for step in range(3):
        body = (
            Line("body", square + step, style="body", group="disc 1"),
            Line("hole", hole + step, style="hole", group="disc 1"),
        )
        arrow = Arrow(np.array([1.0, 1.0]), np.array([0.0, 100.0 * step]), "disc 1", "pin 4")
        frames.append(DrawingFrame(f"{step}°", (*body, pin), (arrow,)))
    return Drawing(tuple(frames))


@pytest.mark.exact
def test_drawing_moves_what_moves() -> None:
    """The pin is sent once, the disc in every frame and in mm; the hole runs against the body."""
    spec = drawing_spec(_frames())
    names = [trace["name"] for trace in spec["data"]]
    assert names == ["disc 1", "pins", "forces, disc 1", "forces, disc 1"]
    assert [motion["trace"] for motion in spec["moving"]] == [0, 2, 3]
    disc = spec["moving"][0]
    x, y = (_numbers(disc[axis]) for axis in "xy")
    assert x.shape == (3, disc["size"]) == (3, 11)
    np.testing.assert_allclose(x[2], np.where(np.isnan(x[0]), np.nan, x[0] + 2000.0))

    def area(part: slice) -> float:
        a, b = x[0, part], y[0, part]
        return float(0.5 * np.sum(a[:-1] * b[1:] - a[1:] * b[:-1]))

    assert area(slice(0, 5)) == pytest.approx(4e6)
    assert area(slice(6, 11)) == pytest.approx(-1e6)


@pytest.mark.exact
def test_arrows_are_as_long_as_forces_are_large() -> None:
    """0, 100 and 200 N: no arrow, half and full length, all in proportion."""
    spec = drawing_spec(_frames())
    tips = _numbers(spec["moving"][1]["y"]).reshape(3, -1)
    lengths = np.nan_to_num(np.nanmax(np.where(np.isnan(tips), 1000.0, tips), axis=1) - 1000.0)
    np.testing.assert_allclose(lengths, [0.0, 280.0, 560.0], rtol=1e-6)
    assert spec["moving"][2]["text"] == [[], ["disc 1 · pin 4 · 100 N"], ["disc 1 · pin 4 · 200 N"]]
    assert spec["captions"] == [
        "nothing touches",
        *(f"disc 1: 1 force, {f} N (pin 4)" for f in (100, 200)),
    ]
    assert spec["scale"] == "Arrows: 560 mm for 200 N."


@pytest.mark.exact
def test_names_are_never_an_axis() -> None:
    """A few harmonics of many named bearings: the axis is the harmonics, however few they are."""
    amplitudes = xarray.DataArray(
        np.ones((4, 2)),
        dims=("bearing", "harmonic"),
        coords={"bearing": ["shaft A", "shaft B", "flange A", "flange B"], "harmonic": [1, 2]},
        attrs={"units": "N", "figure": "Harmonics"},
    )
    (figure,) = figures(xarray.Dataset({"amplitude": amplitudes}))
    assert len(figure.spec["data"]) == 4
    assert all(len(_numbers(trace["x"])) >= 2 for trace in figure.spec["data"])
