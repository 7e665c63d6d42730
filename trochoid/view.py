"""The films of a run in three dimensions: a window with a slider, a picture, or an animation."""

from __future__ import annotations

import ctypes
import math
import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.results.vtk import ENDING, Listed, Listing, listed_files, listing
from trochoid.view_look import EDGES, Look, add_body, chosen_look, exaggeration

__all__ = ["Wanted", "exaggeration", "view"]

Plotter: TypeAlias = Any  # pyvista's; its decorators hide their types

SCALE = 2  # how much larger pictures in space are drawn than kept, against jagged edges (passes that smooth undo glass)
LIGHTS = (((0.0, 0.0, 1.0), 0.45), ((-0.6, 0.8, 1.0), 0.45))  # from the eye's side: place and brightness
FILLED = (0.94, 0.76)  # of the window's width and height by what is shown
ENOUGH = 400  # nodes of a body, evenly among all, tell how large it is
LOW = -0.02  # of half a window's height: room for the colour bars
MOVIE_STEP, MOVIE_COLORS, MOVIE_WIDTH = 120, 128, 640  # ms from frame to frame; colours and width of a frame
_INK = "#1f2933"


@dataclass(frozen=True, slots=True)
class Wanted:
    """What to show: the `film` by name, the first of them by default; its `frame` counted from 0, or the one nearest
    `at` a value of its axis; the point data `shown` in place of the film's own; where to put a picture or a movie.
    """

    film: str | None = None
    frame: int | None = None
    at: float | None = None
    shown: str | None = None
    screenshot: Path | None = None
    movie: Path | None = None


def view(folder: Path, screenshot: Path | None = None, wanted: Wanted | None = None) -> str:
    """Open a film in `folder` in a window, or save a picture of a frame or a movie; return what was shown.

    Raises TrochoidError when there is no such film or frame, nothing to draw on, or the picture cannot be written.
    """
    asked = Wanted(screenshot=screenshot) if wanted is None else wanted
    if asked.movie is not None and Path(asked.movie).suffix.lower() != ".gif":
        raise TrochoidError(f"cannot write the movie {asked.movie}: only .gif is written")
    collection, others = _collection(Path(folder), asked.film)
    film = listing(collection)
    number = _number(film, asked)
    off = asked.screenshot is not None or asked.movie is not None
    _choose_window(off)
    import pyvista as library

    pyvista: Any = library
    frames = [[(listed, pyvista.read(listed.path)) for listed in bodies] for _, bodies in film.frames]
    scale = SCALE if film.spatial and asked.screenshot is not None and asked.movie is None else 1
    look = replace(chosen_look(film, frames, asked.shown), fonts=scale)
    columns = 1 if film.spatial else len(frames[number])
    size = [1120 * scale, 840 * scale] if film.spatial else [max(900, 700 * columns), 760]
    lights = "none" if film.spatial else "light kit"
    plotter = pyvista.Plotter(
        off_screen=off, shape=(1, columns), window_size=size, border=False, lighting=lights
    )
    plotter.set_background("white", all_renderers=True)
    if film.spatial:
        for place, brightness in LIGHTS:
            plotter.add_light(pyvista.Light(position=place, intensity=brightness, light_type="camera light"))
    _draw(plotter, film, frames[number], look, number)
    _place_cameras(plotter, film, frames, columns)
    if asked.screenshot is not None:
        _save(plotter, Path(asked.screenshot), scale)
    if asked.movie is not None:
        _save_movie(plotter, film, frames, look, Path(asked.movie))
    if off:
        plotter.close()
    else:
        _add_slider(plotter, film, frames, look, number)
        plotter.show()
    more = f"; also here: {', '.join(others)} (--film NAME)" if others and asked.film is None else ""
    return f"{collection.stem}: {film.title}, {_value(film, number)}{more}"


