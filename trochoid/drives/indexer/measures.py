"""What both mechanisms are compared by, each measured once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from trochoid.drives.indexer.design import Design
from trochoid.kinematics.indexer import Indexer, shock
from trochoid.kinematics.indexer_measure import Dwell, Peaks, Similarity, dwell, peaks, similarity


@dataclass(frozen=True, slots=True)
class Measured:
    """A mechanism, its peaks, constants and rest, and the speed (per unit drive speed) with which an index starts."""

    indexer: Indexer
    peaks: Peaks
    constants: Similarity
    dwell: Dwell
    shock: float


def measure(design: Design) -> Mapping[str, Measured]:
    """Measure the indexer and the Geneva wheel beside it."""
    return {name: _measured(made) for name, made in design.mechanisms.items()}


def _measured(indexer: Indexer) -> Measured:
    top = peaks(indexer)
    return Measured(indexer, top, similarity(indexer, top), dwell(indexer), shock(indexer))
