"""The errors that pydantic finds, as messages that say what was given and what is allowed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from trochoid.faults import Key, dotted, listed, meant, nearest, quoted, shown
from trochoid.scene import form
from trochoid.scene.effects import EFFECTS
from trochoid.scene.fields import FAULT
from trochoid.scene.needs import MODELS_OF

_TABLE_TYPES = ("model_type", "model_attributes_type", "dict_type")
_EFFECT_TYPES = ("union_tag_invalid", "union_tag_not_found")


def explained(error: ValidationError, scene: type[BaseModel]) -> Iterator[tuple[Key, str]]:
    """Yield (key, message) for each error that `scene`, the model, has found, one for what is one mistake."""
    details = error.errors(include_url=False)
    meant_keys = {
        key for e in details if e["type"] == "extra_forbidden" for key in _meant_keys(scene, e["loc"])
    }
    seen: set[Key] = set()
    for detail in details:
        key = _key(detail)
        if detail["type"] == "default_factory_not_called" or key in seen:
            continue
        if detail["type"] == "missing" and key in meant_keys:
            continue
        if detail["type"] != "extra_forbidden":
            seen.add(key)
        yield key, _message(scene, detail, key)


def _key(detail: ErrorDetails) -> Key:
    """Return the key as written in the scene: without what pydantic adds, too short a list as a whole."""
    loc = detail["loc"]
    if loc[0] == "effects" and len(loc) > 2:
        loc = loc[:2] + loc[3:]
    if detail["type"] in _EFFECT_TYPES:
        return (*loc, "type")
    return loc[:-1] if detail["type"] == "missing" and isinstance(loc[-1], int) else loc


def _message(scene: type[BaseModel], detail: ErrorDetails, key: Key) -> str:
    kind, given = detail["type"], detail["input"]
    if kind == FAULT:
        return detail["msg"]
    if kind == "extra_forbidden":
        return _unknown_key(scene, key)
    if kind in _EFFECT_TYPES:
        return _effect(given)
    if kind in _TABLE_TYPES:
        return f"given {shown(given)}; need a table [{dotted(key)}]"
    if kind == "missing" and isinstance(detail["loc"][-1], str):
        return _missing(scene, key)
    if key == ("accuracy", "model") and isinstance(given, str):
        return _model(scene, given)
    return f"given {shown(given)}; need {form.allowed(form.annotation_at(scene, key))}"


def _model(scene: type[BaseModel], given: str) -> str:
    """Say which contact models a kind of drive has, whatever others have."""
    (kind,) = get_args(form.annotation_at(scene, ("drive", "type")))
    near = nearest(given, MODELS_OF[kind])
    advice = f"; did you mean {quoted(near)}?" if near else ""
    return f"given {shown(given)}; {kind} drives have {listed(MODELS_OF[kind])}{advice}"


def _missing(scene: type[BaseModel], key: Key) -> str:
    annotation = form.annotation_at(scene, key)
    if form.model_of(annotation) is not None:
        return f"missing table [{dotted(key)}]"
    return f"missing; need {form.allowed(annotation)}"


def _effect(given: object) -> str:
    name = given.get("type") if isinstance(given, Mapping) else None
    if name is None:
        return f"missing; need one of {listed(EFFECTS)}"
    if not isinstance(name, str):
        return f"given {shown(name)}; need one of {listed(EFFECTS)}"
    return f"unknown effect {quoted(name)}; {meant(name, EFFECTS)}"


def _meant_keys(scene: type[BaseModel], key: Key) -> list[Key]:
    """Return what an unknown key was probably meant to be: its name elsewhere, else a similar one here."""
    near = nearest(str(key[-1]), form.names(scene, key[:-1]))
    return [(*home, key[-1]) for home in _homes(scene, key)] or ([(*key[:-1], near)] if near else [])


def _unknown_key(scene: type[BaseModel], key: Key) -> str:
    known, name = form.names(scene, key[:-1]), str(key[-1])
    homes = _homes(scene, key)
    if not homes:
        return f"unknown key; {meant(name, known)}"
    near = nearest(name, known)
    here = f"; or did you mean {quoted(near)}?" if near else ""
    places = " or ".join(f"[{dotted(home)}]" if home else "the top level" for home in homes)
    return f"unknown key here; it belongs to {places}{here}"


def _homes(scene: type[BaseModel], key: Key) -> list[Key]:
    """Return the tables that do know the last part of `key`."""
    return [table for table, model in form.tables(scene) if key[-1] in model.model_fields]
