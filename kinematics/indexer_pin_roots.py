"""Indexers without hard shock whose pin ratio ρ is given: the drive angle of the index follows.

With tan β = ρ sin γ/(i + s cos γ) the condition L(P) = 0 has two harmonics in γ, and L(P') = 0, over sin γ, one:

    (i + s cos γ) A3 (1 + sρ cos θ) = ρ sin θ (A1(1 + m cos γ) − m A2 sin γ).

Putting the two roots of the second into the first gives one smooth function of φ0, a trigonometric polynomial
of degree 6(i + 1).  Its zeros are found from samples, and solved for γ as if φ0 had been given.  ρ < 0 stands
for θ0 = π, −φ0 for the other sense of the wheel; φ0 + π gives the same function again, of (−1)^i ρ.
"""

from __future__ import annotations

import math

import numpy as np

from trochoid.kinematics.indexer_roots import (
    Roots,
    clean,
    facing,
    joined,
    planet_and_sense,
    roots_by_duration,
    slot_normal,
    trigonometric_roots,
)
from trochoid.kinematics.types import Array
from trochoid.kinematics.zeros import zeros_around


def roots_by_pin(half_swing: float, pin_ratio: float, planet: int, shaft_angle: float) -> Roots:
    """All candidates for ψ0 (rad) and ρ, but for indices of less than 1e-4 rad of the drive.

    A double root, at which two solutions merge, counts only if rounding parts it.
    """
    # −i with −ρ names the same mechanisms from the other end of the planet's axis; an odd i with −ρ half a turn on
    turns = _zeros(half_swing, pin_ratio, planet, shaft_angle)
    if planet % 2 == 0:
        turns = np.concatenate((turns, _zeros(half_swing, -pin_ratio, planet, shaft_angle)))
    turns = np.concatenate((turns, math.pi - np.abs(turns)))
    turns = np.abs(turns[np.abs(np.sin(turns)) > 1e-4])
    if pin_ratio == 1.0:
        turns = np.concatenate((turns, math.pi / planet * np.arange(1, planet)))
    found = roots_by_duration(half_swing, turns, planet, shaft_angle)
    found = found.take(np.abs(found.pin_ratio - pin_ratio) < 1e-6 * pin_ratio)
    return _distinct(joined([found, *_free_arms(half_swing, pin_ratio, planet, shaft_angle)]))


def _free_arms(half_swing: float, pin_ratio: float, planet: int, shaft_angle: float) -> list[Roots]:
    """Candidates at φ0 = jπ/i where A3 = 0: there L(P') = 0 holds for every arm."""
    ratio, sense = planet_and_sense(planet)
    found = []
    for j in range(1, planet):
        phi, psi = np.full(4, math.pi * j / planet), np.full(4, half_swing)
        A = slot_normal(sense * psi, shaft_angle, phi)
        free = np.abs(A[2]) < 1e-12
        if not free.any():
            continue
        for rho in (pin_ratio, -pin_ratio):
            harmonics = np.where(free, _on_slot(A, ratio, rho, ratio * phi), 0.0)
            arm, which = trigonometric_roots(harmonics)
            m = ratio[which]
            pin = np.arctan(rho * np.sin(arm) / (planet + np.sign(m) * np.cos(arm)))
            found.append(facing(arm, pin, m, sense[which], phi[which], psi[which], shaft_angle))
    return found


def _on_slot(A: Array, m: Array, pin_ratio: float, theta: Array) -> Array:
    """Coefficients (5, n) of 1, cos γ, sin γ, cos 2γ, sin 2γ in L(P) = 0, times (i + s cos γ)/cos β."""
    c, s = clean(theta)
    i, sign, r = np.abs(m), np.sign(m), pin_ratio
    plus, minus = sign + r * c, sign - r * c
    a1, a2, a3 = A
    return np.stack((0.5 * minus * a2, i * a2, i * a1 + r * s * a3, 0.5 * plus * a2, 0.5 * plus * a1))


def _along_slot(A: Array, m: Array, pin_ratio: float, theta: Array) -> Array:
    """Coefficients (3, n) of 1, cos γ, sin γ in L(P') = 0; for ρ = 1 freed of the factor that makes the cusp."""
    i, sign, r = np.abs(m), np.sign(m), pin_ratio
    if abs(r) != 1.0:
        still, turning = 1.0 + sign * r * np.cos(theta), r * np.sin(theta)
    else:
        half, even = 0.5 * theta, sign * r > 0.0
        still = np.where(even, np.cos(half), np.sin(half))
        turning = r * np.where(even, np.sin(half), np.cos(half))
    a1, a2, a3 = A
    return np.stack((i * a3 * still - turning * a1, sign * a3 * still - turning * m * a1, turning * m * a2))


def _eliminated(half_swing: float, pin_ratio: float, m: float, shaft_angle: float, phi: Array) -> Array:
    """Both conditions without γ: zero at the half index angles φ0 that solve them."""
    ratio = np.full_like(phi, m)
    A = slot_normal(np.full_like(phi, half_swing), shaft_angle, phi)
    q0, qc, qs, qc2, qs2 = _on_slot(A, ratio, pin_ratio, m * phi)
    p0, pc, ps = _along_slot(A, ratio, pin_ratio, m * phi)
    square, delta = pc**2 + ps**2, np.arctan2(ps, pc)
    c, s, c2, s2 = np.cos(delta), np.sin(delta), np.cos(2.0 * delta), np.sin(2.0 * delta)
    x = -p0 / np.sqrt(np.maximum(square, 1e-300))  # cosine of the angle from δ to either root
    even = q0 + (qc * c + qs * s) * x + (qc2 * c2 + qs2 * s2) * (2.0 * x**2 - 1.0)
    odd = qs * c - qc * s + 2.0 * (qs2 * c2 - qc2 * s2) * x
    value: Array = square**2 * (even**2 - (1.0 - x**2) * odd**2)
    return value


def _zeros(half_swing: float, pin_ratio: float, planet: int, shaft_angle: float) -> Array:
    """Zeros over a turn of φ0 in (−π, π), over half a turn where i is even."""
    fold = 2 if planet % 2 == 0 else 1
    found = zeros_around(
        lambda x: _eliminated(half_swing, pin_ratio, float(planet), shaft_angle, x / fold),
        6 * (planet + 1) // fold,
    )
    return found / fold


def _distinct(roots: Roots) -> Roots:
    key = np.round(np.stack((roots.half_turn, roots.arm, roots.ratio, roots.sense)), 8)
    _, first = np.unique(key, axis=1, return_index=True)
    return roots.take(np.sort(first).astype(np.intp))
