"""Eccentric and planetary gear drives: profiles, contact forces, stiffness, reactions, vibration.

`load`, `Run`, `Scene` and `TrochoidError` are imported when first used: `import trochoid` costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from trochoid.kinematics.errors import TrochoidError
    from trochoid.run import Run
    from trochoid.scene import Scene, load

__all__ = ["Run", "Scene", "TrochoidError", "load"]

_HOMES = {
    "Run": "trochoid.run",
    "Scene": "trochoid.scene",
    "TrochoidError": "trochoid.kinematics.errors",
    "load": "trochoid.scene",
}


def __getattr__(name: str) -> object:
    """Import a public name from its home (PEP 562)."""
    if name not in _HOMES:
        raise AttributeError(f"module 'trochoid' has no attribute {name!r}")
    value: object = getattr(import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """List the public names before they are imported."""
    return sorted({*globals(), *__all__})
