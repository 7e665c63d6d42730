"""What tables of a scene demand of each other, found in the raw scene: single wrong fields do not hide it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any, TypeAlias

from trochoid.faults import Key, listed, meant, nearest, quoted, sentence, shown
from trochoid.scene import units
from trochoid.scene.casing_faults import casing_faults
from trochoid.scene.effects import EFFECTS
from trochoid.scene.materials import PREDEFINED
from trochoid.scene.needs import (
    EFFECTS_OF,
    ELASTIC_MODELS,
    FRICTION_OF,
    KINDS,
    LOADED,
    MESHLESS,
    MODELS_OF,
    NEEDS,
    NO_FLANK,
    NOT_WITH_SPRINGS,
    QUANTITIES,
    ROLLING_OF,
    UNDER_TORQUE,
)
from trochoid.scene.reading import read

Found: TypeAlias = tuple[Key, str]


def faults(raw: Mapping[str, Any]) -> Iterator[Found]:
    """Yield (key, message) for every demand that is not met; wrong types are left to the field checks."""
    drive = _table(raw, "drive")
    effects = _effects(raw)
    yield from _material(drive, _table(raw, "materials"))
    yield from _seats(("drive",), drive, _table(raw, "materials"))
    yield from _twice("effects", [(("effects", i, "type"), name) for i, name in effects])
    yield from _mounts(raw, effects)
    yield from _points(_table(raw, "casing"))
    kind = drive.get("type")
    yield from casing_faults(raw, kind if isinstance(kind, str) else None)
    if isinstance(kind, str) and kind in KINDS:
        yield from _foreign_effects(kind, effects)
        yield from _foreign_friction(kind, raw, effects)
        yield from _accuracy(raw, kind)
        names = {name for _, name in effects} | _probable_effects(raw)
        yield from _model(_table(raw, "accuracy"), names)
        yield from _meshless(raw, names)
        yield from _quantities(raw, kind, names)


def kind_faults(raw: Mapping[str, Any]) -> Iterator[Found]:
    """Yield a fault if the kind of drive is missing or unknown: its other faults mean nothing then."""
    drive = raw.get("drive")
    if not isinstance(drive, Mapping):
        return
    if "type" not in drive:
        yield ("drive", "type"), f"missing; need the kind of drive: {listed(KINDS)}"
    elif not isinstance(drive["type"], str) or drive["type"] not in KINDS:
        yield ("drive", "type"), f"given {shown(drive['type'])}; this version knows {listed(KINDS)}"


def _table(raw: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    table = raw.get(name)
    return table if isinstance(table, Mapping) else {}


def _items(table: Mapping[str, Any], name: str) -> Sequence[Any]:
    items = table.get(name)
    return items if isinstance(items, list) else []


def _effects(raw: Mapping[str, Any]) -> list[tuple[int, str]]:
    """Return (index, type) of the effects whose type is known."""
    typed = [
        (i, effect.get("type"))
        for i, effect in enumerate(_items(raw, "effects"))
        if isinstance(effect, Mapping)
    ]
    return [(i, name) for i, name in typed if isinstance(name, str) and name in EFFECTS]


def _probable_effects(raw: Mapping[str, Any]) -> set[str]:
    """Return what misspelt effects were meant to be: that fault is named once, not by every quantity too."""
    names = [effect.get("type") for effect in _items(raw, "effects") if isinstance(effect, Mapping)]
    return {near for name in names if isinstance(name, str) and (near := nearest(name, EFFECTS))}


def _material(drive: Mapping[str, Any], materials: Mapping[str, Any]) -> Iterator[Found]:
    name = drive.get("material", "steel")
    known = sorted({*PREDEFINED, *materials})
    if isinstance(name, str) and name not in known:
        yield (
            ("drive", "material"),
            f"no material {quoted(name)}; {sentence(meant(name, known))} Or add the table [materials.{name}]",
        )


def _seats(key: Key, table: Mapping[str, Any], materials: Mapping[str, Any]) -> Iterator[Found]:
    """Look for seats of bearings anywhere in the drive, and for what they are made of."""
    for name, inner in table.items():
        if not isinstance(inner, Mapping):
            continue
        if name == "seat":
            for place, message in _material(inner, materials):
                yield (*key, "seat", *place[1:]), message
        yield from _seats((*key, name), inner, materials)


def _twice(what: str, named: Sequence[tuple[Key, str]]) -> Iterator[Found]:
    seen: set[str] = set()
    for key, name in named:
        if name in seen:
            yield key, f"{quoted(name)} stands twice in {what}; take one away"
        seen.add(name)


def _mounts(raw: Mapping[str, Any], effects: Sequence[tuple[int, str]]) -> Iterator[Found]:
    for i, name in effects:
        if name != "casing_on_mounts":
            continue
        if "casing" not in raw:
            yield ("effects", i, "type"), f"{quoted(name)} needs the table [casing], which is missing"
        elif not _table(raw, "casing").get("mounts"):
            yield ("effects", i, "type"), f"{quoted(name)} needs at least one [[casing.mounts]]"


def _model(accuracy: Mapping[str, Any], effects: set[str]) -> Iterator[Found]:
    model = accuracy.get("model")
    if isinstance(model, str) and model in ELASTIC_MODELS and "elastic_contact" not in effects:
        yield ("accuracy", "model"), f"{quoted(model)} needs {_absent(['elastic_contact'])}"


def _meshless(raw: Mapping[str, Any], effects: set[str]) -> Iterator[Found]:
    """Yield the facets of a mesh that the scene does not have."""
    given = _table(raw, "accuracy")
    if "facets_per_lobe" not in given:
        return
    if given.get("model") in MESHLESS:
        why = f"accuracy.model = {quoted(str(given['model']))} has no mesh"
    elif "elastic_contact" not in effects:
        why = 'without the effect "elastic_contact" there is no mesh'
    else:
        return
    yield ("accuracy", "facets_per_lobe"), f"{why}; take it away"


def _foreign_effects(kind: str, effects: Sequence[tuple[int, str]]) -> Iterator[Found]:
    offered = EFFECTS_OF[kind]
    for i, name in effects:
        if name not in offered:
            has = f"it has {listed(offered)}" if offered else "it has none"
            yield ("effects", i, "type"), f"{quoted(name)} is not an effect of {kind} drives; {has}"


def _foreign_friction(
    kind: str, raw: Mapping[str, Any], effects: Sequence[tuple[int, str]]
) -> Iterator[Found]:
    own = FRICTION_OF.get(kind, ())
    known = {name for names in FRICTION_OF.values() for name in names}
    for i, effect in effects:
        if effect == "friction" and own:
            for name in _items(raw, "effects")[i]:
                if name in known and name not in own:
                    yield (
                        ("effects", i, name),
                        f"{kind} drives have no such contact; friction has {listed(own)}",
                    )


def _accuracy(raw: Mapping[str, Any], kind: str) -> Iterator[Found]:
    if "accuracy" in raw and not MODELS_OF[kind]:
        yield (
            ("accuracy",),
            f"all answers about {kind} drives are closed forms: take the table [accuracy] away",
        )
    model, known = (
        _table(raw, "accuracy").get("model"),
        {name for names in MODELS_OF.values() for name in names},
    )
    if MODELS_OF[kind] and model in known - {*MODELS_OF[kind]}:
        yield (
            ("accuracy", "model"),
            f"{quoted(str(model))} is not a model of {kind} drives; it has {listed(MODELS_OF[kind])}",
        )


def _points(casing: Mapping[str, Any]) -> Iterator[Found]:
    names = [
        (i, point.get("name"))
        for i, point in enumerate(_items(casing, "points"))
        if isinstance(point, Mapping)
    ]
    texts = [(("casing", "points", i, "name"), name) for i, name in names if isinstance(name, str)]
    yield from _twice("casing.points", texts)


def _quantities(raw: Mapping[str, Any], kind: str, effects: set[str]) -> Iterator[Found]:
    ask = _table(raw, "ask")
    asked = ask.get("quantities")
    if asked == []:
        yield ("ask", "quantities"), f"an empty list; need at least one of {', '.join(NEEDS[kind])}"
    found = [
        (("ask", "quantities", i), name)
        for i, name in enumerate(_items(ask, "quantities"))
        if isinstance(name, str)
    ]
    yield from _twice("ask.quantities", found)
    for key, name in found:
        for message in _quantity(raw, kind, name, effects):
            yield key, message


def _quantity(raw: Mapping[str, Any], kind: str, name: str, effects: set[str]) -> Iterator[str]:
    offered = NEEDS[kind]
    if name not in offered:
        known = name in QUANTITIES
        yield (
            f"{quoted(name)} is not offered by {kind}; it offers: {', '.join(offered)}"
            if known
            else f"unknown quantity {quoted(name)}; {meant(name, tuple(offered))}"
        )
        return
    if name == "bearing_life" and not _rolls(kind, _table(raw, "drive")):
        places = listed([".".join(("drive", *path)) for path in ROLLING_OF[kind]])
        yield f"{quoted(name)} needs a rolling bearing, which the scene lacks: a table with a kind, in {places}"
    lacking = [effect for effect in offered[name] if effect not in effects]
    if lacking:
        yield f"{quoted(name)} needs {_absent(lacking)}"
    if name in NOT_WITH_SPRINGS and _table(raw, "accuracy").get("model") == "springs":
        yield f'{quoted(name)} is not in accuracy.model = "springs" (rigid discs); take "level0" or "strips"'
    why = UNDER_TORQUE.get(name)
    if why is None and kind in LOADED and "elastic_contact" in effects:
        why = NO_FLANK if name in LOADED[kind] or "elastic_contact" in offered[name] else None
    if why and _no_torque(_table(raw, "operation").get("output_torque")):
        yield f"{quoted(name)} needs operation.output_torque above 0: {why}"


def _rolls(kind: str, drive: Mapping[str, Any]) -> bool:
    """Whether a drive has a rolling bearing, by its kind or by a table."""
    if kind not in ROLLING_OF:
        return True
    for path in ROLLING_OF[kind]:
        table = drive
        for name in path:
            table = _table(table, name)
        if "kind" in table:
            return True
    return False


def _no_torque(given: object) -> bool:
    with suppress(ValueError):
        return read(given, units.TORQUE) == 0.0
    return False


def _absent(effects: Sequence[str]) -> str:
    if len(effects) == 1:
        name = quoted(effects[0])
        return f"the effect {name}, which the scene lacks; add [[effects]] with type = {name}"
    return f"the effects {listed(effects)}, which the scene lacks; add an [[effects]] block for each"
