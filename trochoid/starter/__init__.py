"""The commented scenes that `trochoid new` prints, one TOML file for each kind of drive."""

from __future__ import annotations

from importlib.resources import files

from trochoid.faults import listed, quoted
from trochoid.kinematics.errors import SceneError
from trochoid.scene.needs import KINDS


def starter(kind: str) -> str:
    """Return the commented starter scene for a kind of drive; raises SceneError for an unknown kind."""
    if kind not in KINDS:
        raise SceneError(f"no drive of kind {quoted(kind)}; this version knows {listed(KINDS)}")
    return (files(__name__) / f"{kind}.toml").read_text(encoding="utf-8")
