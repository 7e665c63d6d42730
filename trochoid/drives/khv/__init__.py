"""The planetary-cycloid K-H-V reducer: eccentric, cycloid discs between ring pins, parallel-crank output."""

from __future__ import annotations

from trochoid.drives import Drive
from trochoid.drives.khv.answers import QUANTITIES
from trochoid.drives.khv.outcome import outcome
from trochoid.drives.khv.plan import plan
from trochoid.drives.khv.stages import COARSEST, Stages, rung_of
from trochoid.plan import Plan
from trochoid.scene import Scene


def _plan(scene: Scene) -> Plan:
    given = scene.accuracy.facets_per_lobe
    return plan(scene, rung_of(scene), COARSEST if given is None else max(3, given // 2))


DRIVE = Drive(Stages, QUANTITIES, outcome, _plan)
