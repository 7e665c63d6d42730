"""Harmonics of a record that is sampled at equally spaced positions of one period."""

from __future__ import annotations

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, ComplexArray, frozen


def highest_harmonic(positions: int) -> int:
    """Return the highest harmonic below Nyquist's of `positions` samples; raises when there is none."""
    if positions < 3:
        raise TrochoidError(
            f"{positions} position(s) over the period resolve no harmonic; reactions and vibration over time "
            f"need at least 3 (ask.positions), better 4 times the highest order of interest"
        )
    return (positions - 1) // 2


def harmonics(samples: Array) -> ComplexArray:
    """Return peak amplitudes (1 + highest, …) of real `samples` (positions, …); row 0 is the mean.

    The Nyquist line of an even number of samples has no known phase and is left out.
    """
    highest = highest_harmonic(len(samples))
    amplitudes = np.fft.rfft(samples, axis=0)[: highest + 1] * (2.0 / len(samples))
    amplitudes[0] *= 0.5
    return np.asarray(amplitudes, dtype=np.complex128)


def synthesize(amplitudes: ComplexArray, positions: int) -> Array:
    """Return the real samples (positions, …) of peak amplitudes (1 + highest, …); inverse of `harmonics`."""
    lines = np.array(amplitudes, dtype=np.complex128) * (0.5 * positions)
    lines[0] *= 2.0
    return np.asarray(np.fft.irfft(lines, n=positions, axis=0), dtype=np.float64)


def close_turn(samples: Array) -> tuple[Array, Array]:
    """Make a record with both ends, (positions + 1, …), periodic, (positions, …); return it and the mismatch.

    What does not repeat after one period (holes and lobes of unlike number) is taken out as a linear ramp
    about the middle, so that the mean stays; the mismatch says how much that was.
    """
    mismatch = samples[-1] - samples[0]
    ramp = np.linspace(-0.5, 0.5, len(samples))
    periodic = samples - ramp.reshape(-1, *(1,) * (samples.ndim - 1)) * mismatch
    return frozen(periodic[:-1]), frozen(mismatch)
