"""Films as VTK files: a .vtu per body and frame, and a .pvd that collects them and says how to look at them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from trochoid.results.film import Film
from trochoid.results.vtu import save_body

__all__ = ["ENDING", "Listed", "Listing", "listed_files", "listing", "save", "save_body", "saved"]

ENDING = ".pvd"
_DEGREES = "deg"


@dataclass(frozen=True, slots=True)
class Listed:
    """A body in a .pvd of ours."""

    name: str
    path: Path
    color: str
    opacity: float


@dataclass(frozen=True, slots=True)
class Listing:
    """What a .pvd of ours says of its film: `frames` are values, in `units`, and bodies."""

    title: str
    axis: str
    units: str
    shown: str
    spatial: bool
    seen_from: tuple[float, ...]
    frames: tuple[tuple[float, tuple[Listed, ...]], ...]


def save(film: Film, folder: Path) -> None:
    """Write `<film>/<body>_<frame>.vtu` and `<film>.pvd`, with the axis as time: angles in degrees."""
    (folder / film.name).mkdir()
    collection: list[dict[str, str]] = []
    for index, (value, bodies) in enumerate(film.frames):
        time = math.degrees(value) if film.axis.units == "rad" else value
        for part, body in enumerate(bodies):
            name = f"{film.name}/{_file_name(body.name)}_{index:03d}.vtu"
            save_body(body, folder / name)
            look = {"color": body.color, "opacity": f"{body.opacity:g}"} if film.spatial else {}
            entry = {"timestep": repr(round(time, 9)), "part": str(part), "name": body.name, **look}
            collection.append({**entry, "file": name})
    _save_collection(film, collection, folder / f"{film.name}{ENDING}")


def saved(folder: Path) -> Iterator[Path]:
    """Yield the collections in a folder that are ours, and the .vtu files that they name."""
    for collection in sorted(folder.glob(f"*{ENDING}")):
        files = listed_files(collection)
        if files:
            yield collection
            yield from files


def listed_files(collection: Path) -> tuple[Path, ...]:
    """Return the .vtu files that a .pvd of ours names, in the folder of its name; none if it is not ours."""
    root = _root(collection)
    return () if root is None else tuple(sorted({body.path for _, body in _entries(root, collection)}))


def listing(collection: Path) -> Listing:
    """Return what a .pvd of ours says, also one of an earlier version, which names no bodies.

    Raises ValueError where it is not ours.
    """
    root = _root(collection)
    entries = () if root is None else tuple(_entries(root, collection))
    if root is None or not entries:
        raise ValueError(f"{collection} lists no film of ours")
    frames: dict[float, list[Listed]] = {}
    for time, body in entries:
        frames.setdefault(time, []).append(body)
    head = root.find("Collection")
    said = {} if head is None else head.attrib
    return Listing(
        title=said.get("title", collection.stem),
        axis=said.get("axis", "input angle"),
        units=said.get("units", _DEGREES),
        shown=said.get("shown", "von_mises"),
        spatial=said.get("spatial") == "1",
        seen_from=tuple(float(x) for x in said.get("seen_from", "1 -1 0.7").split()),
        frames=tuple((time, tuple(bodies)) for time, bodies in frames.items()),
    )


def _root(collection: Path) -> ElementTree.Element | None:
    try:
        return ElementTree.parse(collection).getroot()
    except (OSError, ElementTree.ParseError):
        return None


def _entries(root: ElementTree.Element, collection: Path) -> Iterator[tuple[float, Listed]]:
    """Yield times and bodies of the data sets in the folder of the collection's name."""
    ours = re.compile(rf"{re.escape(collection.stem)}/([^/\\]+)\.vtu")
    for entry in root.iter("DataSet"):
        found = ours.fullmatch(entry.get("file", ""))
        if found:
            name = entry.get("name") or found[1].rpartition("_")[0].replace("_", " ")
            look = entry.get("color", "#b0c4de"), float(entry.get("opacity", "1"))
            yield (
                float(entry.get("timestep", "0")),
                Listed(name, collection.parent / entry.get("file", ""), *look),
            )


def _save_collection(film: Film, entries: Sequence[dict[str, str]], path: Path) -> None:
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1", byte_order="LittleEndian")
    collection = ElementTree.SubElement(
        root,
        "Collection",
        title=film.title,
        axis=film.axis.name,
        units=_DEGREES if film.axis.units == "rad" else film.axis.units,
        shown=film.shown,
        spatial=str(int(film.spatial)),
        seen_from=" ".join(f"{x:g}" for x in film.seen_from),
    )
    for entry in entries:
        ElementTree.SubElement(collection, "DataSet", {**entry, "group": ""})
    ElementTree.indent(root)
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def _file_name(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9-]+", "_", name).strip("_") or "body"
