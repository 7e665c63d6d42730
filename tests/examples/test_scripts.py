"""The example scripts run as they are, and what they print and write agrees with the library."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import meshio
import numpy as np
import pytest

from trochoid.kinematics.cycloid import Cycloid, Modification, gap
from trochoid.kinematics.types import Array

EXAMPLES = Path(__file__).parents[2] / "examples"
FLANK = Cycloid(20, 19, 80e-3, 5e-3, 2.5e-3)
CRANK = np.radians(10)


def script(name: str, *words: object) -> str:
    """Run a script in a process of its own and return what it printed."""
    command = [sys.executable, str(EXAMPLES / name), *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@dataclass(frozen=True)
class Solved:
    """What mesh_and_solve.py prints, rotation in rad and pin forces (20,) in N, and the file that it writes."""

    rotation: float
    force: Array
    file: meshio.Mesh

    @property
    def parameter(self) -> Array:
        """Flank parameters (20,) nearest to the pins, in the disc's turned frame."""
        angle = self.rotation - CRANK / 19
        pin = 0.08 * np.exp(2j * np.pi * np.arange(20) / 20)
        local = (pin - 2.5e-3 * np.exp(1j * CRANK)) * np.exp(-1j * angle)
        start = FLANK.contact_parameter(np.arange(20), CRANK)
        return gap(FLANK, Modification(), np.stack([local.real, local.imag], axis=-1), start)[1]


@pytest.fixture(scope="module")
def solved(tmp_path_factory: pytest.TempPathFactory) -> Solved:
    """One run of mesh_and_solve.py."""
    file = tmp_path_factory.mktemp("script") / "disc.vtu"
    numbers = [float(word) for word in re.findall(r"-?\d+\.\d+", script("mesh_and_solve.py", file))]
    return Solved(1e-6 * numbers[0], np.array(numbers[1:]), meshio.read(file))


@pytest.mark.exact
def test_pin_forces_carry_the_torque(solved: Solved) -> None:
    """Σ F·lever of the exact profile is the torque of 200 N·m, as far as forces are printed (0.005 N each)."""
    lever, touching = FLANK.lever(solved.parameter), solved.force > 0
    assert solved.force @ lever == pytest.approx(200.0, abs=0.005 * np.abs(lever).sum())
    assert 5 < touching.sum() <= 10
    assert (lever[touching] > 0).all()


@pytest.mark.exact
def test_stress_below_the_hardest_contact(solved: Solved) -> None:
    """Hertz: p0 = √(F E'/(π b R)) on rigid pins, 0.5577 p0 of it below the surface (ν = 0.3); the rest adds little."""
    bend = FLANK.curvature(solved.parameter) + 1 / FLANK.pin_radius
    pressure = np.sqrt(solved.force * 210e9 / (1 - 0.3**2) * bend / (np.pi * 10e-3))
    largest = solved.file.point_data["von_mises"].max()
    assert largest == pytest.approx(0.5577 * pressure.max(), rel=0.03)


@pytest.mark.property
def test_file_holds_the_deformed_disc(solved: Solved) -> None:
    """Quadratic triangles whose nodes on the bore, which is held, do not move; the flank does."""
    mesh = solved.file
    assert set(mesh.cells_dict) == {"triangle6"}
    moved = np.linalg.norm(mesh.point_data["displacement"], axis=1)
    radius = np.linalg.norm(mesh.points, axis=1)
    bore = np.abs(radius - 25e-3) < 1e-9
    assert bore.sum() > 50
    assert moved[bore].max() == 0.0
    assert 1e-6 < moved.max() < 1e-4


@pytest.mark.property
def test_picture_of_a_run(small_run: Path, tmp_path: Path) -> None:
    """inspect_vtk.py reads what a run wrote: the stress it prints is that of results.json, and it draws a picture."""
    folder = small_run / "out" / "my-drive"
    printed = script("inspect_vtk.py", folder, tmp_path / "discs.png")
    stresses = [float(value) for value in re.findall(r"largest stress ([\d.]+) MPa", printed)]
    found = json.loads((folder / "results.json").read_text())["quantities"]["stress_max"]["parts"]
    assert len(stresses) == 2
    assert max(stresses) == pytest.approx(found["von_mises"]["stress"]["value"], abs=0.06)
    assert (tmp_path / "discs.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.property
def test_stiffness_study(tmp_path: Path) -> None:
    """stiffness_aware_reactions.py: the rigid limit is reached with stiff joints and left at a resonance."""
    printed = script("stiffness_aware_reactions.py", tmp_path / "study.svg", "--points", 5)
    soft, stiff = (float(x) for x in re.findall(r"([\d.e-]+) N with the (?:softest|stiffest)[ ,b]", printed))
    assert soft > 20.0 * stiff
    peak, last, rigid = (float(x) for x in re.findall(r"(?:up to|^ |rigid) +([\d.]+) N", printed, re.M)[-3:])
    assert rigid == pytest.approx(121.19, abs=5e-3)  # largest R_A of sources §2
    assert last == pytest.approx(rigid, rel=1e-4)
    assert peak > 2.0 * rigid
    assert (tmp_path / "study.svg").read_text().count("<path") > 50
