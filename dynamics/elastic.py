"""Stiffness-aware motion: what the inertia of elastic members adds to their quasi-static motion.

Members that yield under the rotating loads do not stay on their rigid paths.  With q the quasi-static
motion, w = q + y obeys

    M ẅ + G ẇ + K_c w + C (ẏ + R y) + K(φ) y = 0

in a frame in which K(φ) varies little: G, K_c and R are what its turning adds (dynamics.turning), nothing where it
stands.  The moving mass adds inertia forces, and where a harmonic comes near a natural frequency it is amplified.  That
is the whole difference between rigid and elastic reactions; it falls with 1/K.  C is modal; each spring takes the part
of it that belongs to its share of K̄, y + T (ẏ + R y) with C = K̄ T, so that forces and inertia balance exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.dynamics.hill import rate, steady
from trochoid.dynamics.modes import FrequencyResponse, Modes, natural_modes
from trochoid.dynamics.spectrum import harmonics, synthesize
from trochoid.dynamics.system import System
from trochoid.dynamics.whirl import whirl
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, ComplexArray, frozen


@dataclass(frozen=True, eq=False, slots=True)
class Frame:
    """What a turning frame adds, (n, n) each: skew `gyroscopic` G, symmetric `centrifugal` K_c, and the `rate` R by
    which a velocity that damping feels is ẏ + R y; 0 where what damps turns with the frame.  `seen` says from where, as
    in ", seen from the eccentric".
    """

    gyroscopic: Array
    centrifugal: Array
    rate: Array
    seen: str = ""


@dataclass(frozen=True, slots=True)
class Resonance:
    """The excited mode with the largest amplification: `factor` = |spring force / its quasi-static value|.

    Frequencies in Hz, `seen` from the frame of the response.
    """

    harmonic: int
    frequency: float
    natural_frequency: float
    factor: float
    seen: str = ""


@dataclass(frozen=True, slots=True)
class Response:
    """Motion of elastic members over one record of n_pos positions, n coordinates, along the axes of the frame.

    `motion` = q + y, `correction` = y, `spring_correction` = y + T (ẏ + R y) (deflection whose springs give the
    force with damping), `velocity` = ẏ; `acceleration` M⁻¹ (M ẅ + G ẇ + K_c w), with that of the frame, and `inertia`,
    −M times it, = K y + K̄ T (ẏ + R y), all (n_pos, n).  `frequencies` (nh,) Hz and peak `amplitudes` (nh, n) of the
    motion for harmonics 1…nh, `natural_frequencies` (n,) Hz of the frame at standstill.  `stiffness_variation` is the
    largest relative departure of K(φ) from its mean, `variation_effect` how much of the motion y comes from it,
    relative.  `damper` C (n, n); `loss` W, what it takes on average.
    """

    motion: Array
    correction: Array
    spring_correction: Array
    velocity: Array
    acceleration: Array
    inertia: Array
    frequencies: Array
    amplitudes: ComplexArray
    natural_frequencies: Array
    resonance: Resonance | None
    stiffness_variation: float
    variation_effect: float
    damper: Array
    loss: float
    warnings: tuple[str, ...]


def respond(
    motion: Array,
    mass: Array,
    stiffness: Array,
    speed: float,
    damping_ratio: float = 0.02,
    frame: Frame | None = None,
    named: Array | None = None,
) -> Response:
    """Return the response to a quasi-static `motion` (n_pos, n), periodic with the angular `speed` in rad/s.

    `mass` (n, n); `stiffness` (n, n) or (n_pos, n, n); `damping_ratio` of every mode of the mean stiffness at
    standstill; `frame`: the one along whose axes all of it is; `named` (n, n): the stiffness whose modes a resonance is
    named by, the mean where it is None.  Free modes are allowed: no net force acts on them, so
    their harmonics vanish.  Raises for speed ≤ 0, fewer than 3 positions, bad matrices, and resonance without damping;
    NotConverged where a stiffness that varies leaves no steady motion.
    """
    q, stiffnesses = _checked(motion, stiffness, speed, damping_ratio)
    mean, mass = stiffnesses.mean(axis=0), np.asarray(mass, dtype=np.float64)
    basis = natural_modes(mass, mean)
    none = np.zeros_like(mass)
    turns = Frame(none, none, none) if frame is None else frame
    damper, delay = modal_damper(mass, basis, damping_ratio)
    lines = harmonics(q)
    lines[0] *= 0.0 if frame is None else 1.0
    still = synthesize(lines, len(q))

    def inertia(record: Array) -> Array:
        turned = rate(record, speed) @ turns.gyroscopic.T + record @ turns.centrifugal.T
        return -rate(record, speed, 2) @ mass - turned

    velocity_matrix = damper + turns.gyroscopic
    aside = turns.centrifugal + damper @ turns.rate
    load = inertia(still)
    first = steady(mass, velocity_matrix, (mean + aside)[None], load, speed)
    correction = first
    if len(stiffnesses) > 1:
        correction = steady(mass, velocity_matrix, stiffnesses + aside, load, speed)
    velocity = rate(correction, speed)
    felt = velocity + correction @ turns.rate.T
    named_by = mean if named is None else np.asarray(named)
    own = basis if named is None else natural_modes(mass, named_by)
    resonance = _strongest(mass, named_by, own, frame, lines, speed, damping_ratio)
    amplitudes = np.array(harmonics(q + correction)[1:])
    amplitudes.setflags(write=False)
    pushed = inertia(still + correction)
    return Response(
        motion=frozen(q + correction),
        correction=frozen(correction),
        spring_correction=frozen(correction + felt @ delay.T),
        velocity=frozen(velocity),
        acceleration=frozen(-np.linalg.solve(mass, pushed.T).T),
        inertia=frozen(pushed),
        frequencies=frozen(speed * np.arange(1.0, len(lines)) / (2.0 * np.pi)),
        amplitudes=amplitudes,
        natural_frequencies=basis.hertz,
        resonance=resonance,
        stiffness_variation=departure(stiffnesses),
        variation_effect=_relative(correction - first, correction, mean),
        damper=frozen(damper),
        loss=float((felt * (felt @ damper)).sum(axis=1).mean()),
        warnings=_warnings(resonance),
    )


def modal_damper(mass: Array, modes: Modes, ratio: float) -> tuple[Array, Array]:
    """Return C and T (n, n), C = K T, by which every mode has the damping `ratio`; free ones are not damped."""
    natural, weighted = modes.angular_frequencies, mass @ modes.shapes
    slow = np.divide(2.0 * ratio, natural, out=np.zeros_like(natural), where=natural > 0.0)
    return (weighted * (2.0 * ratio * natural)) @ weighted.T, (modes.shapes * slow) @ weighted.T


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
        f"{text}; harmonic {peak.harmonic} ({peak.frequency:.4g} Hz{peak.seen}) meets the mode at "
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


def departure(stiffnesses: Array) -> float:
    """Return the largest departure of K(φ) (n, k, k) from its mean, relative to the mean's diagonal."""
    mean = stiffnesses.mean(axis=0)
    size = np.sqrt(np.abs(np.diag(mean)))
    scale = np.divide(1.0, size, out=np.zeros_like(size), where=size > 0.0)
    return float(np.linalg.norm((stiffnesses - mean) * np.outer(scale, scale), ord=2, axis=(1, 2)).max())


