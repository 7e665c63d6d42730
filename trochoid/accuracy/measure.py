"""Climb the ladder: solve every rung on ever finer meshes for as long as the budget lasts, and judge the steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from trochoid.accuracy.choice import choice
from trochoid.accuracy.errors import errors, modelled
from trochoid.accuracy.study import Check, Error, Judged, Numbers, Step, Study
from trochoid.clock import Clock
from trochoid.drives import drive_of
from trochoid.kinematics.errors import NotConverged, SceneError, TrochoidError
from trochoid.ladder import Ladder
from trochoid.results.outcome import Quantity
from trochoid.scene import Scene

BUDGET = 60.0  # s
BRIEF = 0.5  # s; what takes less is done twice, and the faster counts: the first pays for loading libraries
GROWTH = 8.0  # of the seconds from one level to the next, as long as only one is known
FEWEST = 2  # levels that are solved whatever the budget
Answers = Mapping[str, Callable[[Any], Quantity]]
Key = tuple[str, int | None]


def study(
    scene: Scene[Any],
    budget: float = BUDGET,
    announce: Callable[[str], None] = lambda text: None,
    oracle: bool = False,
) -> Study:
    """Measure error against seconds for the quantities that the scene asks for.

    `budget` in seconds bounds the finest level, not what is solved in any case: the rungs on the two coarsest
    levels, and the `oracle` when it is asked for. Raises SceneError when nothing asked depends on the model,
    NotConverged when fewer than two levels could be solved.
    """
    drive = drive_of(scene.drive.type)
    if drive.ladder is None:
        raise SceneError(
            f"{scene.drive.type} drives have no models and meshes to compare: their answers come with what is known of "
            "their error"
        )
    ladder = drive.ladder(scene, Clock(announce))
    if not ladder.quantities:
        raise SceneError(
            f"no model of the contacts stands behind {', '.join(scene.ask.quantities)}: closed forms have no error to "
            "pay for; ask for torsional_stiffness, contact_force_max or the like"
        )
    climb = Climb(ladder, {name: drive.quantities[name] for name in ladder.quantities}, announce)
    climb.run(budget)
    judged = _judged(ladder, list(climb.steps.values()), climb.remarks)
    found = choice(ladder, judged, climb.solved, climb.seconds, climb.remarks)
    check = _check(climb, judged, announce) if oracle else None
    return Study(
        scene.model_dump(mode="json"),
        ladder.title,
        scene.accuracy.tolerance,
        budget,
        ladder.rungs,
        ladder.unit,
        tuple(judged),
        found,
        check,
        tuple(climb.remarks),
    )


@dataclass
class Climb:
    """The steps solved so far, the drive's stages behind each, and what could not be solved."""

    ladder: Ladder
    answers: Answers
    announce: Callable[[str], None]
    steps: dict[Key, Step] = field(default_factory=dict)
    solved: dict[Key, Any] = field(default_factory=dict)
    remarks: list[str] = field(default_factory=list)
    spent: float = 0.0

    def run(self, budget: float) -> None:
        """Solve all rungs, the meshed ones on as many levels as fit into `budget` seconds, two at least."""
        for rung in self.ladder.rungs:
            if not rung.meshed:
                self._step(rung.name, None, None, {})
        costs: list[float] = []
        for count, level in enumerate(self.ladder.levels):
            if count >= FEWEST and self.spent + _next(costs) > budget:
                self.remarks.append(
                    f"{level} {self.ladder.unit} would take about {_next(costs):.0f} s more, beyond the budget of "
                    f"{budget:g} s; raise it with --budget"
                )
                return
            before = self.spent
            self._level(level)
            costs.append(self.spent - before)

    def seconds(self, levels: Sequence[int], rung: str) -> float:
        """Return the seconds of a run that solves these levels on a rung."""
        return sum(self.steps[rung, level].seconds for level in levels if (rung, level) in self.steps)

    def _level(self, level: int) -> None:
        where = f"{level} {self.ladder.unit}"
        try:
            built, shared = self._timed(where, lambda clock: self.ladder.build(level, clock))
        except TrochoidError as fault:
            self.remarks.append(f"{where}: {fault}")
            return
        for rung in self.ladder.rungs:
            if rung.meshed:
                self._step(rung.name, level, built, shared)

    def _step(self, rung: str, level: int | None, built: Any, shared: Mapping[str, float]) -> None:
        where = rung if level is None else f"{rung}, {level} {self.ladder.unit}"

        def solve(clock: Clock) -> tuple[Any, tuple[Numbers, dict[str, str]]]:
            stages = self.ladder.stages(rung, built, clock)
            return stages, numbers(stages, self.answers)

        try:
            (stages, (found, faults)), own = self._timed(where, solve)
        except TrochoidError as fault:
            self.remarks.append(f"{where}: {fault}")
            return
        self.remarks += [f"{where}: {name}: {fault}" for name, fault in faults.items()]
        self.steps[rung, level] = Step(rung, level, {**shared, **own}, found)
        self.solved[rung, level] = stages

    def _timed(self, where: str, make: Callable[[Clock], Any]) -> tuple[Any, dict[str, float]]:
        """Make something and return it with its seconds by stage; twice when that is quick."""
        made, seconds = self._once(where, make)
        if sum(seconds.values()) < BRIEF:
            again, others = self._once(where, make)
            if sum(others.values()) < sum(seconds.values()):
                return again, others
        return made, seconds

    def _once(self, where: str, make: Callable[[Clock], Any]) -> tuple[Any, dict[str, float]]:
        clock = Clock(lambda stage: self.announce(f"{where}: {stage}"))
        try:
            return make(clock), clock.seconds
        finally:
            self.spent += sum(clock.seconds.values())


