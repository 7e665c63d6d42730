"""The study as one HTML file: pictures, tables, and what follows from them."""

from __future__ import annotations

from importlib.resources import files

from trochoid.accuracy import words
from trochoid.accuracy.plot import svg
from trochoid.accuracy.study import Study
from trochoid.accuracy.terminal import quantity_rows, step_rows
from trochoid.results import text
from trochoid.results.document import version


def render(study: Study) -> str:
    """Return the page; it needs no network and no script."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("trochoid.accuracy", "."), autoescape=True, undefined=StrictUndefined
    )
    environment.trim_blocks = environment.lstrip_blocks = True
    quantities = list(study.reference.step.numbers)
    page = environment.get_template("page.html.j2").render(
        study=study,
        version=version(),
        css=files("trochoid.report").joinpath("style.css").read_text(encoding="utf-8"),
        picture=svg(study),
        pictures={text.label(name): svg(study, name) for name in quantities if name in study.reference.errors}
        if len(quantities) > 1
        else {},
        steps=list(step_rows(study)),
        chosen=[study.choice is not None and study.choice.judged is judged for judged in study.steps],
        quantities=list(quantity_rows(study)),
        sentences=list(words.sentences(study)),
    )
    return str(page)
