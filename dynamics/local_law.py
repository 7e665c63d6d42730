"""What is not linear, or not constant, acts along a few deflections: a gap, a mesh whose stiffness varies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

ROUNDING = 1e-3  # of half a gap

Law: TypeAlias = Callable[[Array, Array], tuple[Array, Array]]
"""(deflection (N,) m, phase (N,) rad of the period) → force (N,) N and its slope (N,) N/m."""


@dataclass(frozen=True, slots=True)
class Local:
    """A force of `law` along the deflection `direction`·x (n,); what it adds is not in the system's K.

    `stiffness` (N/m) is a constant that stands for the law where a stiffness is wanted: the iteration is about it.
    `play` (m) is how far it moves before it carries: a search for a loaded motion begins beyond it.
    """

    name: str
    direction: Array
    law: Law
    stiffness: float
    play: float = 0.0


def gap(stiffness: float, half_gap: float, rounding: float = ROUNDING) -> Law:
    """Return the force of two stops at ±`half_gap` (m): backlash; `half_gap` 0 is a plain spring.

    The corner at the stop is rounded over ± `rounding` half gaps: where a motion just touches it, a sharp one has no
    derivative, and that is where motions jump.
    """
    if not (stiffness > 0.0 and half_gap >= 0.0):
        raise TrochoidError(
            f"a gap needs a stiffness above 0 and half a gap of 0 or more, given {stiffness:g} N/m, {half_gap:g} m"
        )

    def law(deflection: Array, phase: Array) -> tuple[Array, Array]:
        beyond, touching = _beyond(deflection, half_gap, rounding)
        return stiffness * beyond, stiffness * touching

    return law


def varying(samples: Array, periods: int = 1, half_gap: float = 0.0, rounding: float = ROUNDING) -> Law:
    """Return k(t) times the deflection beyond ±`half_gap`, k from `samples` (p,), N/m, over one of its periods.

    `periods` of it pass in the period of the motion.  Between samples the trigonometric interpolation holds.
    """
    lines = np.fft.rfft(np.asarray(samples, dtype=np.float64)) / len(samples)
    if not np.all(np.isfinite(lines)) or lines[0].real <= 0.0:
        raise TrochoidError("a varying stiffness needs finite samples with a mean above 0")
    order = periods * np.arange(len(lines))
    weight = np.full(len(lines), 2.0)
    weight[0] = 1.0
    if len(samples) % 2 == 0:
        weight[-1] = 1.0  # the line at Nyquist's frequency stands alone

    def law(deflection: Array, phase: Array) -> tuple[Array, Array]:
        k = (np.exp(1j * np.multiply.outer(phase, order)) @ (weight * lines)).real
        beyond, touching = _beyond(deflection, half_gap, rounding)
        return k * beyond, k * touching

    return law


def _beyond(deflection: Array, half_gap: float, rounding: float) -> tuple[Array, Array]:
    """Return how far a deflection is beyond ±half_gap, with its sign, and the derivative of that."""
    if half_gap == 0.0:
        return deflection, np.ones(deflection.shape)
    corner = rounding * half_gap
    reach = np.abs(deflection) - half_gap
    inside = np.clip(reach + corner, 0.0, 2.0 * corner)
    rounded = inside**2 / (4.0 * corner) if corner > 0.0 else 0.0
    slope = inside / (2.0 * corner) if corner > 0.0 else (reach > 0.0).astype(np.float64)
    return np.sign(deflection) * (rounded + np.maximum(reach - corner, 0.0)), slope
