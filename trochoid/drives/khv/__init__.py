"""The planetary-cycloid K-H-V reducer: eccentric, cycloid discs between ring pins, parallel-crank output."""

from __future__ import annotations

from trochoid.clock import Clock
from trochoid.drives import Drive
from trochoid.drives.khv.answers import QUANTITIES
from trochoid.drives.khv.outcome import outcome
from trochoid.drives.khv.plan import plan
from trochoid.drives.khv.stages import COARSEST, Stages, rung_of
from trochoid.plan import Plan
from trochoid.scene import Scene


def _plan(scene: Scene) -> Plan:
    given = scene.accuracy.facets_per_lobe
    made = plan(scene, rung_of(scene), COARSEST if given is None else max(3, given // 2))
    if any(stage.needed and stage.name == "geometry" for stage in made.stages):
        Stages(scene, Clock()).feasible  # noqa: B018 - raises Infeasible with every reason
    return made


DRIVE = Drive(Stages, QUANTITIES, outcome, _plan)
