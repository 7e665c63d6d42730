"""Stiffness-aware motion: what the inertia of elastic members adds to their quasi-static motion.

Members that yield under the rotating loads do not stay on their rigid paths.  With q the quasi-static
motion, the motion q + y obeys M (q̈ + ÿ) + C ẏ + K(φ) y = 0: the moving mass adds inertia forces, and where a
harmonic comes near a natural frequency it is amplified.  That is the whole difference between rigid and
elastic reactions; it falls with 1/K.  Coordinates lie along axes that do not turn.  C is modal; each spring
takes the part of it that belongs to its share of K̄, y + T ẏ with C = K̄ T, so that forces and inertia
balance exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from trochoid.dynamics.modes import FrequencyResponse, natural_modes
from trochoid.dynamics.spectrum import harmonics, synthesize
from trochoid.kinematics.errors import NotConverged, TrochoidError
from trochoid.kinematics.types import Array, ComplexArray, frozen

COUPLED = 60  # harmonics that the variation of the stiffness may couple: 1500 Hz at 1500 rpm
DENSE = 3000  # unknowns up to which a varying stiffness is solved directly when iterating fails


@dataclass(frozen=True, slots=True)
class Resonance:
    """The excited mode with the largest amplification: `factor` = |spring force / its quasi-static value|."""

    harmonic: int
    frequency: float
    natural_frequency: float
    factor: float


@dataclass(frozen=True, slots=True)
class Response:
    """Motion of elastic members over one record of n_pos positions, n coordinates.

    `motion` = q + y, `correction` = y, `spring_correction` = y + T ẏ (deflection whose springs give the
    force with damping), `acceleration` = q̈ + ÿ and `inertia` = −M (q̈ + ÿ) = K y + K̄ T ẏ, all (n_pos, n).
    `frequencies` (nh,) Hz and peak `amplitudes` (nh, n) of the motion for harmonics 1…nh,
    `natural_frequencies` (n,) Hz.  `stiffness_variation` is the largest relative departure of K(φ) from its
    mean, `variation_effect` how much of the motion y comes from it, relative.
    """

    motion: Array
    correction: Array
    spring_correction: Array
    acceleration: Array
    inertia: Array
    frequencies: Array
    amplitudes: ComplexArray
    natural_frequencies: Array
    resonance: Resonance | None
    stiffness_variation: float
    variation_effect: float
    warnings: tuple[str, ...]


def respond(
    motion: Array, mass: Array, stiffness: Array, speed: float, damping_ratio: float = 0.02
) -> Response:
    """Return the response to a quasi-static `motion` (n_pos, n), periodic with the angular `speed` in rad/s.

    `mass` (n, n); `stiffness` (n, n) or (n_pos, n, n); `damping_ratio` of every mode of the mean stiffness.
    Free modes are allowed: no net force acts on them, so their harmonics vanish.  Raises for speed ≤ 0, fewer
    than 3 positions, bad matrices, and resonance without damping; NotConverged where a stiffness that varies
    excites itself.
    """
    q, stiffnesses = _checked(motion, stiffness, speed, damping_ratio)
    mean = stiffnesses.mean(axis=0)
    basis = natural_modes(mass, mean)
    still = harmonics(q)[1:]
    order: Array = speed * np.arange(1.0, len(still) + 1.0)
    answer = FrequencyResponse(basis, order, damping_ratio)
    first = _series(answer.to((order[:, None] ** 2) * (still @ np.asarray(mass))) @ basis.shapes.T, len(q))
    correction = first if len(stiffnesses) == 1 else _coupled(answer, stiffnesses - mean, first)
    lines = harmonics(correction)
    y = lines[1:]
    springs = ((y @ np.asarray(mass) @ basis.shapes) * answer.spring_factor()) @ basis.shapes.T
    resonance = _strongest(answer, still, np.asarray(mass))
    amplitudes = np.array(still + y)
    amplitudes.setflags(write=False)
    acceleration = _series(-(order[:, None] ** 2) * amplitudes, len(q))
    return Response(
        motion=frozen(q + correction),
        correction=frozen(correction),
        spring_correction=frozen(lines[0].real + _series(springs, len(q))),
        acceleration=frozen(acceleration),
        inertia=frozen(-acceleration @ np.asarray(mass)),
        frequencies=frozen(order / (2.0 * np.pi)),
        amplitudes=amplitudes,
        natural_frequencies=basis.hertz,
        resonance=resonance,
        stiffness_variation=_departure(stiffnesses),
        variation_effect=_relative(correction - first, correction, mean),
        warnings=_warnings(resonance),
    )


def explain(response: Response, names: Sequence[str]) -> str:
    """Say in one sentence why elastic reactions differ from rigid ones here; `names` of the coordinates."""
    effort = np.abs(response.inertia * response.acceleration).max(axis=0)
    text = (
        "elastic members leave their rigid paths and the inertia of that motion adds to the loads, "
        f"most of all in {names[int(np.argmax(effort))]}"
    )
    if response.resonance is None or abs(response.resonance.factor - 1.0) < 0.05:
        return f"{text}; no harmonic comes near a natural frequency"
    peak = response.resonance
    return (
        f"{text}; harmonic {peak.harmonic} ({peak.frequency:.4g} Hz) meets the mode at "
        f"{peak.natural_frequency:.4g} Hz, which multiplies its spring force by {peak.factor:.3g}"
    )


def _checked(motion: Array, stiffness: Array, speed: float, damping_ratio: float) -> tuple[Array, Array]:
    q, k = np.asarray(motion, dtype=np.float64), np.asarray(stiffness, dtype=np.float64)
    if not (np.isfinite(speed) and speed > 0.0):
        raise TrochoidError(f"dynamics needs a speed above 0, given {speed} rad/s")
    if not 0.0 <= damping_ratio < 1.0:
        raise TrochoidError(f"damping_ratio must be at least 0 and below 1, given {damping_ratio}")
    if q.ndim != 2 or not np.isfinite(q).all():
        raise TrochoidError(f"motion must be finite, (positions, coordinates), given shape {q.shape}")
    if k.ndim == 2:
        k = k[None]
    if k.shape[1:] != (q.shape[1], q.shape[1]) or len(k) not in (1, len(q)):
        raise TrochoidError(f"stiffness {k.shape} does not belong to {q.shape[0]} positions of {q.shape[1]}")
    return q, k


def _series(amplitudes: ComplexArray, positions: int) -> Array:
    """Return the zero-mean record (positions, n) of harmonics 1…nh."""
    return synthesize(np.concatenate([np.zeros_like(amplitudes[:1]), amplitudes]), positions)


def _coupled(answer: FrequencyResponse, change: Array, first: Array) -> Array:
    """Return y (n_pos, n) with the varying stiffness; harmonics above COUPLED see the mean stiffness only."""
    samples = 2 * COUPLED + 1
    if len(first) <= samples:
        return _varying(answer, change, first)

    def lower(record: Array) -> Array:
        return synthesize(harmonics(record)[: COUPLED + 1], samples)

    low = lower(first)
    added = _varying(replace(answer, order=answer.order[:COUPLED]), lower(change), low) - low
    return np.asarray(first + synthesize(harmonics(added), len(first)))


def _varying(answer: FrequencyResponse, change: Array, first: Array) -> Array:
    """Solve y = y₁ − G[(K(φ) − K̄) y], with y₁ (n_pos, n) and G the answers of the mean stiffness."""
    from scipy.sparse.linalg import LinearOperator, gmres

    shapes, natural = answer.modes.shapes, answer.modes.angular_frequencies
    held = np.divide(1.0, natural**2, out=np.zeros_like(natural), where=natural > 0.0)

    def moved(flat: Array) -> Array:
        y = flat.reshape(first.shape)
        lines = harmonics(np.einsum("pij,pj->pi", change, y))
        modal = np.concatenate([(lines[:1] @ shapes) * held, answer.to(lines[1:])])
        lines = np.asarray(modal @ shapes.T, dtype=np.complex128)
        return np.asarray((y + synthesize(lines, len(y))).ravel())

    size = first.size
    scale = float(np.abs(first).max(initial=0.0))
    if scale == 0.0:
        return first
    right = first.ravel() / scale
    operator = LinearOperator((size, size), matvec=moved, dtype=np.float64)
    y, failed = gmres(operator, right, rtol=1e-11, restart=min(size, 100), maxiter=5)
    if failed and size <= DENSE:  # contacts that come and go: too far from the mean for an iteration
        y = np.linalg.solve(np.column_stack([moved(unit) for unit in np.eye(size)]), right)
    if np.abs(moved(y) - right).max() > 1e-6 * np.abs(y).max():
        raise NotConverged(
            "reactions: no steady elastic motion was found with the stiffness of every position; ask for fewer "
            "positions, raise operation.damping_ratio, or change the speed"
        )
    return np.asarray(scale * y.reshape(first.shape))


def _departure(stiffnesses: Array) -> float:
    """Return the largest departure of K(φ) from its mean, relative to the mean's diagonal."""
    mean = stiffnesses.mean(axis=0)
    size = np.sqrt(np.abs(np.diag(mean)))
    scale = np.divide(1.0, size, out=np.zeros_like(size), where=size > 0.0)
    return float(np.linalg.norm((stiffnesses - mean) * np.outer(scale, scale), ord=2, axis=(1, 2)).max())


