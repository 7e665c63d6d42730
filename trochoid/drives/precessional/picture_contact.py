"""The forces of teeth and joints on the satellite, put into the drawing of the drive in space."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from trochoid.drives.precessional.contact import Series
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.tooth_loads import tooth_loads
from trochoid.kinematics.types import Array, frozen
from trochoid.results.plot import Plot, PlotCurve

LONGEST = 0.6  # of the teeth's distance from O: the largest force
HEAD = 0.15  # of an arrow


def with_forces(drawn: Plot, design: Design, series: Series) -> Plot:
    """Add the contacts at input angle 0 and all forces on the satellite, in the frame that the drive is drawn in."""
    curves = tuple(_forces(design, series))
    if not curves:
        return drawn
    said = "Arrows: forces on the satellite, longer where larger; lines on the flanks: pressed contacts."
    caption = f"{drawn.caption} {said}"
    return replace(drawn, curves=(*drawn.curves, *curves), caption=caption)


def _forces(design: Design, series: Series) -> Iterator[PlotCurve]:
    total = series.total[0]
    if not total.any():
        return
    loads = tooth_loads(design, series)
    joints = {
        "force of the bearing A": (design.mechanism.joint * series.axis, loads.joint_a[0]),
        "force of the joint O": (np.zeros(3), loads.joint_o[0]),
    }
    largest = max(float(np.linalg.norm(force)) for _, force in joints.values())
    scale = LONGEST * design.tooth_radius / max(float(total.max()), largest)
    inner, outer = float(series.places[0]), float(series.places[-1])
    for i in np.flatnonzero(total > 0.0):
        point = series.point[0, i]
        said = f"roller {i + 1}: {total[i]:.4g} N, {1e-6 * series.pressure[0, i].max():.4g} MPa"
        line = frozen(np.array([inner * point, outer * point]))
        yield PlotCurve(said, line, "pressed contacts", labels=(said, said))
        middle = float(series.force[0, i] @ series.places / total[i])
        force = series.on_satellite * total[i] * series.normal[0, i]
        yield _arrow(said, middle * point, scale * force, "forces of the rollers", point)
    for name, (origin, force) in joints.items():
        said = f"{name}: {np.linalg.norm(force):.4g} N"
        yield _arrow(said, origin, scale * force, name, series.axis)


def _arrow(said: str, start: Array, way: Array, group: str, up: Array) -> PlotCurve:
    """Return an arrow with two barbs."""
    side = HEAD * np.cross(way, up) * 0.5
    tip = start + way
    back = tip - HEAD * way
    points = np.array([start, tip, back + side, tip, back - side])
    return PlotCurve(said, frozen(points), group, labels=(said,) * len(points))
