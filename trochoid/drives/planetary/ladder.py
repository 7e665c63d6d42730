"""The ladder of a planetary set: contact models, facets per flank."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from trochoid.clock import Clock
from trochoid.drives.choosing import Chosen, choose, or_level0
from trochoid.drives.planetary import headline
from trochoid.drives.planetary.plan import STAGES_OF
from trochoid.drives.planetary.stages import Solved, Stages
from trochoid.kinematics.errors import SceneError
from trochoid.ladder import Ladder, Pick, Rung
from trochoid.scene.drive_planetary import PlanetaryScene

if TYPE_CHECKING:
    from trochoid.drives.planetary.bodies import Level

RUNGS = (
    Rung("level0", "elastic wheels, one force per pair of teeth and Hertz's pressure under it", True),
    Rung("strips", "elastic wheels, the pressure of each pair resolved by strips", True),
)
ORDER = 2.0


@dataclass(frozen=True)
class Held(Stages):
    """The stages of a scene whose contacts are made elsewhere: on one rung, and on one level alone."""

    make: Callable[[Stages], Solved]

    @cached_property
    def contact(self) -> Solved:
        """Contacts over a pitch."""
        return self.make(self)


def ladder(scene: PlanetaryScene, clock: Clock) -> Ladder:
    """Return what may be climbed; raises SceneError for rigid wheels, Infeasible."""
    if not scene.has("elastic_contact"):
        raise SceneError(
            'wheels are rigid: the effect "elastic_contact" is not listed, so that there is no mesh to compare; add '
            '[[effects]] with type = "elastic_contact"'
        )
    base = Stages(scene, clock)
    base.feasible  # noqa: B018 - raises Infeasible with every reason

    def build(level: int, clock: Clock) -> Level:
        return Stages(scene, clock).level(level)

    def stages(rung: str, built: Level, clock: Clock) -> Stages:
        return Held(scene, clock, lambda s: Solved(s.series(built, rung), None, built, None))

    return Ladder(
        headline.title(base),
        tuple(name for name in scene.ask.quantities if "contact" in STAGES_OF[name]),
        RUNGS,
        base.levels,
        "facets per flank",
        ORDER,
        build,
        stages,
        lambda solved: _pick(base, solved),
    )


def _pick(base: Stages, solved: Callable[[str, int | None], Any]) -> Pick:
    """Choose as a run does, among what is solved."""
    from trochoid.drives.planetary.estimate import worst_error

    accuracy = base.scene.accuracy

    def best(rung: str | None) -> Chosen:
        return choose(
            accuracy.tolerance if accuracy.facets_per_lobe is None else float("inf"),
            base.levels,
            lambda name, level: solved(name, level).contact.fine,
            worst_error,
            lambda: base.model_error(solved("level0", base.levels[0]).contact.level),
            rung,
        )

    chosen, _ = or_level0(best, accuracy.model)
    named = accuracy.model is not None or accuracy.facets_per_lobe is not None
    error = chosen.error + chosen.model_error
    return Pick(chosen.rung, chosen.levels[-1], error, chosen.of, chosen.levels, named)
