"""The command line as a user meets it: what it prints, where, and with which exit code."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import trochoid
from trochoid.cli import main
from trochoid.kinematics.errors import Infeasible, NotConverged, SceneError
from trochoid.results import Outcome, Quantity
from trochoid.run import Run, plan

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "cycloid.toml")
Captured = pytest.CaptureFixture[str]


def stand_in(monkeypatch: pytest.MonkeyPatch, outcome: Callable[[], Any]) -> None:
    """Let the outcome of a run be what `outcome` does."""
    monkeypatch.setattr(Run, "outcome", property(lambda run: outcome()))


def raising(error: BaseException) -> Callable[[], Any]:
    def raise_it() -> Any:
        raise error

    return raise_it


@pytest.mark.property
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--help"], "trochoid run scene.toml"),
        (["run", "--help"], "--ask Q1,Q2"),
        (["check", "-h"], "solve nothing"),
        (["--version"], "trochoid "),
    ],
)
def test_help_is_on_standard_output(capsys: Captured, arguments: list[str], said: str) -> None:
    """Help and version are answers: exit code 0, at most 25 lines."""
    assert main(arguments) == 0
    out, err = capsys.readouterr()
    assert said in out
    assert not err
    assert len(out.splitlines()) <= 25


@pytest.mark.property
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["frobnicate"], "No such command 'frobnicate'"),
        (["run"], "Missing argument 'SCENE'"),
        (["run", EXAMPLE, "--otu", "x"], "No such option"),
        (["new", "worm"], 'no drive of kind "worm"; this version knows "khv"'),
        (["check", "nowhere.toml"], "nowhere.toml: no such file; `trochoid new khv > scene.toml`"),
        (["run", EXAMPLE, "--set", "drive.pins"], "--set drive.pins: need KEY=VALUE"),
        (
            ["run", EXAMPLE, "--set", "drive.pins=3"],
            "--set drive.pins=3: given 3; need a whole number from 4",
        ),
        (
            ["run", EXAMPLE, "--ask", "ratio,rato"],
            '--ask ratio,rato: ask.quantities.1: unknown quantity "rato"',
        ),
        (
            ["run", EXAMPLE, "--ask", ""],
            "--ask : ask.quantities: an empty list; need at least one of ratio, ",
        ),
    ],
)
def test_wrong_command_or_scene_is_2(capsys: Captured, arguments: list[str], said: str) -> None:
    """Contract: exit code 2, the message on standard error, nothing on standard output."""
    assert main(arguments) == 2
    out, err = capsys.readouterr()
    assert said in err
    assert not out
    assert "Traceback" not in err


@pytest.mark.property
def test_new_prints_a_scene_that_loads(capsys: Captured, tmp_path: Path) -> None:
    """`trochoid new khv > scene.toml` gives a file that `load` takes."""
    assert main(["new", "khv"]) == 0
    out, _ = capsys.readouterr()
    assert tomllib.loads(out)["drive"]["type"] == "khv"
    (tmp_path / "scene.toml").write_text(out, encoding="ascii")
    assert trochoid.load(tmp_path / "scene.toml").drive.pins == 20


@pytest.mark.property
@pytest.mark.parametrize(
    ("error", "code", "said"),
    [
        (NotConverged("contact at 12 deg: 50 iterations; try more facets"), 1, "trochoid: contact at 12 deg"),
        (Infeasible("pins overlap\nholes overlap"), 1, "trochoid: pins overlap\ntrochoid: holes overlap\n"),
        (
            Infeasible("pin_radius 15 mm undercuts; at most 14.2 mm"),
            1,
            "trochoid: pin_radius 15 mm undercuts",
        ),
        (SceneError("s.toml:3: drive.pins: wrong"), 2, "s.toml:3: drive.pins: wrong"),
        (KeyboardInterrupt(), 1, "trochoid: interrupted; previous results are untouched"),
        (MemoryError(), 1, "trochoid: out of memory"),
        (BrokenPipeError(), 1, ""),
    ],
)
def test_failed_run_is_one_line(
    capsys: Captured,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    error: BaseException,
    code: int,
    said: str,
) -> None:
    """Contract: 1 for a job that failed, 2 for a scene; one line, no traceback, previous results whole."""
    (tmp_path / "results.json").write_text("old")
    stand_in(monkeypatch, raising(error))
    assert main(["run", EXAMPLE, "--out", str(tmp_path)]) == code
    out, err = capsys.readouterr()
    assert err.startswith(said)
    assert err.count("\n") == (str(error).count("\n") + 1 if said else 0)
    assert not out
    assert [path.name for path in tmp_path.iterdir()] == ["results.json"]
    assert (tmp_path / "results.json").read_text() == "old"


@pytest.mark.property
def test_defect_is_no_traceback(capsys: Captured, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """An error that nobody foresaw: one line, exit code 1, the traceback in a file that is named."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    stand_in(monkeypatch, raising(ZeroDivisionError("division by zero")))
    assert main(["run", EXAMPLE, "--out", str(tmp_path / "out")]) == 1
    _, err = capsys.readouterr()
    (report,) = tmp_path.glob("trochoid-*.txt")
    assert err == (
        "trochoid: a defect of the program (ZeroDivisionError: division by zero); please report it with "
        f"{report}\n"
    )
    assert "Traceback" in report.read_text()


