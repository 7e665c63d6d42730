"""The page: template, style, script and data put into one file that needs no network."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trochoid.report.tables import Table, scene_tables, tables_of, tiles_of
from trochoid.results import text
from trochoid.results.document import document, version
from trochoid.results.outcome import Outcome

if TYPE_CHECKING:
    from jinja2 import Template

_HERE = Path(__file__).parent


def render(outcome: Outcome) -> str:
    """Return the report of `outcome` as HTML; plotly is inlined once, and only when something is drawn."""
    drawing, figures = _drawing(outcome), _figures(outcome)
    plots = [spec for spec, _ in figures.values()]
    page = _template().render(
        outcome=outcome,
        title=outcome.title or "Gear drive",
        version=version(),
        films=outcome.films,
        tiles=tiles_of(outcome.quantities),
        tables=tables_of(outcome.quantities),
        figures={title: caption for title, (_, caption) in figures.items()},
        drawing=drawing is not None,
        drawing_title="The drive and its contact forces" if _forces(outcome) else "The drive in motion",
        failed=[check for check in outcome.checks if not check.ok],
        seconds=sum(stage.seconds for stage in outcome.stages),
        scene=_scene(outcome),
        css=_file("style.css"),
        script=_file("report.js"),
        plotly=_plotly() if plots or drawing else "",
        data=_embedded({"figures": plots, "drawing": drawing}),
    )
    return str(page)


def _template() -> Template:
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(loader=FileSystemLoader(_HERE), autoescape=True, undefined=StrictUndefined)
    environment.trim_blocks = environment.lstrip_blocks = True
    environment.filters |= {"number": text.number, "label": text.label, "sentence": text.sentence}
    return environment.get_template("page.html.j2")


def _scene(outcome: Outcome) -> list[Table]:
    return scene_tables(document(outcome)["scene"])


def _figures(outcome: Outcome) -> dict[str, tuple[Mapping[str, Any], str]]:
    found: dict[str, tuple[Mapping[str, Any], str]] = {}
    if outcome.plots:
        from trochoid.report.plots import plot_spec

        found |= {plot.title: (plot_spec(plot), plot.caption) for plot in outcome.plots}
    if outcome.dataset is not None:
        from trochoid.report.figures import figures

        found |= {figure.title: (figure.spec, figure.caption) for figure in figures(outcome.dataset)}
    return found


def _drawing(outcome: Outcome) -> dict[str, Any] | None:
    if outcome.drawing is None or not outcome.drawing.frames:
        return None
    from trochoid.report.drawing import drawing_spec

    return drawing_spec(outcome.drawing)


def _forces(outcome: Outcome) -> bool:
    return outcome.drawing is not None and any(frame.arrows for frame in outcome.drawing.frames)


def _embedded(data: Any) -> str:
    """Return `data` as JSON that cannot end the script element it stands in."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def _file(name: str) -> str:
    return (_HERE / name).read_text(encoding="utf-8")


def _plotly() -> str:
    """Return plotly.js out of the plotly package, without importing the package."""
    spec = find_spec("plotly")
    folders: Sequence[str] = (spec.submodule_search_locations if spec else None) or ()
    return (Path(folders[0]) / "package_data" / "plotly.min.js").read_text(encoding="utf-8")
