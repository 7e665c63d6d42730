"""The errors that pydantic finds, as messages that say what was given and what is allowed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from trochoid.faults import Key, dotted, listed, meant, nearest, quoted, shown
from trochoid.scene.effects import EFFECTS
from trochoid.scene.fields import FAULT
from trochoid.scene.model import Scene

_TABLE_TYPES = ("model_type", "model_attributes_type", "dict_type")
_EFFECT_TYPES = ("union_tag_invalid", "union_tag_not_found")


def explained(error: ValidationError) -> Iterator[tuple[Key, str]]:
    """Yield (key, message) for each error, one for what is one mistake."""
    details = error.errors(include_url=False)
    wrong_names = {_misspelt(e["loc"]) for e in details if e["type"] == "extra_forbidden"}
    seen: set[Key] = set()
    for detail in details:
        key = _key(detail)
        if detail["type"] == "default_factory_not_called" or key in seen:
            continue
        if detail["type"] == "missing" and key in wrong_names:
            continue
        if detail["type"] != "extra_forbidden":
            seen.add(key)
        yield key, _message(detail, key)


def _key(detail: ErrorDetails) -> Key:
    """Return the key as written in the scene: without what pydantic adds, too short a list as a whole."""
    loc = detail["loc"]
    if loc[0] == "effects" and len(loc) > 2:
        loc = loc[:2] + loc[3:]
    if detail["type"] in _EFFECT_TYPES:
        return (*loc, "type")
    return loc[:-1] if detail["type"] == "missing" and isinstance(loc[-1], int) else loc


def _message(detail: ErrorDetails, key: Key) -> str:
    kind, given = detail["type"], detail["input"]
    if kind == FAULT:
        return detail["msg"]
    if kind == "extra_forbidden":
        return _unknown_key(key)
    if kind in _EFFECT_TYPES:
        return _effect(given)
    if kind in _TABLE_TYPES:
        return f"given {shown(given)}; need a table [{dotted(key)}]"
    if kind == "missing" and isinstance(detail["loc"][-1], str):
        return _missing(key)
    return f"given {shown(given)}; need {_allowed(_annotation(key))}"


def _missing(key: Key) -> str:
    annotation = _annotation(key)
    if _model(annotation) is not None:
        return f"missing table [{dotted(key)}]"
    return f"missing; need {_allowed(annotation)}"


def _effect(given: object) -> str:
    name = given.get("type") if isinstance(given, Mapping) else None
    if name is None:
        return f"missing; need one of {listed(EFFECTS)}"
    if not isinstance(name, str):
        return f"given {shown(name)}; need one of {listed(EFFECTS)}"
    return f"unknown effect {quoted(name)}; {meant(name, EFFECTS)}"


def _misspelt(loc: Key) -> Key:
    """Return the key that an unknown one was probably meant to be."""
    near = nearest(str(loc[-1]), _names(loc[:-1]))
    return (*loc[:-1], near) if near and not _homes(loc) else ()


def _unknown_key(key: Key) -> str:
    known, name = _names(key[:-1]), str(key[-1])
    homes = _homes(key)
    if not homes:
        return f"unknown key; {meant(name, known)}"
    near = nearest(name, known)
    here = f"; or did you mean {quoted(near)}?" if near else ""
    return f"unknown key here; it belongs to {' or '.join(homes)}{here}"


def _homes(key: Key) -> list[str]:
    """Return the tables that do know the last part of `key`."""
    tables = [table for table, model in _tables(Scene) if key[-1] in model.model_fields]
    return [f"[{dotted(table)}]" if table else "the top level" for table in tables]


def _names(key: Key) -> Sequence[str]:
    """Return the keys that the table at `key` knows; of an effect, whichever it is, those of all effects."""
    annotation = _annotation(key)
    models = [model for part in (annotation, *get_args(_bare(annotation))) if (model := _model(part))]
    return tuple(dict.fromkeys(name for model in models for name in model.model_fields))


def _tables(model: type[BaseModel], key: Key = ()) -> Iterator[tuple[Key, type[BaseModel]]]:
    """Yield every table that has a fixed name, with its key."""
    yield key, model
    for name, info in model.model_fields.items():
        inner = _model(info.annotation)
        if inner is not None:
            yield from _tables(inner, (*key, name))


def _annotation(key: Key) -> Any:
    """Return the type of what stands at `key`; an entry of a list or of a dictionary may have any name."""
    annotation: Any = Scene
    for part in key:
        model = _model(annotation)
        if model is not None:
            info = model.model_fields.get(str(part))
            if info is None:
                return None
            annotation = Annotated[info.annotation, *info.metadata] if info.metadata else info.annotation
            continue
        args = get_args(_bare(annotation))
        if not args:
            return None
        annotation = args[1] if _bare_origin(annotation) is dict else args[0]
    return annotation


def _bare(annotation: Any) -> Any:
    """Return the type without Annotated and without `| None`."""
    if get_origin(annotation) is Annotated:
        return _bare(get_args(annotation)[0])
    if get_origin(annotation) in (Union, UnionType):
        rest = [arg for arg in get_args(annotation) if arg is not NoneType]
        return _bare(rest[0]) if len(rest) == 1 else annotation
    return annotation


def _bare_origin(annotation: Any) -> Any:
    return get_origin(_bare(annotation))


def _model(annotation: Any) -> type[BaseModel] | None:
    bare = _bare(annotation)
    return bare if isinstance(bare, type) and issubclass(bare, BaseModel) else None


def _allowed(annotation: Any) -> str:
    """Return in words what may be written for a type."""
    origin = get_origin(annotation)
    if origin is Annotated:
        said = [m.allowed for m in get_args(annotation)[1:] if hasattr(m, "allowed")]
        return said[0] if said else _allowed(get_args(annotation)[0])
    if origin in (Union, UnionType):
        return _allowed(next(arg for arg in get_args(annotation) if arg is not NoneType))
    if origin is Literal:
        return f"one of {listed(map(str, get_args(annotation)))}"
    if origin is tuple:
        first, *others = get_args(annotation)
        if Ellipsis in others:
            return "a list of texts" if first is str else "a list of tables"
        return f"a list of {1 + len(others)}, each {_allowed(first)}"
    return "a text" if annotation is str else "a table"
