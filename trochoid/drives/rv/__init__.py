"""The RV (2K-V) reducer: an involute stage, crankshafts, cycloid discs between ring pins, the carrier as output."""

from __future__ import annotations

from trochoid.clock import Clock
from trochoid.drives import Drive
from trochoid.drives.rv.answers import QUANTITIES
from trochoid.drives.rv.outcome import outcome
from trochoid.drives.rv.plan import plan
from trochoid.drives.rv.stages import Stages
from trochoid.ladder import Ladder
from trochoid.scene.drive_rv import RvScene


def _ladder(scene: RvScene, clock: Clock) -> Ladder:
    from trochoid.drives.rv.ladder import ladder

    return ladder(scene, clock)


DRIVE = Drive(Stages, QUANTITIES, outcome, plan, _ladder)