def _collection(folder: Path, name: str | None) -> tuple[Path, tuple[str, ...]]:
    """Return the film's .pvd and the names of the others."""
    if not folder.is_dir():
        raise TrochoidError(f"no folder {folder}; give the one that a run wrote, such as out/cycloid")
    films = {path.stem: path for path in sorted(folder.glob(f"*{ENDING}")) if listed_files(path)}
    if not films:
        raise TrochoidError(
            f"no films in {folder}: bodies in space are written for stress_max, where the drive offers it, and by the "
            "precessional drive and the indexer with elastic contact; all other pictures are in report.html"
        )
    if name is not None and name not in films:
        known = "\n".join(f"  {stem}: {listing(path).title}" for stem, path in films.items())
        raise TrochoidError(f'no film "{name}" in {folder}; there are\n{known}')
    chosen = next(iter(films)) if name is None else name
    return films[chosen], tuple(stem for stem in films if stem != chosen)


def _number(film: Listing, wanted: Wanted) -> int:
    """Return which frame is shown first."""
    values = [value for value, _ in film.frames]
    if wanted.at is not None and wanted.frame is not None:
        raise TrochoidError("give --frame or --at, not both")
    if wanted.at is not None:
        at = wanted.at
        low, high = min(values), max(values)
        if not low - 1e-9 <= at <= high + 1e-9:
            raise TrochoidError(
                f"--at {at:g}: the film's {film.axis} goes from {low:.6g} to {high:.6g} {film.units}".rstrip()
            )
        return min(range(len(values)), key=lambda i: abs(values[i] - at))
    number = wanted.frame or 0
    if not 0 <= number < len(values):
        raise TrochoidError(
            f"--frame {number}: the film has {len(values)} frame(s); take 0 to {len(values) - 1}"
        )
    return number


def _choose_window(off_screen: bool) -> None:
    """See to it that VTK finds something to draw on; where it does not, it would end the process."""
    shown = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    if not sys.platform.startswith("linux") or shown:
        return
    if not off_screen:
        raise TrochoidError(
            "there is no display to open a window on: use --screenshot FILE.png, or --movie FILE.gif"
        )
    try:
        ctypes.CDLL("libEGL.so.1")
    except OSError as error:
        raise TrochoidError(
            "drawing without a display needs libEGL: install it (Debian, Ubuntu: apt install libegl1)"
        ) from error
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")


def _draw(
    plotter: Plotter, film: Listing, bodies: Sequence[tuple[Listed, Any]], look: Look, number: int
) -> None:
    """Put the bodies of a frame into their views, in place of those of another frame."""
    if film.spatial:
        plotter.subplot(0, 0)
        kept = {listed.name for listed, _ in bodies}
        for name in look.names - kept:
            plotter.remove_actor(name, render=False)
            plotter.remove_actor(f"{name}{EDGES}", render=False)
        for listed, body in bodies:
            add_body(plotter, listed.name, listed, body, look)
        said = f"{film.title}\n{_value(film, number)}\n{look.caption}".rstrip()
        caption = plotter.add_text(
            said, name="caption", position=(0.02, 0.98), viewport=True, font_size=9 * look.fonts, color=_INK
        )
        caption.prop.SetVerticalJustificationToTop()
        caption.prop.SetLineSpacing(1.25)
        return
    for index, (listed, body) in enumerate(bodies):
        plotter.subplot(0, index)
        said = add_body(plotter, "body", listed, body, look)
        plotter.add_text(
            f"{listed.name}\n{said}", name="caption", position="upper_left", font_size=9, color=_INK
        )


