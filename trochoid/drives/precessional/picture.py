"""The drive in space, and the map of what its pins may be."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from trochoid.drives.precessional.design import Design
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.sphere_tooth_checks import largest_nutation, overlap_angle
from trochoid.kinematics.sphere_tooth_search import pin_limit_map
from trochoid.kinematics.spherical import rotation, turn
from trochoid.kinematics.spherical_curve import SmallCircle
from trochoid.kinematics.types import Array, frozen
from trochoid.results.plot import Axis, Plot, PlotCurve, PlotSurface

ROUND, PER_LOBE, MAPPED = 32, 28, 41  # points of a small circle, of a lobe, nutation angles of the map
LENGTHS = tuple(Axis(name, "m") for name in "xyz")
Z = np.array([0.0, 0.0, 1.0])


def space(design: Design) -> Plot:
    """Draw the drive at input angle 0 in the fixed frame, the satellite's axis leaning towards x."""
    teeth = design.teeth
    reach = design.mechanism.joint if teeth is None else teeth.outer_radius
    surfaces = [*_pitch_cones(design, reach)]
    if design.tooth is not None and teeth is not None:
        surfaces = [*_toothed(design, design.tooth, teeth.inner_radius, teeth.outer_radius), *surfaces]
    return Plot(
        "The drive in space",
        LENGTHS,
        tuple(_axes(design, 1.15 * reach)),
        tuple(surfaces),
        "At input angle 0. All cones have their apex in O. The body cone of the satellite rolls on the space cone of "
        "the wheel; they touch along the instantaneous axis.",
    )


def _toothed(design: Design, tooth: SphereTooth, inner: float, outer: float) -> Iterator[PlotSurface]:
    """Draw flanks and pins, each in its member's place."""
    tilt, still = rotation(1, design.nutation.angle), np.eye(3)
    pins_at, lobes_at = (still, tilt) if tooth.pins_on == "ring" else (tilt, still)
    members = ("wheel", "satellite") if tooth.pins_on == "ring" else ("satellite", "wheel")
    p = np.linspace(0.0, tooth.period, PER_LOBE * tooth.lobes, endpoint=False)
    yield _band(f"flanks of the {members[1]}", turn(lobes_at, tooth.point(p)), inner, outer, 1.0)
    around = np.linspace(0.0, 2.0 * math.pi, ROUND, endpoint=False)
    x, y, z = pin_axes(tooth)[0]
    pin = SmallCircle((float(x), float(y), float(z)), tooth.pin_angle).point(around)
    name = f"pins of the {members[0]}"
    turns = [pins_at @ rotation(2, 2.0 * math.pi * k / tooth.pins) for k in range(tooth.pins)]
    yield _joined(name, [_band(name, turn(each, pin), inner, outer, 0.9) for each in turns])


def _joined(name: str, parts: Sequence[PlotSurface]) -> PlotSurface:
    """Return surfaces as one, which is drawn faster."""
    first = np.cumsum([0, *(len(part.vertices) for part in parts)])
    triangles = [part.triangles + start for part, start in zip(parts, first, strict=False)]
    corners = np.concatenate([part.vertices for part in parts])
    return PlotSurface(name, frozen(corners), np.concatenate(triangles), parts[0].opacity)


def pin_axes(tooth: SphereTooth) -> Array:
    """Return the axes (pins, 3) of the pins in the frame of their member."""
    angle = 2.0 * math.pi * np.arange(tooth.pins) / tooth.pins
    s, c = math.sin(tooth.polar_angle), math.cos(tooth.polar_angle)
    return np.stack((s * np.cos(angle), s * np.sin(angle), np.full(tooth.pins, c)), axis=-1)


def _band(name: str, directions: Array, inner: float, outer: float, opacity: float) -> PlotSurface:
    """Return the part between two spheres of the cone over a closed curve of directions (n, 3)."""
    n = len(directions)
    i = np.arange(n)
    j = (i + 1) % n
    triangles = np.concatenate((np.stack((i, j, i + n), axis=1), np.stack((j, j + n, i + n), axis=1)))
    corners = np.concatenate((inner * directions, outer * directions))
    return PlotSurface(name, frozen(corners), triangles, opacity)


