"""The ladder of an RV drive: contact models with Hertz's or resolved pressure, facets per lobe."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from trochoid.clock import Clock
from trochoid.drives.choosing import Chosen, choose, climbed, first_given, or_level0
from trochoid.drives.mesh_error import Pair
from trochoid.drives.rv import headline
from trochoid.drives.rv.plan import STAGES_OF
from trochoid.drives.rv.stages import Solved, Stages
from trochoid.kinematics.errors import SceneError
from trochoid.ladder import Ladder, Pick, Rung
from trochoid.scene.drive_rv import RvScene

if TYPE_CHECKING:
    from trochoid.drives.rv.bodies import Level

RUNGS = (
    Rung("level0", "elastic discs, one force per contact and Hertz's pressure under it", True),
    Rung("strips", "elastic discs, the pressure of each contact resolved by strips", True),
)
ORDER = 3.0  # benchmarks/disc.py


@dataclass(frozen=True)
class Held(Stages):
    """The stages of a scene whose contacts are on one rung and on one level alone."""

    held: str
    built: Level

    @property
    def rung(self) -> str:
        """The contact model."""
        return self.held

    @cached_property
    def contact(self) -> Solved:
        """Contacts over a turn of the crankshafts."""
        from trochoid.drives.rv.series import turn_angles

        angle = turn_angles(self.design, self.scene.ask.positions)
        fine = self.series(self.built, self.held, angle)
        return Solved(fine, Pair(fine, None), Pair(self.built, None))


def ladder(scene: RvScene, clock: Clock) -> Ladder:
    """Return what may be climbed; raises SceneError without elastic contact, Infeasible."""
    if not scene.has("elastic_contact"):
        raise SceneError(
            'members are rigid: the effect "elastic_contact" is not listed, so that there is no model and no mesh to '
            'compare; add [[effects]] with type = "elastic_contact"'
        )
    base = Stages(scene, clock)
    base.feasible  # noqa: B018 - raises Infeasible with every reason
    return Ladder(
        headline.title(base),
        tuple(name for name in scene.ask.quantities if "contact" in STAGES_OF[name]),
        RUNGS,
        levels(base),
        "facets per lobe",
        ORDER,
        lambda level, clock: Stages(scene, clock).level(level),
        lambda rung, built, clock: Held(scene, clock, rung, built),
        lambda solved: _pick(base, solved),
    )


def levels(stages: Stages) -> tuple[int, ...]:
    """Return the mesh levels: those of a run, or about the facets per lobe that the scene names."""
    given = stages.scene.accuracy.facets_per_lobe
    return climbed(stages.coarsest()[0] if given is None else first_given(given), given)


def _pick(base: Stages, solved: Callable[[str, int | None], Any]) -> Pick:
    """Choose as a run does, among what is solved."""
    from trochoid.drives.rv.estimate import worst_error

    accuracy, all_levels = base.scene.accuracy, levels(base)
    given = accuracy.facets_per_lobe

    def best(rung: str | None) -> Chosen:
        return choose(
            accuracy.tolerance if given is None else float("inf"),
            all_levels if given is None else all_levels[:2],
            lambda name, level: solved(name, level).contact.fine,
            worst_error,
            lambda: base.model_error(solved("level0", all_levels[0]).built),
            rung,
        )

    chosen, _ = or_level0(best, accuracy.model)
    named = accuracy.model is not None or given is not None
    error = chosen.error + chosen.model_error
    return Pick(chosen.rung, chosen.levels[-1], error, chosen.of, chosen.levels, named)
