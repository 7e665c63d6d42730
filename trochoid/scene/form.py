"""The form of a scene, read off its models: which keys a table knows, what may stand at a key."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel

from trochoid.faults import Key, listed


def names(scene: type[BaseModel], key: Key) -> Sequence[str]:
    """Return the keys that the table at `key` knows; of an effect, whichever it is, those of all effects."""
    annotation = annotation_at(scene, key)
    models = [model for part in (annotation, *get_args(_bare(annotation))) if (model := model_of(part))]
    return tuple(dict.fromkeys(name for model in models for name in model.model_fields))


def tables(model: type[BaseModel], key: Key = ()) -> Iterator[tuple[Key, type[BaseModel]]]:
    """Yield every table that has a fixed name, with its key."""
    yield key, model
    for name, info in model.model_fields.items():
        inner = model_of(info.annotation)
        if inner is not None:
            yield from tables(inner, (*key, name))


def annotation_at(scene: type[BaseModel], key: Key) -> Any:
    """Return the type of what stands at `key` of a scene; an entry of a list or a dictionary may have any name."""
    annotation: Any = scene
    for part in key:
        model = model_of(annotation)
        if model is not None:
            info = model.model_fields.get(str(part))
            if info is None:
                return None
            annotation = Annotated[info.annotation, *info.metadata] if info.metadata else info.annotation
            continue
        args = get_args(_bare(annotation))
        if not args:
            return None
        annotation = args[1] if get_origin(_bare(annotation)) is dict else args[0]
    return annotation


def _bare(annotation: Any) -> Any:
    """Return the type without Annotated and without `| None`."""
    if get_origin(annotation) is Annotated:
        return _bare(get_args(annotation)[0])
    if get_origin(annotation) in (Union, UnionType):
        rest = [arg for arg in get_args(annotation) if arg is not NoneType]
        return _bare(rest[0]) if len(rest) == 1 else annotation
    return annotation


def model_of(annotation: Any) -> type[BaseModel] | None:
    """Return the table that a type stands for, None if it is no table."""
    bare = _bare(annotation)
    return bare if isinstance(bare, type) and issubclass(bare, BaseModel) else None


def allowed(annotation: Any) -> str:
    """Return in words what may be written for a type."""
    origin = get_origin(annotation)
    if origin is Annotated:
        said = [m.allowed for m in get_args(annotation)[1:] if hasattr(m, "allowed")]
        return said[0] if said else allowed(get_args(annotation)[0])
    if origin in (Union, UnionType):
        return allowed(next(arg for arg in get_args(annotation) if arg is not NoneType))
    if origin is Literal:
        return f"one of {listed(map(str, get_args(annotation)))}"
    if origin is tuple:
        first, *others = get_args(annotation)
        if Ellipsis in others:
            return "a list of texts" if first is str else "a list of tables"
        return f"a list of {1 + len(others)}, each {allowed(first)}"
    return "a text" if annotation is str else "a table"
