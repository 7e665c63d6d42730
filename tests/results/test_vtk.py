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
from trochoid.results import Field, Film, Outcome, vtk
from trochoid.results.film import Later
from trochoid.results.plot import Axis
from trochoid.view import Wanted, exaggeration, view

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


CORNERS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float32)
FACES = np.array([[0, 0, 0, 1], [2, 1, 3, 2], [1, 3, 2, 3]])


def _space(frames: int = 3) -> Film:
    """A body with stress, one of glass, and a contact, over a phase."""

    def frame(i: int) -> tuple[float, tuple[Field, ...]]:
        up = np.zeros((4, 3), np.float32) + np.array([0, 0, 1e-6 * i], np.float32)
        stress: dict[str, Any] = {
            "von_mises": 1e6 * np.arange(4.0),
            "displacement": up,
            "deformation": 0.5 * up,
        }
        aside = np.array([[1e-3, 0, 0], [-1e-3, 0, 0], [0, 0, 0], [0, 0, 0]])
        touch = {"contact_pressure": np.full(4, 2e9), "from_middle": aside}
        parts = (
            Field("gear", CORNERS, FACES, stress, "triangle"),
            Field("shaft", 1.5 * CORNERS, FACES, {}, "triangle", "#aa0000", 0.5),
            Field("contacts", CORNERS + np.float32(0.3), FACES[:, :1], touch, "triangle"),
        )
        return 0.5 * i, parts[: 3 if i else 2]

    return Film(
        "turns",
        "Gears <in> space",
        Later(lambda: [frame(i) for i in range(frames)]),
        Axis("phase"),
        "contact_pressure",
        True,
        (0.0, -1.0, 0.25),
    )


@pytest.fixture(scope="module")
def turns(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("turns")
    vtk.save(_space(), folder)
    return folder


@pytest.mark.exact
def test_a_film_says_how_to_look_at_it(turns: Path) -> None:
    """Title, axis, what is shown, from where; bodies by name with their looks."""
    found = vtk.listing(turns / "turns.pvd")
    assert (found.title, found.axis, found.units) == ("Gears <in> space", "phase", "")
    assert (found.shown, found.spatial, found.seen_from) == ("contact_pressure", True, (0.0, -1.0, 0.25))
    assert [value for value, _ in found.frames] == [0.0, 0.5, 1.0]
    assert [[body.name for body in bodies] for _, bodies in found.frames] == [
        ["gear", "shaft"],
        *[["gear", "shaft", "contacts"]] * 2,
    ]
    assert (found.frames[0][1][1].color, found.frames[0][1][1].opacity) == ("#aa0000", 0.5)


@pytest.mark.independent
def test_single_precision_is_kept(turns: Path) -> None:
    """VTK reads float32 arrays as such, float64 ones beside them, and the cells as they were given."""
    reader: Any = import_module("pyvista")
    gear = reader.read(turns / "turns" / "gear_002.vtu")
    np.testing.assert_array_equal(gear.points, CORNERS)
    assert gear.points.dtype == gear["displacement"].dtype == np.float32
    assert gear["von_mises"].dtype == np.float64
    np.testing.assert_array_equal(gear.cells.reshape(-1, 4)[:, 1:], FACES.T)
    np.testing.assert_array_equal(gear["displacement"][:, 2], np.float32(2e-6))


@pytest.mark.exact
def test_frames_are_made_when_looked_at() -> None:
    """Once, and not before."""
    calls = []
    later = Later(lambda: calls.append(1) or _space().frames)  # type: ignore[func-returns-value]
    assert not calls
    assert len(later) == 3
    assert later[1][0] == 0.5
    assert len(calls) == 1


@pytest.mark.exact
def test_earlier_collections_are_still_read(tmp_path: Path) -> None:
    """Those before films had axes and looks."""
    (tmp_path / "fields.pvd").write_text(
        '<VTKFile type="Collection"><Collection><DataSet timestep="5" part="0" file="fields/disc_1_000.vtu"/>'
        "</Collection></VTKFile>"
    )
    found = vtk.listing(tmp_path / "fields.pvd")
    assert (found.axis, found.units, found.spatial) == ("input angle", "deg", False)
    assert found.frames[0][1][0].name == "disc 1"
    (tmp_path / "other.pvd").write_text("<VTKFile/>")
    with pytest.raises(ValueError, match="no film"):
        vtk.listing(tmp_path / "other.pvd")


@pytest.mark.exact
@pytest.mark.parametrize(
    ("wanted", "said"),
    [
        (Wanted("turn"), r'no film "turn".*\n  turns: Gears <in> space'),
        (Wanted(frame=3), r"--frame 3: the film has 3 frame\(s\); take 0 to 2"),
        (Wanted(frame=-1), "--frame -1"),
        (Wanted(at=1.2), r"--at 1\.2: the film's phase goes from 0 to 1$"),
        (Wanted(frame=1, at=0.5), "not both"),
    ],
)
def test_what_is_not_there_is_said(turns: Path, wanted: Wanted, said: str) -> None:
    """Films by name, frames by number and value."""
    with pytest.raises(TrochoidError, match=said):
        view(turns, wanted=wanted)


@drawing
@pytest.mark.property
def test_view_of_bodies_in_space(turns: Path, tmp_path: Path) -> None:
    """The command saves a picture with two scales of colours and a movie of all frames, and says what it shows."""
    picture, movie = tmp_path / "turns.png", tmp_path / "turns.gif"
    command = ["view", str(turns), "--at", "0.4", "--screenshot", str(picture), "--movie", str(movie)]
    done = subprocess.run(
        [sys.executable, "-m", "trochoid", *command], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout == "turns: Gears <in> space, phase 0.5\n"
    assert _colors(picture) > 100
    from PIL import Image

    assert getattr(Image.open(movie), "n_frames", 1) == 3


@drawing
@pytest.mark.property
def test_view_refuses_what_it_cannot_show_or_write(turns: Path, tmp_path: Path) -> None:
    """Point data that no body has; an animation that is no GIF."""
    for option, said in (
        (["--show", "stress"], "contact_pressure, deformation, displacement, von_mises"),
        (["--movie", str(tmp_path / "a.mp4")], "only .gif is written"),
    ):
        command = ["view", str(turns), "--screenshot", str(tmp_path / "a.png"), *option]
        done = subprocess.run(
            [sys.executable, "-m", "trochoid", *command], capture_output=True, text=True, timeout=120
        )
        assert done.returncode != 0
        assert said in done.stderr
        assert "Traceback" not in done.stderr


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
