"""Harmonics of sampled records."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.dynamics.spectrum import close_turn, harmonics, highest_harmonic, synthesize
from trochoid.kinematics.errors import TrochoidError


@pytest.mark.exact
@pytest.mark.parametrize(("positions", "highest"), [(3, 1), (4, 1), (5, 2), (60, 29), (61, 30)])
def test_nothing_at_or_above_nyquist(positions: int, highest: int) -> None:
    """Sampling theorem: the last harmonic is below half the positions."""
    assert highest_harmonic(positions) == highest
    assert len(harmonics(np.zeros((positions, 2)))) == highest + 1


@pytest.mark.exact
def test_amplitudes_are_peak_values() -> None:
    """x = 3 + 2 cos(4φ + 0.3): mean 3, amplitude 2·exp(0.3i) at harmonic 4, nothing else."""
    phi = 2.0 * np.pi * np.arange(60) / 60
    lines = harmonics(3.0 + 2.0 * np.cos(4.0 * phi + 0.3))
    expected = np.zeros(30, dtype=complex)
    expected[0], expected[4] = 3.0, 2.0 * np.exp(0.3j)
    assert lines == pytest.approx(expected, abs=1e-14)


@pytest.mark.property
@settings(max_examples=30, deadline=None)
@given(st.integers(1, 20), st.integers(0, 2**31 - 1))
def test_round_trip_of_odd_records(half: int, seed: int) -> None:
    """An odd number of samples has no Nyquist line: nothing is lost, and Parseval holds."""
    samples = np.random.default_rng(seed).normal(size=(2 * half + 1, 2))
    lines = harmonics(samples)
    assert synthesize(lines, len(samples)) == pytest.approx(samples, abs=1e-12)
    power = np.abs(lines[0]) ** 2 + 0.5 * (np.abs(lines[1:]) ** 2).sum(axis=0)
    assert power == pytest.approx((samples**2).mean(axis=0), rel=1e-12)


@pytest.mark.exact
def test_ramp_is_taken_out_and_reported() -> None:
    """cos φ + 0.5·φ/2π closes with a mismatch of 0.5; a ramp about the middle leaves cos φ − 0.25 + 0.5/2."""
    phi = 2.0 * np.pi * np.arange(61) / 60
    periodic, mismatch = close_turn(np.cos(phi) + 0.5 * phi / (2.0 * np.pi))
    assert mismatch == pytest.approx(0.5, abs=1e-14)
    assert periodic == pytest.approx(np.cos(phi[:-1]) + 0.25, abs=1e-14)


@pytest.mark.exact
@pytest.mark.parametrize("positions", [1, 2])
def test_too_few_positions_are_refused(positions: int) -> None:
    """No harmonic fits: say so instead of reporting zero vibration."""
    with pytest.raises(TrochoidError, match="at least 3"):
        harmonics(np.zeros((positions, 1)))
