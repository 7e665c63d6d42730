"""STEP files of bodies of rays, by gmsh's OpenCASCADE: B-splines through exact points, true spheres and cones.

The outline's curves are interpolated on two spheres, inside and outside the body, and ruled surfaces span them: their
rulings are the rays.  These surfaces and the hub's cone cut a spherical shell, and the part between them is the body.
Lengths are in mm, as STEP files have them.
"""

from __future__ import annotations

import contextlib
import math
import os
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from types import ModuleType

import numpy as np

from trochoid.geometry.ray_solid import RaySolid, Trace
from trochoid.geometry.session import gmsh_session
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.types import Array

MM = 1e3
BEYOND = 0.05  # of the radii: how far ruled surfaces reach beyond both spheres
# longest arcs, in a parameter that is an angle, and azimuths of the spheres' seams, rad: where one intersection fails
# (an arc's end on a plane of symmetry), another does not
TRIES = ((1.1, 2.0), (0.83, 1.0), (0.61, 2.7))
FIRST, MOST = 8, 2048  # points of a piece

Tag = tuple[int, int]


def write_step(solid: RaySolid, path: Path, tolerance: float = 1e-6) -> int:
    """Write a body; its surface lies within `tolerance` (m) of the exact one.  Returns the number of points used.

    Raises Infeasible for a tolerance that cannot be met, TrochoidError when OpenCASCADE does not build the body.
    """
    limit = 0.5 * tolerance / ((1.0 + BEYOND) * solid.outer)
    said = ""
    for arc, seam in TRIES:
        cut = replace(solid, outline=tuple(part for trace in solid.outline for part in _short(trace, arc)))
        pieces = [interpolated(trace, limit) for trace in cut.outline]
        with gmsh_session() as gmsh:
            try:
                body = _body(gmsh, cut, pieces, seam)
            except Exception as fault:  # gmsh raises bare exceptions
                said = str(fault)
                continue
            _keep(gmsh, body)
            with _written(path) as part, _quiet():
                gmsh.write(str(part))
        return sum(len(points) for points in pieces)
    raise TrochoidError(f"OpenCASCADE could not build the body ({said})")


def _short(trace: Trace, arc: float) -> Iterator[Trace]:
    """Yield a piece, or an arc in parts: OpenCASCADE does not rule long ones well."""
    count = max(1, math.ceil(abs(trace.last - trace.first) / arc)) if trace.arc else 1
    stops = np.linspace(trace.first, trace.last, count + 1)
    yield from (replace(trace, first=float(a), last=float(b)) for a, b in pairwise(stops))


def interpolated(trace: Trace, limit: float) -> Array:
    """Return points (n, 3) whose cubic spline over the chords stays within `limit` (rad) of the piece; three of an arc.

    Raises Infeasible where MOST points do not do.
    """
    from scipy.interpolate import CubicSpline

    if trace.arc:
        return trace.point(np.linspace(trace.first, trace.last, 3))
    count = FIRST
    while count <= MOST:
        t = np.linspace(trace.first, trace.last, count + 1)
        points = trace.point(t)
        closed = bool(np.linalg.norm(points[0] - points[-1]) < 1e-9)
        if closed:
            points[-1] = points[0]
        way = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
        spline = CubicSpline(way, points, bc_type="periodic" if closed else "natural")
        between = np.linspace(0.0, way[-1], 4 * count + 1)
        if _distance(spline(between), np.interp(between, way, t), trace) <= limit:
            return points
        count *= 2
    raise Infeasible(
        f"a surface within {limit:.1e} rad needs more than {MOST} points on one piece; take a larger tolerance"
    )


def _distance(found: Array, place: Array, trace: Trace) -> float:
    """Return how far points (m, 3) are from a piece, near its parameters `place` (m,): Newton's nearest points."""
    low, high = sorted((trace.first, trace.last))
    small = 1e-6 * (high - low)
    for _ in range(4):
        here = trace.point(place)
        slope = (trace.point(place + small) - here) / small
        place = place + np.sum((found - here) * slope, axis=1) / np.sum(slope**2, axis=1)
    return float(np.linalg.norm(found - trace.point(np.clip(place, low, high)), axis=1).max())


def _body(gmsh: ModuleType, solid: RaySolid, pieces: list[Array], seam: float) -> Tag:
    """Cut the shell by outline and hub; return the part that touches both."""
    occ = gmsh.model.occ
    low, high = (MM * (1.0 - BEYOND) * solid.inner, MM * (1.0 + BEYOND) * solid.outer)
    flank = [
        face
        for pair in zip(*(_wires(occ, solid, pieces, r) for r in (low, high)), strict=True)
        for face in occ.addThruSections(list(pair), makeSolid=False, makeRuled=True)
    ]
    sine, cosine = math.sin(solid.hub), math.cos(solid.hub)
    circles = [occ.addWire([occ.addCircle(0.0, 0.0, r * cosine, r * sine)]) for r in (low, high)]
    hub = occ.addThruSections(circles, makeSolid=False, makeRuled=True)
    spheres = [occ.addSphere(0.0, 0.0, 0.0, MM * r) for r in (solid.outer, solid.inner)]
    shell, _ = occ.cut([(3, spheres[0])], [(3, spheres[1])])
    occ.rotate(shell, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, seam)
    parts, came = occ.fragment(shell, flank + hub)
    occ.synchronize()
    of_flank = {tag for made in came[len(shell) : len(shell) + len(flank)] for tag in made}
    of_hub = {tag for made in came[len(shell) + len(flank) :] for tag in made}
    for part in parts:
        if part[0] == 3:
            faces = set(gmsh.model.getBoundary([part], oriented=False))
            if faces & of_flank and faces & of_hub:
                return (int(part[0]), int(part[1]))
    raise TrochoidError("no part of the shell lies between outline and hub")


def _wires(occ: ModuleType, solid: RaySolid, pieces: list[Array], radius: float) -> list[int]:
    """Return a wire for each piece, an arc or a spline through the points, which ends where the next begins."""
    starts = [occ.addPoint(*(radius * points[0])) for points in pieces]
    wires = []
    for number, (trace, points) in enumerate(zip(solid.outline, pieces, strict=True)):
        first, last = starts[number], starts[(number + 1) % len(pieces)]
        inner = [occ.addPoint(*(radius * x)) for x in points[1:-1]]
        curve = (
            occ.addCircleArc(first, inner[0], last, center=False)
            if trace.arc
            else occ.addSpline([first, *inner, last])
        )
        wires.append(occ.addWire([curve]))
    return wires


def _keep(gmsh: ModuleType, body: Tag) -> None:
    """Remove everything that is not part of the body."""
    occ = gmsh.model.occ
    occ.remove([part for part in occ.getEntities(3) if part != body], recursive=True)
    faces = set(gmsh.model.getBoundary([body], oriented=False))
    occ.remove([face for face in occ.getEntities(2) if face not in faces], recursive=True)
    occ.synchronize()


@contextlib.contextmanager
def _written(path: Path) -> Iterator[Path]:
    """Yield a temporary name beside `path`, which takes its place at the end."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.stem}.{os.getpid()}.step")
    try:
        yield part
        if not part.exists():
            raise TrochoidError(f"{path}: gmsh wrote nothing; is there space, and leave to write?")
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """Send what OpenCASCADE prints to nowhere: it writes to the process's own output."""
    import sys

    sys.stdout.flush()
    kept = os.dup(1)
    try:
        with open(os.devnull, "w") as nowhere:
            os.dup2(nowhere.fileno(), 1)
            yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
