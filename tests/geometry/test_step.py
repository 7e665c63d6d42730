"""STEP files of toothed rims and slotted wheels, read back: closed, of the right volume, near the exact surfaces."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from tests.kinematics.sphere_cases import EXAMPLES
from trochoid.geometry.ray_solid import RaySolid, Trace, rim_solid, wheel_solid
from trochoid.geometry.session import gmsh_session
from trochoid.geometry.slotted import SlottedWheel
from trochoid.geometry.sphere_mesh import jacobians, mesh_sphere
from trochoid.geometry.sphere_outline import sector_outline
from trochoid.geometry.sphere_rim import RimShape
from trochoid.geometry.step import write_step
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.spherical_curve import foot_point
from trochoid.kinematics.types import Array

INNER, OUTER = 60e-3, 70e-3
TOOTH = EXAMPLES[5]  # 5 pins, 4 lobes
RIM = RimShape(TOOTH, math.radians(25.0))
_WEIGHTS = np.array([3.0, 3.0, 3.0, 8.0, 8.0, 8.0, 27.0]) / 120.0  # degree 3, at nodes and middle (Strang)


@dataclass(frozen=True)
class Reread:
    """A STEP file as gmsh reads it: `volumes` in it, volume (mm³) of its surface mesh, open edges of that, points (mm)
    on faces that are no spheres.
    """

    volumes: int
    volume: float
    open_edges: int
    points: Array


def reread(path: Path, size: float) -> Reread:
    """Mesh the surface by second-order triangles of a size in mm."""
    with gmsh_session() as gmsh:
        entities = gmsh.model.occ.importShapes(str(path))
        gmsh.model.occ.synchronize()
        gmsh.option.setNumber("Mesh.MeshSizeMax", size)
        gmsh.option.setNumber("Mesh.SecondOrderLinear", 0)
        gmsh.model.mesh.generate(2)
        gmsh.model.mesh.setOrder(2)
        tags, xyz, _ = gmsh.model.mesh.getNodes()
        order = np.argsort(tags)
        place = np.asarray(xyz).reshape(-1, 3)[order]
        _, found = gmsh.model.mesh.getElementsByType(9)
        points = []
        for _, face in gmsh.model.getEntities(2):
            if gmsh.model.getType(2, face) == "Sphere":
                continue
            low, high = gmsh.model.getParametrizationBounds(2, face)
            u, v = np.meshgrid(np.linspace(low[0], high[0], 61), np.linspace(low[1], high[1], 4))
            uv = np.stack([u.ravel(), v.ravel()], axis=1).ravel()
            points.append(np.asarray(gmsh.model.getValue(2, face, uv)).reshape(-1, 3))
    triangles = np.searchsorted(np.sort(tags), found).reshape(-1, 6)
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, count = np.unique(edges, axis=0, return_counts=True)
    return Reread(len(entities), _volume(place, triangles), int((count != 2).sum()), np.concatenate(points))


def _volume(place: Array, triangles: Array) -> float:
    """Gauss' theorem over quadratic triangles, six points (Dunavant)."""
    a, b = 0.445948490915965, 0.091576213509771
    x, y = np.array([[a, a], [1 - 2 * a, a], [a, 1 - 2 * a], [b, b], [1 - 2 * b, b], [b, 1 - 2 * b]]).T
    weight = 0.5 * np.repeat([0.223381589678011, 0.109951743655322], 3)
    z, o = 1.0 - x - y, 0.0 * x
    shape = np.stack([z * (2 * z - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * z * x, 4 * x * y, 4 * y * z])
    by_x = np.stack([1 - 4 * z, 4 * x - 1, o, 4 * (z - x), 4 * y, -4 * y])
    by_y = np.stack([1 - 4 * z, o, 4 * y - 1, -4 * x, 4 * x, 4 * (z - y)])
    r, rx, ry = (np.einsum("aq,mac->mqc", s, place[triangles]) for s in (shape, by_x, by_y))
    return float(np.sum(r * np.cross(rx, ry) * weight[:, None]) / 3.0)


@pytest.mark.exact
@pytest.mark.parametrize("tip", [None, math.radians(44.0)])
def test_rim(tmp_path: Path, tip: float | None) -> None:
    """One closed body of the volume of the mesh; the flanks of the file lie on the exact ones within the tolerance."""
    shape = RimShape(TOOTH, RIM.hub, tip)
    solid, path, tolerance = rim_solid(shape, INNER, OUTER), tmp_path / "rim.step", 1e-6
    write_step(solid, path, tolerance)
    mesh = mesh_sphere(sector_outline(shape, 32))
    angle = TOOTH.lobes * float(_WEIGHTS @ jacobians(mesh).sum(axis=1))
    meshed = angle * (OUTER**3 - INNER**3) / 3.0
    assert solid.volume == pytest.approx(meshed, rel=1e-4)
    found = reread(path, 4.0)
    assert (found.volumes, found.open_edges) == (1, 0)
    assert abs(found.volume) == pytest.approx(1e9 * meshed, rel=1e-3)
    assert {p.name for p in tmp_path.iterdir()} == {"rim.step"}
    rho = np.linalg.norm(found.points, axis=1)
    way = found.points / rho[:, None]
    polar = np.arccos(way[:, 2])
    off = np.abs(polar - shape.hub)
    if tip is not None:
        off = np.minimum(off, np.abs(polar - tip))
    flank = off > 1e-6
    assert flank.sum() > 200
    start = np.array([_nearest(w) for w in way[flank]])
    _, apart = foot_point(TOOTH, way[flank], start)
    assert np.abs(apart * rho[flank]).max() < 1e3 * tolerance


def _nearest(way: Array) -> float:
    p = np.linspace(0.0, 2.0 * math.pi, 721)
    return float(p[np.argmin(np.linalg.norm(TOOTH.point(p) - way, axis=1))])


@pytest.mark.exact
def test_slotted_wheel(tmp_path: Path) -> None:
    """The wheel's walls are parallels to great circles; closed, of its own volume; a quarter has no slot."""
    rim, bottom, hub, opening, swing = (math.radians(x) for x in (60.0, 45.0, 25.0, 4.0, 90.0))
    wheel = SlottedWheel(rim, bottom, hub, opening, swing, 3)
    solid, path = wheel_solid(wheel, INNER, OUTER), tmp_path / "wheel.step"
    write_step(solid, path)
    found = reread(path, 3.0)
    assert (found.volumes, found.open_edges) == (1, 0)
    assert abs(found.volume) == pytest.approx(1e9 * solid.volume, rel=1e-3)
    # rim less slots: the cap's zone, less 2·opening times the slots' lengths, to a few per cent
    zone = 2.0 * math.pi * (math.cos(wheel.hub) - math.cos(wheel.rim))
    slots = 3 * (2.0 * wheel.opening * (wheel.mouth - wheel.bottom) + 0.5 * math.pi * wheel.opening**2)
    assert solid.volume == pytest.approx((zone - slots) * (OUTER**3 - INNER**3) / 3.0, rel=3e-3)


@pytest.mark.property
def test_what_cannot_be_written_is_refused(tmp_path: Path) -> None:
    """A tolerance below rounding; a file that stands there is left as it was."""
    path = tmp_path / "rim.step"
    path.write_text("before")
    with pytest.raises(Infeasible, match="take a larger tolerance"):
        write_step(rim_solid(RIM, INNER, OUTER), path, 1e-16)
    assert path.read_text() == "before"
    corner = RaySolid((Trace(SphereTooth.point.__get__(TOOTH), 0.0, 1.0),), RIM.hub, INNER, OUTER)
    assert corner.volume > 0.0
