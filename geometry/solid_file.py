"""Solid meshes from files: whatever meshio reads, its named groups as sets of nodes."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from trochoid.geometry.solid_mesh import SolidMesh, solid_mesh
from trochoid.geometry.solid_places import Place, find
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import IntArray

if TYPE_CHECKING:
    import meshio

SOLIDS = {"tetra": 4, "tetra10": 10, "hexahedron": 8, "hexahedron20": 20}
EMPTY = "holds no volume elements; write the body's mesh of tetrahedra or bricks"
NOT_READ = ("wedge", "pyramid", "hexahedron27", "hexahedron24", "tetra20", "polyhedron")


def read_solid(path: Path | str, scale: float = 1.0, places: Mapping[str, Place] | None = None) -> SolidMesh:
    """Read a mesh of tetrahedra or bricks, of 4, 8, 10 or 20 nodes; `scale` metres are one unit of the file.

    Sets of nodes are gmsh's named physical groups, named sets of points (Abaqus' NSET) or of cells, and `places` found
    by their shape (m).  Raises TrochoidError for a file that cannot be read, without solid elements, or with several
    kinds of them.
    """
    mesh = _read(path)
    if not scale > 0.0:
        raise TrochoidError(f"scale must be above 0 metres per unit of the file, given {scale}")
    if not len(mesh.points) or not any(len(block.data) for block in mesh.cells):
        raise TrochoidError(f"{path} {EMPTY}")
    kind = _one_kind(path, mesh)
    if not np.isfinite(mesh.points).all():
        raise TrochoidError(
            f"{path}: {int((~np.isfinite(mesh.points)).any(axis=1).sum())} of {len(mesh.points)} nodes have "
            "coordinates that are no numbers; write the mesh again"
        )
    elements = np.concatenate([block.data for block in mesh.cells if block.type == kind]).T
    found = solid_mesh(scale * mesh.points, elements.astype(np.intp), _sets(mesh))
    return find(found, places) if places else found


def _read(path: Path | str) -> meshio.Mesh:
    import meshio

    if Path(path).is_dir():
        raise TrochoidError(f"{path} is a folder; give the file of the mesh")
    if not Path(path).is_file():
        raise TrochoidError(f"{path}: no such file; give the file of the mesh")
    if not Path(path).stat().st_size:
        raise TrochoidError(f"{path} is empty; it {EMPTY}")
    if not Path(path).name.lower().endswith(tuple(meshio.extension_to_filetypes)):
        raise TrochoidError(
            f"{path}: no format of a mesh has this ending; give one that meshio knows, as .msh or .inp"
        )
    # meshio prints what its readers miss, and ends the program where none understands the file
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            return meshio.read(path)
    except (Exception, SystemExit) as fault:
        raise TrochoidError(
            f"{path}: the mesh cannot be read: it holds no elements, is damaged, or is in another format than its name "
            "says; write a volume mesh of tetrahedra or bricks in a format that meshio knows"
        ) from fault


def _one_kind(path: Path | str, mesh: meshio.Mesh) -> str:
    kinds = {block.type for block in mesh.cells if len(block.data)}
    solids = sorted(kinds & SOLIDS.keys())
    others = sorted(kind for kind in kinds if kind.startswith(NOT_READ))
    if others or len(solids) > 1:
        raise TrochoidError(
            f"{path} has {', '.join(solids + others)}: a body must be of one kind, {', '.join(SOLIDS)}; mesh it with "
            "tetrahedra alone"
        )
    if not solids:
        raise TrochoidError(
            f"{path} has {', '.join(sorted(kinds)) or 'no elements'}: no solid elements ({', '.join(SOLIDS)}); "
            "write the volume mesh, not the surface alone"
        )
    return str(solids[0])


def _sets(mesh: meshio.Mesh) -> dict[str, IntArray]:
    """Return the nodes of all named groups."""
    sets: dict[str, list[IntArray]] = {}
    for name, nodes in mesh.point_sets.items():
        sets.setdefault(name, []).append(np.asarray(nodes, dtype=np.intp))
    for name, blocks in mesh.cell_sets.items():
        if name.startswith("gmsh:"):
            continue  # its bookkeeping, not names of a user
        for block, chosen in zip(mesh.cells, blocks, strict=True):
            if chosen is not None and len(chosen):
                sets.setdefault(name, []).append(np.unique(block.data[chosen]))
    tags = mesh.cell_data.get("gmsh:physical")
    for name, (tag, dimension) in mesh.field_data.items():
        for block, tagged in zip(mesh.cells, tags or (), strict=False):
            if block.dim == dimension and (tagged == tag).any():
                sets.setdefault(name, []).append(np.unique(block.data[tagged == tag]))
    return {name: np.unique(np.concatenate(parts)) for name, parts in sets.items()}
