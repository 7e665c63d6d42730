"""The RV (2K-V) reducer: an involute stage, crankshafts, cycloid discs between ring pins, the carrier as output."""

from __future__ import annotations

from trochoid.drives import Drive
from trochoid.drives.lazy import ladder_of
from trochoid.drives.rv.answers import QUANTITIES
from trochoid.drives.rv.outcome import outcome
from trochoid.drives.rv.plan import plan
from trochoid.drives.rv.stages import Stages

DRIVE = Drive(Stages, QUANTITIES, outcome, plan, ladder_of("trochoid.drives.rv.ladder"))
