"""One small run of the shipped example, for all tests of scripts and pages."""

from __future__ import annotations

from pathlib import Path

import pytest

from trochoid import Run, load, results

EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"
ASKED = ("torsional_stiffness", "contact_force_max", "transmission_error", "stress_max")


@pytest.fixture(scope="session")
def small_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with my-drive.toml and its results in out/my-drive."""
    folder = tmp_path_factory.mktemp("run")
    (folder / "my-drive.toml").write_text(EXAMPLE.read_text())
    coarse = ("ask.positions=4", f"ask.quantities={list(ASKED)}", "accuracy.facets_per_lobe=6")
    outcome = Run(load(folder / "my-drive.toml", coarse)).outcome
    results.write(outcome, folder / "out" / "my-drive")
    return folder
