"""Straight-sided triangulation of a polygon with holes by gmsh, graded from its boundary points inwards."""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType

import numpy as np

from trochoid.geometry.crossing import fail_if_crossing
from trochoid.geometry.session import gmsh_session
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, IntArray

_GRID = 2.0**30  # snapping to a fine grid makes the mesh independent of the unit of length and of rounding
_FAR = 2.0  # beyond every distance in a body of extent 1
_SIZE_STEP = 1.25  # boundary points whose facets differ less share one size field


def triangulate(loops: Sequence[Array], slope: float | Array) -> tuple[Array, IntArray]:
    """Triangles between closed polygons, the first of them the outer one, each (n, 2), m.

    Returns points (n, 2), the polygons' vertices first and unmoved, and triangles (3, m), counter-clockwise.
    The element size is the least over boundary points of facet length plus `slope`, one or one for each of them, times
    the distance.  Raises TrochoidError.
    """
    boundary = np.concatenate(loops)
    shift, scale = boundary.mean(axis=0), float(np.ptp(boundary, axis=0).max())
    unit = [np.rint((loop - shift) / scale * _GRID) / _GRID + 0.0 for loop in loops]
    fail_if_crossing(loops)
    with gmsh_session() as gmsh:
        try:
            _add_polygons(gmsh, unit)
            _add_sizes(gmsh, unit, slope)
            gmsh.model.mesh.generate(2)
        except Exception as error:  # gmsh raises bare exceptions
            raise TrochoidError(f"gmsh could not mesh the outline ({error}); do its loops cross?") from error
        tags, xyz, _ = gmsh.model.mesh.getNodes()
        _, corner_tags = gmsh.model.mesh.getElementsByType(2)
    points, triangles = _as_arrays(boundary, shift, scale, tags, xyz, corner_tags)
    _fail_if_not_filled(loops, points, triangles)
    return points, triangles


def _add_polygons(gmsh: ModuleType, loops: Sequence[Array]) -> None:
    geo, first, wires = gmsh.model.geo, 1, []
    for loop in loops:
        count = len(loop)
        for i, (x, y) in enumerate(loop):
            geo.addPoint(x, y, 0.0, tag=first + i)
        for i in range(count):
            geo.addLine(first + i, first + (i + 1) % count, tag=first + i)
            geo.mesh.setTransfiniteCurve(first + i, 2)
        wires.append(geo.addCurveLoop(list(range(first, first + count))))
        first += count
    geo.addPlaneSurface(wires)
    geo.synchronize()


def _add_sizes(gmsh: ModuleType, loops: Sequence[Array], slope: float | Array) -> None:
    """Set size(x) = least over boundary points of facet length + slope |x − point|, in bins of length and slope."""
    edge = [np.linalg.norm(np.roll(loop, -1, axis=0) - loop, axis=1) for loop in loops]
    size = np.concatenate([0.5 * (e + np.roll(e, 1)) for e in edge])
    level = np.floor(np.log(size / size.min()) / np.log(_SIZE_STEP) + 0.5).astype(int)
    fields = gmsh.model.mesh.field
    parts = []
    slopes = np.broadcast_to(slope, size.shape)
    for value, steep in np.unique(np.stack([level, slopes], axis=1), axis=0):
        members = np.flatnonzero((level == value) & (slopes == steep))
        distance = fields.add("Distance")
        fields.setNumbers(distance, "PointsList", (members + 1).tolist())
        ramp = fields.add("Threshold")
        near = float(np.exp(np.log(size[members]).mean()))
        fields.setNumber(ramp, "InField", distance)
        fields.setNumber(ramp, "SizeMin", near)
        fields.setNumber(ramp, "SizeMax", near + _FAR * steep)
        fields.setNumber(ramp, "DistMin", 0.0)
        fields.setNumber(ramp, "DistMax", _FAR)
        parts.append(ramp)
    least = fields.add("Min")
    fields.setNumbers(least, "FieldsList", parts)
    fields.setAsBackgroundMesh(least)


def _as_arrays(
    boundary: Array, shift: Array, scale: float, tags: Array, xyz: Array, corner_tags: Array
) -> tuple[Array, IntArray]:
    order = np.argsort(tags)
    points = shift + scale * xyz.reshape(-1, 3)[order, :2]
    triangles = np.searchsorted(tags[order], corner_tags).reshape(-1, 3).T.astype(np.intp)
    fixed = len(boundary)
    if len(points) < fixed or np.abs(points[:fixed] - boundary).max() > 1e-8 * scale:
        raise TrochoidError("gmsh did not keep the boundary points; are two of them in one place?")
    points[:fixed] = boundary
    flipped = _doubled_areas(points, triangles) < 0.0
    triangles[1:, flipped] = triangles[:0:-1, flipped]
    return points, triangles


def _doubled_areas(points: Array, triangles: IntArray) -> Array:
    a, b, c = points[triangles]
    areas: Array = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    return areas


def _fail_if_not_filled(loops: Sequence[Array], points: Array, triangles: IntArray) -> None:
    """Compare the triangles' area with that of the polygons (shoelace): they differ when loops cross."""
    doubled = []
    for loop in loops:
        after = np.roll(loop, -1, axis=0)
        doubled.append(float(np.sum(loop[:, 0] * after[:, 1] - loop[:, 1] * after[:, 0])))
    if min(doubled) <= 0.0:
        raise TrochoidError("a loop of the outline runs clockwise; give all loops counter-clockwise")
    wanted, found = doubled[0] - sum(doubled[1:]), float(_doubled_areas(points, triangles).sum())
    if abs(found - wanted) > 1e-6 * doubled[0]:
        raise TrochoidError(
            f"triangles cover {0.5 * found:.6g} m² of an outline of {0.5 * wanted:.6g} m²; "
            "all holes must lie inside, and none in another"
        )
