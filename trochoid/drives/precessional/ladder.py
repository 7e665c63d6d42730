"""The ladder of a precessional drive: one contact model, facets on a tooth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from trochoid.clock import Clock
from trochoid.drives.choosing import choose
from trochoid.drives.precessional import headline
from trochoid.drives.precessional.plan import STAGES_OF
from trochoid.drives.precessional.stages import Stages
from trochoid.kinematics.errors import SceneError
from trochoid.ladder import Ladder, Pick, Rung
from trochoid.scene.drive_precessional import PrecessionalScene

if TYPE_CHECKING:
    from trochoid.drives.precessional.contact_stages import Solved, Teeth
    from trochoid.drives.precessional.teeth import Level

RUNGS = (Rung("slices", "elastic rim and rollers, each contact a row of slices", True),)
ORDER = 2.0


@dataclass(frozen=True)
class Held(Stages):
    """The stages of a scene whose contacts are solved on one level alone."""

    made: Level

    @cached_property
    def contact(self) -> Solved:
        """Contacts over a pitch."""
        return _teeth(self).alone(self.made)


def ladder(scene: PrecessionalScene, clock: Clock) -> Ladder:
    """Return what may be climbed; raises SceneError for rigid teeth and without teeth, Infeasible."""
    if not scene.has("elastic_contact"):
        raise SceneError(
            'teeth are rigid: the effect "elastic_contact" is not listed, so that there is no mesh to compare; add '
            '[[effects]] with type = "elastic_contact"'
        )
    base = Stages(scene, clock)
    teeth = _teeth(base)

    def build(level: int, clock: Clock) -> Level:
        return _teeth(Stages(scene, clock)).level(level)

    return Ladder(
        headline.title(base),
        tuple(name for name in scene.ask.quantities if "contact" in STAGES_OF[name]),
        RUNGS,
        teeth.levels,
        "facets per tooth",
        ORDER,
        build,
        lambda _, built, clock: Held(scene, clock, built),
        lambda solved: _pick(teeth, solved),
    )


def _teeth(stages: Stages) -> Teeth:
    if stages.teeth is None:
        raise SceneError("the scene has no teeth: add the table [drive.teeth]")
    return stages.teeth


def _pick(teeth: Teeth, solved: Callable[[str, int | None], Any]) -> Pick:
    """Choose as a run does, among what is solved."""
    from trochoid.drives.precessional.estimate import worst_error

    accuracy = teeth.design.scene.accuracy
    chosen = choose(
        accuracy.tolerance if accuracy.facets_per_lobe is None else float("inf"),
        teeth.levels,
        lambda name, level: solved(name, level).contact.fine,
        worst_error,
        lambda: 0.0,
        RUNGS[0].name,
        "facets per tooth",
    )
    named = accuracy.facets_per_lobe is not None
    return Pick(chosen.rung, chosen.levels[-1], chosen.error, chosen.of, chosen.levels, named)
