"""What README and docs refer to exists, and the Python that they show runs."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from trochoid.scene.effects import EFFECTS
from trochoid.scene.needs import KINDS, NEEDS

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


@pytest.mark.property
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    """Every relative link of a page is a file or folder."""
    targets = re.findall(r"\]\(([^)#]+)\)", page.read_text())
    missing = [t for t in targets if "://" not in t and not (page.parent / t).exists()]
    assert not missing


@pytest.mark.property
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_tests_that_are_named_exist(page: Path) -> None:
    """Tables of verification name a test as `tests/folder/test_file.py::test_name`."""
    named = re.findall(r"`(tests/[\w/]+\.py)(?:::(\w+))?`", page.read_text())
    missing = [
        (file, name)
        for file, name in named
        if not (ROOT / file).is_file() or (name and f"def {name}(" not in (ROOT / file).read_text())
    ]
    assert not missing


def rows(page: str) -> dict[str, str]:
    """Return each name in the first column of a page's tables with its row."""
    lines = [line for line in (ROOT / "docs" / page).read_text().splitlines() if line.startswith("| `")]
    return {name: line for line in lines for name in re.findall(r"`(\w+)`", line.split("|")[1])}


@pytest.mark.property
def test_scene_page_names_every_effect_and_kind() -> None:
    """The tables of docs/scene.md are complete."""
    assert {*EFFECTS, *KINDS} <= rows("scene.md").keys()


@pytest.mark.property
@pytest.mark.parametrize("kind", KINDS)
def test_page_of_a_drive_names_every_quantity(kind: str) -> None:
    """The tables of docs/drives/KIND.md are complete, and name the effects that a quantity needs and no others."""
    found = rows(f"drives/{kind}.md")
    for quantity, effects in NEEDS[kind].items():
        needs = found[quantity].rsplit("|", 2)[1]
        assert set(re.findall(r"`(\w+)`", needs)) == set(effects), quantity


@pytest.mark.property
def test_python_of_the_results_page_runs(small_run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The snippets of docs/results.md, one after the other, on a small run."""
    monkeypatch.chdir(small_run)
    page = (ROOT / "docs" / "results.md").read_text()
    page = page.replace('"ask.positions=120"', '"ask.positions=2", "accuracy.facets_per_lobe=6"')
    snippets = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(snippets) == 3
    for snippet in snippets:
        exec(compile(snippet, "docs/results.md", "exec"), {})
