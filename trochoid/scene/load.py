"""From a file to a Scene, or to all faults at once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from trochoid.faults import Fault, Key, SceneFaults
from trochoid.kinematics.errors import SceneError
from trochoid.scene import cross, toml_text
from trochoid.scene import overrides as replacing
from trochoid.scene.explain import explained
from trochoid.scene.materials import with_predefined
from trochoid.scene.model import Scene, scene_model
from trochoid.scene.needs import KINDS
from trochoid.scene.overrides import Override


def load(path: str | PathLike[str], overrides: Sequence[str | Override] = ()) -> Scene[Any]:
    """Return the scene in the TOML file at `path`, with "a.b=value" overrides put in.

    Raises SceneError: a file that cannot be read, or SceneFaults with one message per fault.
    """
    return read(_text(Path(path)), overrides, source=fspath(path))


def read(text: str, overrides: Sequence[str | Override] = (), source: str = "scene") -> Scene[Any]:
    """Return the scene written in `text`; `source` is its name in faults. Raises SceneFaults."""
    parsed = [replacing.parse(each) if isinstance(each, str) else each for each in overrides]
    accepted = [each for each in parsed if isinstance(each, Override)]
    raw, unplaced = replacing.apply(toml_text.parse(text, source), accepted)
    raw = _located(raw, Path(source).parent)
    scene, found = build(raw)
    faults = [each for each in parsed if isinstance(each, Fault)] + unplaced
    if found:
        faults += _placed(found, text, source, accepted)
    if scene is None or faults:
        raise SceneFaults(faults)
    return scene


def build(raw: dict[str, Any]) -> tuple[Scene[Any] | None, list[tuple[Key, str]]]:
    """Return the scene that plain dictionaries describe, or None, and what is wrong as (key, message)."""
    complete = raw | {"materials": with_predefined(raw.get("materials", {}))}
    scene, found = None, list(cross.kind_faults(raw))
    # where the kind is in doubt, everything but the drive is checked by the tables that all kinds share
    model = scene_model(KINDS[0] if found else _kind(raw))
    try:
        scene = model.model_validate(complete)
    except ValidationError as error:
        found += [(key, text) for key, text in explained(error, model) if not (found and key[0] == "drive")]
    found += cross.faults(raw)
    return (None if found else scene), found


def _located(raw: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Return the raw scene with its mesh file's place, which is relative to the scene's, made whole."""
    casing = raw.get("casing")
    if not isinstance(casing, dict) or not isinstance(file := casing.get("mesh_file"), str):
        return raw
    return {**raw, "casing": {**casing, "mesh_file": str(folder / file)}}


def _kind(raw: dict[str, Any]) -> str:
    drive = raw.get("drive")
    return str(drive["type"]) if isinstance(drive, dict) else KINDS[0]


def _text(path: Path) -> str:
    try:
        return path.read_bytes().decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        raise SceneError(
            f"{path}: not a text in UTF-8 (byte {error.start}); a scene is a TOML file"
        ) from None
    except FileNotFoundError:
        raise SceneError(
            f"{path}: no such file; `trochoid new khv > scene.toml` writes a commented one"
        ) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise SceneError(f"{path}: cannot be read: {reason}") from None


def _placed(
    found: Iterable[tuple[Key, str]], text: str, source: str, overrides: Sequence[Override]
) -> list[Fault]:
    """Return the faults in the order of the file, each with its line or the override that it came with."""
    from trochoid.scene.lines import key_lines

    covered = [override.key for override in overrides]
    lines = {
        key: line for key, line in key_lines(text).items() if not any(_starts(key, own) for own in covered)
    }
    placed = [(_place(key, lines, overrides), key, message) for key, message in found]
    placed.sort(key=lambda each: each[0][0])
    return [Fault(key, message, label or f"{source}:{line}") for (line, label), key, message in placed]


def _place(key: Key, lines: dict[Key, int], overrides: Sequence[Override]) -> tuple[int, str]:
    """Return (line, "") in the file or (0, label) of an override, for `key` or the nearest table above it."""
    written = tuple(map(str, key))
    for length in range(len(key), -1, -1):
        above = [o for o in overrides if tuple(map(str, o.key)) == written[:length]]
        if above:
            return 0, above[-1].label
        if key[:length] in lines:
            return lines[key[:length]], ""
        below = [o for o in overrides if _starts(o.key, key[:length])]
        if length and below:
            return 0, below[-1].label
    return 1, ""


def _starts(key: Key, first: Key) -> bool:
    return tuple(map(str, key[: len(first)])) == tuple(map(str, first))
