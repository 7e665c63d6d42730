"""The error of few positions: half of them tell it, for means, peaks and swings."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pytest

from tests.drives.planetary_cases import ELASTIC, FLOATING, RELIEF, series_of
from trochoid.drives.mesh_error import sampling_error
from trochoid.drives.planetary.series import Series
from trochoid.kinematics.types import Array


def thinned(record: Array) -> Callable[[int], Iterator[Array]]:
    """Return what takes every m-th sample, from each of the first m on."""
    return lambda stride: (record[start::stride] for start in range(stride))


def swing(record: Array) -> float:
    """Return peak to peak."""
    return float(np.ptp(record))


@pytest.mark.exact
def test_a_wave_that_half_of_the_positions_fold_down() -> None:
    """cos 12φ at 24 positions: the mean of each half is ±1, that of all is 0; slower waves leave means exact."""
    angle = 2.0 * np.pi * np.arange(24) / 24
    assert sampling_error(np.mean, np.cos(12.0 * angle), thinned(np.cos(12.0 * angle))) == pytest.approx(1.0)
    assert sampling_error(np.mean, np.cos(5.0 * angle), thinned(np.cos(5.0 * angle))) < 1e-15
    assert sampling_error(np.mean, np.ones(1), lambda stride: ()) == 0.0


@pytest.mark.exact
@pytest.mark.parametrize("count", [10, 16, 30])
@pytest.mark.parametrize("shift", [0.0, 0.02, 0.1, 0.5])
def test_a_peak_between_positions_is_bracketed(count: int, shift: float) -> None:
    """A wave whose top falls between two positions: no more is missed than the error, which falls with h²."""
    angle = 2.0 * np.pi * (np.arange(count) + shift) / count
    record = np.cos(angle) + 0.3 * np.cos(2.0 * angle + 0.5)
    fine = 2.0 * np.pi * np.arange(100_000) / 100_000
    missed = float((np.cos(fine) + 0.3 * np.cos(2.0 * fine + 0.5)).max() - record.max())
    error = sampling_error(lambda x: float(x.max()), record, thinned(record))
    assert missed <= error <= 2.0 * (2.0 * np.pi / count) ** 2


@pytest.mark.property
def test_numbers_of_a_set_are_bracketed() -> None:
    """Contacts of a small set over a pitch at 12 positions against 96: within three times the error, but for the
    pressures, which have spikes where tip edges pass.
    """
    effects = (ELASTIC, FLOATING, RELIEF)
    few, many = (series_of(effects=effects, relief=0.01, positions=n)[1] for n in (12, 96))
    numbers: tuple[Callable[[Series], float], ...] = (
        lambda x: float(x.torsional_stiffness.mean()),
        lambda x: float(x.lag.mean()),
        lambda x: swing(x.lag),
        lambda x: float(x.sun.force.max()),
        lambda x: float(x.ring.force.max()),
    )
    for get in numbers:
        assert abs(get(few) - get(many)) <= 3.0 * sampling_error(get, few, few.thinned)
