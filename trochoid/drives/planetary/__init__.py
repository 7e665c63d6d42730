"""The involute planetary set 2K-H: sun, planets, ring with internal teeth, carrier."""

from __future__ import annotations

from trochoid.clock import Clock
from trochoid.drives import Drive
from trochoid.drives.lazy import ladder_of
from trochoid.drives.planetary.answers import QUANTITIES
from trochoid.drives.planetary.outcome import outcome
from trochoid.drives.planetary.plan import plan
from trochoid.drives.planetary.stages import Stages
from trochoid.plan import Plan
from trochoid.scene.drive_planetary import PlanetaryScene


def _plan(scene: PlanetaryScene) -> Plan:
    made = plan(scene)
    if any(stage.needed and stage.name == "geometry" for stage in made.stages):
        Stages(scene, Clock()).feasible  # noqa: B018 - raises Infeasible with every reason
    return made


DRIVE = Drive(Stages, QUANTITIES, outcome, _plan, ladder_of("trochoid.drives.planetary.ladder"))
