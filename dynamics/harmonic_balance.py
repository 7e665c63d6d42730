"""Steady periodic motion of a linear system with local forces that are not linear or not constant.

    loads F_h, speed Ω ──► receptance H_h of the linear part (with each local stiffness k_e in it)
                           │
    deflections δ = Bᵀ x ──┴─► local forces at N instants ──► their harmonics f_h − k_e δ_h
                           └── δ_h = Bᵀ H_h (F_h − B (f − k_e δ)_h): Newton on the few δ, not on all x

The unknowns are the harmonics of the local deflections alone: a drive with 30 coordinates and one gap is as
small a problem as the gap itself.  With e^{ihΩt}, x(t) = Re Σ X_h e^{ihφ}, φ = Ωt.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from trochoid.dynamics.continuation import crossings
from trochoid.dynamics.local_law import Local
from trochoid.dynamics.system import System, free_part, receptance, static_receptance
from trochoid.kinematics.errors import NotConverged, TrochoidError
from trochoid.kinematics.types import Array, ComplexArray, frozen

TOLERANCE = 1e-10
STEPS = 60
GENTLE = 1e-3  # share of the varying load at which its motion is found without fail
RUNAWAY = 1e6  # times the linear motion: where nothing holds, Newton runs away
SAMPLES = 16  # instants per harmonic: kinks of a gap fold down from far above


@dataclass(frozen=True, eq=False, slots=True)
class Periodic:
    """A steady motion at `speed` (rad/s): peak `amplitudes` (H + 1, n), complex, row 0 the mean.

    Over N instants of the period, `phase` (N,): local `deflection` and `force` (N, m).  `unknowns` continue it;
    `side` is the sign of the equations' determinant, which changes at every fold of the curve of motions.
    """

    speed: float
    amplitudes: ComplexArray
    phase: Array
    deflection: Array
    force: Array
    unknowns: Array
    side: int
    iterations: int

    @property
    def peak_to_peak(self) -> Array:
        """Swing (m,) of each local deflection."""
        return np.asarray(np.ptp(self.deflection, axis=0))


@dataclass(frozen=True, eq=False)
class Balance:
    """The equations of one speed: `offset` (H + 1, m) of the deflections under the loads alone, `answer`
    (H + 1, m, m) to local forces, `waves` (N, 2H + 1) from real coefficients to instants and `back` the way back.
    """

    speed: float
    locals: Sequence[Local]
    offset: ComplexArray
    answer: ComplexArray
    waves: Array
    back: Array
    phase: Array

    def instants(self, unknowns: Array) -> Array:
        """Deflections (N, m) at all instants from the unknowns (2H + 1, m)."""
        return np.asarray(self.waves @ unknowns)

    def forces(self, deflection: Array) -> tuple[Array, Array]:
        """Local forces less their constant part, and the slopes of that, (N, m) each."""
        pairs = [each.law(deflection[:, i], self.phase) for i, each in enumerate(self.locals)]
        k = np.array([each.stiffness for each in self.locals])
        force = np.stack([pair[0] for pair in pairs], axis=1) - k * deflection
        return force, np.stack([pair[1] for pair in pairs], axis=1) - k

    def residual(self, unknowns: Array) -> tuple[Array, Array]:
        """Return δ − Bᵀ H (F − B f(δ)) (2H + 1, m) and the slopes (N, m) at these unknowns."""
        force, slope = self.forces(self.instants(unknowns))
        lines = _complex(self.back @ force)
        wanted = self.offset - np.einsum("hij,hj->hi", self.answer, lines)
        return unknowns - _real(wanted), slope

    def jacobian(self, slope: Array) -> Array:
        """Return the derivative ((2H + 1) m, (2H + 1) m) of the residual."""
        count, m = self.waves.shape[1], slope.shape[1]
        changes = np.einsum("cn,nj,nd->cdj", self.back, slope, self.waves)  # of the force's lines, by local
        full = np.zeros((count, m, count, m))
        for j in range(m):
            lines = _complex(changes[:, :, j])  # (H + 1, 2H + 1)
            moved = np.einsum("hi,hd->hid", self.answer[:, :, j], lines)
            full[:, :, :, j] = _real(moved.reshape(len(lines), -1)).reshape(count, m, count)
        return np.asarray(np.eye(count * m) + full.reshape(count * m, count * m))


def balance(
    system: System, locals_: Sequence[Local], loads: ComplexArray, speed: float, samples: int | None = None
) -> Balance:
    """Set up the equations for `loads` (H + 1, n), peak values, row 0 their mean, at `speed` (rad/s).

    Raises TrochoidError for a speed that is not positive, a mean load without equilibrium, an undamped resonance.
    """
    if not (np.isfinite(speed) and speed > 0.0):
        raise TrochoidError(f"a periodic motion needs a speed above 0, given {speed} rad/s")
    lines = np.asarray(loads, dtype=np.complex128)
    harmonics = len(lines) - 1
    if harmonics < 1 or lines.shape[1:] != (system.size,):
        raise TrochoidError(
            f"loads must be (harmonics + 1, {system.size}) with a harmonic, given {lines.shape}"
        )
    directions = np.stack([each.direction for each in locals_], axis=1)
    linear = _with_local_stiffness(system, locals_)
    if free_part(linear, lines[0].real):
        raise TrochoidError(
            "the mean loads are not in equilibrium: a free member would run away; the torques on it must sum to 0"
        )
    at = speed * np.arange(1.0, harmonics + 1.0)
    gain = receptance(
        linear, at, directions
    )  # (H, n, m): the matrices are not symmetric with gyroscopic terms
    static = static_receptance(linear, np.column_stack([directions, lines[0].real]))
    answer = np.concatenate([(directions.T @ static[:, :-1])[None], directions.T @ gain])
    driven = _driven(linear, at, lines)
    offset = np.concatenate([(directions.T @ static[:, -1])[None], driven @ directions])
    count = samples or SAMPLES * harmonics
    phase: Array = 2.0 * np.pi * np.arange(count) / count
    waves, back = _transforms(harmonics, phase)
    return Balance(speed, tuple(locals_), offset, answer, waves, back, phase)


def steady(
    system: System,
    locals_: Sequence[Local],
    loads: ComplexArray,
    speed: float,
    start: Array | None = None,
    samples: int | None = None,
) -> Periodic:
    """Return the steady motion next to the unknowns `start` (those of a neighbouring speed; default: linear).

    Arguments as for `balance`.  Raises NotConverged where no motion is found.
    """
    equations = balance(system, locals_, loads, speed, samples)
    if start is not None:
        return _settled(system, equations, loads, start)
    with suppress(NotConverged):
        return _settled(system, equations, loads, _loaded(equations))
    # from the load that stands still, the part that varies grows
    lines = np.asarray(loads, dtype=np.complex128)
    shares = np.ones(len(lines))

    def made(share: float) -> Balance:
        shares[1:] = share
        return balance(system, locals_, lines * shares[:, None], speed, samples)

    first = made(GENTLE)
    slowly = crossings(made, _settled(system, first, lines, _loaded(first)).unknowns, GENTLE, 1.0, 0.05)
    return _settled(system, equations, loads, next(slowly))


def _settled(system: System, equations: Balance, loads: ComplexArray, start: Array) -> Periodic:
    """Return the motion to which Newton's steps lead from `start`; raises NotConverged."""
    unknowns = np.array(start, dtype=np.float64)
    far = RUNAWAY * float(np.abs(_loaded(equations)).max(initial=0.0))
    for step in range(STEPS):
        residual, slope = equations.residual(unknowns)
        size = float(np.abs(residual).max())
        if float(np.abs(unknowns).max(initial=0.0)) > far:
            break
        if size <= TOLERANCE * max(float(np.abs(unknowns).max(initial=0.0)), 1e-300):
            side = int(np.linalg.slogdet(equations.jacobian(slope))[0])
            return _periodic(system, equations, loads, unknowns, (side, step))
        change = np.linalg.solve(equations.jacobian(slope), -residual.ravel())
        unknowns = _damped(equations, unknowns, np.asarray(change.reshape(unknowns.shape)), size)
    raise NotConverged(
        f"no steady motion was found at {equations.speed:.6g} rad/s in {STEPS} steps (residual {size:.2g} m); start "
        "from a neighbouring speed (sweep), or take more harmonics or more damping"
    )


