"""What the fields of [casing] demand of each other, in the raw scene: a rigid casing its mass, an elastic one its body.

An elastic casing is meshed from the measures of a box or read from a file; every place where the drive presses it is
held by one bore, or shared by two.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeAlias

from trochoid.faults import Key, listed, meant, nearest, quoted, sentence
from trochoid.scene import units
from trochoid.scene.casing import Bore, Casing, Mount
from trochoid.scene.fields import Measure, Table
from trochoid.scene.materials import PREDEFINED
from trochoid.scene.needs import SEATS_OF
from trochoid.scene.reading import read

Found: TypeAlias = tuple[Key, str]

MASS, INERTIA = (Measure(family, above=0.0).allowed for family in (units.MASS, units.INERTIA))
LENGTH = Measure(units.LENGTH, above=0.0).allowed
OF_ELASTIC = ("material", "damping_ratio", "mesh_edge", "mesh_file", "mesh_unit", "box", "bores")
OF_MOUNTS = ("name", "radius", "normal", "set")
OF_RIGID = ("mass", "inertia", "center")
OF_BOX = {"bores": ("wall", "radius", "boss", "length"), "mounts": ("radius",)}
OF_FILE = {"bores": ("set", "point", "direction", "span"), "mounts": ("set", "normal")}
BY_SHAPE = {"bores": ("point", "direction", "radius"), "mounts": ("normal", "radius")}
NOT_IN_FILE = {"bores": ("wall", "boss", "length", "x", "y"), "mounts": ()}
MODELS: dict[str, type[Table]] = {"bores": Bore, "mounts": Mount}
FREQUENCIES = "casing_frequencies"  # the part of vibration_velocity that has no point's name


def casing_faults(raw: Mapping[str, Any], kind: str | None) -> Iterator[Found]:
    """Yield (key, message) for every demand that is not met; wrong types are left to the field checks."""
    casing = raw.get("casing")
    if not isinstance(casing, Mapping):
        return
    if casing.get("elastic") is not True:
        yield from _rigid(casing)
        return
    for key in OF_RIGID:
        if key in casing:
            yield (
                ("casing", key),
                "an elastic casing has it from its body; take it away, or take elastic = true away",
            )
    yield from _body(casing, raw)
    yield from _names(casing)
    if ("box" in casing) != ("mesh_file" in casing):
        for what in ("bores", "mounts"):
            for i, item in _items(casing, what):
                yield from _place(("casing", what, i), item, what, "box" in casing)
    if kind in SEATS_OF:
        yield from _seats(casing, kind, needed(kind, raw))
    if not casing.get("points"):
        yield (
            ("casing", "points"),
            "an elastic casing is read on its surface: need at least one [[casing.points]]",
        )
    for i, item in _items(casing, "points"):
        if item.get("name") == FREQUENCIES:
            yield (
                ("casing", "points", i, "name"),
                f"{quoted(FREQUENCIES)} has another meaning in the results; take another",
            )


def _rigid(casing: Mapping[str, Any]) -> Iterator[Found]:
    for key, allowed in (("mass", MASS), ("inertia", f"a list of 3, each {INERTIA}")):
        if _lacks(casing, key, Casing):
            yield ("casing", key), f"missing; need {allowed}"
    said = "only an elastic casing has it: add elastic = true to [casing], or take it away"
    for key in OF_ELASTIC:
        if key in casing:
            yield ("casing", key), said
    for i, item in _items(casing, "mounts"):
        for key in OF_MOUNTS:
            if key in item:
                yield ("casing", "mounts", i, key), said


def _body(casing: Mapping[str, Any], raw: Mapping[str, Any]) -> Iterator[Found]:
    """Yield what is wrong with box or file, material and damping."""
    if "box" in casing and "mesh_file" in casing:
        yield (
            ("casing", "mesh_file"),
            "an elastic casing is a box or read from a file: take one of the two away",
        )
    if _lacks(casing, "box", Casing) and _lacks(casing, "mesh_file", Casing):
        yield ("casing", "elastic"), "an elastic casing needs the table [casing.box] or a mesh_file"
    foreign = ("mesh_edge",) if "mesh_file" in casing else ("mesh_unit",)
    for key in foreign:
        if key in casing:
            yield (
                ("casing", key),
                f"only a casing {'of a box' if key == 'mesh_edge' else 'from a file'} has it; take it away",
            )
    file = casing.get("mesh_file")
    if isinstance(file, str) and not Path(file).is_file():
        found = "a folder, not the file of a mesh" if Path(file).is_dir() else "no such file"
        yield ("casing", "mesh_file"), f"{found}: {quoted(file)}; its place is relative to the scene's"
    if _lacks(casing, "damping_ratio", Casing):
        ratio = "a number, e.g. 0.01; of 0 or more and less than 1"
        yield ("casing", "damping_ratio"), f"missing; need the damping ratio of elastic modes, {ratio}"
    materials = raw.get("materials")
    known = sorted({*PREDEFINED, *(materials if isinstance(materials, Mapping) else ())})
    name = casing.get("material")
    if isinstance(name, str) and name not in known:
        yield (
            ("casing", "material"),
            f"no material {quoted(name)}; {sentence(meant(name, known))} Or add the table [materials.{name}]",
        )


def _names(casing: Mapping[str, Any]) -> Iterator[Found]:
    """Yield mounts without a name, and names that stand twice."""
    seen: set[str] = set()
    for what in ("bores", "mounts"):
        for i, item in _items(casing, what):
            name = item.get("name")
            if what == "mounts" and _lacks(item, "name", Mount):
                yield (
                    ("casing", what, i, "name"),
                    "missing; need the name of the place on an elastic casing, a text",
                )
            if isinstance(name, str) and name in seen:
                yield (
                    ("casing", what, i, "name"),
                    f"{quoted(name)} stands twice among bores and mounts; take another",
                )
            if isinstance(name, str):
                seen.add(name)


def _place(key: Key, item: Mapping[str, Any], what: str, box: bool) -> Iterator[Found]:
    """Yield what is missing of, or foreign to, where a bore or a mount is on the body."""
    wanted, foreign = (OF_BOX, OF_FILE) if box else ({}, NOT_IN_FILE)
    for name in foreign[what]:
        if name in item:
            kind = "from a file" if box else "of a box"
            yield (*key, name), f"only a casing {kind} has it; take it away"
    for name in wanted.get(what, ()):
        if _lacks(item, name, MODELS[what]):
            allowed = 'one of "low", "high"' if name == "wall" else LENGTH
            yield (*key, name), f"missing; in a box casing, need {allowed}"
    if box:
        return
    shape = BY_SHAPE[what]
    given = [name for name in shape if name in item]
    if "set" in item:
        for name in (*given, *(("span",) if "span" in item else ())):
            yield (*key, name), "the place is a set of the mesh file's: take this away, or set"
    elif len(given) < len(shape):
        missing = next(name for name in shape if name not in item)
        at = "its position, " if what == "mounts" else ""
        yield (
            (*key, missing),
            f"missing; in a casing from a file a place is a set by name, or found by {at}{' and '.join(shape)}",
        )


def needed(kind: str, raw: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the places of the drive that bores must hold: all, but those of planetary members that float."""
    drive, effects = raw.get("drive"), raw.get("effects")
    if kind != "planetary" or not isinstance(drive, Mapping):
        return SEATS_OF[kind]
    listed_ = effects if isinstance(effects, list) else []
    if not any(isinstance(e, Mapping) and e.get("type") == "bearing_compliance" for e in listed_):
        return SEATS_OF[kind]
    return tuple(n for n in SEATS_OF[kind] if n == drive.get("fixed", "ring") or not _floats(drive, n))


