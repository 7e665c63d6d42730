"""The fields of a run in three dimensions: von Mises stress on the deformed bodies."""

from __future__ import annotations

import ctypes
import math
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.results.vtk import ENDING, listed_files

Body: TypeAlias = Any  # pyvista's grids and plotters; its decorators hide their types
Plotter: TypeAlias = Any

_VISIBLE = 0.02  # largest displacement as a share of a body's size, once exaggerated
_SHOWN = 0.995  # share of the area whose stress the colours reach: at the contacts it is far above the rest
_STRESS = "von Mises stress (MPa)"
_INK = "#1f2933"


def view(folder: Path, screenshot: Path | None = None) -> None:
    """Open the fields in `folder` in a window, one view per body, or save a picture of the first frame.

    Raises TrochoidError when there are no fields, nothing to draw on, or the picture cannot be written.
    """
    collection = _collection(Path(folder))
    _choose_window(screenshot)
    import pyvista as library

    pyvista: Any = library
    reader = pyvista.PVDReader(str(collection))
    times = list(reader.time_values)
    bodies = _read(reader, times[0])
    size = [max(900, 700 * len(bodies)), 760]
    off = screenshot is not None
    plotter = pyvista.Plotter(off_screen=off, shape=(1, len(bodies)), window_size=size, border=False)
    plotter.set_background("white", all_renderers=True)
    _draw(plotter, bodies)
    plotter.link_views()
    if screenshot is not None:
        _save(plotter, screenshot)
        return
    if len(times) > 1:
        _add_slider(plotter, reader, times)
    plotter.show()


def exaggeration(size: float, displacement: float) -> float:
    """Return the factor, 1, 2 or 5 times a power of ten, that makes `displacement` visible; 1 at least."""
    if not displacement > 0.0 or not size > 0.0:
        return 1.0
    wanted = _VISIBLE * size / displacement
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(1.0, max(step * power for step in (1, 2, 5) if step * power <= wanted * (1 + 1e-12)))


def _collection(folder: Path) -> Path:
    if not folder.is_dir():
        raise TrochoidError(f"no folder {folder}; give the one that a run wrote, such as out/cycloid")
    films = [path for path in sorted(folder.glob(f"*{ENDING}")) if listed_files(path)]
    if not films:
        raise TrochoidError(
            f"no films in {folder}: bodies in space are written for stress_max, where the drive offers it; all other "
            "pictures are in report.html"
        )
    return films[0]


def _choose_window(screenshot: Path | None) -> None:
    """See to it that VTK finds something to draw on; where it does not, it would end the process."""
    shown = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    if not sys.platform.startswith("linux") or shown:
        return
    if screenshot is None:
        raise TrochoidError("there is no display to open a window on: use --screenshot FILE.png")
    try:
        ctypes.CDLL("libEGL.so.1")
    except OSError as error:
        raise TrochoidError(
            "drawing without a display needs libEGL: install it (Debian, Ubuntu: apt install libegl1)"
        ) from error
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")


def _read(reader: Any, time: float) -> list[Body]:
    """Return the bodies of the frame nearest to `time`."""
    reader.set_active_time_value(min(reader.time_values, key=lambda known: abs(known - time)))
    return [block for block in reader.read() if block is not None]


def _draw(plotter: Plotter, bodies: Sequence[Body]) -> None:
    """Put each body into its view, all of them deformed by one factor and coloured over one range."""
    lengths = (np.linalg.norm(b["displacement"], axis=1) for b in bodies if "displacement" in b.point_data)
    moved = max((float(length.max()) for length in lengths), default=0.0)
    factor = exaggeration(max(body.length for body in bodies), moved)
    stressed = [body for body in bodies if "von_mises" in body.point_data]
    limits = [0.0, 1e-6 * _reached(stressed, _SHOWN)] if stressed else None
    for index, body in enumerate(bodies):
        plotter.subplot(0, index)
        _add(plotter, body, factor, limits)
        plotter.view_xy()
        plotter.camera.zoom(1.05)


def _reached(bodies: Sequence[Body], share: float) -> float:
    """Return the von Mises stress in Pa that this share of the bodies' area stays below."""
    area = np.concatenate([body.compute_cell_sizes(length=False, volume=False)["Area"] for body in bodies])
    stress = np.concatenate([body.point_data_to_cell_data()["von_mises"] for body in bodies])
    order = np.argsort(stress)
    filled = np.cumsum(area[order])
    return float(stress[order][np.searchsorted(filled, share * filled[-1])])


def _add(plotter: Plotter, body: Body, factor: float, limits: list[float] | None) -> None:
    """Add one body in mm and MPa; its quadratic edges are subdivided, so that they are drawn curved."""
    moved = "displacement" in body.point_data
    shape = body.warp_by_vector("displacement", factor=factor) if moved else body
    surface = shape.extract_surface(nonlinear_subdivision=3, algorithm="dataset_surface").scale(1e3)
    caption = f"displacement x {factor:g}" if moved else "not deformed"
    look: dict[str, Any] = {"color": "lightsteelblue"}
    if "von_mises" in body.point_data:
        surface[_STRESS] = surface["von_mises"] * 1e-6
        caption += f"\nlargest stress {body['von_mises'].max() * 1e-6:.0f} MPa"
        bar = {"title": f"{_STRESS}\n", "color": _INK, "fmt": "%.0f", "width": 0.7, "position_x": 0.15}
        bar |= {"title_font_size": 16, "label_font_size": 14}
        look = {"scalars": _STRESS, "clim": limits, "cmap": "viridis", "scalar_bar_args": bar}
    plotter.add_mesh(surface, name="body", lighting=False, **look)
    plotter.add_text(caption, name="caption", position="upper_left", font_size=9, color=_INK)


def _add_slider(plotter: Plotter, reader: Any, times: Sequence[float]) -> None:
    look = {"title": "input angle (deg)", "style": "modern", "color": _INK}
    ends = {"pointa": (0.05, 0.9), "pointb": (0.55, 0.9)}
    plotter.subplot(0, 0)
    plotter.add_slider_widget(
        lambda time: _draw(plotter, _read(reader, time)), [times[0], times[-1]], **look, **ends
    )


def _save(plotter: Plotter, screenshot: Path) -> None:
    try:
        plotter.screenshot(str(screenshot))
    except (OSError, ValueError) as error:
        raise TrochoidError(
            f"cannot write the picture {screenshot}: {error}; give a .png in a folder that you may write to"
        ) from error
    finally:
        plotter.close()