def _loaded(equations: Balance) -> Array:
    """Return the linear motion, its mean beyond the play on the side to which the loads push."""
    unknowns = _real(equations.offset)
    unknowns[0] += np.sign(unknowns[0]) * [each.play for each in equations.locals]
    return np.asarray(unknowns)


def _damped(equations: Balance, unknowns: Array, change: Array, size: float) -> Array:
    """Return the step, shortened until the residual falls; the last trial when it never does."""
    share = 1.0
    for _ in range(6):
        trial = np.asarray(unknowns + share * change)
        if float(np.abs(equations.residual(trial)[0]).max()) < size:
            break
        share *= 0.5
    return trial


def _periodic(
    system: System, equations: Balance, loads: ComplexArray, unknowns: Array, found: tuple[int, int]
) -> Periodic:
    deflection = equations.instants(unknowns)
    change, _ = equations.forces(deflection)
    stiffness = np.array([each.stiffness for each in equations.locals])
    directions = np.stack([each.direction for each in equations.locals], axis=1)
    linear = _with_local_stiffness(system, equations.locals)
    lines = np.asarray(loads) - _complex(equations.back @ change) @ directions.T
    at = equations.speed * np.arange(1.0, len(lines))
    mean = static_receptance(linear, lines[0].real[:, None])[:, 0]
    amplitudes = np.concatenate([mean[None], _driven(linear, at, lines)])
    amplitudes.setflags(write=False)
    force = change + stiffness * deflection
    return Periodic(
        equations.speed,
        amplitudes,
        equations.phase,
        frozen(deflection),
        frozen(force),
        frozen(unknowns),
        *found,
    )


