"""The precessional K-H-V drive: a nutating satellite between pins and sphere teeth."""

from __future__ import annotations

from trochoid.clock import Clock
from trochoid.drives import Drive
from trochoid.drives.precessional.answers import QUANTITIES
from trochoid.drives.precessional.outcome import outcome
from trochoid.drives.precessional.plan import plan
from trochoid.drives.precessional.stages import Stages
from trochoid.ladder import Ladder
from trochoid.plan import Plan
from trochoid.scene.drive_precessional import PrecessionalScene


def _plan(scene: PrecessionalScene) -> Plan:
    made = plan(scene)
    if any(stage.needed and stage.name == "geometry" for stage in made.stages):
        Stages(scene, Clock()).feasible  # noqa: B018 - raises Infeasible with every reason
    return made


def _ladder(scene: PrecessionalScene, clock: Clock) -> Ladder:
    from trochoid.drives.precessional.ladder import ladder

    return ladder(scene, clock)


DRIVE = Drive(Stages, QUANTITIES, outcome, _plan, _ladder)
