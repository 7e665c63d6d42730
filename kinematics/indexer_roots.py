"""All indexers without hard shock of one task: the roots of the synthesis equations.

No hard shock means that at φ0 the pin is on the slot at σψ0 and moves along it: L(P) = L(P') = 0 with
L(v) = v_y cos ψ0 − (v·w) σ sin ψ0, where σ = ±1 is the sense of the wheel.  With P = cos β a + sin β b this is
L(a)L(b') − L(a')L(b) = 0 and tan β = −L(a)/L(b) (sources §5).  In the frame that turns with the arm L(v) = v·A,

    A1 = n_x cos φ0 + n_y sin φ0,  A2 = n_z,  A3 = n_y cos φ0 − n_x sin φ0,   n = e_y cos ψ0 − w σ sin ψ0,

and the equation has two harmonics in γ only, so at most four arms solve it (θ = m φ0):

    A2 A3 cos θ − m sin θ (A1 A2 cos 2γ + ½(A1² − A2²) sin 2γ)
      + (m A1 A3 cos θ − (A1² + A3²) sin θ) sin γ + (m A2 A3 cos θ − A1 A2 sin θ) cos γ = 0.

θ0 = π in place of 0 only turns the sign of both sides: the sign of tan β says which of the two it is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.types import Array, BoolArray, IntArray

DOUBLE = 1e-6  # how far off the unit circle a double root may be computed
ALONG = 1e-9  # arms (rad) nearer to the drive shaft than this are none


@dataclass(frozen=True, eq=False, slots=True)
class Roots:
    """Candidates (n,): γ, β, m, θ0, σ, φ0 and ψ0, rad."""

    arm: Array
    pin: Array
    ratio: Array
    phase: Array
    sense: Array
    half_turn: Array
    half_swing: Array

    @property
    def pin_ratio(self) -> Array:
        """ρ = tan β/tan δ_s."""
        cone = np.sin(np.abs(self.arm)) / (np.abs(self.ratio) + np.sign(self.ratio) * np.cos(self.arm))
        pin_ratio: Array = np.tan(self.pin) / cone
        return pin_ratio

    def take(self, which: BoolArray | IntArray) -> Roots:
        """Return some of them."""
        return Roots(*(getattr(self, name)[which] for name in Roots.__slots__))


def joined(parts: list[Roots]) -> Roots:
    """Return the candidates of all parts."""
    return Roots(*(np.concatenate([getattr(part, name) for part in parts]) for name in Roots.__slots__))


def roots_by_duration(
    half_swing: npt.ArrayLike, half_turn: npt.ArrayLike, planet: int, shaft_angle: float
) -> Roots:
    """All candidates for ψ0 and φ0 (n,), rad: both kinds of planet, both senses of the wheel, near and far.

    Of the two names that every mechanism has (the planet's axis from either end, which also swaps epi and
    hypo) the one with P·w > 0 in mid-index is kept.
    """
    psi, phi = (np.atleast_1d(x).astype(np.float64) for x in (half_swing, half_turn))
    psi, phi = (np.tile(x, 4) for x in np.broadcast_arrays(psi, phi))
    m, sense = (np.repeat(x, phi.size // 4) for x in planet_and_sense(planet))
    A = slot_normal(sense * psi, shaft_angle, phi)
    arm, which = trigonometric_roots(_arm_harmonics(A, m, m * phi))
    m, sense, phi, psi = m[which], sense[which], phi[which], psi[which]
    pin = _pin(A[:, which], arm, m * phi)
    return facing(arm, pin, m, sense, phi, psi, shaft_angle)


def planet_and_sense(planet: int) -> tuple[Array, Array]:
    """The four pairs of m = ±i and σ = ±1."""
    return planet * np.array([1.0, 1.0, -1.0, -1.0]), np.array([1.0, -1.0, 1.0, -1.0])


def facing(
    arm: Array, pin: Array, m: Array, sense: Array, phi: Array, psi: Array, shaft_angle: float
) -> Roots:
    """Candidates with P·w > 0 in mid-index, from pin angles whose sign stands for θ0.

    A pin square to the planet's axis, ρ without end, is left out.
    """
    found = Roots(arm, np.abs(pin), m, np.where(pin < 0.0, math.pi, 0.0), sense, phi, psi)
    square = found.pin > 0.5 * math.pi - ALONG
    return found.take((np.sin(shaft_angle - arm - pin) > 0.0) & (np.abs(np.sin(arm)) > ALONG) & ~square)


def slot_normal(angle: Array, shaft_angle: float, half_turn: Array) -> Array:
    """A (3, n): L in the frame of the arm at φ0, the slot at `angle`."""
    x, y, z = math.cos(shaft_angle) * np.sin(angle), np.cos(angle), -math.sin(shaft_angle) * np.sin(angle)
    c, s = np.cos(half_turn), np.sin(half_turn)
    return np.stack((x * c + y * s, z, y * c - x * s))


def _arm_harmonics(A: Array, m: Array, theta: Array) -> Array:
    c, s = clean(theta)
    a1, a2, a3 = A
    return np.stack(
        (
            a2 * a3 * c,
            m * a2 * a3 * c - a1 * a2 * s,
            m * a1 * a3 * c - (a1**2 + a3**2) * s,
            -m * s * a1 * a2,
            -0.5 * m * s * (a1**2 - a2**2),
        )
    )


def clean(theta: Array) -> tuple[Array, Array]:
    """Cosine and sine, zero where they are so but for rounding of the angle."""
    c, s = np.cos(theta), np.sin(theta)
    noise = 4e-16 * (1.0 + np.abs(theta))
    return np.where(np.abs(c) < noise, 0.0, c), np.where(np.abs(s) < noise, 0.0, s)


def _pin(A: Array, arm: Array, theta: Array) -> Array:
    """Pin angle in (−π/2, π/2), negative for θ0 = π."""
    c, s = clean(theta)
    on_axis = np.sin(arm) * A[0] + np.cos(arm) * A[1]
    across = c * (np.cos(arm) * A[0] - np.sin(arm) * A[1]) + s * A[2]
    pin: Array = np.arctan2(-on_axis * np.where(across < 0.0, -1.0, 1.0), np.abs(across))
    return pin


def trigonometric_roots(harmonics: Array) -> tuple[Array, IntArray]:
    """Real roots in (−π, π] of trigonometric polynomials, and the column (n,) that each belongs to.

    `harmonics` (5, c) are the coefficients of 1, cos γ, sin γ, cos 2γ, sin 2γ.  Eigenvalues of the companion
    matrix in exp(iγ), then Newton; columns that vanish have none.
    """
    size = np.abs(harmonics).max(axis=0)
    f = harmonics / np.where(size > 1e-14, size, 1.0)
    lead = 0.5 * (f[3] - 1j * f[4])
    full = np.flatnonzero((np.abs(lead) > 1e-6) & (size > 1e-14))
    short = np.flatnonzero((np.abs(lead) <= 1e-6) & (size > 1e-14))  # the other two are far off the circle
    one, top = 0.5 * (f[1] - 1j * f[2])[full], lead[full]
    matrix = np.zeros((full.size, 4, 4), dtype=np.complex128)
    matrix[:, 0] = -(np.stack((one, f[0, full], one.conj(), top.conj()), axis=-1) / top[:, None])
    matrix[:, 1, 0] = matrix[:, 2, 1] = matrix[:, 3, 2] = 1.0
    x = np.linalg.eigvals(matrix)
    i, j = np.nonzero(np.abs(np.abs(x) - 1.0) < DOUBLE)
    arch = -f[0, short] / np.maximum(np.hypot(f[1, short], f[2, short]), 1e-300)
    near = np.abs(arch) < 1.0 + DOUBLE
    middle, half = np.arctan2(f[2, short], f[1, short])[near], np.arccos(np.clip(arch[near], -1.0, 1.0))
    start = np.concatenate((np.angle(x[i, j]), middle - half, middle + half))
    which = np.concatenate((full[i], short[near], short[near])).astype(np.intp)
    return _polished(f[:, which], start, which)


def _polished(f: Array, gamma: Array, which: IntArray) -> tuple[Array, IntArray]:
    for _ in range(4):
        c, s, c2, s2 = np.cos(gamma), np.sin(gamma), np.cos(2.0 * gamma), np.sin(2.0 * gamma)
        value = f[0] + f[1] * c + f[2] * s + f[3] * c2 + f[4] * s2
        slope = -f[1] * s + f[2] * c + 2.0 * (f[4] * c2 - f[3] * s2)
        step = np.where(np.abs(slope) > 1e-9, value / np.where(slope == 0.0, 1.0, slope), 0.0)
        gamma = gamma - np.clip(step, -1e-3, 1e-3)
    order = np.lexsort((gamma, which))
    kept = order[np.abs(value[order]) < 1e-10]
    wrapped: Array = np.angle(np.exp(1j * gamma[kept]))
    return wrapped, which[kept]
