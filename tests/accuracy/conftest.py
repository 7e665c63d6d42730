"""A made-up drive whose errors and seconds are known in closed form, climbed like a real one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from trochoid import accuracy
from trochoid.accuracy import Study, measure
from trochoid.clock import Clock
from trochoid.drives import Drive
from trochoid.kinematics.errors import NotConverged, SceneError
from trochoid.ladder import Ladder, Oracle, Pick, Rung
from trochoid.results import Outcome, Quantity
from trochoid.scene import load
from trochoid.scene.drive_khv import KhvScene

EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"
LEVELS = (8, 16, 32, 64)
MODEL = {"springs": 0.4, "level0": 1e-4, "strips": 0.0}
FORCE, STIFFNESS = 1000.0, 300.0
RUNGS = tuple(Rung(name, f"what {name} is", name != "springs") for name in MODEL)

Studied = Callable[..., Study]


@dataclass(frozen=True)
class Made:
    """The stages of the made-up drive: the relative error of all that it answers."""

    rung: str
    level: int | None

    @property
    def error(self) -> float:
        return MODEL[self.rung] + (0.0 if self.level is None else (2.0 / self.level) ** 3)


def seconds_of(level: int) -> float:
    """Return what the bodies of a level take."""
    return 1e-2 * level**2


def force(s: Made) -> Quantity:
    pins = Quantity(FORCE * (1 + s.error), "N", model=s.rung)
    return Quantity(parts={"pins": pins, "none": Quantity(0.0, "N", model=s.rung)})


def stiffness(s: Made) -> Quantity:
    return Quantity(STIFFNESS * (1 - 2 * s.error), "N*m/arcmin", model=s.rung)


def stress(s: Made) -> Quantity:
    if s.level is None:
        raise SceneError("a rigid disc has no stress")
    return Quantity(5.0, "MPa", model=s.rung)


def ratio(s: Made) -> Quantity:
    return Quantity(-19.0, model="exact")


QUANTITIES = {
    "contact_force_max": force,
    "torsional_stiffness": stiffness,
    "stress_max": stress,
    "ratio": ratio,
}


def ladder(scene: KhvScene, clock: Clock) -> Ladder:
    tolerance = scene.accuracy.tolerance

    def build(level: int, clock: Clock) -> int:
        with clock.stage("bodies"):
            pass
        clock.seconds["bodies"] = seconds_of(level)
        return level

    def stages(rung: str, level: int | None, clock: Clock) -> Made:
        clock.seconds["contact"] = 1.0
        return Made(rung, level)

    def pick(solved: Callable[[str, int | None], Made]) -> Pick:
        rung = "level0" if tolerance > 1e-3 else "strips"
        for i, level in enumerate(LEVELS[1:], 2):
            estimate = abs(solved(rung, LEVELS[i - 2]).error - solved(rung, level).error)
            if estimate <= tolerance:
                return Pick(rung, level, estimate, "the force", LEVELS[:i], False)
        raise NotConverged("not with 64")

    def resolved(made: Made, clock: Clock) -> Made:
        clock.seconds["resolved"] = 40.0
        return Made("strips", 1000)

    oracle = Oracle("Truth at one position", resolved, lambda made: made)
    asked = tuple(name for name in scene.ask.quantities if name != "ratio")
    return Ladder("Made-up drive", asked, RUNGS, LEVELS, "facets per lobe", 3.0, build, stages, pick, oracle)


def _no_outcome(stages: object, quantities: object) -> Outcome:
    raise AssertionError("a study needs no outcome")


def _no_plan(scene: KhvScene) -> accuracy.Study:
    raise AssertionError("a study needs no plan")


DRIVE = Drive(lambda scene, clock: None, QUANTITIES, _no_outcome, _no_plan, ladder)  # type: ignore[arg-type]


@pytest.fixture
def studied(monkeypatch: pytest.MonkeyPatch) -> Studied:
    """Return what studies the made-up drive: `studied(tolerance, budget=..., ask=..., oracle=...)`."""
    monkeypatch.setattr(measure, "drive_of", lambda kind: DRIVE)

    def run(
        tolerance: float = 1e-2,
        budget: float = 1e6,
        ask: tuple[str, ...] = tuple(QUANTITIES),
        oracle: bool = False,
    ) -> Study:
        words = [f"accuracy.tolerance={tolerance}", f"ask.quantities={list(ask)}"]
        return accuracy.study(load(EXAMPLE, words), budget, oracle=oracle)

    return run
