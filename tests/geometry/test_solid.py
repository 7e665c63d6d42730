"""Solid meshes: raised elements, places found by shape, files, and what is refused."""

from __future__ import annotations

from pathlib import Path

import meshio
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.solid_cases import bricks, grid
from trochoid.geometry.session import gmsh_session
from trochoid.geometry.solid_file import read_solid
from trochoid.geometry.solid_mesh import SolidMesh, solid_mesh
from trochoid.geometry.solid_places import Cylinder, Disc, Place, find, patch, place_nodes
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, IntArray

TETRAHEDRA = (
    (0, 1, 2, 6),
    (0, 2, 3, 6),
    (0, 5, 1, 6),
    (0, 4, 5, 6),
    (0, 3, 7, 6),
    (0, 7, 4, 6),
)  # of a brick


def _cut(counts: tuple[int, int, int]) -> tuple[Array, IntArray]:
    """Return the grid's bricks cut into tetrahedra."""
    points, cubes = grid(counts)
    return points, np.concatenate([cubes[list(four)] for four in TETRAHEDRA], axis=1)


def _area(mesh: SolidMesh) -> Array:
    """Return the vector sum over straight facets of area times outward normal, and the sum of their sizes."""
    corners = mesh.points[mesh.facets[: len(mesh.facets) // 2]]
    areas = 0.5 * np.cross(corners[1] - corners[0], corners[2] - corners[0])
    if len(corners) == 4:
        areas += 0.5 * np.cross(corners[2] - corners[0], corners[3] - corners[0])
    return np.append(areas.sum(axis=0), np.linalg.norm(areas, axis=1).sum())


@pytest.mark.property
@settings(max_examples=20, deadline=None)
@given(st.tuples(*[st.integers(1, 3)] * 3), st.booleans())
def test_straight_elements_are_raised(counts: tuple[int, int, int], tetrahedra: bool) -> None:
    """A cube's surface is closed and 6 m² whatever its mesh; nodes are the grid's corners and one per edge."""
    points, elements = _cut(counts) if tetrahedra else grid(counts)
    mesh = solid_mesh(points, elements)
    assert len(mesh.elements) == (10 if tetrahedra else 20)
    assert _area(mesh) == pytest.approx([0.0, 0.0, 0.0, 6.0], abs=1e-12)
    n, m = np.array(counts), np.array(counts) + 1
    edges = n[0] * m[1] * m[2] + m[0] * n[1] * m[2] + m[0] * m[1] * n[2]
    if tetrahedra:  # and a diagonal of each face and each brick
        edges += m[0] * n[1] * n[2] + n[0] * m[1] * n[2] + n[0] * n[1] * m[2] + n.prod()
    assert len(mesh.points) == m.prod() + edges == len(np.unique(mesh.points.round(9), axis=0))


@pytest.mark.exact
def test_sets_keep_their_nodes_and_gain_middles() -> None:
    """A face of 2 × 2 bricks given by its 9 corners becomes 21 nodes, all in its plane; unused points go."""
    points, elements = grid((2, 2, 2))
    points = np.concatenate([[[9.0, 9.0, 9.0]], points])
    face = np.flatnonzero(points[:, 2] == 0.0)
    mesh = solid_mesh(points, elements + 1, {"face": face})
    assert len(mesh.sets["face"]) == 21
    assert np.ptp(mesh.points[mesh.sets["face"], 2]) == 0.0
    assert mesh.points.max() == 1.0


def _tube(points: Array) -> Array:
    angle = 0.5 * np.pi * points[:, 1]
    radius = 0.2 + 0.1 * points[:, 0]
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.5 * points[:, 2]], axis=1)


