"""The scene as a value: frozen, checked, SI throughout."""

from __future__ import annotations

from trochoid.scene.ask import Accuracy, Ask
from trochoid.scene.casing import Casing
from trochoid.scene.drive_khv import KhvDrive
from trochoid.scene.effects import Effect, Friction
from trochoid.scene.fields import Table
from trochoid.scene.materials import Material
from trochoid.scene.operation import Operation


class Scene(Table):
    """A scene, made by `load` or `read`; all attributes are SI (m, rad, N·m, Pa, kg, rad/s).

    Numbers given to a constructor are read like those of a file (mm, deg, rpm, MPa); `model_dump` returns SI.
    """

    drive: KhvDrive
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
