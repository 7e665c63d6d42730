"""The starter scene documents the whole format, and is a scene."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from typing import Any, get_args

import pytest
from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from trochoid.drives.casing import casing_reasons
from trochoid.faults import listed
from trochoid.kinematics.errors import SceneError
from trochoid.scene import KINDS, NEEDS, read
from trochoid.scene.fields import Measure
from trochoid.scene.form import model_of
from trochoid.scene.model import scene_model
from trochoid.scene.needs import EFFECTS_OF, MODELS_OF, SEATS_OF
from trochoid.starter import starter

OPTIONAL = re.compile(r"^# (?=[a-z_]+ = |\[+casing\.)", re.M)
# an optional line stands in their place: of the turning time, of the rigid casing, of a mesh's file
EITHER = re.compile(
    r"^(relative_turning_time|mesh_file|mesh_unit|set|point|direction|span|normal) = .*\n"
    r"|(?<=\[casing\]\n)(?:(?:#.*|mass = .*|inertia = .*|center = .*)\n)+",
    re.M,
)


def fields(model: type[BaseModel], key: str = "") -> Iterator[tuple[str, FieldInfo]]:
    """Yield every field of every table as "casing.mounts.stiffness"; a material stands for all."""
    for name, info in model.model_fields.items():
        inner = model_of(info.annotation)
        args = [model_of(arg) for arg in get_args(info.annotation)]
        named = f"{key}{name}"
        yield named, info
        if inner is not None:
            yield from fields(inner, f"{named}.")
        elif any(args):
            middle = ".steel" if name == "materials" else ""
            yield from fields(next(arg for arg in args if arg), f"{named}{middle}.")


def comments(text: str) -> dict[str, str]:
    """Return the comment above each key, "casing.mounts.stiffness" -> its lines in one."""
    found: dict[str, str] = {}
    table, said = "", ""
    for line in text.splitlines():
        header, key = (
            re.match(r"(?:# (?=\[+casing\.))?\[+([\w.]+)\]", line),
            re.match(r"(?:# )?([a-z_]+) = ", line),
        )
        if key:
            found.setdefault(f"{table}{key[1]}", said.strip())
            said = ""
        elif header:
            found.setdefault(header[1], said.strip())
            table, said = f"{header[1]}.", ""
        elif line.startswith("#"):
            said += line[1:]
        else:
            said = ""
    return found


@pytest.mark.property
@pytest.mark.parametrize("kind", KINDS)
def test_starter_is_a_scene(kind: str) -> None:
    """Every kind that a scene may have has a starter, which loads, as it is and with all optional lines."""
    plain = read(starter(kind))
    full = read(EITHER.sub("", OPTIONAL.sub("", starter(kind))))
    assert plain.drive.type == full.drive.type == kind
    assert plain.ask.quantities == tuple(NEEDS[kind])
    assert tuple(effect.type for effect in plain.effects) == EFFECTS_OF[kind]
    assert (full.accuracy.model is not None) == bool(MODELS_OF[kind])


def documented(kind: str) -> list[tuple[str, FieldInfo]]:
    """Return the fields that a starter must explain: [accuracy] and [casing] only where they have a meaning."""
    absent = {"accuracy"} if not MODELS_OF[kind] else set()
    if "casing_on_mounts" not in EFFECTS_OF[kind]:
        absent.add("casing")
    return [each for each in fields(scene_model(kind)) if each[0].split(".")[0] not in absent]


@pytest.mark.property
@pytest.mark.parametrize("kind", KINDS)
def test_starter_has_every_field_with_a_comment(kind: str) -> None:
    """Each field of each model occurs, uncommented or as an optional line, below a comment of its own."""
    text = starter(kind)
    said = comments(text)
    raw = tomllib.loads(OPTIONAL.sub("", text))
    wanted = [key for key, _ in documented(kind) if key not in ("materials", "effects")]
    wanted = [key for key in wanted if not key.startswith("effects.") or "effects" in raw]
    assert len(wanted) > (70 if kind == "khv" else 20)
    for key in wanted:
        value: Any = raw
        for part in key.split("."):
            value = (value[0] if isinstance(value, list) else value)[part]
        assert said.get(key) or isinstance(value, dict), key


@pytest.mark.property
@pytest.mark.parametrize("kind", KINDS)
def test_starter_tells_the_true_defaults_and_units(kind: str) -> None:
    """The default in a comment is that of the model, in the comment's unit; a required field shows none."""
    said = comments(starter(kind))
    for key, info in documented(kind):
        if (
            model_of(info.annotation)
            or key in ("materials", "effects", "casing")
            or key.startswith("effects.")
        ):
            continue
        comment = said[key]
        if info.is_required():
            assert "default" not in comment or key.startswith("materials."), key
            continue
        assert "default" in comment or info.default in (None, ()), key
        measures = [m for m in info.metadata if isinstance(m, Measure)]
        if measures and measures[0].family.unit:
            assert f"[{measures[0].family.unit};" in comment, key
        if isinstance(info.default, bool):
            assert f"default {str(info.default).lower()};" in comment, key
        elif isinstance(info.default, (int, float)):
            shown = measures[0].family.from_si(info.default) if measures else info.default
            assert re.search(rf"default {shown:g}[;\]]", comment), (key, comment)
        elif isinstance(info.default, str):
            assert f'default "{info.default}"' in comment, key
        else:
            assert info.default in (None, (), PydanticUndefined) or isinstance(info.default, tuple), key


@pytest.mark.property
@pytest.mark.parametrize("kind", [kind for kind in KINDS if "casing_on_mounts" in EFFECTS_OF[kind]])
def test_elastic_casing_of_a_starter_can_be_made(kind: str) -> None:
    """With all optional lines the casing is elastic, a box that holds every place of the drive."""
    full = read(EITHER.sub("", OPTIONAL.sub("", starter(kind))))
    assert full.casing is not None
    assert full.casing.elastic
    assert full.casing.mass is None
    assert sorted({name for bore in full.casing.bores for name in bore.seats}) == sorted(SEATS_OF[kind])
    assert casing_reasons(full) == []


@pytest.mark.property
@pytest.mark.parametrize("kind", KINDS)
def test_starter_prints_anywhere(kind: str) -> None:
    """Plain ASCII: it survives any terminal and redirection."""
    assert starter(kind).isascii()


@pytest.mark.property
def test_unknown_kind_is_named() -> None:
    """A kind that does not exist is refused with those that do."""
    with pytest.raises(
        SceneError, match='no drive of kind "worm"; this version knows ' + re.escape(listed(KINDS))
    ):
        starter("worm")
