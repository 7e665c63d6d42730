"""What a reader of a study gets: terminal, JSON, picture, page, files."""

from __future__ import annotations

import io
import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.accuracy.conftest import LEVELS, MODEL, Studied
from trochoid.accuracy import Study, show, to_json, write
from trochoid.accuracy.page import render
from trochoid.accuracy.plot import svg
from trochoid.accuracy.words import percent


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def _shown(study: Study, stream: io.StringIO) -> str:
    show(study, (Path("out/accuracy.html"),), stream)
    return stream.getvalue()


@pytest.mark.property
def test_pipe_gets_plain_aligned_lines(studied: Studied) -> None:
    """One line for each step, the choice marked, numbers aligned; then what follows, in sentences."""
    found = studied(3e-2)
    lines = _shown(found, io.StringIO()).splitlines()
    assert lines[0] == "Made-up drive: what accuracy costs"
    table = lines[2 : 3 + len(found.steps)]
    assert len({line.index("%") for line in table[1:]}) == 1
    assert sum("← tolerance 0.03 picks this" in line for line in table) == 1
    assert "no mesh helps" in table[1]
    assert "reference" in table[-1]
    text = "\n".join(lines)
    assert "Tolerance 0.03 picks level0 with 16 facets per lobe: error 0.4 % measured" in text
    assert re.search(
        r"A tenth of that error \(0\.04 %\) costs 42\.0 s: level0 with 64 facets per lobe\.", text
    )
    assert "wrote out/accuracy.html" in text
    assert "\x1b" not in text


@pytest.mark.property
def test_terminal_says_the_same(studied: Studied, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "100")
    found = studied(3e-2)
    screen = re.sub(r"\x1b\[[0-9;]*m", "", _shown(found, _Terminal()))
    for name in MODEL:
        assert name in screen
    assert "Torsional stiffness" in screen
    assert "wrote out/accuracy.html" in screen


@pytest.mark.property
def test_stream_without_unicode_gets_ascii(studied: Studied) -> None:
    raw = io.BytesIO()
    stream = io.TextIOWrapper(raw, encoding="ascii")
    show(studied(), (), stream)
    stream.flush()
    assert raw.getvalue().decode("ascii").startswith("Made-up drive")


@pytest.mark.property
def test_json_holds_what_scripts_need(studied: Studied) -> None:
    """The keys of accuracy.json; no NaN; errors, seconds and numbers of every step."""
    document = json.loads(to_json(studied(3e-2, oracle=True)))
    keys = "schema program scene tolerance budget level_unit rungs reference steps choice check remarks"
    assert list(document) == keys.split()
    assert (document["schema"], document["tolerance"], document["level_unit"]) == (1, 3e-2, "facets per lobe")
    assert document["reference"]["rung"] == "strips"
    assert [rung["name"] for rung in document["rungs"]] == list(MODEL)
    assert len(document["steps"]) == 1 + 2 * len(LEVELS)
    for step in document["steps"]:
        assert step["seconds"] == pytest.approx(sum(step["stages"].values()))
        assert step["error"] == max(q["error"] for q in step["quantities"].values())
        assert step["quantities"]["torsional_stiffness"]["parts"][""]["unit"] == "N*m/arcmin"
    choice = document["choice"]
    assert (choice["rung"], choice["level"], choice["run_levels"]) == ("level0", 16, [8, 16])
    assert choice["tenth"]["measured"] is True
    assert document["check"]["quantities"]["contact_force_max"]["error"] > 0


@pytest.mark.property
@pytest.mark.parametrize("quantity", [None, "torsional_stiffness", "stress_max"])
def test_picture_has_all_rungs_levels_and_the_tolerance(studied: Studied, quantity: str | None) -> None:
    """Well-formed, a marker for every step, all of it inside the frame; an error of zero is drawn too."""
    found = studied(3e-2)
    root = ElementTree.fromstring(svg(found, quantity))
    space = "{http://www.w3.org/2000/svg}"
    texts = [text.text for text in root.iter(f"{space}text")]
    drawn = {rung for rung in MODEL if quantity != "stress_max" or rung != "springs"}
    assert drawn <= set(texts)
    assert {str(level) for level in LEVELS} <= set(texts)
    assert {"tolerance", "3 %"} <= set(texts)
    steps = [judged for judged in found.steps if quantity is None or quantity in judged.errors]
    circles = list(root.iter(f"{space}circle"))
    assert len(circles) == len(steps) + 1  # and the ring
    width, height = float(root.attrib["width"]), float(root.attrib["height"])
    checked = ElementTree.fromstring(svg(studied(3e-2, oracle=True), quantity))
    assert "one position" in [text.text for text in checked.iter(f"{space}text")]
    assert all(0 < float(c.attrib["cx"]) < width and 0 < float(c.attrib["cy"]) < height for c in circles)


@pytest.mark.property
def test_page_is_self_contained(studied: Studied) -> None:
    """Pictures are in the page, and nothing is fetched."""
    found = studied(3e-2)
    page = render(found)
    assert page.count("<svg") == 4
    assert "Made-up drive" in page
    addresses = set(re.findall(r"https?://[^\"'<\s]+", page))
    assert addresses <= {"http://www.w3.org/2000/svg"}
    assert "<script" not in page


@pytest.mark.property
def test_files_are_written_beside_those_of_a_run(studied: Studied, tmp_path: Path) -> None:
    (tmp_path / "results.json").write_text("a run's")
    files = write(studied(3e-2), tmp_path)
    assert [file.name for file in files] == ["accuracy.json", "accuracy.svg", "accuracy.html"]
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(
        ["results.json", *(file.name for file in files)]
    )
    assert (tmp_path / "results.json").read_text() == "a run's"


@pytest.mark.exact
@pytest.mark.parametrize(
    ("error", "said"),
    [
        (0.41, "41 %"),
        (0.0123, "1.2 %"),
        (1.3e-4, "0.013 %"),
        (1.3e-9, "<0.0001 %"),
        (0.0, "0 %"),
        (None, "–"),
    ],
)
def test_errors_in_percent(error: float | None, said: str) -> None:
    assert percent(error) == said