def _relative(part: Array, whole: Array, mean: Array) -> float:
    """Return the size of one motion over another's, coordinates weighted by their stiffness."""
    size = np.sqrt(np.abs(np.diag(mean)))
    reach = float(np.linalg.norm(whole * size))
    return float(np.linalg.norm(part * size)) / reach if reach > 0.0 else 0.0


def _strongest(
    mass: Array,
    mean: Array,
    basis: Modes,
    frame: Frame | None,
    lines: ComplexArray,
    speed: float,
    ratio: float,
) -> Resonance | None:
    """Return the most amplified line among those with at least 1 % of the largest quasi-static effort.

    In a turning frame the modes are those that whirl there, each amplified as if it were alone.
    """
    shapes: ComplexArray | Array = basis.shapes
    modes = basis
    if frame is not None:
        found = whirl(System(mass, 0.0 * mass, mean + frame.centrifugal, frame.gyroscopic))
        norm = np.sqrt(np.einsum("im,ij,jm->m", np.conj(found.shapes), mass, found.shapes).real)
        shapes = found.shapes / norm
        modes = Modes(frozen(2.0 * np.pi * found.frequency), basis.shapes)
    order: Array = speed * np.arange(1.0, len(lines))
    answer = FrequencyResponse(modes, order, ratio)
    natural = modes.angular_frequencies
    still = lines[1:] @ mass
    weight = np.maximum(np.abs(still @ shapes), np.abs(still @ np.conj(shapes))) * natural
    if not weight.any():
        return None
    below = answer.denominator()
    below = np.where(below == 0.0, np.inf, below)
    factor = np.abs(natural**2 * answer.spring_factor() / below) * (weight >= 0.01 * weight.max())
    line, mode = np.unravel_index(int(np.argmax(factor)), factor.shape)
    hertz = order[line] / (2.0 * np.pi)
    own = natural[mode] / (2.0 * np.pi)
    seen = "" if frame is None else frame.seen
    return Resonance(int(line) + 1, float(hertz), float(own), float(factor[line, mode]), seen)


def _warnings(resonance: Resonance | None) -> tuple[str, ...]:
    said = []
    if resonance is not None and resonance.factor > 5.0:
        said.append(
            f"near resonance: harmonic {resonance.harmonic} ({resonance.frequency:.4g} Hz{resonance.seen}) meets the "
            f"natural frequency {resonance.natural_frequency:.4g} Hz and is multiplied by {resonance.factor:.3g}; "
            f"the result rests on the damping ratio"
        )
    return tuple(said)