def numbers(stages: Any, answers: Answers) -> tuple[Numbers, dict[str, str]]:
    """Return what the stages answer by a model, and why some answers were not found.

    What a rung has no answer for, such as the stress of a rigid disc, is left out without a word. Raises what the
    first answer raises when there is none at all.
    """
    found: dict[str, Mapping[str, tuple[float, str]]] = {}
    faults: dict[str, TrochoidError] = {}
    for name, answer in answers.items():
        try:
            parts = modelled(answer(stages))
        except SceneError:
            continue
        except TrochoidError as fault:
            faults[name] = fault
            continue
        if parts:
            found[name] = parts
    if faults and not found:
        raise next(iter(faults.values()))
    return found, {name: str(fault) for name, fault in faults.items()}


def _next(costs: Sequence[float]) -> float:
    """Return the seconds to expect of the next level."""
    known = [cost for cost in costs if cost > 0.0]
    if not known:
        return 0.0
    growth = GROWTH if len(known) < 2 else max(2.0, known[-1] / known[-2])
    return growth * known[-1]


def _judged(ladder: Ladder, steps: Sequence[Step], remarks: list[str]) -> list[Judged]:
    """Compare all steps with the best rung that was solved on the finest level; that one with the level before."""
    meshed = [rung.name for rung in ladder.rungs if rung.meshed]
    known = {
        name: [step for step in steps if step.rung == name and step.level is not None] for name in meshed
    }
    able = [name for name in meshed if len(known[name]) >= FEWEST]
    if not able:
        raise NotConverged(
            f"{meshed[-1]} could be solved on {len(known[meshed[-1]])} mesh levels, and an error takes two; see what "
            "`trochoid run` says, and give another geometry or load"
        )
    if able[-1] != meshed[-1]:
        remarks.append(
            f"{meshed[-1]} could not be solved on two levels: errors are against {able[-1]}, and do not hold its own "
            "distance from the truth"
        )
    before, reference = known[able[-1]][-2:]
    assert reference.level is not None
    assert before.level is not None
    left = 1.0 / ((reference.level / before.level) ** ladder.order - 1.0)
    own = errors(before.numbers, reference.numbers, left)
    return [
        Judged(step, own, estimated=True)
        if step is reference
        else Judged(
            step, _beside(errors(step.numbers, reference.numbers), own, step.level == reference.level)
        )
        for step in steps
    ]


def _beside(found: Mapping[str, Error], own: Mapping[str, Error], same_mesh: bool) -> Mapping[str, Error]:
    """Return errors against the reference; on its own mesh that of the mesh is in both, does not show in their
    difference, and is added.
    """
    if not same_mesh:
        return found
    return {
        name: Error(error.size + own[name].size, error.part) if name in own else error
        for name, error in found.items()
    }


def _check(climb: Climb, judged: Sequence[Judged], announce: Callable[[str], None]) -> Check | None:
    oracle = climb.ladder.oracle
    if oracle is None:
        climb.remarks.append("this drive has no independent model to check the reference with")
        return None
    reference = next(j.step for j in judged if j.estimated)
    stages = climb.solved[reference.rung, reference.level]
    clock = Clock(lambda stage: announce(f"{oracle.what}: {stage}"))
    try:
        truth, _ = numbers(oracle.stages(stages, clock), climb.answers)
        same, _ = numbers(oracle.same(stages), climb.answers)
    except TrochoidError as fault:
        climb.remarks.append(f"{oracle.what}: {fault}")
        return None
    return Check(oracle.what, errors(same, truth), sum(clock.seconds.values()))
