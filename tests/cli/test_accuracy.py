"""`trochoid accuracy` as a user meets it."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from trochoid.cli import main

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "cycloid.toml")
SMALL = [
    *("--set", "ask.positions=1", "--budget", "0.001", "--ask", "contact_force_max,ratio"),
    *("--set", "drive.discs=1", "--set", "accuracy.facets_per_lobe=4"),
]
Captured = pytest.CaptureFixture[str]


@pytest.mark.property
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--budget", "0"], "0.0 is not in the range x>0"),
        (["--budget", "soon"], "'soon' is not a valid float range"),
        (["--bugdet", "3"], "No such option"),
        (["--ask", "ratio,mass"], "no model of the contacts stands behind ratio, mass: closed forms have no"),
        (["--set", "effects=[]", "--ask", "contact_force_max"], 'the effect "elastic_contact" is not listed'),
        (["--set", "drive.pins=3"], "--set drive.pins=3: given 3; need a whole number from 4"),
    ],
)
def test_what_is_wrong_is_said(capsys: Captured, tmp_path: Path, arguments: list[str], said: str) -> None:
    """Exit code 2, one clear message on standard error, no output."""
    assert main(["accuracy", EXAMPLE, "--out", str(tmp_path / "out"), *arguments]) == 2
    out, err = capsys.readouterr()
    assert said in err
    assert not out
    assert not (tmp_path / "out").exists()


@pytest.mark.property
def test_drive_that_cannot_be_built_is_refused(capsys: Captured, tmp_path: Path) -> None:
    """Exit code 1 with the reason, as in a run."""
    arguments = ["--set", "drive.bore_radius=60", "--out", str(tmp_path / "out")]
    assert main(["accuracy", EXAMPLE, *arguments]) == 1
    assert "trochoid: " in capsys.readouterr().err


@pytest.mark.property
def test_help_names_the_choices(capsys: Captured) -> None:
    assert main(["accuracy", "--help"]) == 0
    out, _ = capsys.readouterr()
    assert "--budget SECONDS" in out
    assert "--resolved" in out


@pytest.mark.property
def test_study_is_printed_and_written(
    capsys: Captured, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A table in a pipe without progress; files in out/NAME; with --json the same document and no file."""
    monkeypatch.chdir(tmp_path)
    assert main(["accuracy", EXAMPLE, *SMALL]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("Cycloid drive K-H-V 20/19: what accuracy costs\n")
    assert "The scene names level0 with 4 facets per lobe" in out
    assert not err
    folder = tmp_path / "out" / "cycloid"
    assert sorted(path.name for path in folder.iterdir()) == [
        "accuracy.html",
        "accuracy.json",
        "accuracy.svg",
    ]
    written = json.loads((folder / "accuracy.json").read_text())
    (folder / "accuracy.json").unlink()
    assert main(["accuracy", EXAMPLE, *SMALL, "--json"]) == 0
    out, err = capsys.readouterr()
    printed = json.loads(out)
    assert not err
    assert not (folder / "accuracy.json").exists()
    same: Callable[[dict[str, object]], object] = lambda d: (d["scene"], d["reference"], d["level_unit"])  # noqa: E731
    assert same(printed) == same(written)
    assert [step["level"] for step in printed["steps"]] == [None, 3, 3, 4, 4]
