"""The scene as a value: frozen, checked, SI throughout."""

from __future__ import annotations

from importlib import import_module
from typing import Any, Generic, TypeVar, cast

from trochoid.scene.ask import Accuracy, Ask
from trochoid.scene.casing import Casing
from trochoid.scene.effects import Effect, Friction
from trochoid.scene.fields import DriveTable, Table
from trochoid.scene.materials import Material
from trochoid.scene.operation import Operation

DriveT = TypeVar("DriveT", bound=DriveTable)


class Scene(Table, Generic[DriveT]):
    """A scene, made by `load` or `read`; all attributes are SI (m, rad, N·m, Pa, kg, rad/s).

    Numbers given to a constructor are read like those of a file (mm, deg, rpm, MPa); `model_dump` returns SI.
    """

    drive: DriveT
    materials: dict[str, Material]
    operation: Operation
    casing: Casing | None = None
    effects: tuple[Effect, ...] = ()
    ask: Ask
    accuracy: Accuracy = Accuracy()

    def has(self, effect: str) -> bool:
        """Return whether the effect of this type is in the equations."""
        return any(listed.type == effect for listed in self.effects)

    @property
    def friction(self) -> Friction | None:
        """The effect "friction", None when the scene does not list it."""
        return next((listed for listed in self.effects if isinstance(listed, Friction)), None)


def scene_model(kind: str) -> type[Scene[Any]]:
    """Return the model of the scenes of one kind of drive; only its tables are loaded."""
    return cast("type[Scene[Any]]", import_module(f"trochoid.scene.drive_{kind}").SCENE)
