"""Faults of a scene: one message each, with the place, the key, what was given and what is allowed."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from trochoid.kinematics.errors import SceneError

Key: TypeAlias = tuple[str | int, ...]
_BARE = re.compile(r"[A-Za-z0-9_-]+")
_LONGEST = 60


@dataclass(frozen=True, slots=True)
class Fault:
    """One thing that is wrong at `key`; `where` is "scene.toml:12" or "--set drive.pins=3"."""

    key: Key
    message: str
    where: str = ""

    def __str__(self) -> str:
        """Return the line that a user reads."""
        key = "" if not self.key or self.where.startswith(f"--set {dotted(self.key)}=") else dotted(self.key)
        return ": ".join(part for part in (self.where, key, self.message) if part)


class SceneFaults(SceneError):
    """All faults of one scene; its text has one line for each."""

    def __init__(self, faults: Iterable[Fault]) -> None:
        """Keep the faults in the order in which they are to be read."""
        self.faults = tuple(faults)
        super().__init__("\n".join(map(str, self.faults)))


def dotted(key: Key) -> str:
    """Return a key as it is written after --set: casing.mounts.0.stiffness."""
    return ".".join(str(part) if _BARE.fullmatch(str(part)) else quoted(str(part)) for part in key)


def quoted(text: str) -> str:
    """Return `text` in double quotes, on one line."""
    return json.dumps(text, ensure_ascii=False)


def listed(names: Iterable[str]) -> str:
    """Return names in quotes, separated by commas."""
    return ", ".join(map(quoted, names))


def shown(value: object) -> str:
    """Return a value as it is written in a scene, shortened."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return quoted(value if len(value) <= _LONGEST else value[: _LONGEST - 3] + "...")
    if isinstance(value, (list, tuple)):
        return "a list of one" if len(value) == 1 else f"a list of {len(value)}" if value else "an empty list"
    if isinstance(value, dict):
        return "a table"
    text = str(value)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."


def nearest(name: str, known: Sequence[str]) -> str | None:
    """Return the name in `known` that `name` is most likely a misspelling of, or None."""
    from difflib import get_close_matches

    plain = {candidate.lower(): candidate for candidate in known}
    found = get_close_matches(name.lower().replace("-", "_"), plain, n=1, cutoff=0.65)
    return plain[found[0]] if found else None


def sentence(text: str) -> str:
    """Return `text` with a full stop, if it has no end of its own."""
    return text if text.endswith(("?", ".", "!")) else f"{text}."


def meant(name: str, known: Sequence[str]) -> str:
    """Return the advice for an unknown name: its nearest match, or all that there is."""
    near = nearest(name, known)
    return f"did you mean {quoted(near)}?" if near else f"known: {', '.join(known)}"