def _floats(drive: Mapping[str, Any], name: str) -> bool:
    table = drive.get(name)
    given = table.get("bearing_stiffness") if isinstance(table, Mapping) else None
    if given is None:
        return name == "sun"
    with suppress(ValueError):
        return read(given, units.STIFFNESS) == 0.0
    return False


def _seats(casing: Mapping[str, Any], kind: str, must: tuple[str, ...]) -> Iterator[Found]:
    """Yield bores that hold no place of the drive, and places that no bore holds, or too many."""
    known, count = SEATS_OF[kind], dict.fromkeys(SEATS_OF[kind], 0)
    wrong = False
    for i, bore in _items(casing, "bores"):
        holds = bore.get("holds") or [bore.get("name")]
        for j, name in enumerate(holds if isinstance(holds, list) else ()):
            key: Key = (
                ("casing", "bores", i, "holds", j) if bore.get("holds") else ("casing", "bores", i, "name")
            )
            if not isinstance(name, str):
                wrong = True
            elif name not in count:
                wrong = True
                own = "" if bore.get("holds") else "; or say with holds = [...] what it holds"
                yield (
                    key,
                    f"{quoted(name)} is no place where {kind} drives press a casing; they have {listed(known)}{own}",
                )
            else:
                count[name] += 1
                if count[name] > 2:
                    yield key, f"{quoted(name)} is held a third time; at most two bores share it"
    left = [name for name in must if not count[name]]
    if left and not wrong:
        yield (
            ("casing", "bores"),
            f"no bore holds {listed(left)}, where the drive presses its casing; add [[casing.bores]] with such a name, "
            "or put it into the holds of one",
        )


def _lacks(table: Mapping[str, Any], name: str, model: type[Table]) -> bool:
    """Return whether a key is missing, and no unknown key was meant to be it: that fault is named once."""
    known = tuple(model.model_fields)
    return name not in table and all(nearest(str(key), known) != name for key in table if key not in known)


def _items(table: Mapping[str, Any], name: str) -> list[tuple[int, Mapping[str, Any]]]:
    items = table.get(name)
    return [(i, x) for i, x in enumerate(items) if isinstance(x, Mapping)] if isinstance(items, list) else []
