"""One body as a VTK file of unstructured cells: its arrays as they are in memory, after a few lines of XML."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

from trochoid.results.film import Field, Floats, Shape

CELL_TYPES: dict[Shape, int] = {
    "triangle": 5,
    "triangle6": 22,
    "quad8": 23,
    "tetra10": 24,
    "hexahedron20": 25,
    "wedge15": 26,
}
_NAMES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "u1": "UInt8"}


def save_body(body: Field, path: Path) -> None:
    """Write one body: its nodes, cells and nodal data in SI, as float64 but for arrays given as float32."""
    count = body.cells.shape[1]
    arrays: list[npt.NDArray[np.generic]] = []
    root = ElementTree.Element(
        "VTKFile", type="UnstructuredGrid", version="1.0", byte_order="LittleEndian", header_type="UInt64"
    )
    grid = ElementTree.SubElement(root, "UnstructuredGrid")
    piece = ElementTree.SubElement(
        grid, "Piece", NumberOfPoints=str(len(body.points)), NumberOfCells=str(count)
    )
    _add(ElementTree.SubElement(piece, "Points"), "Points", _padded(body.points), arrays)
    cells = ElementTree.SubElement(piece, "Cells")
    _add(cells, "connectivity", body.cells.T.astype("<i4").ravel(), arrays)
    _add(cells, "offsets", len(body.cells) * np.arange(1, count + 1, dtype="<i4"), arrays)
    _add(cells, "types", np.full(count, CELL_TYPES[body.shape], dtype="u1"), arrays)
    data = ElementTree.SubElement(piece, "PointData")
    for name, values in body.point_data.items():
        _add(data, name, _columns(name, values), arrays)
    appended = ElementTree.SubElement(root, "AppendedData", encoding="raw")
    appended.text = "_"
    head, _, tail = ElementTree.tostring(root, encoding="utf-8", xml_declaration=True).partition(
        b">_</AppendedData>"
    )
    with path.open("wb") as file:
        file.write(head + b">_")
        for array in arrays:
            file.write(np.uint64(array.nbytes).astype("<u8").tobytes())
            file.write(np.ascontiguousarray(array).tobytes())
        file.write(b"\n</AppendedData>" + tail)


def _add(
    parent: ElementTree.Element,
    name: str,
    values: npt.NDArray[np.generic],
    arrays: list[npt.NDArray[np.generic]],
) -> None:
    """Announce an array where it will stand: after all before it, each with 8 bytes that say how long it is."""
    ElementTree.SubElement(
        parent,
        "DataArray",
        type=_NAMES[values.dtype.str[1:]],
        Name=name,
        NumberOfComponents=str(values.shape[1] if values.ndim > 1 else 1),
        format="appended",
        offset=str(sum(8 + array.nbytes for array in arrays)),
    )
    arrays.append(values)


def _columns(name: str, values: Floats) -> Floats:
    """Return nodal values as VTK knows them: scalar, vector of 3, symmetric tensor xx yy zz xy yz xz."""
    array = _floats(values)
    if array.ndim == 1:
        return array
    if name == "stress":
        if array.shape[1] not in (4, 6):
            raise ValueError(
                f"stress has {array.shape[1]} components; it needs xx yy zz xy (4) or xx yy zz xy yz xz (6)"
            )
        return np.hstack([array, np.zeros((len(array), 6 - array.shape[1]), array.dtype)])
    return _padded(array) if array.shape[1] == 2 else array


def _padded(vectors: Floats) -> Floats:
    array = _floats(vectors)
    return array if array.shape[1] == 3 else np.column_stack([array, np.zeros(len(array), array.dtype)])


def _floats(values: Floats) -> Floats:
    """Return values as float32 where they are, as float64 otherwise, little-endian."""
    return np.asarray(values, dtype="<f4" if values.dtype == np.float32 else "<f8")
