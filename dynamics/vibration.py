"""Vibration velocity of a casing under all that members put on it: rigid, under their vector sum, or elastic."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.dynamics.casing import Casing, Triple, follow, matrices
from trochoid.dynamics.modes import natural_modes
from trochoid.dynamics.spectrum import harmonics
from trochoid.dynamics.wrench import Wrench, moved, total
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, ComplexArray, frozen

if TYPE_CHECKING:
    from trochoid.dynamics.structure import Structure

BAND = (10.0, 1000.0)


@dataclass(frozen=True, slots=True)
class Point:
    """A place on the casing where the velocity is reported."""

    name: str
    position: Triple


@dataclass(frozen=True, slots=True)
class Vibration:
    """Velocity at named points.

    `frequencies` (nf,) Hz, complex peak `velocity` (points, 3, nf) m/s of every resolved line; `rms`
    (points, 3) by direction and `rms_vector` (points,) over `band`; `rms_max` the largest of `rms`, at
    `worst` (point, direction). `resolved_to` Hz is what the sampling shows; `upper_share` the part of the
    worst rms² in the upper third of the lines: when it is not small, there is more above.
    `natural_frequencies` Hz are those of the casing on its mounts, of an elastic one as far as it keeps modes.
    """

    points: tuple[Point, ...]
    frequencies: Array
    velocity: ComplexArray
    rms: Array
    rms_vector: Array
    rms_max: float
    worst: tuple[str, str]
    natural_frequencies: Array
    band: tuple[float, float]
    resolved_to: float
    upper_share: float
    warnings: tuple[str, ...]


def vibrate(
    casing: Casing | Structure,
    load: Wrench | Mapping[str, Wrench],
    base_frequency: float,
    points: Sequence[Point],
    band: tuple[float, float] = BAND,
) -> Vibration:
    """Return the steady vibration under a periodic `load` whose record lasts 1/`base_frequency` seconds.

    A rigid casing feels the vector sum of its loads, wherever they act; an elastic one (`structure`) is told where:
    a wrench by the name of each seat, and its points are those that it is read at.  Lines h·base_frequency below
    Nyquist's, no others; the mean is static and no vibration.  Raises for a frequency that is not positive, no
    points, fewer than 3 positions, and an excited resonance without damping.
    """
    if not (np.isfinite(base_frequency) and base_frequency > 0.0) or not points:
        raise TrochoidError(
            f"vibration needs a speed above 0 and at least one point, given {base_frequency} Hz and "
            f"{len(points)} points"
        )
    if not isinstance(casing, Casing):
        return _elastic(casing, load, base_frequency, points, band)
    whole = load if isinstance(load, Wrench) else total(tuple(load.values()))
    at_center = moved(whole, casing.center)
    lines = harmonics(np.concatenate([at_center.force, at_center.moment], axis=1))[1:]
    frequencies: Array = base_frequency * np.arange(1.0, len(lines) + 1.0)
    mass, damping, stiffness = matrices(casing)
    motion = _velocity(mass, damping, stiffness, 2.0 * np.pi * frequencies, lines)
    maps = np.stack([follow(point.position, casing.center) for point in points])
    velocity = np.einsum("pij,fj->pif", maps, motion)
    return _evaluate(tuple(points), frequencies, velocity, band, natural_modes(mass, stiffness).hertz)


def _elastic(
    structure: Structure,
    load: Wrench | Mapping[str, Wrench],
    base_frequency: float,
    points: Sequence[Point],
    band: tuple[float, float],
) -> Vibration:
    from trochoid.dynamics.structure import loads_on, velocities

    if isinstance(load, Wrench):
        raise TrochoidError(
            "an elastic casing must be told where its loads act: give a wrench by the name of each seat, of "
            f"{', '.join(structure.seats)}"
        )
    unread = [point.name for point in points if point.name not in structure.points]
    if unread:
        raise TrochoidError(
            f"the elastic casing is not read at {', '.join(unread)}; its points are {', '.join(structure.points)}"
        )
    lines = harmonics(loads_on(structure, load))[1:]
    frequencies: Array = base_frequency * np.arange(1.0, len(lines) + 1.0)
    motion = velocities(structure, 2.0 * np.pi * frequencies, lines)
    maps = np.stack([structure.points[point.name].motion[:3] for point in points])
    velocity = np.asarray(np.einsum("pij,fj->pif", maps, motion))
    natural = natural_modes(structure.mass, structure.stiffness).hertz
    natural = natural[natural <= structure.upper]  # those above are of static shapes, not of modes
    found = _evaluate(tuple(points), frequencies, velocity, band, natural)
    if structure.upper >= band[1]:
        return found
    said = f"the elastic casing keeps modes up to {structure.upper:.4g} Hz, the band ends at {band[1]:.4g} Hz"
    return replace(found, warnings=(*found.warnings, f"{said}; reduce it with modes up to twice that"))


def positions_for(frequency: float, base_frequency: float) -> int:
    """Return how many positions over the record resolve lines up to `frequency`."""
    return 2 * int(np.ceil(frequency / base_frequency)) + 1


def _velocity(
    mass: Array, damping: Array, stiffness: Array, angular: Array, lines: ComplexArray
) -> ComplexArray:
    """Solve (K + iΩC − Ω²M) u = f for every line and return iΩ u (nf, 6)."""
    size = 1.0 / np.sqrt(np.diag(mass))
    scale = np.outer(size, size)
    omega = angular[:, None, None]
    dynamic = (stiffness + 1j * omega * damping - omega**2 * mass) * scale
    flat = np.linalg.svd(dynamic, compute_uv=False)[:, -1] <= 1e-8 * angular**2
    forces = lines * size
    heard = np.linalg.norm(forces, axis=1) > 1e-13 * np.abs(forces).max(initial=0.0)
    if (flat & heard).any():
        line = int(np.flatnonzero(flat & heard)[0])
        raise TrochoidError(
            f"harmonic {line + 1} ({angular[line] / 2 / np.pi:.6g} Hz) coincides with a natural frequency of "
            f"the casing on its mounts and there is no damping; give the mounts some (casing.mounts.damping)"
        )
    motion = np.zeros(forces.shape, dtype=np.complex128)
    if heard.any():
        motion[heard] = np.linalg.solve(dynamic[heard], forces[heard][:, :, None])[:, :, 0]
    return np.asarray(1j * angular[:, None] * motion * size, dtype=np.complex128)


def _evaluate(
    points: tuple[Point, ...],
    frequencies: Array,
    velocity: ComplexArray,
    band: tuple[float, float],
    natural: Array,
) -> Vibration:
    edge = 1e-9 * frequencies[0]
    inside = (frequencies >= band[0] - edge) & (frequencies <= band[1] + edge)
    power = 0.5 * np.abs(velocity) ** 2 * inside
    rms = np.sqrt(power.sum(axis=2))
    point, direction = np.unravel_index(int(np.argmax(rms)), rms.shape)
    lines = power[point, direction]
    whole = float(lines.sum())
    upper = float(lines[2 * len(lines) // 3 :].sum()) / whole if whole > 0.0 else 0.0
    velocity.setflags(write=False)
    return Vibration(
        points=points,
        frequencies=frozen(frequencies),
        velocity=velocity,
        rms=frozen(rms),
        rms_vector=frozen(np.sqrt((rms**2).sum(axis=1))),
        rms_max=float(rms.max()),
        worst=(points[point].name, "xyz"[direction]),
        natural_frequencies=natural,
        band=band,
        resolved_to=float(frequencies[-1]),
        upper_share=upper,
        warnings=_warnings(frequencies, band, upper),
    )


def _warnings(frequencies: Array, band: tuple[float, float], upper: float) -> tuple[str, ...]:
    said = []
    if frequencies[-1] + frequencies[0] <= band[1]:
        need = positions_for(band[1], float(frequencies[0]))
        said.append(
            f"the positions resolve vibration up to {frequencies[-1]:.4g} Hz of {band[1]:.4g} Hz; "
            f"{need} positions (ask.positions) cover the whole band"
        )
    if upper > 0.1:
        said.append(
            f"{100.0 * upper:.0f} % of the vibration's power is in the upper third of the resolved lines: "
            f"higher ones are missing or folded down; raise ask.positions"
        )
    return tuple(said)
