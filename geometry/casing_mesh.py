"""The box casing meshed with quadratic tetrahedra by gmsh."""

from __future__ import annotations

from types import ModuleType

import numpy as np

from trochoid.geometry.casing_box import (
    BoxCasing,
    casing_places,
    inner_face,
    mount_center,
    outer_face,
)
from trochoid.geometry.casing_limits import fail_if_impossible
from trochoid.geometry.session import gmsh_session
from trochoid.geometry.solid_mesh import EDGES, SolidMesh, solid_mesh
from trochoid.geometry.solid_places import find
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.types import Array, IntArray

COARSE = 1.5  # walls: the length of edges that is taken when none is given
ROUND = 16.0  # elements round a bore or a mount place
UPRIGHT = 0.05  # least Jacobian of an element over its largest, below which it counts as folded
ROUNDS = 5  # a straight edge may fold what lies beside it
TETRAHEDRON = 11  # gmsh's number of the kind with ten nodes
TO_VTK = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]  # gmsh has its last two middles the other way round


def mesh_casing(casing: BoxCasing, edge: float | None = None) -> SolidMesh:
    """Return the mesh of a casing with edges of about `edge` m (None: 1.5 walls), finer round bores and mounts.

    The nodes of every bore's seat and every mount place are a set of its name.  Raises Infeasible for measures that
    cannot be, TrochoidError when gmsh fails.
    """
    fail_if_impossible(casing)
    longest = COARSE * casing.wall if edge is None else edge
    if not longest > 0.0:
        raise Infeasible(f"casing: edges of the mesh must be longer than 0, given {longest} m")
    with gmsh_session() as gmsh:
        try:
            _add_volume(gmsh, casing)
            for option, value in (
                ("MeshSizeMax", longest),
                ("MeshSizeFromCurvature", ROUND),
                ("ElementOrder", 2.0),
            ):
                gmsh.option.setNumber(f"Mesh.{option}", value)
            gmsh.model.mesh.generate(3)
            _straighten(gmsh)
        except Exception as error:  # gmsh raises bare exceptions
            raise TrochoidError(
                f"gmsh could not mesh the casing ({error}); try another edge length"
            ) from error
        points, elements = _arrays(gmsh)
    return find(solid_mesh(points, elements), casing_places(casing))


def _add_volume(gmsh: ModuleType, casing: BoxCasing) -> None:
    occ = gmsh.model.occ
    low, high, wall = np.array(casing.low), np.array(casing.high), casing.wall
    body = [(3, occ.addBox(*low, *(high - low)))]
    reach = np.array([casing.flange[0], 0.0, casing.flange[1]])
    if reach.any():
        side = high - low + 2.0 * reach
        plate = (3, occ.addBox(*(low - reach), side[0], casing.plate, side[2]))
        body, _ = occ.fuse(body, [plate])
    hollow_low = low + np.array([wall, casing.plate, wall])
    body, _ = occ.cut(body, [(3, occ.addBox(*hollow_low, *(high - wall - hollow_low)))])
    ends = [(bore, outer_face(casing, bore), inner_face(casing, bore)) for bore in casing.bores]
    bosses = [(3, occ.addCylinder(b.x, b.y, start, 0.0, 0.0, end - start, b.boss)) for b, start, end in ends]
    if bosses:
        body, _ = occ.fuse(body, bosses)
        holes = [
            (3, occ.addCylinder(b.x, b.y, start, 0.0, 0.0, end - start, b.radius)) for b, start, end in ends
        ]
        body, _ = occ.cut(body, holes)
    discs = []
    for mount in casing.mounts:
        disc = occ.addDisk(*mount_center(casing, mount), mount.radius, mount.radius, zAxis=[0.0, 1.0, 0.0])
        discs.append((2, disc))
    if discs:
        body, _ = occ.fragment(body, discs)
    occ.synchronize()
    solids = gmsh.model.getEntities(3)
    if len(solids) != 1:
        raise TrochoidError(f"the measures leave {len(solids)} bodies")


def _straighten(gmsh: ModuleType) -> None:
    """Draw edges straight where curved elements fold: a boss that is thinner than its facets bulge.

    gmsh's own optimisation of curved meshes ends the process where it fails.
    """
    mesh = gmsh.model.mesh
    tags, nodes = mesh.getElementsByType(TETRAHEDRON)
    for _ in range(ROUNDS):
        folded = np.array(mesh.getElementQualities(tags, "minSJ")) < UPRIGHT
        if not folded.any():
            return
        for element in nodes.reshape(-1, 10)[folded]:
            place = [mesh.getNode(node)[0] for node in element[:4]]
            for node, (a, b) in zip(element[TO_VTK][4:], EDGES[10], strict=True):
                mesh.setNode(node, 0.5 * (place[a] + place[b]), [])


def _arrays(gmsh: ModuleType) -> tuple[Array, IntArray]:
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    _, nodes = gmsh.model.mesh.getElementsByType(TETRAHEDRON)
    order = np.argsort(tags)
    elements = np.searchsorted(tags[order], nodes).reshape(-1, 10).T[TO_VTK]
    return xyz.reshape(-1, 3)[order], elements.astype(np.intp)
