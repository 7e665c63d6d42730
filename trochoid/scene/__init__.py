"""The scene: what a user writes, checked and in SI."""

from trochoid.scene.ask import Accuracy, Ask
from trochoid.scene.casing import Casing, MeasuringPoint, Mount
from trochoid.scene.effects import EFFECTS, Effect, Friction
from trochoid.scene.load import load, read
from trochoid.scene.materials import Material
from trochoid.scene.model import Scene
from trochoid.scene.needs import KINDS, NEEDS, QUANTITIES
from trochoid.scene.operation import Operation
from trochoid.scene.overrides import Override

__all__ = [
    "EFFECTS",
    "KINDS",
    "NEEDS",
    "QUANTITIES",
    "Accuracy",
    "Ask",
    "Casing",
    "Effect",
    "Friction",
    "Material",
    "MeasuringPoint",
    "Mount",
    "Operation",
    "Override",
    "Scene",
    "load",
    "read",
]