@pytest.mark.exact
def test_places_are_found_by_shape() -> None:
    """A quarter of a tube: bore, outside, an end, and half of the bore by its span, however the body is turned."""
    mesh = bricks((2, 4, 4), _tube)
    turn, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    turn *= np.linalg.det(turn)
    turned = solid_mesh(mesh.points @ turn.T + [1.0, 2.0, 3.0], mesh.elements)
    start, axis = (1.0, 2.0, 3.0), tuple(3.0 * turn[:, 2])
    places: dict[str, Place] = {
        "bore": Cylinder(start, axis, 0.2),
        "half": Cylinder(start, axis, 0.2, (0.0, 0.25)),
        "outside": Cylinder(start, axis, 0.3),
        "end": Disc(start, axis),
        "off": Disc(start, axis, 0.26),
    }
    found = find(turned, places).sets
    radius = np.linalg.norm(mesh.points[:, :2], axis=1)
    assert {name: len(nodes) for name, nodes in found.items()} == {
        "bore": 3 * 4 * 4 + 2 * 4 + 2 * 4 + 1,
        "half": 3 * 4 * 2 + 2 * 4 + 2 * 2 + 1,
        "outside": 65,
        "end": 3 * 2 * 4 + 2 * 2 + 2 * 4 + 1,
        "off": 3 * 1 * 4 + 2 * 1 + 2 * 4 + 1,
    }
    assert radius[found["bore"]] == pytest.approx(0.2, rel=1e-12)
    assert mesh.points[found["half"], 2].max() == pytest.approx(0.25)


@pytest.mark.exact
def test_a_place_that_is_not_there_says_how_far() -> None:
    """A bore of 210 mm in one of 200 mm: named, with what is missing."""
    mesh = bricks((1, 4, 2), _tube)
    with pytest.raises(TrochoidError, match=r"bearing: no whole facet .* 10 mm off; check"):
        place_nodes(mesh, Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.21), "bearing")
    with pytest.raises(TrochoidError, match=r"single nodes do, .* the place ends within the facets"):
        place_nodes(mesh, Disc((0.2, 0.0, 0.0), (0.0, 0.0, 1.0), 0.01), "foot")
    with pytest.raises(TrochoidError, match=r"(?s)radius 210 mm .*low: no whole .* the body is between"):
        find(
            mesh,
            {
                "bearing": Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.21),
                "low": Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.2, (5.0, 6.0)),
            },
        )
    with pytest.raises(TrochoidError, match="must have a length"):
        place_nodes(mesh, Disc((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)))


@pytest.mark.exact
def test_patch() -> None:
    """By radius or the next facet, on the surface alone; a point off the body is refused."""
    mesh = bricks((3, 3, 3))
    assert (
        len(patch(mesh, (1.0 / 3.0, 1.0 / 3.0, 1.01), 0.2)) == 5
    )  # a corner and the middles of its four edges
    facet = mesh.points[patch(mesh, (1.0, 0.9, 0.9))]
    assert facet.min(axis=0) == pytest.approx([1.0, 2.0 / 3.0, 2.0 / 3.0])
    assert len(facet) == 8
    with pytest.raises(TrochoidError, match=r"527 mm from the body"):
        patch(mesh, (0.5, 0.5, 1.5))
    with pytest.raises(TrochoidError, match="only 1 node"):
        patch(mesh, (0.0, 0.0, 0.0), 0.01)


@pytest.mark.exact
def test_impossible_meshes_are_refused() -> None:
    """Turned inside out, two bodies, triangles."""
    points, elements = grid((2, 1, 1))
    with pytest.raises(TrochoidError, match="2 of 2 elements are flat or turned inside out"):
        solid_mesh(points * [-1.0, 1.0, 1.0], elements)
    apart = np.concatenate([points, points + 5.0]), np.concatenate([elements, elements + len(points)], axis=1)
    with pytest.raises(TrochoidError, match="2 bodies that share no nodes"):
        solid_mesh(*apart)
    with pytest.raises(TrochoidError, match="4, 8, 10 or 20"):
        solid_mesh(points, elements[:3])


@pytest.mark.independent
@pytest.mark.parametrize("order", [1, 2])
def test_gmsh_file_with_physical_groups(tmp_path: Path, order: int) -> None:
    """A cylinder of 30 mm written by gmsh in mm: read in m, its named groups as found by shape."""
    path = tmp_path / "cylinder.msh"
    with gmsh_session() as gmsh:
        gmsh.model.occ.addCylinder(0, 0, 0, 0, 0, 50, 30)
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(3, [1], name="body")
        gmsh.model.addPhysicalGroup(2, [1], name="seat")
        gmsh.option.setNumber("Mesh.MeshSizeMax", 15.0)
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(order)
        gmsh.write(str(path))
    mesh = read_solid(path, 1e-3, {"found": Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.03)})
    assert len(mesh.elements) == 10
    assert np.array_equal(mesh.sets["found"], mesh.sets["seat"])
    assert len(mesh.sets["body"]) == len(mesh.points)
    radius = np.linalg.norm(mesh.points[mesh.sets["seat"], :2], axis=1)
    assert radius.max() == pytest.approx(0.03, rel=1e-9)
    assert (radius.min() > 0.03 * (1 - 1e-9)) == (order == 2)


