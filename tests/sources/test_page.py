"""The page of the sources: not stale, complete, and every test that it names is there."""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from trochoid.sources import planetary_table
from trochoid.sources.book import SOURCES, Chapter, chapters, summary
from trochoid.sources.page import markdown
from trochoid.sources.report import render

ROOT = Path(__file__).parents[2]
ENVIRONMENT = {**os.environ, "PYTHONIOENCODING": "utf-8"}


@pytest.fixture(scope="module")
def made() -> tuple[Chapter, ...]:
    """Return all sources, computed once for this file."""
    return chapters()


@cache
def names_in(file: str) -> frozenset[str]:
    """Names of the test functions of a file."""
    tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
    return frozenset(node.name for node in tree.body if isinstance(node, ast.FunctionDef))


@pytest.mark.regression
def test_page_is_what_would_be_written_today(made: tuple[Chapter, ...]) -> None:
    """docs/sources.md is written by `python examples/sources.py --docs`; run it when this fails."""
    page = (ROOT / "docs" / "sources.md").read_text(encoding="utf-8")
    assert markdown(made).splitlines() == page.splitlines()


@pytest.mark.published
def test_every_verdict_is_explained(made: tuple[Chapter, ...]) -> None:
    """What differs has a reason, and nothing that has one is reproduced after all."""
    faults = [
        (c.source.number, each.row.what, each.verdict)
        for c in made
        for each in c.rows
        if each.state == "unexplained"
    ]
    assert not faults


@pytest.mark.property
def test_every_row_names_a_test_or_why_it_has_none(made: tuple[Chapter, ...]) -> None:
    """A computed number has a test; one that is not computed has a reason."""
    for chapter in made:
        for each in chapter.rows:
            assert each.row.test if each.row.computed else each.row.reason, each.row.what


@pytest.mark.property
def test_every_test_exists() -> None:
    """All ids of rows, errata and prose are functions of their files."""
    prose = " ".join([text for s in SOURCES for text in (s.intro, *s.remarks)])
    named = [row.test for s in SOURCES for row in s.rows if row.test]
    named += [erratum.test for s in SOURCES for erratum in s.errata]
    named += re.findall(r"`(tests/[\w/]+\.py::\w+)`", prose)
    missing = [each for each in named if each.partition("::")[2] not in names_in(each.partition("::")[0])]
    assert not missing


@pytest.mark.property
def test_every_test_of_the_sources_stands_on_the_page() -> None:
    """No number or erratum has a test in tests/published and no line on the page."""
    page = markdown(())  # the prose alone
    for source in SOURCES:
        page += " ".join([source.intro, *source.remarks, *(e.test for e in source.errata)])
        page += " ".join(row.test for row in source.rows)
    for file in sorted((ROOT / "tests" / "published").glob("test_*.py")):
        names = {n for n in names_in(f"tests/published/{file.name}") if n.startswith("test_")}
        assert not sorted(n for n in names - NOT_ON_THE_PAGE if n not in page), file.name


# further checks of lines that are there, or of the program's own parts
NOT_ON_THE_PAGE = {
    "test_largest_pin_force_of_the_hand_calculation",
    "test_like_discs_fit_their_rollers",
    "test_members_of_the_flank_pair_are_where_the_drive_puts_them",
    "test_modified_flank_loads_fewer_pins",
    "test_peak_of_another_program",
    "test_printed_model_is_what_the_paper_has",
    "test_ratio_of_the_textbook",
    "test_table_1_has_65_numbers",
}


@pytest.mark.published
def test_table_1_is_whole() -> None:
    """All 65 numbers of Table 1 of §4 are on the page."""
    assert sum(len(row.published) for row in planetary_table.ROWS) == 65


@pytest.mark.property
def test_summary_adds_up(made: tuple[Chapter, ...]) -> None:
    """Every printed number is counted once, and nearly all errata have both forms computed."""
    _, *rows = summary(made)
    for row in rows:
        total, *parts = (int(cell) for cell in row[1:5])
        assert sum(parts) == total
    assert int(rows[-1][5]) == sum(len(s.errata) for s in SOURCES)
    for chapter in made:
        for each in chapter.errata:
            assert not each.printed or each.printed != each.right, each.erratum.printed


@pytest.mark.property
def test_report_is_one_file_and_has_every_line(made: tuple[Chapter, ...]) -> None:
    """No address of another machine, no script, a table row for each number and each erratum."""
    page = render(made)
    assert not re.search(r"(src|href)=\"(?!#)", page)
    assert "<script" not in page
    lines = sum(len(s.rows) + len(s.errata) for s in SOURCES)
    assert page.count("<tr") == lines + 2 * len(SOURCES) + len(summary(made))


@pytest.mark.property
def test_script_writes_the_report(tmp_path: Path) -> None:
    """`python examples/sources.py --out DIR` writes report.html and prints the summary."""
    command = [sys.executable, str(ROOT / "examples" / "sources.py"), "--out", str(tmp_path / "made")]
    done = subprocess.run(
        command, check=True, capture_output=True, text=True, encoding="utf-8", env=ENVIRONMENT
    )
    assert (tmp_path / "made" / "report.html").read_text(encoding="utf-8").startswith("<!doctype html>")
    assert len(done.stdout.splitlines()) == len(SOURCES) + 3
