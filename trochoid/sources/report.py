"""The same page as one HTML file that needs no network and no script."""

from __future__ import annotations

import re
from importlib.resources import files

from trochoid.results.document import version
from trochoid.sources.book import Chapter, chapters, summary


def render(made: tuple[Chapter, ...] | None = None) -> str:
    """Return the report as HTML."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    made = chapters() if made is None else made
    environment = Environment(
        loader=PackageLoader("trochoid.sources", "."), autoescape=True, undefined=StrictUndefined
    )
    environment.trim_blocks = environment.lstrip_blocks = True
    environment.filters |= {"marked": marked, "name": _name, "breakable": _breakable}
    page = environment.get_template("page.html.j2").render(
        chapters=made,
        summary=summary(made),
        version=version(),
        css=files("trochoid.report").joinpath("style.css").read_text(encoding="utf-8"),
    )
    return str(page)


def _name(test: str) -> str:
    return test.partition("::")[2]


def _breakable(name: str) -> object:
    """The name, which may break after each underscore."""
    from markupsafe import Markup, escape

    return Markup(str(escape(name)).replace("_", "_<wbr>"))


def marked(text: str) -> object:
    """The text, escaped, with `code` and *emphasis* as in Markdown."""
    from markupsafe import Markup, escape

    pieces = re.split(r"`([^`]+)`", text)
    made = [
        f"<code>{escape(piece)}</code>"
        if i % 2
        else re.sub(r"\*(\S[^*]*)\*", r"<em>\1</em>", str(escape(piece)))
        for i, piece in enumerate(pieces)
    ]
    return Markup("".join(made))