def _driven(system: System, at: Array, lines: ComplexArray) -> ComplexArray:
    """Return the motion (H, n) under the loads of each harmonic, (H + 1, n)."""
    moved = [
        receptance(system, omega, load[:, None])[:, 0] if load.any() else np.zeros(system.size)
        for omega, load in zip(at, lines[1:], strict=True)
    ]
    return np.asarray(moved, dtype=np.complex128)


def _with_local_stiffness(system: System, locals_: Sequence[Local]) -> System:
    stiffness = np.array(system.stiffness, dtype=np.float64)
    for each in locals_:
        stiffness += each.stiffness * np.outer(each.direction, each.direction)
    return System(system.mass, system.damping, stiffness, system.gyroscopic, system.names)


def _transforms(harmonics: int, phase: Array) -> tuple[Array, Array]:
    """Return (N, 2H + 1) from coefficients 1, cos hφ, sin hφ to instants, and (2H + 1, N) back."""
    order = np.arange(1, harmonics + 1)
    angle = np.multiply.outer(phase, order)
    waves = np.column_stack([np.ones(len(phase)), np.cos(angle), np.sin(angle)])
    back = waves.T * (2.0 / len(phase))
    back[0] *= 0.5
    return waves, np.asarray(back)


def _complex(coefficients: Array) -> ComplexArray:
    """Return peak amplitudes (H + 1, ...) of coefficients (2H + 1, ...): a cos + b sin = Re (a − ib) e^{iφ}."""
    h = (len(coefficients) - 1) // 2
    lines = coefficients[1 : h + 1] - 1j * coefficients[h + 1 :]
    return np.concatenate([coefficients[:1].astype(np.complex128), lines])


def _real(lines: ComplexArray) -> Array:
    """Return coefficients (2H + 1, ...) of peak amplitudes (H + 1, ...)."""
    return np.concatenate([lines[:1].real, lines[1:].real, -lines[1:].imag])
