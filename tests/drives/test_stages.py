"""Only what is asked for is computed, in all kinds of drives: stages that ran, and bits that effects leave alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from trochoid.run import Run, plan
from trochoid.scene import load
from trochoid.scene.needs import EFFECTS_OF, NEEDS

EXAMPLES = Path(__file__).parents[2] / "examples"
SCENES = {"khv": "cycloid"} | {kind: kind for kind in NEEDS if kind != "khv"}
FEW = ("ask.positions=3",)
OF_REPORT = {
    "figures",
    "kinematics",
    "forces",
}  # pictures, and closed forms at the head of whatever is reported
EXACT = (
    "ratio",
    "member_speeds",
    "mass",
)  # which no effect is in but the modification of flanks under "clearance"


def scene_of(kind: str, quantities: tuple[str, ...], *overrides: str) -> Run:
    """Return a run of the shipped example that asks for these quantities."""
    asked = "ask.quantities=[" + ",".join(f'"{name}"' for name in quantities) + "]"
    return Run(load(EXAMPLES / f"{SCENES[kind]}.toml", (asked, *FEW, *overrides)))


def listed(kind: str) -> str:
    """Return the override that lists every effect of a kind but clearance."""
    return (
        "effects=[" + ",".join(f'{{type="{name}"}}' for name in EFFECTS_OF[kind] if name != "clearance") + "]"
    )


@pytest.mark.property
@pytest.mark.parametrize("kind", SCENES)
def test_stages_that_ran_are_those_that_the_answers_call_for(kind: str) -> None:
    """Every quantity by itself, without any effect: what `trochoid check` announces has run, and nothing else."""
    for name, needs in NEEDS[kind].items():
        if needs:
            continue
        run = scene_of(kind, (name,), "effects=[]")
        announced = {stage.name for stage in plan(run.scene).stages if stage.needed}
        _ = run.quantity(name)
        assert set(run.clock.seconds) == announced, name
        _ = run.outcome
        assert set(run.clock.seconds) - announced <= OF_REPORT, name


@pytest.mark.exact
@pytest.mark.parametrize("kind", SCENES)
def test_effects_that_no_answer_asks_for_cost_nothing(kind: str) -> None:
    """Every effect of the kind listed but clearance, or none: closed forms keep their bits, and the same stages run."""
    names = tuple(name for name in EXACT if name in NEEDS[kind])
    none, every = scene_of(kind, names, "effects=[]"), scene_of(kind, names, listed(kind))
    for name in names:
        assert none.quantity(name) == every.quantity(name), name
    assert set(none.clock.seconds) == set(every.clock.seconds)
