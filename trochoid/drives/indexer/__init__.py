"""The spherical planetary-pin indexer: a pin on a bevel planet turns a slotted wheel, and lets it rest."""

from __future__ import annotations

from trochoid.drives import Drive
from trochoid.drives.indexer.answers import QUANTITIES
from trochoid.drives.indexer.outcome import outcome
from trochoid.drives.indexer.plan import plan
from trochoid.drives.indexer.stages import Stages

DRIVE = Drive(Stages, QUANTITIES, outcome, plan)