@pytest.mark.property
def test_json_alone_writes_no_files(
    capsys: Captured, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """--json prints results.json and nothing else; a folder is written only when --out names one."""
    stand_in(monkeypatch, lambda: Outcome(scene={}, quantities={"ratio": Quantity(-19.0)}))
    monkeypatch.chdir(tmp_path)
    assert main(["run", EXAMPLE, "--json"]) == 0
    out, err = capsys.readouterr()
    assert json.loads(out)["quantities"]["ratio"]["value"] == -19.0
    assert not err
    assert not list(tmp_path.iterdir())
    assert main(["run", EXAMPLE, "--json", "--out", "here"]) == 0
    assert capsys.readouterr().out == (tmp_path / "here" / "results.json").read_text()
    assert main(["run", EXAMPLE]) == 0
    assert "ratio" in capsys.readouterr().out
    assert (tmp_path / "out" / "cycloid" / "report.html").is_file()


@pytest.mark.property
def test_plan_is_readable(capsys: Captured) -> None:
    """`check` prints quantities, effects and model, each stage with its cost or a dash, and the sum."""
    assert main(["check", EXAMPLE, "--ask", "ratio"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[:2] == [f"{EXAMPLE} is valid", "quantities  ratio"]
    assert lines[2].startswith("effects     elastic_contact, pin_compliance, ")
    start = next(i for i, line in enumerate(lines) if line.startswith("stage "))
    stages = {line.split()[0]: line.split()[1:3] for line in lines[start + 1 : -2]}
    planned = plan(trochoid.load(EXAMPLE, ["ask.quantities=['ratio']"])).stages
    assert list(stages) == [stage.name for stage in planned]
    assert [name for name, cost in stages.items() if cost != ["-", "-"]] == [
        s.name for s in planned if s.needed
    ]
    assert lines[-1].startswith("about ")


@pytest.mark.property
def test_ratio_is_light(tmp_path: Path) -> None:
    """`run --ask ratio` computes it, writes its files and imports neither solver, mesher nor plotting."""
    program = f"""if True:
        import sys
        from trochoid.cli import main
        code = main(["run", {EXAMPLE!r}, "--ask", "ratio", "--out", {str(tmp_path)!r}])
        heavy = "scipy gmsh skfem pyvista pint plotly xarray meshio matplotlib pandas cvxopt".split()
        print(code, [name for name in heavy if name in sys.modules])"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "0 []"
    assert not done.stderr
    results = json.loads((tmp_path / "results.json").read_text())
    assert results["quantities"]["ratio"]["value"] == -19.0
    assert results["scene"]["drive"]["pin_radius"] == 0.005


@pytest.mark.property
def test_closed_pipe_is_quiet() -> None:
    """A reader that leaves early (`trochoid new khv | head -1`) sees no complaint."""
    program = "import sys; from trochoid.cli import main; sys.exit(main(['new', 'khv']))"
    reader, writer = os.pipe()
    os.close(reader)
    try:
        done = subprocess.run(
            [sys.executable, "-c", program], stdout=writer, stderr=subprocess.PIPE, timeout=60
        )
    finally:
        os.close(writer)
    assert done.stderr == b""
    assert done.returncode == 1


@pytest.mark.property
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
def test_full_disk_is_one_line() -> None:
    """What cannot be printed is an error that names the reason."""
    program = "import sys; from trochoid.cli import main; sys.exit(main(['new', 'khv']))"
    with open("/dev/full", "w") as full:
        done = subprocess.run([sys.executable, "-c", program], stdout=full, stderr=subprocess.PIPE, text=True)
    assert (done.returncode, done.stderr) == (1, "trochoid: No space left on device\n")


@pytest.mark.property
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signal_ends_a_run_with_one_line(tmp_path: Path, number: signal.Signals) -> None:
    """Ctrl-C and a termination signal: one line, exit code 1, no files left behind."""
    program = f"""if True:
        import signal, sys, time
        signal.signal(signal.SIGINT, signal.default_int_handler)  # tests in the background inherit its being ignored
        from trochoid.cli import main
        from trochoid.run import Run
        def outcome(run):
            print("running", flush=True)
            time.sleep(60)
        Run.outcome = property(outcome)
        sys.exit(main(["run", {EXAMPLE!r}, "--out", {str(tmp_path / "out")!r}]))"""
    process = subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "running\n"
    process.send_signal(number)
    _, err = process.communicate(timeout=30)
    assert err == "trochoid: interrupted; previous results are untouched\n"
    assert process.returncode == 1
    assert not list(tmp_path.iterdir())
