"""VTU and PVD files, read back by VTK itself (as ParaView does)."""

from __future__ import annotations

import ctypes
import math
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from trochoid.kinematics.errors import TrochoidError
from trochoid.results import Field, Outcome, vtk
from trochoid.view import exaggeration, view

_EXAMPLE = Path(__file__).parents[2] / "examples" / "inspect_vtk.py"


def _can_draw() -> bool:
    try:
        ctypes.CDLL("libEGL.so.1")
    except OSError:
        return not sys.platform.startswith("linux")
    return True


drawing = pytest.mark.skipif(not _can_draw(), reason="off-screen drawing needs libEGL")


@pytest.fixture(scope="module")
def folder(outcome: Outcome, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("fields")
    vtk.save(outcome.films[0], folder)
    return folder


def _reader(folder: Path) -> Any:
    pyvista: Any = import_module("pyvista")
    return pyvista.PVDReader(str(folder / "fields.pvd"))


@pytest.mark.independent
def test_vtk_reads_the_same_arrays(outcome: Outcome, folder: Path) -> None:
    """Points, cells and nodal data of every frame and body, float64, in SI."""
    reader = _reader(folder)
    for index, (angle, bodies) in enumerate(outcome.films[0].frames):
        assert reader.time_values[index] == pytest.approx(math.degrees(angle), abs=1e-9)
        reader.set_active_time_point(index)
        blocks = reader.read()
        assert len(blocks) == len(bodies)
        for block, body in zip(blocks, bodies, strict=True):
            np.testing.assert_array_equal(block.points, body.points)
            np.testing.assert_array_equal(block.cells.reshape(-1, 7)[:, 1:], body.cells.T)
            assert set(block.celltypes) == {22}  # VTK_QUADRATIC_TRIANGLE
            assert block["displacement"].dtype == np.float64
            np.testing.assert_array_equal(block["displacement"][:, :2], body.point_data["displacement"])
            np.testing.assert_array_equal(block["displacement"][:, 2], 0.0)
            np.testing.assert_array_equal(block["stress"][:, :4], body.point_data["stress"])
            np.testing.assert_array_equal(block["stress"][:, 4:], 0.0)
            np.testing.assert_array_equal(block["von_mises"], body.point_data["von_mises"])


@pytest.mark.exact
def test_mid_nodes_bend_the_edges(folder: Path) -> None:
    """Edges that VTK subdivides stay on the circle, to the error of a parabola: no mid node is misplaced."""
    disc = _reader(folder).read()[0]
    surface = disc.extract_surface(nonlinear_subdivision=3, algorithm="dataset_surface")
    edges = surface.extract_feature_edges(boundary_edges=True, feature_edges=False, manifold_edges=False)
    radius = np.linalg.norm(edges.points[:, :2], axis=1)
    inner, outer = 0.025, 0.070
    off = np.minimum(abs(radius - inner), abs(radius - outer))
    angle = 2 * np.pi / 24
    assert off.max() < outer * angle**4 / 128
    assert off.max() < 0.01 * outer * (1 - np.cos(angle / 2))
    area = math.pi * (outer**2 - inner**2)
    assert surface.area == pytest.approx(area, rel=2e-4)


@pytest.mark.exact
def test_plane_points_lie_at_zero_height(tmp_path: Path) -> None:
    """Points of two components get z = 0."""
    import pyvista

    points = np.array([[0.0, 0], [1, 0], [0, 1], [0.5, 0], [0.5, 0.5], [0, 0.5]])
    vtk.save_body(Field("a", points, np.arange(6).reshape(6, 1)), tmp_path / "a.vtu")
    np.testing.assert_array_equal(pyvista.read(tmp_path / "a.vtu").points[:, 2], 0.0)


@pytest.mark.exact
def test_stress_of_three_components_is_refused(tmp_path: Path) -> None:
    """In plane strain zz is not zero, so it must be given."""
    body = Field("a", np.zeros((6, 2)), np.arange(6).reshape(6, 1), {"stress": np.zeros((6, 3))})
    with pytest.raises(ValueError, match="xx yy zz xy"):
        vtk.save_body(body, tmp_path / "a.vtu")


@pytest.mark.exact
def test_only_files_of_ours_are_listed(tmp_path: Path, folder: Path) -> None:
    """Names that lead out of fields/ are not ours to remove."""
    assert [path.name for path in vtk.listed_files(folder / "fields.pvd")] == [
        f"disc_{disc}_{index:03d}.vtu" for disc in (1, 2) for index in range(3)
    ]
    bad = tmp_path / "fields.pvd"
    bad.write_text('<VTKFile><DataSet file="../secret.vtu"/><DataSet file="fields/../x.vtu"/></VTKFile>')
    assert vtk.listed_files(bad) == ()
    bad.write_text("not XML")
    assert vtk.listed_files(bad) == ()
    assert vtk.listed_files(tmp_path / "none.pvd") == ()


@pytest.mark.exact
@pytest.mark.parametrize(
    ("size", "displacement", "factor"),
    [
        (0.2, 2e-5, 200.0),
        (0.2, 1e-5, 200.0),
        (0.2, 4e-5, 100.0),
        (0.2, 1e-5 / 2.5, 1000.0),
        (0.2, 0.0, 1.0),
        (0.2, 1.0, 1.0),
    ],
)
def test_exaggeration_is_a_round_factor(size: float, displacement: float, factor: float) -> None:
    """Largest of 1, 2, 5 times a power of ten that keeps the displacement within 2 % of the size."""
    assert exaggeration(size, displacement) == pytest.approx(factor)


def _colors(picture: Path) -> int:
    from PIL import Image

    return len(np.unique(np.asarray(Image.open(picture).convert("RGB")).reshape(-1, 3), axis=0))


@drawing
@pytest.mark.property
def test_example_draws_the_stress(folder: Path, tmp_path: Path) -> None:
    """examples/inspect_vtk.py, as a user calls it, leaves a picture with a scale of colours."""
    picture = tmp_path / "picture.png"
    command = [sys.executable, str(_EXAMPLE), str(folder), str(picture)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    assert "disc 2: 624 nodes, largest stress" in done.stdout
    assert _colors(picture) > 100


@drawing
@pytest.mark.property
def test_view_saves_a_picture(folder: Path, tmp_path: Path) -> None:
    """A picture with a scale of colours; a process of its own keeps VTK's settings out of this one."""
    picture = tmp_path / "view.png"
    code = "import sys; from trochoid.view import view; view(sys.argv[1], sys.argv[2])"
    done = subprocess.run(
        [sys.executable, "-c", code, str(folder), str(picture)], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    assert _colors(picture) > 100


@pytest.mark.exact
def test_view_without_fields_says_what_to_do(tmp_path: Path) -> None:
    """No fields, one clear sentence."""
    with pytest.raises(TrochoidError, match=r"no films in .*stress_max"):
        view(tmp_path)


@pytest.mark.exact
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the display of Linux")
def test_view_without_display_says_what_to_do(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """VTK would end the process."""
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    with pytest.raises(TrochoidError, match="--screenshot"):
        view(folder)
