"""The planetary-cycloid K-H-V reducer: eccentric, cycloid discs between ring pins, parallel-crank output."""

from __future__ import annotations

from dataclasses import replace

from trochoid.clock import Clock
from trochoid.drives import Drive
from trochoid.drives.choosing import COARSEST
from trochoid.drives.khv.answers import QUANTITIES
from trochoid.drives.khv.outcome import outcome
from trochoid.drives.khv.plan import plan
from trochoid.drives.khv.stages import Stages, named_rung
from trochoid.drives.lazy import ladder_of
from trochoid.plan import Plan
from trochoid.scene.drive_khv import KhvScene


def _plan(scene: KhvScene) -> Plan:
    given = scene.accuracy.facets_per_lobe
    rung = named_rung(scene)
    made = plan(scene, rung or "level0", COARSEST if given is None else max(3, given // 2))
    if rung is None:
        made = replace(made, model="level0, or strips where that is not within the tolerance")
    if any(stage.needed and stage.name == "geometry" for stage in made.stages):
        Stages(scene, Clock()).feasible  # noqa: B018 - raises Infeasible with every reason
    return made


DRIVE = Drive(Stages, QUANTITIES, outcome, _plan, ladder_of("trochoid.drives.khv.ladder"))