def _pitch_cones(design: Design, reach: float) -> Iterator[PlotSurface]:
    wheel, satellite = design.pitch_cones
    n = design.nutation.axis
    along = design.instantaneous_axis
    around = np.linspace(0.0, 2.0 * math.pi, 96, endpoint=False)
    for name, axis, half in (
        ("space cone (wheel)", Z, wheel),
        ("body cone (satellite)", n, satellite),
    ):
        across = along - (along @ axis) * axis
        across = across / np.linalg.norm(across)
        round_it = np.cos(around)[:, None] * across + np.sin(around)[:, None] * np.cross(axis, across)
        yield _band(name, math.cos(half) * axis + math.sin(half) * round_it, 0.0, reach, 0.25)


def _axes(design: Design, reach: float) -> Iterator[PlotCurve]:
    n, along = design.nutation.axis, design.instantaneous_axis
    low, high = min(-0.2 * reach, 1.1 * design.mechanism.support), max(reach, 1.1 * design.mechanism.support)
    yield PlotCurve("axis of the shafts", frozen(np.array([low * Z, high * Z])), style="dashed")
    yield PlotCurve("axis of the satellite", frozen(np.array([-0.2 * reach * n, reach * n])), style="dashed")
    yield PlotCurve("instantaneous axis", frozen(np.array([-0.2 * reach * along, reach * along])))
    drive = design.mechanism
    marks = np.array([0.0 * Z, drive.joint * n, drive.support * Z])
    yield PlotCurve("O, A, B", frozen(marks), style="points", labels=("O", "A", "B"))


def undercut_map(tooth: SphereTooth) -> Plot:
    """Draw the margin to undercut over nutation and pin angle, and its zero for other polar angles."""
    most = min(0.999 * largest_nutation(tooth), max(4.0 * tooth.nutation, math.radians(10.0)))
    nutation = np.linspace(0.01 * most, most, MAPPED)
    limit = pin_limit_map(tooth, nutation, np.array([tooth.polar_angle]))[0]
    foot = np.array([[most, 0.0], [nutation[0], 0.0]])
    own = f"polar angle {math.degrees(tooth.polar_angle):.4g}°"
    curves = [
        PlotCurve(
            f"can be made, {own}",
            frozen(np.concatenate((np.stack((nutation, limit), axis=1), foot))),
            style="area",
            closed=True,
        )
    ]
    levels = tuple(_levels(float(limit.max())))
    group = ", ".join(f"{math.degrees(margin):g}°" for margin in levels) + " below it"
    for margin in levels:
        kept = limit > margin
        line = np.stack((nutation[kept], limit[kept] - margin), axis=1)
        said = f"{math.degrees(margin):g}° left"
        curves.append(PlotCurve(said, frozen(line), group, "dashed", labels=(said,) * len(line)))
    curves += list(_other_polar_angles(tooth, nutation))
    overlap = overlap_angle(tooth)
    pins = np.array([[nutation[0], overlap], [most, overlap]])
    curves.append(PlotCurve("neighbouring pins touch", frozen(pins)))
    here = np.array([[tooth.nutation, tooth.pin_angle]])
    curves.append(PlotCurve("this drive", frozen(here), style="points", labels=("this drive",)))
    return Plot(
        "Margin to undercut",
        (Axis("nutation angle", "rad"), Axis("half angle of a pin", "rad")),
        tuple(curves),
        caption=f"{tooth.pins} pins, {tooth.lobes} lobes. Above its line a pin undercuts the flank or meets the next "
        "pin; dashed: what is left below that limit. Lines end where the path of the pins has cusps.",
        equal=False,
    )


def _levels(limit: float) -> Iterator[float]:
    """Yield three round margins (rad) below the largest limit."""
    wide = math.degrees(limit) / 4.0
    step = 10.0 ** math.floor(math.log10(wide))
    step *= next(m for m in (5.0, 2.0, 1.0) if m * step <= wide)
    for k in (1, 2, 3):
        yield math.radians(k * step)


def _other_polar_angles(tooth: SphereTooth, nutation: Array) -> Iterator[PlotCurve]:
    for off in (-20.0, -10.0, 10.0, 20.0):
        polar = tooth.polar_angle + math.radians(off)
        if not math.radians(5.0) < polar <= 0.5 * math.pi + 1e-9:
            continue
        limit = pin_limit_map(replace(tooth, polar_angle=polar), nutation, np.array([polar]))[0]
        kept = limit > 0.0
        if kept.sum() > 1:
            line = np.stack((nutation[kept], limit[kept]), axis=1)
            yield PlotCurve(f"limit at polar angle {math.degrees(polar):.4g}°", frozen(line))