def _place_cameras(plotter: Plotter, film: Listing, frames: Any, columns: int) -> None:
    """Look at all that the film shows, from where it wants to be seen."""
    if not film.spatial:
        for index in range(columns):
            plotter.subplot(0, index)
            plotter.view_xy()
            plotter.camera.zoom(1.05)
        plotter.link_views()
        return
    plotter.subplot(0, 0)
    some = [body.points[:: max(1, body.n_points // ENOUGH)] for bodies in frames for _, body in bodies]
    points = 1e3 * np.concatenate(some)
    low, high = points.min(axis=0), points.max(axis=0)
    toward = np.array(film.seen_from) / np.linalg.norm(film.seen_from)
    camera = plotter.camera
    camera.up, camera.focal_point = (0.0, 0.0, 1.0), 0.5 * (low + high)
    camera.position = camera.focal_point + 2.5 * np.linalg.norm(high - low) * toward
    across = np.cross((0.0, 0.0, 1.0), toward)
    across /= np.linalg.norm(across)
    up = np.cross(toward, across)
    seen = _seen(points, camera, toward, across, up)
    shift = 0.5 * (seen.min(axis=0) + seen.max(axis=0)) * camera.distance
    camera.focal_point, camera.position = (
        np.array(place) + shift[0] * across + shift[1] * up for place in (camera.focal_point, camera.position)
    )
    half = np.abs(_seen(points, camera, toward, across, up)).max(axis=0)
    wide, tall = plotter.window_size
    view_angle = math.tan(math.radians(0.5 * camera.view_angle))
    camera.zoom(float(min(FILLED[0] * view_angle * wide / tall / half[0], FILLED[1] * view_angle / half[1])))
    camera.SetWindowCenter(0.0, LOW)
    plotter.renderer.reset_camera_clipping_range()


def _seen(points: Any, camera: Any, toward: Any, across: Any, up: Any) -> Any:
    """Return where points (n, 3) are seen (n, 2): to the right and up, over their distance from the eye."""
    away = points - np.array(camera.position)
    return np.stack([away @ across, away @ up], axis=1) / -(away @ toward)[:, None]


def _add_slider(plotter: Plotter, film: Listing, frames: Any, look: Look, number: int) -> None:
    if len(film.frames) < 2:
        return
    values = [value for value, _ in film.frames]
    shown = [number]

    def move(value: float) -> None:
        nearest = min(range(len(values)), key=lambda i: abs(values[i] - value))
        if nearest != shown[0]:
            shown[0] = nearest
            _draw(plotter, film, frames[nearest], look, nearest)

    plotter.subplot(0, 0)
    plotter.add_slider_widget(
        move,
        [min(values), max(values)],
        value=values[number],
        title=f"{film.axis} ({film.units})" if film.units else film.axis,
        style="modern",
        color=_INK,
        pointa=(0.62, 0.93),
        pointb=(0.95, 0.93),
    )


def _value(film: Listing, number: int) -> str:
    value = film.frames[number][0]
    unit = "°" if film.units == "deg" else f" {film.units}" if film.units else ""
    return f"{film.axis} {round(value, 3):g}{unit}"


def _picture(plotter: Plotter, part: float) -> Any:
    """Return what is seen, reduced to a part of its width and height."""
    from PIL import Image

    picture = Image.fromarray(plotter.screenshot(None, return_img=True))
    size = round(part * picture.width), round(part * picture.height)
    return picture if part == 1 else picture.resize(size, Image.Resampling.LANCZOS)


def _save(plotter: Plotter, screenshot: Path, scale: int) -> None:
    try:
        _picture(plotter, 1 / scale).save(screenshot, optimize=True)
    except (OSError, ValueError) as error:
        plotter.close()
        raise TrochoidError(
            f"cannot write the picture {screenshot}: {error}; give a .png in a folder that you may write to"
        ) from error


def _save_movie(plotter: Plotter, film: Listing, frames: Any, look: Look, movie: Path) -> None:
    """Save all frames as an animated GIF that runs for ever."""

    def pictures() -> Iterator[Any]:
        for number, bodies in enumerate(frames):
            _draw(plotter, film, bodies, look, number)
            yield _picture(plotter, MOVIE_WIDTH / plotter.window_size[0]).quantize(MOVIE_COLORS)

    try:
        first, *others = pictures()
        first.save(movie, save_all=True, append_images=others, duration=MOVIE_STEP, loop=0)
    except (OSError, ValueError) as error:
        plotter.close()
        raise TrochoidError(
            f"cannot write the movie {movie}: {error}; give a .gif in a folder that you may write to"
        ) from error