def _relative(part: Array, whole: Array, mean: Array) -> float:
    """Return the size of one motion over another's, coordinates weighted by their stiffness."""
    size = np.sqrt(np.abs(np.diag(mean)))
    reach = float(np.linalg.norm(whole * size))
    return float(np.linalg.norm(part * size)) / reach if reach > 0.0 else 0.0


def _strongest(answer: FrequencyResponse, still: ComplexArray, mass: Array) -> Resonance | None:
    """Return the most amplified line among those with at least 1 % of the largest quasi-static effort."""
    natural = answer.modes.angular_frequencies
    weight = np.abs(still @ mass @ answer.modes.shapes) * natural
    if not weight.any():
        return None
    below = answer.denominator()
    below = np.where(below == 0.0, np.inf, below)
    factor = np.abs(natural**2 * answer.spring_factor() / below) * (weight >= 0.01 * weight.max())
    line, mode = np.unravel_index(int(np.argmax(factor)), factor.shape)
    hertz = answer.order[line] / (2.0 * np.pi)
    return Resonance(int(line) + 1, float(hertz), float(answer.modes.hertz[mode]), float(factor[line, mode]))


def _warnings(resonance: Resonance | None) -> tuple[str, ...]:
    said = []
    if resonance is not None and resonance.factor > 5.0:
        said.append(
            f"near resonance: harmonic {resonance.harmonic} ({resonance.frequency:.4g} Hz) meets the natural "
            f"frequency {resonance.natural_frequency:.4g} Hz and is multiplied by {resonance.factor:.3g}; "
            f"the result rests on the damping ratio"
        )
    return tuple(said)