@pytest.mark.property
@pytest.mark.parametrize("ending", ["vtu", "inp", "msh"])
@pytest.mark.parametrize("kind", ["hexahedron20", "hexahedron", "tetra"])
def test_files_keep_the_mesh(tmp_path: Path, ending: str, kind: str) -> None:
    """What meshio writes comes back: points, elements, a set of nodes where the format has them."""
    points, elements = _cut((2, 1, 1)) if kind == "tetra" else grid((2, 1, 1))
    expected = solid_mesh(points, elements)
    if kind == "hexahedron20":
        points, elements = expected.points, expected.elements
    sets = {"end": np.flatnonzero(points[:, 0] == 0.0)}
    written = meshio.Mesh(1e3 * points, [(kind, elements.T)], point_sets=sets if ending == "inp" else None)
    path = tmp_path / f"body.{ending}"
    meshio.write(path, written, file_format={"inp": "abaqus", "msh": "gmsh", "vtu": "vtu"}[ending])
    found = read_solid(path, 1e-3)
    assert found.points == pytest.approx(expected.points, abs=1e-12)
    assert np.array_equal(found.elements, expected.elements)
    if ending == "inp":
        assert found.points[found.sets["end"], 0] == pytest.approx(0.0)


@pytest.mark.exact
def test_files_that_do_not_serve_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A surface alone, wedges, two kinds, no such file, an unknown ending, a scale of zero."""
    points, cubes = grid((2, 1, 1))
    shapes = {
        "surface": [("quad", cubes[:4].T)],
        "wedge": [("wedge", cubes[:6].T)],
        "mixed": [("hexahedron", cubes[:, :1].T), ("tetra", cubes[[0, 1, 3, 4], 1:].T)],
    }
    for name, cells in shapes.items():
        meshio.write(tmp_path / f"{name}.vtu", meshio.Mesh(points, cells))
    for name, said in (("surface", "no solid elements"), ("wedge", "one kind"), ("mixed", "one kind")):
        with pytest.raises(TrochoidError, match=said):
            read_solid(tmp_path / f"{name}.vtu")
    with pytest.raises(TrochoidError, match="no such file"):
        read_solid(tmp_path / "none.vtu")
    (tmp_path / "empty.msh").write_text("")
    with pytest.raises(TrochoidError, match="holds no volume elements"):
        read_solid(tmp_path / "empty.msh")
    meshio.write(tmp_path / "cells.vtk", meshio.Mesh(points, []))
    with pytest.raises(TrochoidError, match="it holds no elements, is damaged"):
        read_solid(tmp_path / "cells.vtk")
    with pytest.raises(TrochoidError, match="is a folder"):
        read_solid(tmp_path)
    lost = np.where(np.arange(len(points))[:, None] == 1, np.nan, points)
    meshio.write(tmp_path / "lost.vtu", meshio.Mesh(lost, [("tetra", [[0, 1, 2, 3]])]))
    with pytest.raises(TrochoidError, match=r"1 of .* nodes have coordinates that are no numbers"):
        read_solid(tmp_path / "lost.vtu")
    (tmp_path / "body.xyz1").write_text("no mesh")
    with pytest.raises(TrochoidError, match=r"format|cannot be read"):
        read_solid(tmp_path / "body.xyz1")
    (tmp_path / "body.msh").write_text("no mesh")
    with pytest.raises(TrochoidError, match="cannot be read"):
        read_solid(tmp_path / "body.msh")
    (tmp_path / "body.vtu").write_text("<no mesh")
    with pytest.raises(TrochoidError, match="cannot be read"):
        read_solid(tmp_path / "body.vtu")
    with pytest.raises(TrochoidError, match="scale"):
        read_solid(tmp_path / "surface.vtu", 0.0)
    assert capsys.readouterr() == ("", "")  # meshio prints on its own account
