"""The ladder of a K-H-V drive: contact models from rigid discs to resolved pressure, facets per lobe."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from trochoid.clock import Clock
from trochoid.drives.choosing import Chosen, climbed, first_given, or_level0
from trochoid.drives.khv import headline
from trochoid.drives.khv.choice import choose
from trochoid.drives.khv.plan import STAGES_OF
from trochoid.drives.khv.stages import Solved, Stages, named_rung
from trochoid.kinematics.errors import SceneError
from trochoid.ladder import Ladder, Oracle, Pick, Rung
from trochoid.scene.drive_khv import KhvScene

if TYPE_CHECKING:
    from trochoid.drives.khv.bodies import Level
    from trochoid.drives.khv.series import Series, Touches
    from trochoid.kinematics.types import Array

RUNGS = (
    Rung(
        "springs", "rigid discs, each contact one and the same spring: its error is one of the model", False
    ),
    Rung("level0", "elastic discs, one force per contact and Hertz's pressure under it", True),
    Rung("strips", "elastic discs, the pressure of each contact resolved by strips", True),
)
ORDER = 3.0  # benchmarks/disc.py
RESOLVED = "Fully resolved finite elements at one position"


@dataclass(frozen=True)
class Held(Stages):
    """The stages of a scene whose contacts are made elsewhere: on one rung, and on one level alone."""

    held: str
    make: Callable[[Stages], Solved]

    @property
    def rung(self) -> str:
        """The contact model."""
        return self.held

    @cached_property
    def contact(self) -> Solved:
        """Contacts over a turn."""
        return self.make(self)


def ladder(scene: KhvScene, clock: Clock) -> Ladder:
    """Return what may be climbed; raises SceneError for rigid discs, Infeasible."""
    if not scene.has("elastic_contact"):
        raise SceneError(
            'discs are rigid: the effect "elastic_contact" is not listed, so that there is one model and no mesh to '
            'compare; add [[effects]] with type = "elastic_contact"'
        )
    base = Stages(scene, clock)
    base.feasible  # noqa: B018 - raises Infeasible with every reason

    def build(level: int, clock: Clock) -> Level:
        return Stages(scene, clock).level(level)

    def stages(rung: str, built: Level | None, clock: Clock) -> Stages:
        return Held(scene, clock, rung, lambda s: Solved(s.series(built, rung), None, built, None))

    return Ladder(
        headline.title(base),
        tuple(name for name in scene.ask.quantities if "contact" in STAGES_OF[name]),
        RUNGS,
        levels(base),
        "facets per lobe",
        ORDER,
        build,
        stages,
        lambda solved: _pick(base, solved),
        Oracle(RESOLVED, _resolved, _first_position),
    )


def levels(stages: Stages) -> tuple[int, ...]:
    """Return the mesh levels: those of a run, or about the facets per lobe that the scene names."""
    given = stages.scene.accuracy.facets_per_lobe
    return climbed(stages.coarsest()[0] if given is None else first_given(given), given)


def _pick(base: Stages, solved: Callable[[str, int | None], Any]) -> Pick:
    """Choose as a run does, among what is solved."""
    accuracy, rung = base.scene.accuracy, named_rung(base.scene)
    if rung == "springs":
        solved(rung, None)
        return Pick(rung, None, None, "", (), True)
    given, all_levels = accuracy.facets_per_lobe, levels(base)

    def best(rung: str | None) -> Chosen:
        return choose(
            accuracy.tolerance if given is None else float("inf"),
            all_levels if given is None else all_levels[:2],
            lambda name, level: solved(name, level).contact.fine,
            lambda: base.model_error(solved("level0", all_levels[0]).contact.level),
            rung,
        )

    chosen, _ = or_level0(best, rung)
    named = rung is not None or given is not None
    error = chosen.error + chosen.model_error
    return Pick(chosen.rung, chosen.levels[-1], error, chosen.of, chosen.levels, named)


def _resolved(reference: Stages, clock: Clock) -> Stages:
    """Return the stages of the first position of `reference` alone, by the resolved model."""
    from trochoid.drives.khv.resolved import resolved_position

    angle = float(reference.contact.fine.angle[0])
    with clock.stage("resolved"):
        found = resolved_position(reference.feasible, angle)
    return _one(reference, "resolved", found.series)


def _first_position(reference: Stages) -> Stages:
    return _one(reference, reference.rung, reference.contact.fine)


def _one(stages: Stages, rung: str, series: Series) -> Stages:
    solved = Solved(repeated(series), None, None, None)
    return Held(stages.scene, Clock(), rung, lambda s: solved)


def repeated(series: Series) -> Series:
    """Return the first position of a series as a turn of one: it stands for the end as well."""

    def twice(values: Array) -> Array:
        return values[[0, 0]]

    def touches(kind: Touches) -> Touches:
        return replace(
            kind,
            force=twice(kind.force),
            pressure=twice(kind.pressure),
            half_width=twice(kind.half_width),
            point=twice(kind.point),
            normal=twice(kind.normal),
        )

    return replace(
        series,
        angle=twice(series.angle),
        crank=twice(series.crank),
        ring=touches(series.ring),
        output=touches(series.output),
        bearing=None if series.bearing is None else touches(series.bearing),
        motion=twice(series.motion),
        stiffness=twice(series.stiffness),
        wandering=twice(series.wandering),
    )
