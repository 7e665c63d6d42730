"""Films as VTK files: a .vtu per body and frame, and a .pvd that collects them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from trochoid.kinematics.types import Array
from trochoid.results.film import Field, Film

ENDING = ".pvd"


def save(film: Film, folder: Path) -> None:
    """Write `<film>/<body>_<frame>.vtu` and `<film>.pvd`, with the axis as time: angles in degrees."""
    (folder / film.name).mkdir()
    collection: list[dict[str, str]] = []
    for index, (value, bodies) in enumerate(film.frames):
        time = math.degrees(value) if film.axis.units == "rad" else value
        for part, body in enumerate(bodies):
            name = f"{film.name}/{_file_name(body.name)}_{index:03d}.vtu"
            save_body(body, folder / name)
            collection.append({"timestep": repr(round(time, 9)), "part": str(part), "file": name})
    _save_collection(collection, folder / f"{film.name}{ENDING}")


def save_body(body: Field, path: Path) -> None:
    """Write one body: its nodes, cells and nodal data (float64, SI)."""
    import meshio

    cells: list[tuple[str, Any]] = [(body.shape, np.ascontiguousarray(body.cells.T))]
    data = {name: _columns(name, values) for name, values in body.point_data.items()}
    mesh = meshio.Mesh(_padded(body.points), cells, point_data=data)
    meshio.vtu.write(str(path), mesh, binary=True, compression=None)


def saved(folder: Path) -> Iterator[Path]:
    """Yield the collections in a folder that are ours, and the .vtu files that they name."""
    for collection in sorted(folder.glob(f"*{ENDING}")):
        files = listed_files(collection)
        if files:
            yield collection
            yield from files


def listed_files(collection: Path) -> tuple[Path, ...]:
    """Return the .vtu files that a .pvd of ours names, in the folder of its name; none if it is not ours."""
    try:
        sets = ElementTree.parse(collection).getroot().iter("DataSet")
    except (OSError, ElementTree.ParseError):
        return ()
    names = {entry.get("file", "") for entry in sets}
    ours = re.compile(rf"{re.escape(collection.stem)}/[^/\\]+\.vtu")
    return tuple(sorted(collection.parent / name for name in names if ours.fullmatch(name)))


def _columns(name: str, values: Array) -> Array:
    """Return nodal values as VTK knows them: scalar, vector of 3, symmetric tensor xx yy zz xy yz xz."""
    array = np.asarray(values, dtype=np.float64)
    if array.ndim == 1:
        return array
    if name == "stress":
        if array.shape[1] not in (4, 6):
            raise ValueError(
                f"stress has {array.shape[1]} components; it needs xx yy zz xy (4) or xx yy zz xy yz xz (6)"
            )
        return np.hstack([array, np.zeros((len(array), 6 - array.shape[1]))])
    return _padded(array) if array.shape[1] == 2 else array


def _padded(vectors: Array) -> Array:
    array = np.asarray(vectors, dtype=np.float64)
    return array if array.shape[1] == 3 else np.column_stack([array, np.zeros(len(array))])


def _save_collection(entries: Sequence[dict[str, str]], path: Path) -> None:
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1", byte_order="LittleEndian")
    collection = ElementTree.SubElement(root, "Collection")
    for entry in entries:
        ElementTree.SubElement(
            collection,
            "DataSet",
            timestep=entry["timestep"],
            group="",
            part=entry["part"],
            file=entry["file"],
        )
    ElementTree.indent(root)
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def _file_name(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9-]+", "_", name).strip("_") or "body"
