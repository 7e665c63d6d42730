"""The summary on a terminal and in a pipe."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

from trochoid.results import Check, Outcome, Quantity, show
from trochoid.results.terminal import rows


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def _plain(outcome: Outcome, *files: Path) -> str:
    stream = io.StringIO()
    show(outcome, files, stream)
    return stream.getvalue()


@pytest.mark.exact
def test_pipe_gets_plain_aligned_lines(outcome: Outcome) -> None:
    """No escape codes; every number ends in the same column."""
    text = _plain(outcome, Path("out/report.html"))
    lines = text.splitlines()
    assert "\x1b" not in text
    assert lines[0] == outcome.title
    table = lines[2 : 2 + 1 + len(list(rows(outcome.quantities)))]
    ends = {
        line.index(value) + len(value)
        for line in table
        for value in ("101.31", "405.47", "513", "6408.7")
        if value in line
    }
    assert len(ends) == 1
    assert any(
        line.split() == ["torsional_stiffness", "101.31", "0.41", "N·m/arcmin", "strips"] for line in table
    )
    assert "force balance             3.2×10⁻¹²  1×10⁻⁹  ok" in lines
    assert "wrote out/report.html" in lines
    assert any(line.startswith("warning: the spectrum") for line in lines)


@pytest.mark.exact
def test_terminal_gets_the_same_content(outcome: Outcome, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same numbers as in the pipe; names are never cut on 80 columns."""
    monkeypatch.setenv("COLUMNS", "100")
    stream = _Terminal()
    show(outcome, (Path("out/report.html"),), stream)
    for word in (
        "101.31",
        "0.41",
        "N·m/arcmin",
        "contact_pressure_max",
        "relative_to_input",
        "ok",
        "out/report.html",
    ):
        assert word in stream.getvalue()


@pytest.mark.exact
def test_stream_without_unicode_gets_ascii(outcome: Outcome) -> None:
    """A console of Windows or LANG=C still shows everything."""
    buffer = io.BytesIO()
    stream = io.TextIOWrapper(buffer, encoding="ascii")
    show(outcome, (), stream)
    stream.flush()
    text = buffer.getvalue().decode("ascii")
    assert "N*m/arcmin" in text
    assert "3.2e-12" in text
    assert "+/- error" in text


@pytest.mark.exact
def test_failed_check_stands_out() -> None:
    """A verdict that no one overlooks."""
    assert "FAILED" in _plain(Outcome({}, {}, checks=(Check("force balance", 0.1, 1e-9, False),)))


@pytest.mark.exact
def test_long_lists_are_cut_with_a_pointer() -> None:
    """Of 100 parts the first are shown, and where the others are."""
    parts = {f"pin_{k}": Quantity(float(k), "N") for k in range(100)}
    text = _plain(Outcome({}, {"load_sharing": Quantity(parts=parts)}))
    assert "pin_23" in text
    assert "pin_24" not in text
    assert "… 76 more in results.json" in text


@pytest.mark.exact
def test_markup_in_names_is_text() -> None:
    """Square brackets of a warning are shown, not obeyed."""
    stream = _Terminal()
    show(Outcome({}, {}, warnings=("set [bold]drive.pins[/bold]",)), (), stream)
    assert "[bold]drive.pins[/bold]" in stream.getvalue()
