"""`trochoid export`: endings that a kind offers, and what it says to others."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from trochoid.cli import main
from trochoid.kinematics.cycloid import Cycloid
from trochoid.scene import load

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.property
@pytest.mark.parametrize("kind", ["cycloid", "planetary", "precessional", "rv", "indexer"])
def test_profiles_as_points(kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Every kind writes .csv: finite numbers under names with units; nothing else is left in the folder."""
    path = tmp_path / "profile.csv"
    assert main(["export", str(EXAMPLES / f"{kind}.toml"), "--to", str(path)]) == 0
    assert f"wrote {path}" in capsys.readouterr().out
    names, *rows = path.read_text(encoding="utf-8").splitlines()
    assert len(rows) > 30
    assert "[m]" in names or "profile_x" in names
    assert np.isfinite([float(x) for row in rows for x in row.split(",") if x]).all()
    assert [p.name for p in path.parent.iterdir()] == ["profile.csv"]


@pytest.mark.exact
def test_points_are_the_flank(tmp_path: Path) -> None:
    """The cycloid's points lie on it."""
    path = tmp_path / "flank.csv"
    scene = EXAMPLES / "cycloid.toml"
    assert main(["export", str(scene), "--to", str(path)]) == 0
    d = load(scene).drive
    flank = Cycloid(d.pins, d.lobes, d.pin_circle_radius, d.pin_radius, d.eccentricity)
    t, x, y = np.loadtxt(path, delimiter=",", skiprows=1, usecols=(0, 1, 2)).T
    assert np.stack([x, y], axis=1) == pytest.approx(flank.point(t), abs=1e-15)


@pytest.mark.property
def test_endings_that_are_not_offered(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Exit code 2, and what the kind offers; a rim that cannot be made is exit code 1 with the reason."""
    scene = str(EXAMPLES / "precessional.toml")
    assert main(["export", scene, "--to", str(tmp_path / "rim.dxf")]) == 2
    assert ".step (the toothed rim as a solid)" in capsys.readouterr().err
    assert main(["export", str(EXAMPLES / "rv.toml"), "--to", str(tmp_path / "disc.step")]) == 2
    assert "the kind rv offers .csv" in capsys.readouterr().err
    undercut = ["--set", "drive.teeth.pin_angle=9"]
    assert main(["export", scene, "--to", str(tmp_path / "rim.step"), *undercut]) == 1
    assert "undercut" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.property
def test_solids(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """A STEP file of rim and wheel, and one line on the terminal: OpenCASCADE's own words stay away."""
    for kind in ("precessional", "indexer"):
        path = tmp_path / f"{kind}.step"
        assert main(["export", str(EXAMPLES / f"{kind}.toml"), "--to", str(path)]) == 0
        assert path.read_text(encoding="utf-8").startswith("ISO-10303-21;")
        out, err = capfd.readouterr()
        assert len(out.splitlines()) == 1
        assert not err


@pytest.mark.property
@pytest.mark.parametrize(
    ("target", "said"),
    [
        ("a", "the name has no ending; the kind khv offers .csv"),
        ("no/a.csv", "there is no folder"),
        ("", "is empty"),
    ],
)
def test_targets_that_are_no_files(
    target: str,
    said: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A name without an ending, in a folder that is not there, or none: said, and nothing is made."""
    monkeypatch.chdir(tmp_path)
    assert main(["export", str(EXAMPLES / "cycloid.toml"), "--to", target]) == 2
    assert said in capsys.readouterr().err
    assert main(["run", str(EXAMPLES / "cycloid.toml"), "--ask", "ratio", "--out", ""]) == 2
    assert "is empty; give a name" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
