"""How bodies of a film are drawn: what is exaggerated, by which numbers they are coloured, what is left as glass."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array
from trochoid.results.vtk import Listed, Listing

Body: TypeAlias = Any  # pyvista's grids; its decorators hide their types
Frames: TypeAlias = Sequence[Sequence[tuple[Listed, Body]]]

VISIBLE = 0.02  # largest displacement as a share of a body's size, once exaggerated
SLIGHT = 0.004  # the same of the whole film, where contacts must stay together
WIDE = 0.01  # the same of half a contact's width
SHOWN = 0.995  # share of the area whose stress the colours reach: at the contacts it is far above the rest
IN_FRONT = (-2.0, -400.0)  # by how much contacts are drawn before what they lie on: slope, units of depth
UNITS = {
    "von_mises": ("von Mises stress (MPa)", 1e-6),
    "max_shear": ("largest shear stress (MPa)", 1e-6),
    "contact_pressure": ("contact pressure (MPa)", 1e-6),
    "roller_force": ("force of a roller (N)", 1.0),
}
ALONE, BESIDE, POINTED = "viridis", "Blues", "YlOrRd"  # colour maps: stress, the same beside pressure, that
SWUNG = "YlGnBu"  # of modes, which are pale where and when nothing is displaced
PHASE = "phase"  # axis of films of modes, whose size is arbitrary
CREASE = 35.0  # degrees: sharper edges are edges
EDGES = " edges"  # what the lines of a body are called after it
_INK = "#1f2933"


@dataclass(frozen=True, slots=True)
class Colors:
    """Point data that colours a body, what the bar calls it, what multiplies it, its largest value and colour map."""

    data: str
    label: str
    scale: float
    top: float
    map: str


@dataclass(frozen=True, slots=True)
class Look:
    """`names` of all bodies of the film, by what factor vectors are drawn, colours by priority, the caption, how
    large `fonts` are, and whether `edges` are drawn as lines.
    """

    names: frozenset[str]
    factor: float
    part: str
    widening: float
    colors: tuple[Colors, ...]
    caption: str
    spatial: bool
    fonts: int = 1
    edges: bool = False


def chosen_look(film: Listing, frames: Frames, shown: str | None = None) -> Look:
    """Choose one look for all frames.  Raises TrochoidError for point data that no body has."""
    bodies = [body for frame in frames for _, body in frame]
    known = {name for body in bodies for name in body.point_data if name != "from_middle"}
    name = shown or film.shown
    if shown is not None and shown not in known:
        raise TrochoidError(f'no body has the point data "{shown}"; there are {", ".join(sorted(known))}')
    part = "deformation" if "deformation" in known else "displacement"
    moved = _largest(bodies, part)
    size = _size(frames) if film.spatial else max(body.length for body in bodies)
    wide = _largest(bodies, "from_middle")
    factor = exaggeration(size, moved, SLIGHT if wide > 0.0 else VISIBLE)
    widening = exaggeration(size, wide, WIDE) if wide > 0.0 else 1.0
    chosen = tuple(_colors([name, "von_mises"], bodies))
    names = frozenset(listed.name for frame in frames for listed, _ in frame)
    if film.axis == PHASE:
        relative = (
            Colors(c.data, "relative displacement", 1.0 / c.top if c.top > 0.0 else 1.0, c.top, SWUNG)
            for c in chosen
        )
        return Look(names, 1.0, part, 1.0, tuple(relative), "", film.spatial, edges=film.spatial)
    return Look(
        names,
        factor,
        part,
        widening,
        chosen,
        ", ".join(_said(part, moved, factor, widening)),
        film.spatial,
    )


def _colors(names: Sequence[str], bodies: Sequence[Body]) -> Iterator[Colors]:
    """Yield the colours of all of these names that bodies have, the first before the others."""
    known = [data for data in dict.fromkeys(names) if any(data in body.point_data for body in bodies)]
    for data in known:
        having = [body for body in bodies if data in body.point_data]
        stress = data in ("von_mises", "max_shear")
        top = _reached(having, data, SHOWN) if stress else max(float(_size_of(b, data).max()) for b in having)
        label, scale = UNITS.get(data, (data.replace("_", " "), 1.0))
        if data in ("displacement", "deformation"):
            label, scale = (f"{data} (mm)", 1e3) if top >= 1e-3 else (f"{data} (µm)", 1e6)
        pointed = POINTED if data == "contact_pressure" else ALONE
        yield Colors(data, label, scale, top, BESIDE if stress and len(known) > 1 else pointed)


def _said(part: str, moved: float, factor: float, widening: float) -> Iterator[str]:
    if part == "deformation":
        yield "rigid motion true to scale"
    if moved > 0.0:
        drawn = f"x {factor:g}" if factor != 1.0 else "true to scale"
        yield f"{part} {drawn} (largest {_length(moved)})"
    if widening > 1.0:
        yield f"contacts {widening:g} times as wide"


def exaggeration(size: float, displacement: float, visible: float = VISIBLE) -> float:
    """Return the factor, 1, 2 or 5 times a power of ten, that makes `displacement` visible; 1 at least."""
    if not displacement > 0.0 or not size > 0.0:
        return 1.0
    wanted = visible * size / displacement
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(1.0, max(step * power for step in (1, 2, 5) if step * power <= wanted * (1 + 1e-12)))


def add_body(plotter: Any, name: str, listed: Listed, body: Body, look: Look) -> str:
    """Add one body in mm, deformed; return what is to be said of it alone.

    Its quadratic edges are subdivided, so that they are drawn curved.
    """
    shape = _moved(body, look)
    surface = shape.extract_surface(nonlinear_subdivision=3, algorithm="dataset_surface").scale(1e3)
    moved = "displacement" in body.point_data
    caption = f"displacement x {look.factor:g}" if moved else "not deformed"
    colors = next((c for c in look.colors if c.data in body.point_data), None)
    style: dict[str, Any] = {"color": listed.color}
    if colors is not None:
        values = _size_of(surface, colors.data) * colors.scale
        surface[colors.label] = values
        top = colors.scale * colors.top
        what, _, unit = colors.label.rstrip(")").partition(" (")
        caption += f"\nlargest {what.removeprefix('largest ')} {values.max():.4g} {unit}".rstrip()
        style = {"scalars": colors.label, "clim": [0.0, top], "cmap": colors.map}
        style["scalar_bar_args"] = _bar(look, colors, top)
    if look.spatial:
        style |= {"opacity": listed.opacity}
        style |= {"smooth_shading": True, "specular": 0.15, "ambient": 0.15}
        if "from_middle" in body.point_data:
            style["lighting"] = False
        else:
            surface = surface.clean().compute_normals(
                consistent_normals=False, split_vertices=True, feature_angle=CREASE
            )
    else:
        style["lighting"] = False
    actor = plotter.add_mesh(surface, name=name, **style)
    if look.edges:
        lines = shape.extract_surface(algorithm="dataset_surface").scale(1e3).clean()
        lines = lines.extract_feature_edges(CREASE, boundary_edges=True, manifold_edges=False)
        if lines.n_cells:
            ink = {
                "color": _INK,
                "line_width": 1.2 * look.fonts,
                "opacity": 0.35 + 0.4 * (listed.opacity >= 1.0),
            }
            plotter.add_mesh(lines, name=f"{name}{EDGES}", lighting=False, **ink)
    if "from_middle" in body.point_data:  # as wide as it is drawn, a contact would dip into a hollow flank
        actor.mapper.SetResolveCoincidentTopologyToPolygonOffset()
        actor.mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(*IN_FRONT)
    return caption


def _bar(look: Look, colors: Colors, top: float) -> dict[str, Any]:
    bar: dict[str, Any] = {"title": f"{colors.label}\n", "color": _INK}
    bar["fmt"] = "%.0f" if top >= 20.0 else "%.1f" if top >= 2.0 else "%.3g"
    bar |= {"title_font_size": 16, "label_font_size": 14, "width": 0.7, "position_x": 0.15}
    if look.spatial:
        place = look.colors.index(colors)
        wide = 0.4 if len(look.colors) > 1 else 0.5
        left = (0.05, 0.55)[place] if len(look.colors) > 1 else 0.25
        bar |= {
            "title_font_size": 20 * look.fonts,
            "label_font_size": 17 * look.fonts,
            "width": wide,
            "position_x": left,
        }
        bar |= {"position_y": 0.02, "height": 0.07, "n_labels": 5}
    return bar


def _moved(body: Body, look: Look) -> Body:
    """Return a body where it is drawn: a rigid part of its displacement as it is, the rest exaggerated."""
    shape = body.copy()
    points = np.asarray(body.points, dtype=np.float64).copy()
    if "displacement" in body.point_data:
        whole = np.asarray(body["displacement"], dtype=np.float64)
        if look.part in body.point_data:
            part = np.asarray(body[look.part], dtype=np.float64)
            points += whole + (look.factor - 1.0) * part
        else:
            points += whole if look.part == "deformation" else look.factor * whole
    if "from_middle" in body.point_data:
        points += (look.widening - 1.0) * np.asarray(body["from_middle"], dtype=np.float64)
    shape.points = points
    return shape


def _size(frames: Frames) -> float:
    """Return the diagonal, m, of the box about all bodies of the film."""
    bounds = np.array([body.bounds for frame in frames for _, body in frame])
    return float(np.linalg.norm(bounds[:, 1::2].max(axis=0) - bounds[:, ::2].min(axis=0)))


def _largest(bodies: Sequence[Body], name: str) -> float:
    return max((float(_size_of(b, name).max()) for b in bodies if name in b.point_data), default=0.0)


def _size_of(body: Body, name: str) -> Array:
    """Return a scalar, or the length of a vector, at all nodes."""
    values = np.asarray(body[name])
    return values if values.ndim == 1 else np.asarray(np.linalg.norm(values, axis=1))


def _reached(bodies: Sequence[Body], name: str, share: float) -> float:
    """Return the value that this share of the bodies' area stays below."""
    area = np.concatenate([body.compute_cell_sizes(length=False, volume=False)["Area"] for body in bodies])
    value = np.concatenate([body.point_data_to_cell_data()[name] for body in bodies])
    order = np.argsort(value)
    filled = np.cumsum(area[order])
    return float(value[order][np.searchsorted(filled, share * filled[-1])])


def _length(meters: float) -> str:
    return f"{1e6 * meters:.2g} µm" if meters < 1e-3 else f"{1e3 * meters:.2g} mm"
