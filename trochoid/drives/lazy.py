"""Quantities by their public names, and ladders: their modules are imported only when one is asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from importlib import import_module
from typing import Any

from trochoid.clock import Clock
from trochoid.ladder import Ladder
from trochoid.results.outcome import Quantity


def answers(package: str, modules: Mapping[str, Iterable[str]]) -> dict[str, Callable[[Any], Quantity]]:
    """Return name → function of the drive's stages, from module of `package` → names of functions in it."""
    return {name: _answer(f"{package}.{module}", name) for module, names in modules.items() for name in names}


def ladder_of(module: str) -> Callable[[Any, Clock], Ladder]:
    """Return the function `ladder` of a module."""

    def ladder(scene: Any, clock: Clock) -> Ladder:
        made: Ladder = import_module(module).ladder(scene, clock)
        return made

    return ladder


def _answer(module: str, name: str) -> Callable[[Any], Quantity]:
    def answer(stages: Any) -> Quantity:
        found: Quantity = getattr(import_module(module), name)(stages)
        return found

    return answer
